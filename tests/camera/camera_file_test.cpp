// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"

#include <homeward/camera/camera_file.h>
#include <homeward/camera/camera_model_file.h>
#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>
#include <vector>

namespace homeward
{
namespace
{

std::string text(const std::filesystem::path &file)
{
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

TEST(CameraFile, EveryShippedFileIsRead)
{
  int files = 0;
  for (const auto &entry : std::filesystem::directory_iterator(dataDir() / "cameras")) {
    EXPECT_NO_THROW(parseMirrorCamera(text(entry.path()), entry.path().string())) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 2);
}

TEST(CameraFile, ReadsWhatItWrites)
{
  const MirrorCamera camera{
      UnifiedCamera({0.9, 108.1, 107.9, 320.2, 241, 0.1, -0.02, 1e-3, 2e-3, 0.3}, 640, 480),
      {31.5, 230.25},
      {-1.5, false}};
  const MirrorCamera back = parseMirrorCamera(formatMirrorCamera(camera), "test");
  EXPECT_EQ(back.model.parameters().xi, 0.9);
  EXPECT_EQ(back.model.parameters().p2, 2e-3);
  EXPECT_EQ(back.model.parameters().skew, 0.3);
  EXPECT_EQ(back.model.width(), 640);
  EXPECT_EQ(back.ring.outer, 230.25);
  EXPECT_NEAR(back.mount.forward, -1.5, 1e-12);
  EXPECT_FALSE(back.mount.leftIsClockwise);
}

// A camera file says its model to who needs no more.
TEST(CameraFile, IsReadAsAModelToo)
{
  const std::string yaml = text(dataDir() / "cameras/sim_nominal.yaml");
  const auto model = parseCameraModel(yaml, "sim_nominal.yaml");
  const MirrorCamera camera = parseMirrorCamera(yaml, "sim_nominal.yaml");
  const Eigen::Vector3d ray(0.3, -0.8, 0.2);
  EXPECT_EQ(*model->project(ray), *camera.model.project(ray));
  EXPECT_THROW(parseCameraModel("model: ocam\nparameters: {a0: 1}\n", "x"), ConfigError);
}

// The shipped fit against the polynomial it was fitted to: elevation = atan2(f(r), r).
TEST(CameraFile, TheRealMirrorSeesAsItsCalibrationSays)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("mirror/calib_results.txt");
  std::istringstream calibration(text(outsideDataDir() / "mirror/calib_results.txt"));
  std::string comment;
  std::getline(calibration, comment);
  std::size_t count = 0;
  calibration >> count;
  std::vector<double> polynomial(count);
  for (double &coefficient : polynomial) {
    calibration >> coefficient;
  }
  ASSERT_EQ(count, 5U);
  const std::filesystem::path file = dataDir() / "cameras/example_mirror.yaml";
  const MirrorCamera camera = parseMirrorCamera(text(file), file.string());
  const auto &p = camera.model.parameters();
  for (double radius = camera.ring.inner; radius <= camera.ring.outer; radius += 5.0) {
    double height = 0.0;
    for (std::size_t k = count; k-- > 0;) {
      height = height * radius + polynomial[k];
    }
    const auto ray = camera.model.unproject({p.cx + radius, p.cy});
    ASSERT_TRUE(ray);
    EXPECT_NEAR(degrees(std::asin(-ray->z())), degrees(std::atan2(height, radius)), 0.05) << radius;
  }
}

std::string refusal(const std::string &yaml)
{
  try {
    parseMirrorCamera(yaml, "cam.yaml");
  }
  catch (const ConfigError &error) {
    return error.what();
  }
  return "accepted";
}

TEST(CameraFile, RefusesByName)
{
  const std::string good = text(dataDir() / "cameras/sim_nominal.yaml");
  const auto with = [&](const std::string &from, const std::string &to) {
    std::string changed = good;
    changed.replace(changed.find(from), from.size(), to);
    return changed;
  };
  EXPECT_THAT(refusal(with("xi: 0.95", "xi: banana")), testing::HasSubstr("parameters.xi"));
  EXPECT_THAT(refusal(with("xi: 0.95", "xi: -1")), testing::HasSubstr("xi must not be negative"));
  EXPECT_THAT(refusal(with("fx: 108", "focal: 108")), testing::HasSubstr("focal"));
  EXPECT_THAT(refusal(with("model: unified", "model: pinhole")), testing::HasSubstr("unified"));
  EXPECT_THAT(refusal(with("width: 640", "width: 0.5")), testing::HasSubstr("image.width"));
  EXPECT_THAT(refusal(with("outer_radius_px: 236", "outer_radius_px: 3")),
              testing::HasSubstr("inner_radius_px"));
  EXPECT_THAT(refusal(with("xi: 0.95", "xi: banana")), testing::HasSubstr("'banana'"));
  EXPECT_THAT(refusal(with("xi: 0.95, ", "")), testing::HasSubstr("missing"));
  EXPECT_THAT(refusal(with("xi: 0.95", "xi: .nan")), testing::HasSubstr("parameters.xi"));
  EXPECT_THAT(refusal(with("xi: 0.95", "xi: 0.95, xi: 1")),
              testing::HasSubstr("'xi' stands twice"));
  EXPECT_THAT(refusal(with("left_is_clockwise: true", "left_is_clockwise: maybe")),
              testing::HasSubstr("'maybe'"));
  EXPECT_THAT(refusal(with("mount: {", "mount: [1] #")), testing::HasSubstr("mount"));
  EXPECT_THAT(refusal("[1, 2"), testing::HasSubstr("cam.yaml is not YAML"));
  EXPECT_THAT(refusal("42"), testing::HasSubstr("cam.yaml"));
}

} // namespace
} // namespace homeward
