// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_views.h"

#include "files.h"

#include <homeward/calib/board_detector.h>
#include <homeward/calib/guidance.h>
#include <homeward/core/error.h>
#include <homeward/drivers/camera_sources.h>
#include <homeward/drivers/live_camera.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string_view>

namespace homeward
{
namespace
{

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

/** Where the mirror is, or else the whole picture. */
MirrorCircles mirrorOrAll(const std::optional<MirrorCircles> &mirror, const cv::Size &size)
{
  const Circle whole{{size.width / 2.0, size.height / 2.0},
                     std::min(size.width, size.height) / 2.0};
  return mirror.value_or(MirrorCircles{{whole.centre, 0.0}, whole});
}

/** Keeps what a live camera showed, for it cannot be shown again. */
void keepView(const std::string &folder, std::size_t number, const cv::Mat &picture)
{
  if (folder.empty()) {
    return;
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::string digits = std::to_string(1000 + number).substr(1);
  writeText((std::filesystem::path(folder) / ("view" + digits + ".png")).string(),
            encodePng(picture));
}

} // namespace

Pictures watch(ImageSource &source, const std::string &name, const Target &target,
               const WatchOptions &options, const std::atomic<bool> &stop)
{
  constexpr Duration kPause = std::chrono::milliseconds(5);
  SteadyClock clock;
  Pictures pictures;
  BoardViews views;
  std::optional<MirrorCircles> mirror;
  std::optional<Time> seen;
  std::string said;
  while (static_cast<int>(views.views.size()) < options.most && !stop) {
    const auto frame = source.grab();
    if (!frame) {
      break;
    }
    if (seen == frame->stamp) {
      clock.sleepUntil(clock.now() + kPause);
      continue;
    }
    seen = frame->stamp;
    const cv::Mat gray = grayOf(frame->image);
    views.width = gray.cols;
    views.height = gray.rows;
    mirror = mirror ? mirror : findMirror(gray);
    const auto view = findBoard(gray, target, mirror);
    if (view && isNew(*view, views)) {
      views.views.push_back(*view);
      pictures.names.push_back(name + " view " + std::to_string(views.views.size()));
      pictures.images.push_back(frame->image.clone());
      keepView(options.keep, views.views.size(), frame->image);
    }
    const Guidance next = guide(views, mirrorOrAll(mirror, gray.size()));
    if (next.sentence != said) {
      std::fprintf(stderr, "%zu views. %s\n", views.views.size(), next.sentence.c_str());
      said = next.sentence;
    }
    if (next.enough) {
      break;
    }
  }
  if (pictures.images.empty()) {
    throw ConfigError(name + " has shown no board; check --target, --columns and --rows");
  }
  return pictures;
}

std::unique_ptr<ImageSource> openLiveCamera(const std::string &name)
{
  constexpr std::string_view kDevice = "/dev/video";
  std::unique_ptr<ImageSource> source;
  if (name.find("://") != std::string::npos) {
    source = openStreamCamera(name);
  }
  else {
    int number = -1;
    const char *end = name.data() + name.size();
    if (!name.starts_with(kDevice) ||
        std::from_chars(name.data() + kDevice.size(), end, number).ptr != end || number < 0) {
      throw ConfigError("--live " + name + " is neither /dev/videoN nor the URL of a stream");
    }
    source = openV4l2Camera(number);
  }
  return std::make_unique<LiveCamera>(std::move(source), CaptureOptions());
}

} // namespace homeward
