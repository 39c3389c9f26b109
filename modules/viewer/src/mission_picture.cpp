// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/viewer/mission_picture.h>

#include <homeward/viewer/map_picture.h>
#include <homeward/viewer/scan_picture.h>

#include "legend.h"
#include "symbols.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace homeward
{
namespace
{

constexpr double kText = 11.0;    // height of a capital, pixels
constexpr int kSightHeight = 370; // pixels
constexpr int kPanelHeight = 420; // pixels
constexpr int kScanWidth = 400;   // pixels
constexpr int kMapWidth = 470;    // pixels
constexpr double kSpan = 30.0;    // seconds that the speeds go back
constexpr Colour kTold{158, 158, 158};

std::string formatted(const char *format, double value)
{
  char text[60];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/** A picture, as large as fits, in the middle of a white one of this size. */
cv::Mat framed(const cv::Mat &picture, int width, int height)
{
  cv::Mat frame(height, width, CV_8UC3, cv::Scalar::all(255));
  const double scale = std::min(
      {1.0, static_cast<double>(width) / picture.cols, static_cast<double>(height) / picture.rows});
  cv::Mat fitting = picture;
  if (scale < 1.0) {
    cv::resize(picture, fitting, {}, scale, scale, cv::INTER_AREA);
  }
  const cv::Rect place((width - fitting.cols) / 2, (height - fitting.rows) / 2, fitting.cols,
                       fitting.rows);
  fitting.copyTo(frame(place));
  return frame;
}

/** A white picture with words in its middle. */
cv::Mat nothing(const std::string &words, int width, int height)
{
  RasterCanvas canvas(width, height);
  canvas.text({0.5 * width, 0.5 * height}, words, kText, palette::kFaint, Anchor::Middle);
  return canvas.picture();
}

/** One curve of the speeds over time. */
struct Curve
{
  std::string title;
  double reach; ///< the axis goes from minus to plus this
  double (*value)(const Twist2 &twist);
};

void drawCurve(Canvas &canvas, const std::deque<SpeedSample> &speeds, const Curve &curve,
               const cv::Rect2d &area)
{
  const double end = speeds.empty() ? 0.0 : speeds.back().seconds;
  const auto at = [&](double seconds, double value) {
    const double share = std::clamp(value / curve.reach, -1.0, 1.0);
    return Point(area.x + area.width * (1.0 - (end - seconds) / kSpan),
                 area.y + 0.5 * area.height * (1.0 - share));
  };
  canvas.text({area.x, area.y - 10.0}, curve.title, kText, palette::kInk, Anchor::Left);
  for (const double value : {-curve.reach, 0.0, curve.reach}) {
    canvas.line({at(end - kSpan, value), at(end, value)}, {.stroke = palette::kGrid});
    canvas.text(at(end - kSpan, value) + Point(-6.0, 4.0), formatted("%.1f", value), 9.0,
                palette::kFaint, Anchor::Right);
  }
  std::vector<Point> told;
  std::vector<Point> measured;
  for (const SpeedSample &sample : speeds) {
    if (sample.seconds >= end - kSpan) {
      told.push_back(at(sample.seconds, curve.value(sample.told)));
      measured.push_back(at(sample.seconds, curve.value(sample.measured)));
    }
  }
  if (told.size() > 1) {
    canvas.line(told, {.stroke = kTold, .width = 3.0});
    canvas.line(measured, {.stroke = palette::kWay, .width = 1.5});
  }
}

std::string alikeWords(const MissionScene &scene)
{
  std::string words;
  for (std::size_t i = 0; i < std::min<std::size_t>(scene.alike.size(), 4); ++i) {
    const auto &[node, probability] = scene.alike[i];
    words += (i == 0 ? "it may be node " : ", ") + std::to_string(node.value) +
             formatted(" (%.0f %%)", 100.0 * probability);
  }
  return words;
}

} // namespace

cv::Mat sightImage(const MissionScene &scene, int width)
{
  constexpr double kTop = 34.0;
  constexpr double kBottom = 46.0;
  if (width < 400) {
    throw LogicError("picture of the view: width " + std::to_string(width) +
                     ", at least 400 is needed");
  }
  if (scene.view.image.empty()) {
    return nothing("no picture was needed yet", width, width / 4);
  }
  cv::Mat view = scene.view.image;
  if (view.channels() == 1) {
    cv::cvtColor(view, view, cv::COLOR_GRAY2BGR);
  }
  const double scale = static_cast<double>(width) / view.cols;
  const double high = scale * view.rows;
  RasterCanvas canvas(width, static_cast<int>(kTop + high + kBottom));
  canvas.image(view, {0.0, kTop}, {width, high});
  const auto column = [&](double bearing) {
    return scale * (scene.view.geometry.column(bearing) + 0.5);
  };
  constexpr std::pair<double, const char *> kSides[] = {
      {0.0, "ahead"}, {0.5 * kPi, "left"}, {-0.5 * kPi, "right"}};
  for (const auto &[bearing, words] : kSides) {
    canvas.line({{column(bearing), kTop + high}, {column(bearing), kTop + high + 6.0}},
                {.stroke = palette::kInk});
    canvas.text({column(bearing), kTop + high + 20.0}, words, 9.0, palette::kFaint, Anchor::Middle);
  }
  std::string words = "What the robot saw last, all round";
  if (!scene.goal.empty()) {
    words += scene.home ? "; the arrow points home to " + scene.goal
                        : "; it does not tell the way home to " + scene.goal;
  }
  canvas.text({10.0, 22.0}, words, kText, palette::kInk, Anchor::Left);
  canvas.text({10.0, kTop + high + 40.0}, alikeWords(scene), kText, palette::kInk, Anchor::Left);
  if (scene.home) {
    const double x = column(*scene.home);
    const Style white{.fill = palette::kWhite, .stroke = palette::kWhite, .width = 4.0};
    const Style strong{.fill = palette::kRoute, .stroke = palette::kRoute, .width = 1.0};
    const double tip = kTop + 0.35 * high;
    for (const Style &style : {white, strong}) {
      canvas.polygon({{x, tip},
                      {x - 18.0, tip + 30.0},
                      {x - 6.0, tip + 30.0},
                      {x - 6.0, kTop + 0.9 * high},
                      {x + 6.0, kTop + 0.9 * high},
                      {x + 6.0, tip + 30.0},
                      {x + 18.0, tip + 30.0}},
                     style);
    }
  }
  return canvas.picture();
}

cv::Mat speedImage(const MissionScene &scene, int width, int height)
{
  constexpr int kSmallest = 200;
  if (std::min(width, height) < kSmallest) {
    throw LogicError("picture of the speeds: at least 200 pixels each way are needed");
  }
  RasterCanvas canvas(width, height);
  const double left = 46.0;
  const double high = 0.5 * height - 60.0;
  const double wide = width - left - 16.0;
  const Curve speed{"Speed, m/s", 0.6, [](const Twist2 &twist) { return twist.v; }};
  const Curve turn{"Turn rate, rad/s, left upwards", 1.0,
                   [](const Twist2 &twist) { return twist.w; }};
  drawCurve(canvas, scene.speeds, speed, {left, 40.0, wide, high});
  drawCurve(canvas, scene.speeds, turn, {left, 40.0 + high + 46.0, wide, high});
  const double foot = height - 14.0;
  canvas.line({{left, foot - 4.0}, {left + 24.0, foot - 4.0}}, {.stroke = kTold, .width = 3.0});
  canvas.text({left + 30.0, foot}, "told", 10.0, palette::kInk, Anchor::Left);
  canvas.line({{left + 80.0, foot - 4.0}, {left + 104.0, foot - 4.0}},
              {.stroke = palette::kWay, .width = 1.5});
  canvas.text({left + 110.0, foot}, "driven", 10.0, palette::kInk, Anchor::Left);
  canvas.text({width - 16.0, foot}, "the last 30 s", 10.0, palette::kFaint, Anchor::Right);
  return canvas.picture();
}

std::vector<TitledImage> missionImages(const MissionScene &scene)
{
  const int speedWidth = kMissionWidth - kScanWidth - kMapWidth;
  std::vector<TitledImage> images;
  images.push_back({"view", framed(sightImage(scene, kMissionWidth), kMissionWidth, kSightHeight)});
  cv::Mat scan = nothing("no scan yet", kScanWidth, kPanelHeight);
  if (scene.scan) {
    const ScanPicture how{.title = "Scan and open directions",
                          .width = kScanWidth,
                          .openDirections = scene.openDirections};
    scan = framed(scanImage(*scene.scan, how), kScanWidth, kPanelHeight);
  }
  images.push_back({"scan", scan});
  cv::Mat map = nothing("no place yet", kMapWidth, kPanelHeight);
  if (scene.map && !scene.map->nodes().empty()) {
    MapPicture how;
    how.title = "Map";
    how.width = kMapWidth;
    how.legend = false;
    how.route = scene.route;
    const bool known =
        std::all_of(scene.map->nodes().begin(), scene.map->nodes().end(),
                    [&](const auto &node) { return scene.poses.count(node.first) > 0; });
    if (known) {
      how.poses = scene.poses;
      how.robot = scene.robot;
    }
    map = framed(mapImage(*scene.map, how), kMapWidth, kPanelHeight);
  }
  images.push_back({"map", map});
  images.push_back({"speeds", speedImage(scene, speedWidth, kPanelHeight)});
  return images;
}

cv::Mat missionImage(const MissionScene &scene)
{
  cv::Mat all(kMissionHeight, kMissionWidth, CV_8UC3, cv::Scalar::all(255));
  const std::vector<TitledImage> images = missionImages(scene);
  images[0].image.copyTo(all(cv::Rect({0, 0}, images[0].image.size())));
  int x = 0;
  for (std::size_t i = 1; i < images.size(); ++i) {
    images[i].image.copyTo(all(cv::Rect({x, kSightHeight}, images[i].image.size())));
    x += images[i].image.cols;
  }
  const int footHeight = kMissionHeight - kSightHeight - kPanelHeight;
  RasterCanvas foot(kMissionWidth, footHeight);
  const std::string words = formatted("%.0f s: ", scene.seconds) + scene.state;
  foot.text({10.0, 18.0}, clipped(words, kText, kMissionWidth - 20.0), kText, palette::kInk,
            Anchor::Left);
  foot.text({10.0, 38.0}, clipped(scene.reason, kText, kMissionWidth - 20.0), kText,
            palette::kFaint, Anchor::Left);
  foot.picture().copyTo(all(cv::Rect(0, kSightHeight + kPanelHeight, kMissionWidth, footHeight)));
  return all;
}

} // namespace homeward
