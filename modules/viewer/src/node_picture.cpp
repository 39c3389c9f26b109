// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/viewer/node_picture.h>

#include "legend.h"
#include "node_tables.h"

#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

constexpr int kSmallestWidth = 800;     // pixels
constexpr double kBorder = 28.0;        // white round everything, pixels
constexpr double kTitleHeight = 30.0;   // pixels
constexpr double kScaleHeight = 62.0;   // bearings below the panorama, with a gap, pixels
constexpr double kDiscShare = 0.46;     // of the width between the borders
constexpr double kDiscBorder = 46.0;    // room for the bearings round the disc, pixels
constexpr double kHeadHeight = 30.0;    // of what is below the panorama, pixels
constexpr double kLabelsApart = 0.32;   // radians, from which on two labels at the rim are apart
constexpr double kUnknownLength = 0.96; // of the disc's radius, where neighbours of that stand

Colour shadeOf(DirectionState state)
{
  constexpr Colour kDrivenShade{206, 225, 245};
  constexpr Colour kClosedShade{228, 228, 228};
  return state == DirectionState::Open     ? palette::kOpenShade
         : state == DirectionState::Driven ? kDrivenShade
                                           : kClosedShade;
}

Colour colourOf(DirectionState state)
{
  return state == DirectionState::Open     ? palette::kOpen
         : state == DirectionState::Driven ? palette::kWay
                                           : palette::kClosed;
}

/** In whole metres, so that every neighbour is well inside. */
double rangeFor(const TopologicalMap &map, NodeId node)
{
  double farthest = 1.0;
  for (const Link &link : map.links(node)) {
    farthest = std::max(farthest, map.edge(link.edge).length.value_or(0.0));
  }
  return std::ceil(1.15 * farthest);
}

class NodeDrawing
{
public:
  NodeDrawing(const TopologicalMap &map, NodeId node, const NodePicture &picture)
      : m_map(&map), m_node(&map.node(node)), m_picture(&picture), m_range(rangeFor(map, node)),
        m_tables(nodeTables(map, node, picture.alike)), m_legend(makeLegend())
  {
    if (picture.width < kSmallestWidth) {
      throw LogicError("node picture: width " + std::to_string(picture.width) + ", at least " +
                       std::to_string(kSmallestWidth) + " is needed");
    }
    const double room = picture.width - 2.0 * kBorder;
    m_top = kBorder + (picture.title.empty() ? 0.0 : kTitleHeight);
    m_panoramaSize = {room, room * shapeOfPanorama()};
    m_below = m_top + m_panoramaSize.y() + kScaleHeight;
    m_radius = 0.5 * kDiscShare * room - kDiscBorder;
    m_centre = {kBorder + 0.5 * kDiscShare * room,
                m_below + kHeadHeight + 0.6 * kDiscBorder + m_radius};
    double tables = 0.0;
    for (const NodeTable &table : m_tables) {
      tables += table.height();
    }
    const double disc = m_centre.y() + m_radius + kDiscBorder;
    m_legendY = std::max(disc, m_below + tables) + 0.5 * Legend::kRowHeight;
    m_height = static_cast<int>(
        std::ceil(m_legendY - 0.5 * Legend::kRowHeight + m_legend.height() + 0.5 * kBorder));
  }

  int width() const { return m_picture->width; }
  int height() const { return m_height; }

  void draw(Canvas &canvas) const
  {
    if (!m_picture->title.empty()) {
      canvas.text({kBorder, kBorder + 8.0}, m_picture->title, 13.0, palette::kInk, Anchor::Left);
    }
    drawPanorama(canvas);
    drawBearings(canvas);
    drawDisc(canvas);
    Point corner{kBorder + (kDiscShare + 0.02) * m_panoramaSize.x(), m_below};
    for (const NodeTable &table : m_tables) {
      table.draw(canvas, corner, m_picture->width - kBorder - corner.x());
      corner.y() += table.height();
    }
    m_legend.draw(canvas, {kBorder, m_legendY});
  }

private:
  /** Height by width; checks that picture and geometry fit. */
  double shapeOfPanorama() const
  {
    if (!m_picture->panorama) {
      return 0.1;
    }
    const cv::Mat &image = m_picture->panorama->image;
    const PanoramaGeometry &geometry = m_picture->panorama->geometry;
    if (image.empty() || image.size() != cv::Size(geometry.width, geometry.height) ||
        (image.type() != CV_8UC1 && image.type() != CV_8UC3)) {
      throw LogicError("node picture: the panorama has " + std::to_string(image.cols) + " x " +
                       std::to_string(image.rows) + " pixels of type " +
                       std::to_string(image.type()) + ", its geometry " +
                       std::to_string(geometry.width) + " x " + std::to_string(geometry.height));
    }
    return static_cast<double>(image.rows) / image.cols;
  }

