// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_picture.h"
#include "program.h"
#include "test_paths.h"

#include <homeward/camera/camera_file.h>
#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

namespace homeward
{
namespace
{

using testing::HasSubstr;
using testing::Not;

TEST(CalibrateTool, printsTargetsToScale)
{
  const Folder folder;
  const std::string pdf = folder / "board.pdf";
  const ProgramRun run = runProgram("target --columns 6 --rows 4 --pitch 30 --pdf " + pdf +
                                    " --svg " + (folder / "b.svg"));
  ASSERT_EQ(run.status, 0) << run.output;
  // 7 squares of 30 mm and twice 18 mm of margin are 246 mm: 697.32 points of 1/72 inch.
  EXPECT_THAT(fileText(pdf), HasSubstr("/MediaBox [ 0 0 697.32"));
  EXPECT_THAT(fileText(folder / "b.svg"), HasSubstr("width=\"697.32"));
}

TEST(CalibrateTool, saysWhenATargetDoesNotFit)
{
  const Folder folder;
  const ProgramRun run = runProgram("target --pitch 60 --paper a4 --pdf " + (folder / "b.pdf"));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("paper a4 has 210 mm by 297 mm"));
}

TEST(CalibrateTool, refusesBadUsage)
{
  EXPECT_EQ(runProgram("").status, 2);
  EXPECT_EQ(runProgram("target").status, 2);
  EXPECT_EQ(runProgram("x.png --target checkers").status, 2);
  EXPECT_EQ(runProgram("x.png --target charuco --pitch -3").status, 2);
  EXPECT_EQ(runProgram("--help").status, 0);
  EXPECT_THAT(runProgram("--help").output, HasSubstr("Example: homeward-calibrate"));
}

TEST(CalibrateTool, namesThePictureThatIsWrong)
{
  const Folder folder;
  std::ofstream(folder / "text.png") << "no picture";
  cv::imwrite(folder / "a.png", cv::Mat1b(48, 64, uchar{90}));
  cv::imwrite(folder / "b.png", cv::Mat1b(40, 64, uchar{90}));
  EXPECT_THAT(runProgram(folder / "text.png").output, HasSubstr("text.png"));
  EXPECT_EQ(runProgram(folder / "text.png").status, 2);
  const ProgramRun sizes = runProgram((folder / "a.png") + " " + (folder / "b.png"));
  EXPECT_EQ(sizes.status, 2);
  EXPECT_THAT(sizes.output, HasSubstr("b.png has 64 x 40 pixels"));
  EXPECT_THAT(runProgram(folder / "a.png").output, HasSubstr("check --target"));
}

TEST(CalibrateTool, calibratesQuicklyFromARoom)
{
  const Folder folder;
  const std::string camera = folder / "camera.yaml";
  const ProgramRun run = runProgram("quick " + (dataDir() / "samples/mirror.jpg").string() +
                                    " -o " + camera + " --json - --panorama " + (folder / "p.png"));
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_NEAR(parseMirrorCamera(fileText(camera), camera).model.parameters().cx, 319.5, 4.0);
  EXPECT_FALSE(cv::imread(folder / "p.png").empty());
  EXPECT_TRUE(nlohmann::json::parse(run.data).contains("assumed"));
}

/** Boards in a small mirror: one picture of 16 bits, one in colour, the rest gray. */
void paintPictures(const Folder &folder, const Target &target, int count)
{
  const UnifiedCamera camera({0.95, 190, 190, 330.0, 236.0, 0, 0, 0, 0}, 640, 480);
  const BoardPainter painter([&](const Eigen::Vector2d &pixel) { return camera.unproject(pixel); },
                             {{640, 480}, {330.0, 236.0}, 40.0, 230.0}, target);
  Random random(2, 1);
  int number = 0;
  for (const auto &cMo : posesRound(count, {0.12, 0.06, 0.0}, 0.3, 0.4, random, radians(2.0))) {
    cv::Mat picture = painter.paint(cMo, random);
    if (number == 0) {
      picture.convertTo(picture, CV_16U, 200.0);
    }
    if (number == 1) {
      cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
    }
    std::string name = "board";
    name.append(std::to_string(number++)).append(".png");
    cv::imwrite(folder / name, picture);
  }
}

TEST(CalibrateTool, makesCameraFileJsonAndReport)
{
  const Folder folder;
  paintPictures(folder, {TargetKind::Charuco, 6, 4, 0.06}, 9);
  const std::string camera = folder / "camera.yaml";
  const std::string report = folder / "report.html";
  std::string arguments = "--target charuco --columns 6 --rows 4 --pitch 60 -o " + camera;
  arguments.append(" --json ").append(folder / "out.json").append(" --report ").append(report);
  arguments.append(" '").append(folder / "board*.png").append("'");
  const ProgramRun run = runProgram(arguments);
  ASSERT_EQ(run.status, 0) << run.output;
  const auto json = nlohmann::json::parse(fileText(folder / "out.json"));
  for (const char *key :
       {"schema", "version", "command", "seed", "wall_time_s", "model", "parameters", "rms_px",
        "robust_rms_px", "heldout_rms_px", "views", "boards_found", "outliers"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["boards_found"], 9);
  EXPECT_NEAR(json["parameters"]["cx"]["value"].get<double>(), 330.0, 0.5);
  EXPECT_GT(json["parameters"]["fx"]["sigma"].get<double>(), 0.0);
  EXPECT_NEAR(parseMirrorCamera(fileText(camera), camera).model.parameters().cy, 236.0, 0.5);
  const std::string html = fileText(report);
  EXPECT_THAT(html, HasSubstr("Residual histogram"));
  EXPECT_THAT(html, HasSubstr("data:image/jpeg;base64,"));
  EXPECT_THAT(html, Not(HasSubstr("src=\"http")));
}

TEST(CalibrateTool, convertsThereAndBack)
{
  const Folder folder;
  const std::string camera = folder / "camera.yaml";
  std::ofstream(camera) << formatMirrorCamera(
      {UnifiedCamera({0.95, 277, 277, 651, 472, 0, 0, 0, 0}, 1280, 960), {90.0, 450.0}, {}});
  const std::string ocam = folder / "calib_results.txt";
  const ProgramRun there =
      runProgram("convert " + camera + " " + ocam + " --to ocamcalib --model ocam --json -");
  ASSERT_EQ(there.status, 0) << there.output;
  const auto json = nlohmann::json::parse(there.data);
  EXPECT_LT(json["mean_px"].get<double>(), json["largest_px"].get<double>());
  EXPECT_LT(json["largest_px"].get<double>(), 1.0);
  const std::string again = folder / "again.yml";
  const ProgramRun back =
      runProgram("convert " + ocam + " " + again + " --to opencv --model unified");
  ASSERT_EQ(back.status, 0) << back.output;
  EXPECT_THAT(back.output, HasSubstr("ocam as unified: off by "));
  EXPECT_THAT(fileText(again), HasSubstr("xi"));
}

TEST(CalibrateTool, keepsOrFindsTheMirrorOfACameraThatIsConverted)
{
  const Folder folder;
  const std::string camera = folder / "camera.yaml";
  std::ofstream(camera) << formatMirrorCamera(
      {UnifiedCamera({0.95, 190, 190, 330, 236, 0, 0, 0, 0}, 640, 480),
       {44.0, 227.0},
       {0.5, false}});
  const std::string before = fileText(camera);
  EXPECT_EQ(runProgram("convert " + camera + " " + camera).status, 0);
  EXPECT_EQ(fileText(camera), before);

  const std::string foreign = folder / "foreign.yaml";
  EXPECT_EQ(runProgram("convert " + camera + " " + foreign + " --to kalibr").status, 0);
  const std::string bare = folder / "bare.yaml";
  const ProgramRun said = runProgram("convert " + foreign + " " + bare);
  EXPECT_THAT(said.output, HasSubstr("--picture"));
  EXPECT_THROW(parseMirrorCamera(fileText(bare), bare), ConfigError);
  paintPictures(folder, {TargetKind::Chessboard, 9, 6, 0.03}, 3);
  const ProgramRun whole = runProgram("convert " + foreign + " " + bare +
                                      " --forward 30 --picture " + (folder / "board2.png"));
  ASSERT_EQ(whole.status, 0) << whole.output;
  const MirrorCamera found = parseMirrorCamera(fileText(bare), bare);
  EXPECT_NEAR(found.ring.outer, 227.0, 3.0);
  EXPECT_NEAR(found.ring.inner, 43.0, 3.0);
  EXPECT_NEAR(found.mount.forward, radians(30.0), 1e-9);
}

TEST(CalibrateTool, countsAPictureOnce)
{
  const Folder folder;
  paintPictures(folder, {TargetKind::Charuco, 6, 4, 0.06}, 9);
  const std::string pictures = " '" + (folder / "board*.png") + "'";
  const ProgramRun run = runProgram("--target charuco --columns 6 --rows 4 --pitch 60 -o " +
                                    (folder / "camera.yaml") + pictures + pictures);
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("left out"));
  EXPECT_THAT(run.output, HasSubstr("9 of 9 boards"));
}

TEST(CalibrateTool, refusesWhatIsNoCamera)
{
  const Folder folder;
  std::ofstream(folder / "text.yaml") << "no camera";
  for (const std::string input : {"text.yaml", "missing.yaml"}) {
    const ProgramRun run =
        runProgram("convert " + (folder / input) + " " + (folder / "out.yaml") + " --to visp");
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.output, HasSubstr(input));
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.yaml"));
  }
  EXPECT_EQ(runProgram("convert a.yaml b.yaml --to xls").status, 2);
}

} // namespace
} // namespace homeward
