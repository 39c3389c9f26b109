// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/viewer/home_vector_picture.h>

#include "symbols.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace homeward
{

namespace
{

constexpr double kTitleHeight = 40.0;  // pixels
constexpr double kLegendHeight = 36.0; // pixels
constexpr double kGap = 8.0;           // between panels, pixels
constexpr double kUnsure = 0.1;        // confidence of hollow arrows

/** What errors up to `limit` look like. */
struct ErrorClass
{
  double limit; // radians
  Colour colour;
  const char *words;
};

constexpr std::array<ErrorClass, 4> kClasses{{{radians(15.0), {27, 122, 61}, "below 15 deg"},
                                              {radians(45.0), {214, 158, 0}, "below 45"},
                                              {radians(90.0), {230, 81, 0}, "below 90"},
                                              {4.0, {198, 21, 21}, "away from home"}}};

Colour colourOf(double error)
{
  return std::find_if(kClasses.begin(), kClasses.end() - 1,
                      [&](const ErrorClass &kind) { return error < kind.limit; })
      ->colour;
}

class HomeVectorDrawing
{
public:
  explicit HomeVectorDrawing(const HomeVectorPicture &picture) : m_picture(&picture)
  {
    if (picture.fields.empty() || picture.panelWidth < 50 || picture.columns < 1 ||
        !(picture.reach > 0.0)) {
      throw LogicError("home vector picture: " + std::to_string(picture.fields.size()) +
                       " homes in panels of " + std::to_string(picture.panelWidth) +
                       " pixels, at least one home and 50 pixels are needed");
    }
    m_columns = std::min(picture.columns, static_cast<int>(picture.fields.size()));
    m_rows = (static_cast<int>(picture.fields.size()) + m_columns - 1) / m_columns;
    m_top = picture.title.empty() ? kGap : kTitleHeight;
  }

  int width() const
  {
    // The legend needs its room.
    return std::max(560, static_cast<int>(kGap + m_columns * (m_picture->panelWidth + kGap)));
  }
  int height() const
  {
    return static_cast<int>(m_top + m_rows * (m_picture->panelWidth + kGap) + kLegendHeight);
  }

  void draw(Canvas &canvas) const
  {
    for (std::size_t i = 0; i < m_picture->fields.size(); ++i) {
      drawPanel(canvas, m_picture->fields[i], corner(static_cast<int>(i)));
    }
    if (!m_picture->title.empty()) {
      canvas.text({16.0, 26.0}, m_picture->title, 12.0, palette::kInk, Anchor::Left);
    }
    drawLegend(canvas);
  }

private:
  double scale() const { return m_picture->panelWidth / (2.0 * m_picture->reach); }

  Point corner(int panel) const
  {
    const double side = m_picture->panelWidth + kGap;
    return {kGap + (panel % m_columns) * side, m_top + (panel / m_columns) * side};
  }

  /** The floor round a home, as large as a panel. */
  cv::Mat floorAround(const Eigen::Vector2d &home) const
  {
    const int side = m_picture->panelWidth;
    cv::Mat panel(side, side, CV_8UC3, cv::Scalar::all(255));
    if (!m_picture->floor) {
      return panel;
    }
    const FloorPicture &floor = *m_picture->floor;
    for (int v = 0; v < side; ++v) {
      for (int u = 0; u < side; ++u) {
        const double x = home.x() + (u + 0.5) / scale() - m_picture->reach;
        const double y = home.y() - (v + 0.5) / scale() + m_picture->reach;
        const int column = static_cast<int>(std::floor((x - floor.origin.x()) / floor.resolution));
        const int row = floor.image.rows - 1 -
                        static_cast<int>(std::floor((y - floor.origin.y()) / floor.resolution));
        const bool inside =
            column >= 0 && row >= 0 && column < floor.image.cols && row < floor.image.rows;
        const int value = inside ? floor.image.at<unsigned char>(row, column) : 190;
        const Colour colour = value < 100    ? palette::kObstacle
                              : value >= 250 ? palette::kWhite
                                             : palette::kFloor;
        panel.at<cv::Vec3b>(v, u) = {colour.b, colour.g, colour.r};
      }
    }
    return panel;
  }

  void drawPanel(Canvas &canvas, const HomeVectorField &field, const Point &corner) const
  {
    const double side = m_picture->panelWidth;
    canvas.image(floorAround(field.home), corner, {side, side});
    const auto pixel = [&](const Eigen::Vector2d &place) {
      const Eigen::Vector2d offset = place - field.home;
      return Point(corner + Point(side / 2.0, side / 2.0) +
                   scale() * Point(offset.x(), -offset.y()));
    };
    if (!field.way.empty()) {
      std::vector<Point> way;
      std::transform(field.way.begin(), field.way.end(), std::back_inserter(way), pixel);
      canvas.line(way, {std::nullopt, palette::kWay, 1.5});
      canvas.circle(way.front(), 3.5, {palette::kWay, std::nullopt, 1.0});
    }
    for (const HomeArrow &arrow : field.arrows) {
      drawArrow(canvas, pixel(arrow.place), arrow);
    }
    canvas.circle(pixel(field.home), 6.0, {palette::kWay, palette::kWhite, 1.5});
    canvas.polygon(
        {corner, corner + Point(side, 0.0), corner + Point(side, side), corner + Point(0.0, side)},
        {std::nullopt, palette::kFaint, 1.0});
  }

  void drawArrow(Canvas &canvas, const Point &at, const HomeArrow &arrow) const
  {
    const double length = 0.3 * scale();
    const Colour colour = colourOf(arrow.error);
    const Point tip = at + 0.5 * length * towards(arrow.direction);
    const Point tail = at - 0.5 * length * towards(arrow.direction);
    const std::optional<Colour> fill = arrow.confidence < kUnsure ? palette::kWhite : colour;
    canvas.line({tail, tip}, {std::nullopt, colour, 1.8});
    drawArrowHead(canvas, tip - 0.3 * length * towards(arrow.direction), arrow.direction,
                  0.5 * length, {fill, colour, 1.2});
  }

  void drawLegend(Canvas &canvas) const
  {
    const double y = height() - 0.5 * kLegendHeight;
    double x = 16.0;
    for (const ErrorClass &kind : kClasses) {
      canvas.circle({x, y}, 5.0, {kind.colour, std::nullopt, 1.0});
      canvas.text({x + 10.0, y + 4.0}, kind.words, 8.0, palette::kInk, Anchor::Left);
      x += 130.0;
    }
  }

  const HomeVectorPicture *m_picture;
  int m_columns = 1;
  int m_rows = 1;
  double m_top = 0.0;
};

} // namespace

std::string homeVectorSvg(const HomeVectorPicture &picture)
{
  const HomeVectorDrawing drawing(picture);
  SvgCanvas canvas(drawing.width(), drawing.height());
  drawing.draw(canvas);
  return canvas.svg();
}

cv::Mat homeVectorImage(const HomeVectorPicture &picture)
{
  const HomeVectorDrawing drawing(picture);
  RasterCanvas canvas(drawing.width(), drawing.height());
  drawing.draw(canvas);
  return canvas.picture();
}

} // namespace homeward
