// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_map.h"
#include "grid_boards.h"
#include "marker_fit.h"
#include "markers.h"
#include "picture_views.h"

#include <homeward/core/angle.h>

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace homeward
{
namespace
{

/** Points that still fix a pose with something to spare. */
constexpr std::size_t kFewest = 6;

/** The corners of every marker seen, clockwise on the board from its top left. */
using Markers = std::map<int, std::array<Eigen::Vector2d, 4>>;

/** Adds the markers of a view that are not known yet. */
void addMarkers(const PictureView &view, const Target &target, std::size_t count, Markers &markers)
{
  auto parameters = cv::aruco::DetectorParameters::create();
  parameters->adaptiveThreshWinSizeMin = 5;
  parameters->adaptiveThreshWinSizeMax = 29;
  parameters->adaptiveThreshWinSizeStep = 8;
  parameters->minMarkerPerimeterRate = 0.02;
  parameters->polygonalApproxAccuracyRate = 0.06; // sides are bent
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_NONE;
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(view.image, dictionaryOf(target.kind), corners, ids, parameters);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] < 0 || static_cast<std::size_t>(ids[i]) >= count) {
      continue;
    }
    std::array<Eigen::Vector2d, 4> pixels;
    for (std::size_t k = 0; k < 4; ++k) {
      pixels[k] = view.toPicture({corners[i][k].x, corners[i][k].y});
    }
    markers.emplace(ids[i], pixels);
  }
}

/** Markers as they are, or as the mirror shows them: whichever are more. */
Markers findMarkers(const cv::Mat1b &picture, const Target &target, std::size_t count,
                    const UnifiedCamera &camera)
{
  std::array<Markers, 2> found; // as they are; flipped
  const auto look = [&](const PictureView &view) {
    if (found[0].size() >= found[1].size() || found[1].size() < 2) {
      addMarkers(view, target, count, found[0]);
    }
    if (found[1].size() >= found[0].size() || found[0].size() < 2) {
      addMarkers(flipped(view), target, count, found[1]);
    }
  };
  look(enlarged(picture, 1.0));
  for (const PatchAim &aim : aimsRound(radians(70.0))) {
    constexpr double kScale = 1.6; // small markers, too
    if (std::max(found[0].size(), found[1].size()) == count) {
      break;
    }
    look(straightened(picture, camera, aim, kScale));
  }
  return found[0].size() >= found[1].size() ? found[0] : found[1];
}

std::array<Eigen::Vector2d, 4> boardCorners(const Eigen::Vector2d &corner, double side)
{
  return {corner, corner + Eigen::Vector2d(side, 0.0), corner + Eigen::Vector2d(side, side),
          corner + Eigen::Vector2d(0.0, side)};
}

/** The corners of a tag to a fraction of a pixel. */
std::optional<std::array<Eigen::Vector2d, 4>>
fittedTag(const cv::Mat1b &picture, const Target &target, int id, const BoardMap &map)
{
  const Eigen::Vector2d corner = markerCorners(target)[static_cast<std::size_t>(id)];
  return fitMarker(picture, markerCells(target.kind, id), [&](const Eigen::Vector2d &unit) {
    return map.toPicture(corner + target.markerSide() * unit);
  });
}

/** A marker board in one picture. */
class MarkerBoard
{
public:
  MarkerBoard(const cv::Mat1b &picture, const Target &target, const UnifiedCamera &camera)
      : m_picture(picture), m_target(target), m_camera(camera), m_corners(markerCorners(target)),
        m_markers(findMarkers(picture, target, m_corners.size(), camera))
  {
    dropImpostors();
  }

