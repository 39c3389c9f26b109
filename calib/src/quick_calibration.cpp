// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/quick_calibration.h>

#include "scene_lines.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

constexpr double kUsualXi = 1.0;
constexpr double kUsualRim = radians(25.0); ///< elevation
constexpr int kEnoughLines = 12;

/** To two places. */
std::string rounded(double value)
{
  const std::string text = std::to_string(value + (value < 0.0 ? -0.005 : 0.005));
  return text.substr(0, text.find('.') + 3);
}

void check(const std::vector<cv::Mat> &pictures, const MirrorSheet &sheet)
{
  if (pictures.empty()) {
    throw ConfigError("a quick calibration needs at least one picture");
  }
  for (const cv::Mat &picture : pictures) {
    if (picture.size() != pictures[0].size()) {
      throw ConfigError("the pictures differ in size; they must come from one camera");
    }
  }
  if (sheet.xi && !(*sheet.xi >= 0.3 && *sheet.xi <= 3.0)) {
    throw ConfigError("xi of the mirror must lie between 0.3 and 3, not " +
                      std::to_string(*sheet.xi));
  }
  if (sheet.rimElevation && !(std::abs(*sheet.rimElevation) <= radians(60.0))) {
    throw ConfigError("the elevation that the rim shows must lie between -60 and 60 degrees, not " +
                      std::to_string(degrees(*sheet.rimElevation)));
  }
}

cv::Mat1b grayOf(const cv::Mat &picture)
{
  cv::Mat1b gray;
  if (picture.channels() == 3) {
    cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
  }
  else {
    gray = picture;
  }
  return gray;
}

cv::Mat1b meanOf(const std::vector<cv::Mat1b> &pictures)
{
  cv::Mat1f sum(pictures[0].size(), 0.0F);
  for (const cv::Mat1b &picture : pictures) {
    cv::Mat1f real;
    picture.convertTo(real, CV_32F);
    sum += real;
  }
  cv::Mat1b mean;
  sum.convertTo(mean, CV_8U, 1.0 / static_cast<double>(pictures.size()));
  return mean;
}

/** The mirror of a picture. */
MirrorCircles mirrorIn(const std::vector<cv::Mat1b> &grays)
{
  const auto mirror = findMirror(meanOf(grays));
  if (!mirror) {
    throw ConfigError("no mirror is seen in the picture; its round rim must show, or use a target");
  }
  return *mirror;
}

QuickCalibration fromGrays(const std::vector<cv::Mat1b> &grays, const MirrorCircles &mirror,
                           const MirrorSheet &sheet)
{
  const SceneLines lines(grays, mirror);
  const bool enough = lines.count() >= kEnoughLines;
  MirrorShape start{mirror, sheet.xi.value_or(kUsualXi), sheet.rimElevation.value_or(kUsualRim)};
  QuickCalibration result{start.camera(grays[0].size()), mirror, 0, 0.0, {}, {}};
  if (enough) {
    SceneLines::Fit fit = lines.fit(start, !sheet.xi, !sheet.rimElevation);
    if (!sheet.xi && !fit.tellsXi) {
      fit = lines.fit(start, false, !sheet.rimElevation);
      result.assumed.push_back("xi " + rounded(kUsualXi) +
                               ", usual for such mirrors: the scene's lines hardly tell it; --xi "
                               "gives the data sheet's");
    }
    result.camera = fit.shape.camera(grays[0].size());
    result.lines = fit.lines;
    result.bendPx = fit.rms;
  }
  else {
    result.warnings.push_back("the scene shows only " + std::to_string(lines.count()) +
                              " long edges; take pictures of a room with straight edges all round");
  }
  if (sheet.xi || !enough) {
    result.assumed.push_back("xi " + rounded(start.xi) +
                             (sheet.xi ? " as given" : ", usual for such mirrors"));
  }
  if (sheet.rimElevation || !enough) {
    result.assumed.push_back("the rim shows " + rounded(degrees(start.rimElevation)) +
                             " degrees above the horizon" +
                             (sheet.rimElevation ? " as given" : ", usual for such mirrors"));
  }
  result.assumed.emplace_back("square pixels and no lens distortion");
  result.assumed.emplace_back("the mirror's axis stands upright");
  return result;
}

/** Of a picture so many times larger, pixels' middles being whole numbers. */
Circle reduced(const Circle &circle, int factor)
{
  return {((circle.centre.array() + 0.5) / factor - 0.5).matrix(), circle.radius / factor};
}

QuickCalibration reduced(QuickCalibration result, int factor, const cv::Size &size)
{
  UnifiedCamera::Parameters p = result.camera.parameters();
  p.fx /= factor;
  p.fy /= factor;
  p.cx = (p.cx + 0.5) / factor - 0.5;
  p.cy = (p.cy + 0.5) / factor - 0.5;
  result.camera = UnifiedCamera(p, size.width, size.height);
  result.mirror.inner = reduced(result.mirror.inner, factor);
  result.mirror.outer = reduced(result.mirror.outer, factor);
  result.bendPx /= factor;
  return result;
}

} // namespace

QuickCalibration calibrateFromScene(const std::vector<cv::Mat> &pictures, const MirrorSheet &sheet)
{
  check(pictures, sheet);
  std::vector<cv::Mat1b> grays;
  grays.reserve(pictures.size());
  for (const cv::Mat &picture : pictures) {
    grays.push_back(grayOf(picture));
  }
  const MirrorCircles mirror = mirrorIn(grays);
  constexpr double kSmall =
      300.0; // pixels; in smaller mirrors edges hardly bend by more than noise
  constexpr int kMost = 4;
  const int factor =
      std::clamp(static_cast<int>(std::ceil(kSmall / mirror.outer.radius)), 1, kMost);
  if (factor == 1) {
    return fromGrays(grays, mirror, sheet);
  }
  const cv::Size size = grays[0].size();
  for (cv::Mat1b &gray : grays) {
    cv::resize(gray, gray, {}, factor, factor, cv::INTER_CUBIC);
  }
  return reduced(fromGrays(grays, mirrorIn(grays), sheet), factor, size);
}

} // namespace homeward
