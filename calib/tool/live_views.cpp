// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_views.h"

#include <homeward/calib/board_detector.h>
#include <homeward/calib/guidance.h>
#include <homeward/core/error.h>
#include <homeward/drivers/steady_clock.h>

#include <opencv2/videoio.hpp>

#include <algorithm>
#include <cstdio>

namespace homeward
{
namespace
{

/** A camera of the system, by its device file. */
class SystemCamera final : public ImageSource
{
public:
  explicit SystemCamera(const std::string &device) : m_device(device), m_capture(device)
  {
    if (!m_capture.isOpened()) {
      throw ConfigError("cannot open the camera " + device +
                        "; check the name and its permissions");
    }
  }

  std::optional<Frame> grab() override
  {
    Frame frame;
    if (!m_capture.read(frame.image)) {
      throw DeviceError("the camera " + m_device + " gives no pictures any more");
    }
    frame.stamp = SteadyClock().now();
    return frame;
  }

private:
  std::string m_device;
  cv::VideoCapture m_capture;
};

/** Whether a board lies so elsewhere than in the views so far that it tells something new. */
bool isNew(const BoardView &view, const BoardViews &views)
{
  constexpr double kMoved = 0.02; // of the picture's width
  return std::all_of(views.views.begin(), views.views.end(), [&](const BoardView &other) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < view.ids.size(); ++i) {
      const auto same = std::find(other.ids.begin(), other.ids.end(), view.ids[i]);
      if (same != other.ids.end()) {
        sum += (view.pixels[i] - other.pixels[static_cast<std::size_t>(same - other.ids.begin())])
                   .norm();
        ++count;
      }
    }
    return count == 0 || sum / count > kMoved * views.width;
  });
}

} // namespace

LiveViews watch(ImageSource &source, const std::string &name, const Target &target, int most)
{
  LiveViews live;
  BoardViews views;
  std::optional<MirrorCircles> mirror;
  std::string said;
  while (static_cast<int>(views.views.size()) < most) {
    const auto frame = source.grab();
    if (!frame) {
      break;
    }
    const cv::Mat gray = grayOf(frame->image);
    views.width = gray.cols;
    views.height = gray.rows;
    mirror = mirror ? mirror : findMirror(gray);
    const auto view = findBoard(gray, target, mirror);
    if (view && isNew(*view, views)) {
      views.views.push_back(*view);
      live.pictures.names.push_back(name + " view " + std::to_string(views.views.size()));
      live.pictures.images.push_back(frame->image.clone());
    }
    const Circle whole{{gray.cols / 2.0, gray.rows / 2.0}, std::min(gray.cols, gray.rows) / 2.0};
    const Guidance next = guide(views, mirror.value_or(MirrorCircles{{whole.centre, 0.0}, whole}));
    if (next.sentence != said) {
      std::fprintf(stderr, "%zu views. %s\n", views.views.size(), next.sentence.c_str());
      said = next.sentence;
    }
    if (next.enough) {
      break;
    }
  }
  if (live.pictures.images.empty()) {
    throw ConfigError(name + " has shown no board; check --target, --columns and --rows");
  }
  return live;
}

LiveViews watchCamera(const std::string &device, const Target &target, int most)
{
  SystemCamera camera(device);
  return watch(camera, device, target, most);
}

} // namespace homeward