  BoardView tagCorners() const
  {
    Markers fitted;
    for (const auto &[id, pixels] : m_markers) {
      fitTag(id, cornersOf(m_markers, {id}), fitted);
    }
    addTagsBeside(fitted);
    BoardView view;
    const std::vector<Eigen::Vector3d> points = targetPoints(m_target);
    for (const auto &[id, pixels] : fitted) {
      for (std::size_t k = 0; k < 4; ++k) {
        const int point = 4 * id + static_cast<int>(k);
        view.ids.push_back(point);
        view.board.push_back(points[static_cast<std::size_t>(point)]);
        view.pixels.push_back(pixels[k]);
      }
    }
    return view;
  }

  BoardView squareCorners() const
  {
    BoardView view;
    const std::vector<Eigen::Vector3d> points = targetPoints(m_target);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d point = points[i].head<2>();
      if (const auto pixel = refinedSquareCorner(point)) {
        view.ids.push_back(static_cast<int>(i));
        view.board.push_back(points[i]);
        view.pixels.push_back(*pixel);
      }
    }
    // Of a board that the rim cuts, so few corners stand together that none vouches for another:
    // then the calibration judges them.
    BoardView kept = withoutStrays(view);
    return kept.ids.size() >= kFewest ? kept : view;
  }

private:
  /** @param around that tells roughly where the tag lies @return whether it is there */
  bool fitTag(int id, const std::vector<BoardPixel> &around, Markers &fitted) const
  {
    const auto map = BoardMap::fit(m_camera, around);
    const auto corners = map ? fittedTag(m_picture, m_target, id, *map) : std::nullopt;
    if (corners) {
      fitted.emplace(id, *corners);
    }
    return corners.has_value();
  }

  /** Tags too small to be told by their looks alone: beside others it is known what to look for. */
  void addTagsBeside(Markers &fitted) const
  {
    std::set<int> tried;
    for (bool added = true; added;) {
      added = false;
      for (int id = 0; id < static_cast<int>(m_corners.size()); ++id) {
        const std::vector<int> beside = nearest(fitted, middleOf(id), 4, 1.5 * m_target.pitch);
        if (beside.size() >= 2 && !fitted.contains(id) && tried.insert(id).second) {
          added = fitTag(id, cornersOf(fitted, beside), fitted) || added;
        }
      }
    }
  }

  Eigen::Vector2d middleOf(int id) const
  {
    return m_corners[static_cast<std::size_t>(id)] +
           Eigen::Vector2d::Constant(m_target.markerSide() / 2.0);
  }

  /** Leaves out corners that do not lie where those round them say, or that none stand by. */
  BoardView withoutStrays(const BoardView &view) const
  {
    BoardView kept;
    for (std::size_t i = 0; i < view.ids.size(); ++i) {
      const Eigen::Vector2d point = view.board[i].head<2>();
      std::vector<BoardPixel> others;
      for (std::size_t k = 0; k < view.ids.size(); ++k) {
        const Eigen::Vector2d other = view.board[k].head<2>();
        if (k != i && (other - point).norm() < 2.3 * m_target.pitch) {
          others.push_back({other, view.pixels[k]});
        }
      }
      const auto map = BoardMap::fit(m_camera, others);
      if (!map) {
        continue;
      }
      const Eigen::Vector2d expected = map->toPicture(point);
      const double pitch =
          (map->toPicture(point + Eigen::Vector2d(m_target.pitch, 0.0)) - expected).norm();
      if ((view.pixels[i] - expected).norm() < 0.7 + 0.05 * pitch) {
        kept.ids.push_back(view.ids[i]);
        kept.board.push_back(view.board[i]);
        kept.pixels.push_back(view.pixels[i]);
      }
    }
    return kept;
  }

  std::vector<BoardPixel> cornersOf(const Markers &markers, const std::vector<int> &ids) const
  {
    std::vector<BoardPixel> points;
    for (const int id : ids) {
      const auto board =
          boardCorners(m_corners[static_cast<std::size_t>(id)], m_target.markerSide());
      for (std::size_t k = 0; k < 4; ++k) {
        points.push_back({board[k], markers.at(id)[k]});
      }
    }
    return points;
  }

  /** The markers whose middles lie nearest to a place on the board, at most `most`. */
  std::vector<int> nearest(const Markers &markers, const Eigen::Vector2d &board, std::size_t most,
                           double reach) const
  {
    std::vector<std::pair<double, int>> sorted;
    for (const auto &[id, pixels] : markers) {
      const double away = (middleOf(id) - board).norm();
      if (away < reach) {
        sorted.emplace_back(away, id);
      }
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> ids;
    for (std::size_t i = 0; i < std::min(most, sorted.size()); ++i) {
      ids.push_back(sorted[i].second);
    }
    return ids;
  }

  /** Leaves out markers that do not lie where their neighbours say. */
  void dropImpostors()
  {
    Markers kept;
    for (const auto &[id, pixels] : m_markers) {
      const Eigen::Vector2d corner = m_corners[static_cast<std::size_t>(id)];
      std::vector<int> others = nearest(m_markers, corner, 5, 1e9);
      std::erase(others, id);
      const auto map =
          others.empty() ? std::nullopt : BoardMap::fit(m_camera, cornersOf(m_markers, others));
      const double side = (pixels[0] - pixels[2]).norm();
      if (others.empty() || (map && (map->toPicture(corner) - pixels[0]).norm() < side)) {
        kept.emplace(id, pixels);
      }
    }
    m_markers = kept;
  }

  std::optional<Eigen::Vector2d> refinedSquareCorner(const Eigen::Vector2d &point) const
  {
    const double pitch = m_target.pitch;
    // The two squares with markers that meet here; one of them must be seen.
    if (nearest(m_markers, point, 1, 0.8 * pitch).empty()) {
      return std::nullopt;
    }
    const auto map =
        BoardMap::fit(m_camera, cornersOf(m_markers, nearest(m_markers, point, 4, 1e9)));
    if (!map) {
      return std::nullopt;
    }
    return refineCorner(m_picture, m_target, [&](const Eigen::Vector2d &offset) {
      return map->toPicture(point + pitch * offset);
    });
  }

  cv::Mat1b m_picture;
  Target m_target;
  UnifiedCamera m_camera;
  std::vector<Eigen::Vector2d> m_corners; ///< top left, of every marker of the target
  Markers m_markers;
};

} // namespace

