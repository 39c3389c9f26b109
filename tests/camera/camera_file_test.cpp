// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"

#include <homeward/camera/camera_file.h>
#include <homeward/core/error.h>

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

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
      UnifiedCamera({0.9, 108.1, 107.9, 320.2, 241, 0.1, -0.02, 1e-3, 2e-3}, 640, 480),
      {31.5, 230.25},
      {-1.5, false}};
  const MirrorCamera back = parseMirrorCamera(formatMirrorCamera(camera), "test");
  EXPECT_EQ(back.model.parameters().xi, 0.9);
  EXPECT_EQ(back.model.parameters().p2, 2e-3);
  EXPECT_EQ(back.model.width(), 640);
  EXPECT_EQ(back.ring.outer, 230.25);
  EXPECT_NEAR(back.mount.forward, -1.5, 1e-12);
  EXPECT_FALSE(back.mount.leftIsClockwise);
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
  EXPECT_THAT(refusal("[1, 2"), testing::HasSubstr("cam.yaml is not YAML"));
  EXPECT_THAT(refusal("42"), testing::HasSubstr("cam.yaml"));
}

} // namespace
} // namespace homeward
