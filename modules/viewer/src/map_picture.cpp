// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/viewer/map_picture.h>

#include "legend.h"
#include "symbols.h"

#include <homeward/core/error.h>
#include <homeward/viewer/map_layout.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

constexpr double kBorder = 28.0;        // white round everything, pixels
constexpr double kTitleHeight = 52.0;   // pixels
constexpr double kFooterGap = 9.0;      // above legend and scale bar, pixels
constexpr double kLongestBar = 130.0;   // of the scale, pixels
constexpr double kBarLabelWidth = 66.0; // what stands before it, with a gap, pixels
constexpr int kSmallestWidth = 200;     // pixels

/** A rectangle of the world that grows with what it must hold. */
struct Extent
{
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e9);

  void hold(const Eigen::Vector2d &point, double margin)
  {
    low = low.cwiseMin(point - Eigen::Vector2d::Constant(margin));
    high = high.cwiseMax(point + Eigen::Vector2d::Constant(margin));
  }
};

/** The pixels of a floor that show something, as a rectangle of its picture. */
cv::Rect usedPart(const FloorPicture &floor)
{
  const cv::Rect floorPart = cv::boundingRect(floor.image >= 250);
  const cv::Rect obstaclePart = cv::boundingRect(floor.image < 100);
  const cv::Rect used = floorPart.empty()      ? obstaclePart
                        : obstaclePart.empty() ? floorPart
                                               : (floorPart | obstaclePart);
  return used.empty() ? cv::Rect(cv::Point(0, 0), floor.image.size()) : used;
}

/** World coordinates of a corner of a floor's pixels. */
Eigen::Vector2d cornerOf(const FloorPicture &floor, const cv::Point &corner)
{
  return floor.origin + floor.resolution * Eigen::Vector2d(corner.x, floor.image.rows - corner.y);
}

cv::Mat tinted(const cv::Mat &floor)
{
  const auto bgr = [](Colour c) { return cv::Scalar(c.b, c.g, c.r); };
  cv::Mat picture(floor.size(), CV_8UC3, bgr(palette::kWhite));
  picture.setTo(bgr(palette::kFloor), floor >= 250);
  picture.setTo(bgr(palette::kObstacle), floor < 100);
  return picture;
}

/** Lays a map out on a canvas and draws it. */
class MapDrawing
{
public:
  MapDrawing(const TopologicalMap &map, const MapPicture &picture)
      : m_map(&map), m_picture(&picture), m_poses(picture.poses), m_metric(!picture.poses.empty())
  {
    if (picture.width < kSmallestWidth) {
      throw LogicError("map picture: width " + std::to_string(picture.width) + ", at least " +
                       std::to_string(kSmallestWidth) + " is needed");
    }
    if (!m_metric) {
      m_poses = layOut(map);
    }
    for (const auto &[id, node] : map.nodes()) {
      if (m_poses.count(id) == 0) {
        throw LogicError("map picture: node " + std::to_string(id.value) + " has no pose");
      }
    }
    fit();
  }

  int width() const { return m_picture->width; }
  int height() const { return m_height; }

  void draw(Canvas &canvas) const
  {
    drawFloor(canvas);
    drawWays(canvas);
    if (m_picture->robot && m_metric) {
      drawRobot(canvas, pixel(m_picture->robot->translation()), m_picture->robot->heading,
                std::max(30.0, 0.5 * m_scale));
    }
    drawNodes(canvas);
    drawTitle(canvas);
    if (m_metric) {
      drawScaleBar(canvas);
    }
    if (m_picture->legend) {
      legend().draw(canvas, {kBorder, footerY()});
    }
  }

private:
  bool showsFloor() const { return m_metric && m_picture->floor.has_value(); }

  Point pixel(const Eigen::Vector2d &world) const
  {
    return {m_corner.x() + m_scale * (world.x() - m_extent.low.x()),
            m_corner.y() + m_scale * (m_extent.high.y() - world.y())};
  }

  void fit()
  {
    for (const auto &[id, pose] : m_poses) {
      m_extent.hold(pose.translation(), 0.5);
    }
    if (showsFloor()) {
      const cv::Rect used = usedPart(*m_picture->floor);
      m_extent.hold(cornerOf(*m_picture->floor, used.tl()), 0.0);
      m_extent.hold(cornerOf(*m_picture->floor, used.br()), 0.0);
    }
    if (m_metric) {
      for (const Eigen::Vector2d &point : m_picture->trajectory) {
        m_extent.hold(point, 0.3);
      }
      if (m_picture->robot) {
        m_extent.hold(m_picture->robot->translation(), 0.5);
      }
    }
    if (m_extent.low.x() > m_extent.high.x()) {
      m_extent.hold({0.0, 0.0}, 1.0);
    }
    const Eigen::Vector2d size = m_extent.high - m_extent.low;
    const double room = m_picture->width - 2.0 * kBorder;
    // A tall map is scaled down so that the picture is not higher than 1.2 times its width.
    m_scale = std::min(room / size.x(), 1.2 * room / size.y());
    const double title = m_picture->title.empty() ? 0.0 : kTitleHeight;
    m_corner = {kBorder + 0.5 * (room - m_scale * size.x()), kBorder + title};
    m_bottom = m_corner.y() + m_scale * size.y();
    const double legend = m_picture->legend ? this->legend().height() : 0.0;
    const double footer = m_metric ? std::max(legend, Legend::kRowHeight) : legend;
    m_height = static_cast<int>(
        std::ceil(m_bottom + (footer > 0.0 ? footer + kFooterGap : 0.0) + kBorder));
  }

