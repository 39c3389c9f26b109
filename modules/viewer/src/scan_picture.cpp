// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/viewer/scan_picture.h>

#include "symbols.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace homeward
{

namespace
{

constexpr Colour kUnseen{232, 235, 237};
constexpr double kBorder = 66.0;      // room for the bearings round the disc, pixels
constexpr double kTitleHeight = 34.0; // pixels
constexpr double kLegendX = 24.0;     // pixels
constexpr int kSmallestWidth = 200;   // pixels
constexpr double kRobotLength = 0.5;  // metres

/** Metres from the middle that show every hit, in whole metres. */
double neededRange(const Scan &scan)
{
  double farthest = 1.0;
  for (const float range : scan.ranges) {
    if (std::isfinite(range) && range < scan.rangeMax) {
      farthest = std::max(farthest, static_cast<double>(range));
    }
  }
  return std::ceil(1.05 * farthest);
}

class ScanDrawing
{
public:
  ScanDrawing(const Scan &scan, const ScanPicture &picture)
      : m_scan(&scan), m_picture(&picture),
        m_range(picture.range > 0.0 ? picture.range : neededRange(scan))
  {
    if (picture.width < kSmallestWidth) {
      throw LogicError("scan picture: width " + std::to_string(picture.width) + ", at least " +
                       std::to_string(kSmallestWidth) + " is needed");
    }
    if (!(picture.range >= 0.0)) {
      throw LogicError("scan picture: range " + std::to_string(picture.range) + " m is negative");
    }
    const double title = picture.title.empty() ? 0.0 : kTitleHeight;
    m_radius = 0.5 * picture.width - kBorder;
    m_centre = {0.5 * picture.width, title + 0.5 * kBorder + m_radius};
  }

  int width() const { return m_picture->width; }
  int height() const
  {
    return static_cast<int>(
        std::ceil(m_centre.y() + m_radius + 0.5 * kBorder + legend().height() + 8.0));
  }

  void draw(Canvas &canvas) const
  {
    canvas.circle(m_centre, m_radius, {kUnseen, std::nullopt, 1.0});
    drawSeen(canvas, palette::kWhite, [](double) { return true; });
    drawSeen(canvas, palette::kOpenShade, [this](double angle) { return isOpen(angle); });
    drawRings(canvas);
    drawHits(canvas);
    drawArrows(canvas);
    drawRobot(canvas, m_centre, 0.5 * kPi, std::max(14.0, kRobotLength * scale()));
    if (!m_picture->title.empty()) {
      canvas.text({24.0, 34.0}, m_picture->title, 12.0, palette::kInk, Anchor::Left);
    }
    legend().draw(canvas, {kLegendX, m_centre.y() + m_radius + 0.5 * kBorder + 8.0});
  }

private:
  double scale() const { return m_radius / m_range; }

  /** Forward is up. Metres and radians in the scan's frame; beyond the outer ring it stops there.
   */
  Point pixel(double angle, double range) const
  {
    return m_centre + scale() * std::min(range, m_range) * towards(angle + 0.5 * kPi);
  }

  bool isOpen(double angle) const
  {
    return std::any_of(m_picture->openDirections.begin(), m_picture->openDirections.end(),
                       [&](const OpenDirection &direction) {
                         return std::abs(wrapAngle(angle - direction.bearing)) <=
                                0.5 * direction.width;
                       });
  }

  /** Fills the floor in front of the known readings that are wanted, neighbours as one shape. */
  void drawSeen(Canvas &canvas, Colour colour, const std::function<bool(double)> &wanted) const
  {
    std::vector<Point> shape{m_centre};
    const auto finish = [&] {
      if (shape.size() > 2) {
        canvas.polygon(shape, {colour, std::nullopt, 1.0});
      }
      shape.resize(1);
    };
    for (std::size_t i = 0; i < m_scan->ranges.size(); ++i) {
      const double angle = m_scan->angle(i);
      const double range = m_scan->ranges[i];
      if (std::isnan(range) || !wanted(angle)) {
        finish();
        continue;
      }
      shape.push_back(pixel(angle - 0.5 * m_scan->angleStep, range));
      shape.push_back(pixel(angle + 0.5 * m_scan->angleStep, range));
    }
    finish();
  }

  void drawRings(Canvas &canvas) const
  {
    const double step = m_range <= 6.0 ? 1.0 : m_range <= 12.0 ? 2.0 : 5.0;
    for (int i = 0; i < 8; ++i) {
      const double angle = 0.25 * kPi * i;
      canvas.line({m_centre, pixel(angle, m_range)}, {std::nullopt, palette::kGrid, 0.8});
    }
    for (int ring = 1; step * ring < m_range; ++ring) {
      canvas.circle(m_centre, scale() * step * ring, {std::nullopt, palette::kGrid, 0.8});
    }
    canvas.circle(m_centre, m_radius, {std::nullopt, palette::kFaint, 1.2});
    for (int ring = 1; step * ring <= m_range; ++ring) {
      const Point at = m_centre + Point(4.0, 12.0 - scale() * step * ring);
      canvas.text(at, std::to_string(std::lround(step * ring)) + " m", 7.5, palette::kFaint,
                  Anchor::Left);
    }
  }

  void drawHits(Canvas &canvas) const
  {
    for (std::size_t i = 0; i < m_scan->ranges.size(); ++i) {
      const double range = m_scan->ranges[i];
      if (range < m_scan->rangeMax && range <= m_range) {
        canvas.circle(pixel(m_scan->angle(i), range), 2.0, {palette::kInk, std::nullopt, 1.0});
      }
    }
  }

  void drawArrows(Canvas &canvas) const
  {
    for (const OpenDirection &direction : m_picture->openDirections) {
      const double angle = direction.bearing + 0.5 * kPi;
      const double reach = scale() * std::min(direction.range, 0.9 * m_range);
      const double length = std::max(reach - 12.0, 24.0);
      const Point tail = m_centre + 0.35 * length * towards(angle);
      const Point base = m_centre + length * towards(angle);
      canvas.line({tail, base}, {std::nullopt, palette::kOpen, 2.6});
      drawArrowHead(canvas, base, angle, 13.0, {palette::kOpen, palette::kOpen, 1.0});
      const Point outward = towards(angle);
      const Anchor anchor = outward.x() > 0.3    ? Anchor::Left
                            : outward.x() < -0.3 ? Anchor::Right
                                                 : Anchor::Middle;
      canvas.text(m_centre + (m_radius + 10.0) * outward + Point(0.0, 4.0 + 4.0 * outward.y()),
                  std::to_string(std::lround(degrees(wrapAngle(direction.bearing)))) + " deg", 8.0,
                  palette::kOpen, anchor);
    }
  }

  Legend legend() const
  {
    const auto patch = [](const std::string &words, Colour colour) {
      return LegendEntry{18.0, words, [colour](Canvas &canvas, const Point &at) {
                           canvas.polygon({at + Point(0.0, -6.0), at + Point(12.0, -6.0),
                                           at + Point(12.0, 6.0), at + Point(0.0, 6.0)},
                                          {colour, palette::kFaint, 0.8});
                         }};
    };
    const double room = m_picture->width - 2.0 * kLegendX;
    return {{{18.0, "hit",
              [](Canvas &canvas, const Point &at) {
                canvas.circle(at + Point(6.0, 0.0), 2.5, {palette::kInk, std::nullopt, 1.0});
              }},
             patch("seen free", palette::kWhite),
             patch("not seen", kUnseen),
             patch("open direction", palette::kOpenShade)},
            room,
            room};
  }

  const Scan *m_scan;
  const ScanPicture *m_picture;
  double m_range;        ///< metres
  double m_radius = 0.0; ///< pixels
  Point m_centre{0.0, 0.0};
};

} // namespace

std::string scanSvg(const Scan &scan, const ScanPicture &picture)
{
  const ScanDrawing drawing(scan, picture);
  SvgCanvas canvas(drawing.width(), drawing.height());
  drawing.draw(canvas);
  return canvas.svg();
}

cv::Mat scanImage(const Scan &scan, const ScanPicture &picture)
{
  const ScanDrawing drawing(scan, picture);
  RasterCanvas canvas(drawing.width(), drawing.height());
  drawing.draw(canvas);
  return canvas.picture();
}

} // namespace homeward
