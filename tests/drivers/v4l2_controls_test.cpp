// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/camera_sources.h>
#include <homeward/drivers/v4l2_controls.h>

#include <gmock/gmock.h>

#include <cerrno>
#include <linux/videodev2.h>
#include <map>

namespace homeward
{
namespace
{

using testing::HasSubstr;
using testing::Pair;

/** A camera with controls, each in a range; exposure is out of reach while it is automatic. */
class CameraControls
{
public:
  void add(std::uint32_t id, int minimum, int maximum, int step, int value)
  {
    m_ranges[id] = {minimum, maximum, step};
    values[id] = value;
  }

  int control(unsigned long request, void *argument)
  {
    if (request == VIDIOC_QUERYCTRL) {
      auto &query = *static_cast<v4l2_queryctrl *>(argument);
      const auto range = m_ranges.find(query.id);
      if (range == m_ranges.end()) {
        errno = EINVAL;
        return -1;
      }
      query.minimum = range->second[0];
      query.maximum = range->second[1];
      query.step = range->second[2];
      return 0;
    }
    const auto &wanted = *static_cast<v4l2_control *>(argument);
    const bool automatic = wanted.id == V4L2_CID_EXPOSURE_ABSOLUTE &&
                           values[V4L2_CID_EXPOSURE_AUTO] != V4L2_EXPOSURE_MANUAL;
    if (request != VIDIOC_S_CTRL || automatic) {
      errno = EBUSY;
      return -1;
    }
    values[wanted.id] = wanted.value;
    return 0;
  }

  std::map<std::uint32_t, int> values;

private:
  std::map<std::uint32_t, std::array<int, 3>> m_ranges;
};

/** As many webcams: automatic exposure, 0.3 to 204.7 ms in steps of 0.2, gain 0 to 100. */
CameraControls webcam()
{
  CameraControls camera;
  camera.add(V4L2_CID_EXPOSURE_AUTO, 0, 3, 1, V4L2_EXPOSURE_APERTURE_PRIORITY);
  camera.add(V4L2_CID_EXPOSURE_ABSOLUTE, 3, 2047, 2, 250);
  camera.add(V4L2_CID_GAIN, 0, 100, 1, 30);
  return camera;
}

std::string refusal(CameraControls &camera, const V4l2Settings &settings)
{
  try {
    setV4l2Controls(settings, "/dev/video0", [&](unsigned long request, void *argument) {
      return camera.control(request, argument);
    });
  }
  catch (const DeviceError &error) {
    return error.what();
  }
  return {};
}

TEST(V4l2Controls, SetsExposureAndGainForGood)
{
  CameraControls camera = webcam();
  camera.add(V4L2_CID_AUTOGAIN, 0, 1, 1, 1);
  EXPECT_EQ(refusal(camera, {0.0085, 12}), "");
  EXPECT_THAT(camera.values,
              testing::UnorderedElementsAre(Pair(V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL),
                                            Pair(V4L2_CID_EXPOSURE_ABSOLUTE, 85),
                                            Pair(V4L2_CID_AUTOGAIN, 0), Pair(V4L2_CID_GAIN, 12)));
}

TEST(V4l2Controls, TakesTheNearestStep)
{
  CameraControls camera = webcam();
  EXPECT_EQ(refusal(camera, {0.01, {}}), ""); // 100 counts; 3, 5, ... are possible
  EXPECT_EQ(camera.values[V4L2_CID_EXPOSURE_ABSOLUTE], 101);
  EXPECT_EQ(refusal(camera, {0.2047, {}}), "");
  EXPECT_EQ(camera.values[V4L2_CID_EXPOSURE_ABSOLUTE], 2047);
}

TEST(V4l2Controls, WhatIsLeftOutStaysAsItIs)
{
  CameraControls camera = webcam();
  const auto before = camera.values;
  EXPECT_EQ(refusal(camera, {}), "");
  EXPECT_EQ(camera.values, before);
}

TEST(V4l2Controls, RefusalsSayWhatTheCameraTakes)
{
  CameraControls camera = webcam();
  EXPECT_EQ(refusal(camera, {0.5, {}}),
            "/dev/video0: 'exposure_ms' is 500; this camera takes 0.3 to 204.7");
  EXPECT_EQ(refusal(camera, {{}, 101}), "/dev/video0: 'gain' is 101; this camera takes 0 to 100");
  CameraControls bare;
  EXPECT_EQ(refusal(bare, {{}, 1}),
            "/dev/video0: this camera has no control for 'gain'; leave it out");
  CameraControls stubborn;
  stubborn.add(V4L2_CID_EXPOSURE_ABSOLUTE, 3, 2047, 1, 250); // cannot be made manual
  EXPECT_THAT(refusal(stubborn, {0.01, {}}), HasSubstr("/dev/video0: refuses 'exposure_ms': "));
}

TEST(V4l2Controls, AFileThatIsNoCameraIsRefused)
{
  EXPECT_THROW(setV4l2Controls({0.01, {}}, "/dev/null"), DeviceError);
  EXPECT_THROW(setV4l2Controls({0.01, {}}, "/nowhere"), DeviceError);
}

TEST(FirewireCamera, WithoutOneThereIsOneClearLine)
{
  try {
    openFirewireCamera(7);
    FAIL() << "there is an eighth camera on this machine's bus";
  }
  catch (const RuntimeError &error) {
    EXPECT_THAT(error.what(), HasSubstr("FireWire camera 7: "));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

} // namespace
} // namespace homeward