  void drawPanorama(Canvas &canvas) const
  {
    const Point corner{kBorder, m_top};
    const Point size = m_panoramaSize;
    if (m_picture->panorama) {
      cv::Mat colour = m_picture->panorama->image;
      if (colour.channels() == 1) {
        cv::cvtColor(colour, colour, cv::COLOR_GRAY2BGR);
      }
      canvas.image(colour, corner, size);
      return;
    }
    canvas.polygon(
        {corner, corner + Point(size.x(), 0.0), corner + size, corner + Point(0.0, size.y())},
        {palette::kFloor, std::nullopt, 1.0});
    canvas.text(corner + 0.5 * size + Point(0.0, 5.0), "no panorama is stored", 10.0,
                palette::kFaint, Anchor::Middle);
  }

  /** Where a bearing is in the panorama, pixels from the left. */
  double acrossOf(double bearing) const
  {
    return kBorder + m_panoramaSize.x() * (kPi - wrapAngle(bearing)) / (2.0 * kPi);
  }

  /** Bearings below the panorama, directions as arrows that point up at it. */
  void drawBearings(Canvas &canvas) const
  {
    const double y = m_top + m_panoramaSize.y();
    for (int tick = -180; tick <= 180; tick += 45) {
      const double x = kBorder + m_panoramaSize.x() * (180 - tick) / 360.0;
      canvas.line({{x, y}, {x, y + 5.0}}, {std::nullopt, palette::kFaint, 1.2});
      const std::string words = tick == 0               ? "ahead, 0 deg"
                                : tick == 90            ? "left, +90 deg"
                                : tick == -90           ? "right, -90 deg"
                                : std::abs(tick) == 180 ? "behind"
                                                        : bearingText(radians(tick));
      canvas.text({x, y + 30.0}, words, 8.0, palette::kFaint,
                  tick == 180    ? Anchor::Left
                  : tick == -180 ? Anchor::Right
                                 : Anchor::Middle);
    }
    for (const Direction &direction : m_node->directions) {
      const Point tip{acrossOf(direction.bearing), y + 1.0};
      drawDirection(canvas, tip + Point(0.0, kNodeRadius + 12.5), 0.5 * kPi, direction.state);
    }
  }

  double scale() const { return m_radius / m_range; }

  /** On the canvas, of a bearing with the stored heading on top. */
  static double up(double bearing) { return bearing + 0.5 * kPi; }

  void drawDisc(Canvas &canvas) const
  {
    canvas.text({kBorder, m_below + 12.0}, "From above, stored heading on top", 10.0, palette::kInk,
                Anchor::Left);
    for (const DirectionState state :
         {DirectionState::Closed, DirectionState::Driven, DirectionState::Open}) {
      drawSectors(canvas, state);
    }
    drawRings(canvas);
    drawRim(canvas);
    drawNeighbours(canvas);
    drawNode(canvas, m_centre, up(0.0), std::to_string(m_node->id.value));
  }

  void drawSectors(Canvas &canvas, DirectionState state) const
  {
    for (const Direction &direction : m_node->directions) {
      if (direction.state != state) {
        continue;
      }
      std::vector<Point> shape{m_centre};
      const double half = 0.5 * std::min(direction.width, 2.0 * kPi);
      const int steps = std::max(2, static_cast<int>(std::ceil(half / radians(1.0))));
      for (int i = -steps; i <= steps; ++i) {
        shape.push_back(m_centre + m_radius * towards(up(direction.bearing + half * i / steps)));
      }
      canvas.polygon(shape, {shadeOf(state), colourOf(state), 0.8});
    }
  }

  void drawRings(Canvas &canvas) const
  {
    const double step = m_range <= 6.0 ? 1.0 : m_range <= 12.0 ? 2.0 : 5.0;
    for (int ring = 1; step * ring < m_range; ++ring) {
      canvas.circle(m_centre, scale() * step * ring, {std::nullopt, palette::kGrid, 0.8});
    }
    canvas.circle(m_centre, m_radius, {std::nullopt, palette::kFaint, 1.2});
    const Point outward = towards(up(freeBearing()));
    for (int ring = 1; step * ring <= m_range; ++ring) {
      canvas.text(m_centre + (scale() * step * ring - 17.0) * outward + Point(0.0, 4.0),
                  std::to_string(std::lround(step * ring)) + " m", 7.5, palette::kFaint,
                  Anchor::Middle);
    }
  }