std::optional<BoardView> findMarkerBoard(const cv::Mat1b &picture, const Target &target,
                                         const std::optional<MirrorCircles> &mirror)
{
  const MarkerBoard board(picture, target, roughCamera(mirror, picture.cols, picture.rows));
  BoardView view =
      target.kind == TargetKind::AprilGrid ? board.tagCorners() : board.squareCorners();
  return view.ids.size() >= kFewest ? std::optional(std::move(view)) : std::nullopt;
}

BoardView refineTags(const cv::Mat1b &picture, const Target &target, const BoardView &view,
                     const UnifiedCamera &camera)
{
  std::map<int, std::vector<std::size_t>> tags;
  for (std::size_t i = 0; i < view.ids.size(); ++i) {
    tags[view.ids[i] / 4].push_back(i);
  }
  BoardView refined = view;
  for (const auto &[id, points] : tags) {
    std::vector<BoardPixel> corners;
    for (const std::size_t i : points) {
      corners.push_back({view.board[i].head<2>(), view.pixels[i]});
    }
    const auto map = BoardMap::fit(camera, corners);
    const auto square = map ? fittedTag(picture, target, id, *map) : std::nullopt;
    for (const std::size_t i : points) {
      const auto corner = static_cast<std::size_t>(view.ids[i] % 4);
      constexpr double kFarthest = 3.0; // pixels; then it is another square
      if (square && ((*square)[corner] - view.pixels[i]).norm() < kFarthest) {
        refined.pixels[i] = (*square)[corner];
      }
    }
  }
  return refined;
}

} // namespace homeward
