// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_picture.h"
#include "picture_stream.h"
#include "program.h"

#include <homeward/camera/camera_file.h>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

namespace homeward
{
namespace
{

using testing::HasSubstr;

constexpr const char *kTarget = " --target charuco --columns 6 --rows 4 --pitch 60 ";

/** A board that somebody carries round a mirror, as JPEGs. */
std::vector<std::string> boardRoundAMirror(int count)
{
  const UnifiedCamera camera({0.95, 190, 190, 330.0, 236.0, 0, 0, 0, 0}, 640, 480);
  const BoardPainter painter([&](const Eigen::Vector2d &pixel) { return camera.unproject(pixel); },
                             {{640, 480}, {330.0, 236.0}, 40.0, 230.0},
                             {TargetKind::Charuco, 6, 4, 0.06});
  Random random(2, 1);
  std::vector<std::string> jpegs;
  for (const auto &cMo : posesRound(count, {0.1, 0.06, 0.0}, 0.3, 0.4, random)) {
    std::vector<uchar> bytes;
    cv::imencode(".jpg", painter.paint(cMo, random), bytes, {cv::IMWRITE_JPEG_QUALITY, 97});
    jpegs.emplace_back(bytes.begin(), bytes.end());
  }
  return jpegs;
}

int filesIn(const std::string &folder)
{
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(CalibrateLive, watchesACameraAndSaysWhatToDo)
{
  const Folder folder;
  const PictureStream stream(boardRoundAMirror(10), std::chrono::milliseconds(100));
  const std::string camera = folder / "camera.yaml";
  const ProgramRun run = runProgram("--live " + stream.url() + kTarget + "--most 9 -o " + camera +
                                    " --keep " + (folder / "views"));
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("1 views. "));
  const MirrorCamera found = parseMirrorCamera(fileText(camera), camera);
  EXPECT_NEAR(found.model.parameters().cx, 330.0, 0.7);
  EXPECT_NEAR(found.model.parameters().cy, 236.0, 0.7);
  EXPECT_EQ(filesIn(folder / "views"), 9);
}

TEST(CalibrateLive, keepsTheViewsOfACameraThatIsUnplugged)
{
  const Folder folder;
  const PictureStream stream(boardRoundAMirror(4), std::chrono::milliseconds(900), 4);
  const ProgramRun run = runProgram("--live " + stream.url() + kTarget + "-o " +
                                    (folder / "camera.yaml") + " --keep " + (folder / "views"));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, HasSubstr("the camera has sent nothing new"));
  EXPECT_GE(filesIn(folder / "views"), 3);
}

TEST(CalibrateLive, calibratesWithWhatItHasOnCtrlC)
{
  const Folder folder;
  const PictureStream stream(boardRoundAMirror(12), std::chrono::milliseconds(150));
  const std::string camera = folder / "camera.yaml";
  const std::string views = folder / "views";
  const std::string interrupt = " 2>&1 & pid=$!; for i in $(seq 300); do [ -e " + views +
                                "/view008.png ] && break; sleep 0.1; done; "
                                "kill -INT $pid; wait $pid";
  const ProgramRun run = runProgram("--live " + stream.url() + kTarget + "--most 900 -o " + camera +
                                    " --keep " + views + interrupt);
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_NEAR(parseMirrorCamera(fileText(camera), camera).model.parameters().cx, 330.0, 1.5);
}

TEST(CalibrateLive, saysWhatIsWrongWithACamera)
{
  const auto expect = [](const std::string &camera, int status, const std::string &words) {
    const ProgramRun run = runProgram("--live " + camera);
    EXPECT_EQ(run.status, status) << run.output;
    EXPECT_THAT(run.output, HasSubstr(words));
  };
  expect("kitchen", 2, "neither /dev/videoN nor the URL");
  expect("/dev/video", 2, "neither /dev/videoN nor the URL");
  expect("/dev/video987", 2, "/dev/video987: no such camera");
  expect("http://127.0.0.1:1/", 1, "http://127.0.0.1:1/");
}

} // namespace
} // namespace homeward
