// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"

#include <homeward/calib/convert.h>
#include <homeward/calib/formats.h>
#include <homeward/camera/camera_models.h>
#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace homeward
{
namespace
{

using testing::HasSubstr;

std::unique_ptr<CameraModel> make(const char *name, std::vector<double> values)
{
  const auto count = static_cast<Eigen::Index>(values.size());
  return makeCameraModel(name, Eigen::Map<const Eigen::VectorXd>(values.data(), count), 1280, 960);
}

struct Held
{
  const char *format;
  const char *model;
  std::vector<double> parameters;
};

class FormatLaw : public testing::TestWithParam<Held>
{};

TEST_P(FormatLaw, ReadsWhatItWrites)
{
  const Held held = GetParam();
  const auto model = make(held.model, held.parameters);
  const std::string text = formatCamera(*model, cameraFormat(held.format));
  EXPECT_EQ(guessCameraFormat(text, "test"), cameraFormat(held.format)) << text;
  const auto back = parseCamera(text, cameraFormat(held.format), "test", PictureSize{1280, 960});
  EXPECT_EQ(back->name(), held.model);
  EXPECT_TRUE(back->parameters().isApprox(model->parameters(), 1e-14)) << text;
  EXPECT_EQ(back->width(), 1280);
  EXPECT_EQ(back->height(), 960);
}

TEST_P(FormatLaw, RefusesWhatIsCutOff)
{
  const Held held = GetParam();
  const std::string text =
      formatCamera(*make(held.model, held.parameters), cameraFormat(held.format));
  for (const double share : {0.0, 0.2, 0.5}) {
    const auto cut = static_cast<std::size_t>(share * static_cast<double>(text.size()));
    try {
      parseCamera(text.substr(0, cut), cameraFormat(held.format), "cut.txt",
                  PictureSize{1280, 960});
      ADD_FAILURE() << "accepted " << share;
    }
    catch (const ConfigError &error) {
      EXPECT_THAT(error.what(), HasSubstr("cut.txt"));
    }
  }
}

const std::vector<double> kUnified{0.95, 210.5, 211, 641, 478, -0.05, 0.01, 1e-3, -2e-3, 0.25};
const std::vector<double> kNoSkew{0.95, 210.5, 211, 641, 478, -0.05, 0.01, 1e-3, -2e-3, 0};
const std::vector<double> kPlain{0.95, 210.5, 211, 641, 478, 0, 0, 0, 0, 0};
const std::vector<double> kFisheye{0.01, -0.002, 1e-3, -1e-4, 300, 301, 641, 478};
const std::vector<double> kExtended{0.48, 1.1, 108, 109, 641, 478};
const std::vector<double> kSphere{0.4, 0.3, 150, 151, 641, 478};
const std::vector<double> kOcam{266.6, -1.2e-3, 5.8e-7, -2e-9, 0.999, 1e-3, -2e-3, 641, 478};

INSTANTIATE_TEST_SUITE_P(
    Formats, FormatLaw,
    testing::Values(Held{"homeward", "unified", kUnified}, Held{"homeward", "ocam", kOcam},
                    Held{"homeward", "kannala_brandt", kFisheye},
                    Held{"homeward", "extended_unified", kExtended},
                    Held{"homeward", "double_sphere", kSphere}, Held{"visp", "unified", kUnified},
                    Held{"visp", "ocam", kOcam}, Held{"visp", "kannala_brandt", kFisheye},
                    Held{"visp", "unified", {0, 600, 610, 641, 478, 0, 0, 0, 0, 0}},
                    Held{"visp", "unified", {0, 600, 610, 641, 478, -0.1, 0, 0, 0, 0}},
                    Held{"visp", "double_sphere", kSphere}, Held{"opencv", "unified", kUnified},
                    Held{"kalibr", "unified", kNoSkew}, Held{"kalibr", "kannala_brandt", kFisheye},
                    Held{"kalibr", "extended_unified", kExtended},
                    Held{"kalibr", "double_sphere", kSphere}, Held{"ocamcalib", "ocam", kOcam},
                    Held{"libper", "unified", kPlain}));

TEST(Formats, SayWhatTheyCannotHold)
{
  const auto refusal = [](const char *model, const std::vector<double> &parameters,
                          const char *format) -> std::string {
    try {
      formatCamera(*make(model, parameters), cameraFormat(format));
    }
    catch (const ConfigError &error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal("unified", kUnified, "libper"), HasSubstr("distortion"));
  EXPECT_THAT(refusal("unified", kUnified, "kalibr"), HasSubstr("skew"));
  EXPECT_THAT(refusal("ocam", kOcam, "opencv"), HasSubstr("convert"));
  EXPECT_THAT(refusal("unified", kUnified, "ocamcalib"), HasSubstr("convert"));
  EXPECT_THROW(cameraFormat("matlab"), ConfigError);
}

std::string refusal(const std::string &text, const char *format)
{
  try {
    parseCamera(text, cameraFormat(format), "bad.txt");
  }
  catch (const ConfigError &error) {
    return error.what();
  }
  return "accepted";
}

TEST(Formats, BadFilesGetOneClearLine)
{
  EXPECT_THAT(refusal("<root>\n<camera>\n</root>", "visp"), HasSubstr("bad.txt, line 3"));
  EXPECT_THAT(refusal("<root><camera><image_width>9</image_width><image_height>x</image_height>"
                      "</camera></root>",
                      "visp"),
              HasSubstr("'x'"));
  EXPECT_THAT(refusal("<root></root>", "libper"), HasSubstr("no <camera>"));
  EXPECT_THAT(refusal("<root><camera><type>0</type><au>1</au><av>1</av><u0>1</u0><v0>1</v0>"
                      "<xi>1</xi></camera></root>",
                      "libper"),
              HasSubstr("give width and height"));
  EXPECT_THAT(refusal("cam1: {}", "kalibr"), HasSubstr("no cam0"));
  EXPECT_THAT(
      refusal("cam0: {camera_model: omni, distortion_model: fov, resolution: [9, 9]}", "kalibr"),
      HasSubstr("'fov'"));
  EXPECT_THAT(refusal("cam0: {camera_model: ds, distortion_model: none, resolution: [9, 9], "
                      "intrinsics: [1, 2]}",
                      "kalibr"),
              HasSubstr("list of 6"));
  EXPECT_THAT(refusal("%YAML:1.0\n---\nK: 3\n", "opencv"), HasSubstr("distortion"));
  EXPECT_THAT(refusal("model: fish\n", "homeward"), HasSubstr("'fish'"));
  EXPECT_THAT(refusal("1000000 2", "ocamcalib"), HasSubstr("no length"));
  EXPECT_THAT(refusal("3 -200 0.5 1e-3 1 1 1 1 1 0 0 9 9", "ocamcalib"), HasSubstr("zero"));
  EXPECT_THROW(guessCameraFormat("hello", "bad.txt"), ConfigError);
}

// cv::omnidir's users also write K, D and xi by these names, xi as a matrix.
TEST(Formats, OpencvFilesMayCallThemKAndD)
{
  const auto model = parseCamera("%YAML:1.0\n---\n"
                                 "K: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                                 "   data: [ 400., 1., 630., 0., 410., 430., 0., 0., 1. ]\n"
                                 "D: !!opencv-matrix\n   rows: 1\n   cols: 4\n   dt: d\n"
                                 "   data: [ -0.1, 0.02, 0.001, 0.002 ]\n"
                                 "xi: !!opencv-matrix\n   rows: 1\n   cols: 1\n   dt: d\n"
                                 "   data: [ 1.05 ]\n",
                                 CameraFormat::Opencv, "k.yml", PictureSize{1280, 960});
  Eigen::VectorXd expected(10);
  expected << 1.05, 400, 410, 630, 430, -0.1, 0.02, 0.001, 0.002, 1;
  EXPECT_EQ(model->parameters(), expected);
}

/** What world2cam of OCamCalib's C library does with a ray in its own frame. */
Eigen::Vector2d worldToCam(const std::vector<double> &inverse, const Eigen::Vector3d &ray,
                           const Eigen::VectorXd &p)
{
  const double across = ray.head<2>().norm();
  const double angle = std::atan(ray.z() / across);
  double radius = 0.0;
  for (std::size_t i = inverse.size(); i-- > 0;) {
    radius = radius * angle + inverse[i];
  }
  const double x = ray.x() / across * radius; // along the rows
  const double y = ray.y() / across * radius;
  const Eigen::VectorXd affine = p.tail<5>();
  return {x * affine[2] + y + affine[3], x * affine[0] + y * affine[1] + affine[4]};
}

std::vector<double> inverseOf(const std::string &text)
{
  std::istringstream lines(text);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream row(line.substr(0, line.find('#')));
    std::vector<double> values;
    for (double value = 0.0; row >> value;) {
      values.push_back(value);
    }
    if (!values.empty()) {
      rows.push_back(values);
    }
  }
  return {rows.at(1).begin() + 1, rows.at(1).end()};
}

void expectWorldToCam(const CameraModel &model, const std::string &text, double pixels)
{
  const auto inverse = inverseOf(text);
  for (const Eigen::Vector2d &pixel : pixelGrid(model, 100.0, 590.0)) {
    const auto ray = model.unproject(pixel);
    ASSERT_TRUE(ray);
    // Rows before columns, z away from the camera.
    const Eigen::Vector2d back =
        worldToCam(inverse, {ray->y(), ray->x(), -ray->z()}, model.parameters());
    EXPECT_NEAR((back - pixel).norm(), 0.0, pixels) << pixel.transpose();
  }
}

TEST(Formats, OcamcalibsOwnInverseAgrees)
{
  const auto model = make("ocam", kOcam);
  expectWorldToCam(*model, formatCamera(*model, CameraFormat::Ocamcalib), 0.05);
}

// The file's own inverse polynomial is an independent way through rows, columns and signs.
TEST(Formats, ARealOcamcalibFileIsReadAsItsOwnInverseSaysIt)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("mirror/calib_results.txt");
  std::ostringstream text;
  text << std::ifstream(outsideDataDir() / "mirror/calib_results.txt").rdbuf();
  EXPECT_EQ(guessCameraFormat(text.str(), "calib_results.txt"), CameraFormat::Ocamcalib);
  const auto model = parseCamera(text.str(), CameraFormat::Ocamcalib, "calib_results.txt");
  EXPECT_EQ(model->width(), 1300);
  EXPECT_EQ(model->parameters()[0], 266.588);
  const auto straight = model->project({1.0, 0.0, 0.0});
  ASSERT_TRUE(straight);
  EXPECT_GT(straight->x(), 900.0);
  expectWorldToCam(*model, text.str(), 1.0);
}

// The ocam file as the unified model: the shipped data/cameras/example_mirror.yaml was fitted so.
TEST(Convert, ARealOcamBecomesUnified)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("mirror/calib_results.txt");
  std::ostringstream text;
  text << std::ifstream(outsideDataDir() / "mirror/calib_results.txt").rdbuf();
  const auto model = parseCamera(text.str(), CameraFormat::Ocamcalib, "calib_results.txt");
  const ModelFit fit = fitModel(*model, "unified", pixelGrid(*model, 235.0, 600.0));
  EXPECT_LT(fit.mean, 0.2);
  EXPECT_LT(fit.largest, 2.0);
  EXPECT_EQ(fit.unseen, 0.0);
}

TEST(Convert, EveryModelStandsForTheUnifiedOne)
{
  const auto unified = make("unified", kPlain);
  const auto pixels = pixelGrid(*unified, 0.0, 470.0);
  for (const std::string &name : cameraModelNames()) {
    const ModelFit fit = fitModel(*unified, name, pixels);
    EXPECT_EQ(fit.model->name(), name);
    const bool exact = name == "unified" || name == "extended_unified" || name == "double_sphere";
    EXPECT_LT(fit.largest, exact ? 1e-4 : 1.0) << name;
    EXPECT_LE(fit.mean, fit.largest);
    EXPECT_EQ(fit.unseen, 0.0) << name;
    // And back again.
    const ModelFit back = fitModel(*fit.model, "unified", pixels);
    EXPECT_LT(back.largest, exact ? 1e-4 : 2.0) << name;
  }
  EXPECT_THROW(fitModel(*unified, "pinhole", pixels), ConfigError);
  EXPECT_THROW(fitModel(*unified, "ocam", {}), ConfigError);
}

} // namespace
} // namespace homeward