  /** The bearing that is farthest from ways and from the middles and sides of directions. */
  double freeBearing() const
  {
    std::vector<double> taken;
    for (const Direction &direction : m_node->directions) {
      for (const double side : {-0.5, 0.0, 0.5}) {
        taken.push_back(direction.bearing + side * direction.width);
      }
    }
    for (const Link &link : m_map->links(m_node->id)) {
      taken.push_back(m_map->departureBearing(m_node->id, link.to).value_or(kPi));
    }
    const auto clearance = [&](double bearing) {
      double nearest = kPi;
      for (const double other : taken) {
        nearest = std::min(nearest, std::abs(wrapAngle(other - bearing)));
      }
      return nearest;
    };
    double best = 0.0;
    for (int i = 1; i < 72; ++i) {
      const double bearing = wrapAngle(radians(5.0 * i));
      if (clearance(bearing) > clearance(best)) {
        best = bearing;
      }
    }
    return best;
  }

  /** Arrows and bearings of the directions round the disc; a label that would cover one before it
   * is left out, the table has it. */
  void drawRim(Canvas &canvas) const
  {
    std::vector<double> labels;
    for (const Direction &direction : m_node->directions) {
      const Point outward = towards(up(direction.bearing));
      drawDirection(canvas, m_centre + (m_radius - kNodeRadius - 2.0) * outward,
                    up(direction.bearing), direction.state);
      if (std::any_of(labels.begin(), labels.end(), [&](double label) {
            return std::abs(wrapAngle(label - direction.bearing)) < kLabelsApart;
          })) {
        continue;
      }
      labels.push_back(direction.bearing);
      const Anchor anchor = outward.x() > 0.3    ? Anchor::Left
                            : outward.x() < -0.3 ? Anchor::Right
                                                 : Anchor::Middle;
      canvas.text(m_centre + (m_radius + 13.0) * outward + Point(0.0, 4.0 + 5.0 * outward.y()),
                  bearingText(direction.bearing), 8.0, palette::kInk, anchor);
    }
  }

  void drawNeighbours(Canvas &canvas) const
  {
    const auto placeOf = [&](const Link &link, double bearing) -> Point {
      const std::optional<double> length = m_map->edge(link.edge).length;
      const double reach = length ? *length : kUnknownLength * m_range;
      return m_centre + scale() * reach * towards(up(bearing));
    };
    for (const Link &link : m_map->links(m_node->id)) {
      if (const auto bearing = m_map->departureBearing(m_node->id, link.to)) {
        canvas.line({m_centre, placeOf(link, *bearing)}, {std::nullopt, palette::kWay, 2.4});
      }
    }
    for (const Link &link : m_map->links(m_node->id)) {
      if (const auto bearing = m_map->departureBearing(m_node->id, link.to)) {
        drawPlace(canvas, placeOf(link, *bearing), std::to_string(link.to.value));
      }
    }
  }

  /** A neighbour: its heading is not known here. */
  static void drawPlace(Canvas &canvas, const Point &at, const std::string &label)
  {
    canvas.circle(at, kNodeRadius, {palette::kWhite, palette::kWay, 1.8});
    if (!label.empty()) {
      const double size = label.size() < 3 ? 7.0 : 5.5;
      canvas.text(at + Point(0.0, 0.5 * size), label, size, palette::kInk, Anchor::Middle);
    }
  }

  Legend makeLegend() const
  {
    const double room = m_picture->width - 2.0 * kBorder;
    return {{{2.0 * kNodeRadius + 11.0, "this place and its heading",
              [](Canvas &canvas, const Point &at) {
                drawNode(canvas, at + Point(kNodeRadius, 0.0), 0.0, "");
              }},
             {2.0 * kNodeRadius + 8.0, "neighbour",
              [](Canvas &canvas, const Point &at) {
                drawPlace(canvas, at + Point(kNodeRadius, 0.0), "");
              }},
             lineEntry("way", {std::nullopt, palette::kWay, 2.4}),
             directionEntry(DirectionState::Open, "open direction"),
             directionEntry(DirectionState::Driven, "driven"),
             directionEntry(DirectionState::Closed, "closed")},
            room,
            room};
  }

  const TopologicalMap *m_map;
  const Node *m_node;
  const NodePicture *m_picture;
  double m_range; ///< metres from the middle to the rim
  std::vector<NodeTable> m_tables;
  Legend m_legend;
  double m_top = 0.0; ///< of the panorama, as the following pixels
  Point m_panoramaSize{0.0, 0.0};
  double m_below = 0.0; ///< top of what is below the panorama
  double m_radius = 0.0;
  Point m_centre{0.0, 0.0};
  double m_legendY = 0.0;
  int m_height = 0;
};

} // namespace

std::string nodeSvg(const TopologicalMap &map, NodeId node, const NodePicture &picture)
{
  const NodeDrawing drawing(map, node, picture);
  SvgCanvas canvas(drawing.width(), drawing.height());
  drawing.draw(canvas);
  return canvas.svg();
}

cv::Mat nodeImage(const TopologicalMap &map, NodeId node, const NodePicture &picture)
{
  const NodeDrawing drawing(map, node, picture);
  RasterCanvas canvas(drawing.width(), drawing.height());
  drawing.draw(canvas);
  return canvas.picture();
}

} // namespace homeward
