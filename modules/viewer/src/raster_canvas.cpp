// SPDX-License-Identifier: GPL-3.0-or-later
#include "canvas.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

constexpr int kFineness = 3;     // fine pixels along a pixel
constexpr int kFractionBits = 4; // of OpenCV's drawing coordinates
constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kCapital = 22.0; // height of a capital of kFont at scale 1, pixels

cv::Scalar bgr(Colour colour)
{
  return {static_cast<double>(colour.b), static_cast<double>(colour.g),
          static_cast<double>(colour.r)};
}

int fraction(double fine)
{
  return cvRound(fine * (1 << kFractionBits));
}

/** The centre of the first pixel is at 0.5 here and at 0 in OpenCV. */
cv::Point fine(const Point &point)
{
  return {fraction(point.x() * kFineness - 0.5), fraction(point.y() * kFineness - 0.5)};
}

std::vector<cv::Point> fine(const std::vector<Point> &points)
{
  std::vector<cv::Point> scaled;
  scaled.reserve(points.size());
  for (const Point &point : points) {
    scaled.push_back(fine(point));
  }
  return scaled;
}

int thickness(double pixels)
{
  return std::max(1, cvRound(pixels * kFineness));
}

} // namespace

RasterCanvas::RasterCanvas(int width, int height)
    : m_size(width, height),
      m_fine(height * kFineness, width * kFineness, CV_8UC3, cv::Scalar::all(255))
{}

void RasterCanvas::line(const std::vector<Point> &points, const Style &style)
{
  if (style.stroke && points.size() > 1) {
    cv::polylines(m_fine, fine(points), false, bgr(*style.stroke), thickness(style.width),
                  cv::LINE_AA, kFractionBits);
  }
}

void RasterCanvas::polygon(const std::vector<Point> &points, const Style &style)
{
  const std::vector<std::vector<cv::Point>> outline{fine(points)};
  if (style.fill) {
    cv::fillPoly(m_fine, outline, bgr(*style.fill), cv::LINE_AA, kFractionBits);
  }
  if (style.stroke) {
    cv::polylines(m_fine, outline, true, bgr(*style.stroke), thickness(style.width), cv::LINE_AA,
                  kFractionBits);
  }
}

void RasterCanvas::circle(const Point &centre, double radius, const Style &style)
{
  // OpenCV's own large circles have visible corners.
  const int corners = std::clamp(cvRound(4.0 * radius), 24, 720);
  std::vector<Point> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * CV_PI * i / corners;
    outline.emplace_back(centre + radius * Point(std::cos(angle), std::sin(angle)));
  }
  polygon(outline, style);
}

void RasterCanvas::text(const Point &at, const std::string &words, double size, Colour colour,
                        Anchor anchor)
{
  const double scale = size * kFineness / kCapital;
  const int weight = std::max(1, cvRound(size * kFineness / 14.0));
  int baseLine = 0;
  const cv::Size extent = cv::getTextSize(words, kFont, scale, weight, &baseLine);
  const double shift = anchor == Anchor::Left     ? 0.0
                       : anchor == Anchor::Middle ? 0.5 * extent.width
                                                  : extent.width;
  cv::putText(m_fine, words, {cvRound(at.x() * kFineness - shift), cvRound(at.y() * kFineness)},
              kFont, scale, bgr(colour), weight, cv::LINE_AA);
}

void RasterCanvas::image(const cv::Mat &picture, const Point &corner, const Point &size)
{
  const cv::Rect place(cvRound(corner.x() * kFineness), cvRound(corner.y() * kFineness),
                       cvRound(size.x() * kFineness), cvRound(size.y() * kFineness));
  const cv::Rect shown = place & cv::Rect(cv::Point(0, 0), m_fine.size());
  if (shown.empty()) {
    return;
  }
  cv::Mat stretched;
  cv::resize(picture, stretched, place.size(), 0.0, 0.0, cv::INTER_LINEAR);
  stretched(shown - place.tl()).copyTo(m_fine(shown));
}

cv::Mat RasterCanvas::picture() const
{
  cv::Mat picture;
  cv::resize(m_fine, picture, m_size, 0.0, 0.0, cv::INTER_AREA);
  return picture;
}

} // namespace homeward