  void drawFloor(Canvas &canvas) const
  {
    if (showsFloor()) {
      const FloorPicture &floor = *m_picture->floor;
      const cv::Rect used = usedPart(floor);
      const Point upperLeft = pixel(cornerOf(floor, used.tl()));
      canvas.image(tinted(floor.image(used)), upperLeft,
                   pixel(cornerOf(floor, used.br())) - upperLeft);
    }
    if (m_metric && m_picture->trajectory.size() > 1) {
      std::vector<Point> path;
      for (const Eigen::Vector2d &point : m_picture->trajectory) {
        const Point next = pixel(point);
        if (path.empty() || (next - path.back()).norm() > 1.0) {
          path.push_back(next);
        }
      }
      canvas.line(path, {std::nullopt, palette::kPath, 1.6});
    }
  }

  void drawWays(Canvas &canvas) const
  {
    for (const auto &[id, edge] : m_map->edges()) {
      canvas.line({place(edge.a), place(edge.b)}, {std::nullopt, palette::kWay, 2.4});
    }
    std::vector<Point> route;
    for (const NodeId node : m_picture->route) {
      m_map->node(node);
      route.push_back(place(node));
    }
    canvas.line(route, {std::nullopt, palette::kRoute, 5.0});
  }

  void drawNodes(Canvas &canvas) const
  {
    for (const auto &[id, node] : m_map->nodes()) {
      for (const Direction &direction : node.directions) {
        drawDirection(canvas, place(id), m_poses.at(id).heading + direction.bearing,
                      direction.state);
      }
    }
    for (const auto &[id, node] : m_map->nodes()) {
      drawNode(canvas, place(id), m_poses.at(id).heading, std::to_string(id.value));
    }
  }

  void drawTitle(Canvas &canvas) const
  {
    if (m_picture->title.empty()) {
      return;
    }
    canvas.text({kBorder, kBorder + 12.0}, m_picture->title, 13.0, palette::kInk, Anchor::Left);
    const std::string facts =
        counted(m_map->nodes().size(), "place") + ", " + counted(m_map->edges().size(), "way") +
        ", " + counted(static_cast<std::size_t>(m_map->openDirectionCount()), "open direction");
    canvas.text({kBorder, kBorder + 32.0}, facts, 9.0, palette::kFaint, Anchor::Left);
  }

  /** Middle of the first row below the map, pixels. */
  double footerY() const { return m_bottom + kFooterGap + 0.5 * Legend::kRowHeight; }

  /** Metres that the scale bar stands for: a round number, at most kLongestBar pixels. */
  double barMetres() const
  {
    double metres = 0.1;
    for (const double candidate : {0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
      if (candidate * m_scale <= kLongestBar) {
        metres = candidate;
      }
    }
    return metres;
  }

  void drawScaleBar(Canvas &canvas) const
  {
    const double y = footerY() + 2.0;
    const double metres = barMetres();
    const double right = m_picture->width - kBorder;
    const double left = right - metres * m_scale;
    const Style bar{std::nullopt, palette::kInk, 1.6};
    canvas.line({{left, y - 4.0}, {left, y}, {right, y}, {right, y - 4.0}}, bar);
    const std::string label = metres < 1.0 ? std::to_string(std::lround(100.0 * metres)) + " cm"
                                           : std::to_string(std::lround(metres)) + " m";
    canvas.text({left - 6.0, y}, label, 8.0, palette::kInk, Anchor::Right);
  }

  /** What the symbols mean, in rows that leave room for the scale bar at the end of the first. */
  Legend legend() const
  {
    std::vector<LegendEntry> entries{{2.0 * kNodeRadius + 11.0, "place and heading",
                                      [](Canvas &canvas, const Point &at) {
                                        drawNode(canvas, at + Point(kNodeRadius, 0.0), 0.0, "");
                                      }},
                                     lineEntry("way", {std::nullopt, palette::kWay, 2.4})};
    for (const DirectionState state :
         {DirectionState::Open, DirectionState::Driven, DirectionState::Closed}) {
      entries.push_back(directionEntry(state, std::string(name(state))));
    }
    if (m_metric && m_picture->trajectory.size() > 1) {
      entries.push_back(lineEntry("from stop to stop", {std::nullopt, palette::kPath, 1.6}));
    }
    if (m_picture->route.size() > 1) {
      entries.push_back(lineEntry("route", {std::nullopt, palette::kRoute, 5.0}));
    }
    const double room = m_picture->width - 2.0 * kBorder;
    const double bar = m_metric ? barMetres() * m_scale + kBarLabelWidth : 0.0;
    return {std::move(entries), room - bar, room};
  }

  Point place(NodeId id) const { return pixel(m_poses.at(id).translation()); }

  const TopologicalMap *m_map;
  const MapPicture *m_picture;
  std::map<NodeId, Pose2> m_poses;
  bool m_metric; ///< whether a unit of the poses is a metre
  Extent m_extent;
  double m_scale = 1.0;  ///< pixels per unit
  Point m_corner{0, 0};  ///< of the extent on the canvas
  double m_bottom = 0.0; ///< of the extent on the canvas
  int m_height = 0;
};

} // namespace

std::string mapSvg(const TopologicalMap &map, const MapPicture &picture)
{
  const MapDrawing drawing(map, picture);
  SvgCanvas canvas(drawing.width(), drawing.height());
  drawing.draw(canvas);
  return canvas.svg();
}

cv::Mat mapImage(const TopologicalMap &map, const MapPicture &picture)
{
  const MapDrawing drawing(map, picture);
  RasterCanvas canvas(drawing.width(), drawing.height());
  drawing.draw(canvas);
  return canvas.picture();
}

} // namespace homeward
