// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/viewer/map_layout.h>

#include <homeward/core/symmetric_eigen.h>
#include <homeward/topology/planner.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <utility>

namespace homeward
{

namespace
{

using Points = Eigen::MatrixX2d; ///< row i is node i

constexpr int kRounds = 300;

/** Numbers of edges between all nodes; parts that are not joined are put a step beyond the rest. */
Eigen::MatrixXd distancesOf(const TopologicalMap &map)
{
  const auto n = static_cast<Eigen::Index>(map.nodes().size());
  Eigen::MatrixXd distances = Eigen::MatrixXd::Constant(n, n, -1.0);
  for (const auto &[id, node] : map.nodes()) {
    for (const auto &[other, steps] : stepDistances(map, id)) {
      distances(id.value, other.value) = steps;
    }
  }
  const double apart = distances.maxCoeff() + 1.0;
  return distances.unaryExpr([apart](double d) { return d < 0.0 ? apart : d; });
}

/** Classical scaling, then a little shove so that no two nodes coincide. */
Points start(const Eigen::MatrixXd &distances)
{
  const Eigen::Index n = distances.rows();
  const Eigen::MatrixXd centring = Eigen::MatrixXd::Identity(n, n) -
                                   Eigen::MatrixXd::Constant(n, n, 1.0 / static_cast<double>(n));
  const Eigen::MatrixXd gram = -0.5 * centring * distances.cwiseAbs2() * centring;
  const SymmetricEigen eigen = symmetricEigen(gram);
  Points points = Points::Zero(n, 2);
  for (Eigen::Index axis = 0; axis < std::min<Eigen::Index>(2, n); ++axis) {
    const Eigen::Index largest = n - 1 - axis;
    Eigen::VectorXd vector = eigen.vectors.col(largest);
    Eigen::Index peak = 0;
    vector.cwiseAbs().maxCoeff(&peak);
    vector *= vector[peak] < 0.0 ? -1.0 : 1.0;
    points.col(axis) = vector * std::sqrt(std::max(0.0, eigen.values[largest]));
  }
  constexpr double kGoldenAngle = 2.399963229728653;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = kGoldenAngle * static_cast<double>(i);
    points.row(i) += 0.02 * Eigen::RowVector2d(std::cos(angle), std::sin(angle));
  }
  return points;
}

/** Moves each node in turn to where its weighted wishes for distance balance. */
void majorize(Points &points, const Eigen::MatrixXd &distances)
{
  const Eigen::Index n = points.rows();
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index i = 0; i < n; ++i) {
      Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
      double total = 0.0;
      for (Eigen::Index j = 0; j < n; ++j) {
        if (j == i) {
          continue;
        }
        const double wanted = distances(i, j);
        const double weight = 1.0 / (wanted * wanted);
        const Eigen::RowVector2d away = points.row(i) - points.row(j);
        const double length = std::max(away.norm(), 1e-9);
        sum += weight * (points.row(j) + wanted / length * away);
        total += weight;
      }
      if (total > 0.0) {
        points.row(i) = sum / total;
      }
    }
  }
}

/** Headings that fit the bearings of the edges, and how well they do: 1 for a perfect fit. */
std::pair<std::vector<double>, double> headingsOf(const TopologicalMap &map, const Points &points)
{
  std::vector<Eigen::Vector2d> votes(map.nodes().size(), Eigen::Vector2d::Zero());
  int count = 0;
  const auto vote = [&](NodeId at, NodeId to, const std::optional<double> &bearing) {
    if (bearing) {
      const Eigen::RowVector2d way = points.row(to.value) - points.row(at.value);
      const double heading = std::atan2(way.y(), way.x()) - *bearing;
      votes[static_cast<std::size_t>(at.value)] +=
          Eigen::Vector2d(std::cos(heading), std::sin(heading));
      ++count;
    }
  };
  for (const auto &[id, edge] : map.edges()) {
    vote(edge.a, edge.b, edge.bearingAtA);
    vote(edge.b, edge.a, edge.bearingAtB);
  }
  std::vector<double> headings;
  double agreement = 0.0;
  for (const Eigen::Vector2d &sum : votes) {
    headings.push_back(sum.norm() > 1e-9 ? std::atan2(sum.y(), sum.x()) : 0.0);
    agreement += sum.norm();
  }
  return {headings, count > 0 ? agreement / count : 1.0};
}

} // namespace

std::map<NodeId, Pose2> layOut(const TopologicalMap &map)
{
  if (map.nodes().empty()) {
    return {};
  }
  const Eigen::MatrixXd distances = distancesOf(map);
  Points points = start(distances);
  majorize(points, distances);
  Points mirrored = points;
  mirrored.col(1) *= -1.0;
  auto [headings, agreement] = headingsOf(map, points);
  auto [otherHeadings, otherAgreement] = headingsOf(map, mirrored);
  if (otherAgreement > agreement) {
    points = mirrored;
    headings = otherHeadings;
  }
  std::map<NodeId, Pose2> poses;
  for (const auto &[id, node] : map.nodes()) {
    poses.emplace(id, Pose2{points(id.value, 0), points(id.value, 1),
                            headings[static_cast<std::size_t>(id.value)]});
  }
  return poses;
}

} // namespace homeward
