// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_map.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include <algorithm>

namespace homeward
{
namespace
{

constexpr double kLeastForward = 0.2; ///< of a ray on the touching plane's axis

/** A frame whose z lies in the middle of the rays. */
Eigen::Matrix3d frameOf(const std::vector<Eigen::Vector3d> &rays)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d &ray : rays) {
    sum += ray;
  }
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), sum).toRotationMatrix();
}

} // namespace

std::optional<BoardMap> BoardMap::fit(const UnifiedCamera &camera,
                                      const std::vector<BoardPixel> &points)
{
  std::vector<Eigen::Vector3d> rays;
  std::vector<cv::Point2d> board;
  for (const BoardPixel &point : points) {
    if (const auto ray = camera.unproject(point.pixel)) {
      rays.push_back(*ray);
      board.emplace_back(point.board.x(), point.board.y());
    }
  }
  if (rays.size() < 4) {
    return std::nullopt;
  }
  const Eigen::Matrix3d cRt = frameOf(rays);
  std::vector<cv::Point2d> plane;
  for (const Eigen::Vector3d &ray : rays) {
    const Eigen::Vector3d t = cRt.transpose() * ray;
    if (t.z() < kLeastForward) {
      return std::nullopt;
    }
    plane.emplace_back(t.x() / t.z(), t.y() / t.z());
  }
  const cv::Mat found = cv::findHomography(board, plane, 0);
  if (found.empty()) {
    return std::nullopt;
  }
  Eigen::Matrix3d tHb;
  cv::cv2eigen(found, tHb);
  return BoardMap(camera, cRt * tHb);
}

Eigen::Vector2d BoardMap::toPicture(const Eigen::Vector2d &board) const
{
  const Eigen::Vector3d ray = m_cHb * board.homogeneous();
  return m_camera.project(ray).value_or(Eigen::Vector2d(-1.0, -1.0));
}

} // namespace homeward
