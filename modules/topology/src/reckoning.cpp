// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/topology/reckoning.h>

#include <homeward/core/angle.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <vector>

namespace homeward
{

namespace
{

constexpr double kPlaceSigma = 0.12;   // metres, of where an edge ends
constexpr double kHeadingSigma = 0.08; // radians, likewise; the first turns skid by far more
constexpr double kHuber = 2.5;         // sigmas beyond which an edge pulls no harder
constexpr int kIterations = 4;
constexpr int kFree = 3; // numbers of a pose

/** One edge as a measurement: the pose of b's frame in a's. */
struct Measured
{
  int a = 0; ///< index of the node
  int b = 0;
  Pose2 aMb;
  double length = 0.0; ///< metres
};

Pose2 along(double length, double out, double back)
{
  return {length * std::cos(out), length * std::sin(out), wrapAngle(out + kPi - back)};
}

/** How far an edge is off what was measured, in sigmas, and how that changes with its ends. */
struct Linear
{
  Eigen::Vector3d error;
  std::array<Eigen::Matrix3d, 2> byEnd; ///< by a's pose and b's
};

Linear linearise(const Pose2 &measured, const Pose2 &oMa, const Pose2 &oMb)
{
  const Eigen::Vector3d weights(1.0 / kPlaceSigma, 1.0 / kPlaceSigma, 1.0 / kHeadingSigma);
  const Eigen::Matrix2d aRo = Eigen::Rotation2Dd(-oMa.heading).toRotationMatrix();
  const Eigen::Vector2d aP = aRo * (oMb.translation() - oMa.translation());
  const Eigen::Vector3d error(aP.x() - measured.x, aP.y() - measured.y,
                              wrapAngle(oMb.heading - oMa.heading - measured.heading));
  Eigen::Matrix3d byA = -Eigen::Matrix3d::Identity();
  byA.topLeftCorner<2, 2>() = -aRo;
  byA.topRightCorner<2, 1>() = Eigen::Vector2d(aP.y(), -aP.x());
  Eigen::Matrix3d byB = Eigen::Matrix3d::Identity();
  byB.topLeftCorner<2, 2>() = aRo;
  return {weights.cwiseProduct(error), {weights.asDiagonal() * byA, weights.asDiagonal() * byB}};
}

/** Normal equations in the making. */
struct Normal
{
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd gradient;

  /** @param columns of the poses at the edge's ends; -1: known */
  void add(const Linear &edge, const std::array<int, 2> &columns)
  {
    const double weight = std::min(1.0, kHuber / std::max(edge.error.norm(), 1e-12));
    for (std::size_t row = 0; row < columns.size(); ++row) {
      if (columns[row] < 0) {
        continue;
      }
      const Eigen::Matrix3d pull = weight * edge.byEnd[row].transpose();
      gradient.segment<kFree>(columns[row]) += pull * edge.error;
      for (std::size_t column = 0; column < columns.size(); ++column) {
        if (columns[column] >= 0) {
          addBlock(columns[row], columns[column], pull * edge.byEnd[column]);
        }
      }
    }
  }

  void addBlock(int row, int column, const Eigen::Matrix3d &block)
  {
    for (int i = 0; i < kFree; ++i) {
      for (int j = 0; j < kFree; ++j) {
        entries.emplace_back(row + i, column + j, block(i, j));
      }
    }
  }
};

} // namespace

class Reckoning::Impl
{
public:
  Impl(const TopologicalMap &map, NodeId from)
  {
    static_cast<void>(map.node(from)); // refuses an unknown one
    gather(map);
    chain(m_indices.at(from));
    optimise();
  }

  std::optional<Reckoned> find(NodeId to) const
  {
    const auto found = m_indices.find(to);
    if (found == m_indices.end()) {
      return std::nullopt;
    }
    const std::size_t node = static_cast<std::size_t>(found->second);
    return m_columns[node] ? std::optional(Reckoned{m_poses[node], sigma(*m_columns[node])})
                           : std::nullopt;
  }

  std::vector<NodeId> near(const Eigen::Vector2d &point, double metres) const
  {
    std::vector<NodeId> found;
    for (const auto &[id, index] : m_indices) {
      const auto node = static_cast<std::size_t>(index);
      if (m_columns[node] && (m_poses[node].translation() - point).norm() < metres) {
        found.push_back(id);
      }
    }
    return found;
  }

private:
  void gather(const TopologicalMap &map);
  void chain(int from);
  void optimise();
  double sigma(int column) const;

  std::map<NodeId, int> m_indices;
  std::vector<Measured> m_edges;
  std::vector<Pose2> m_poses;                ///< of each node, in the first's frame
  std::vector<std::optional<int>> m_columns; ///< of each node's pose; -1: known; nothing: cut off
  int m_unknowns = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> m_information;
};

void Reckoning::Impl::gather(const TopologicalMap &map)
{
  for (const auto &[id, node] : map.nodes()) {
    m_indices.emplace(id, static_cast<int>(m_indices.size()));
  }
  for (const auto &[id, edge] : map.edges()) {
    if (edge.bearingAtA && edge.bearingAtB && edge.length) {
      m_edges.push_back({m_indices.at(edge.a), m_indices.at(edge.b),
                         along(*edge.length, *edge.bearingAtA, *edge.bearingAtB), *edge.length});
    }
  }
}

/** Poses by the shortest chains, and who is reached at all. */
void Reckoning::Impl::chain(int from)
{
  const std::size_t count = m_indices.size();
  std::vector<std::vector<std::size_t>> edgesAt(count);
  for (std::size_t i = 0; i < m_edges.size(); ++i) {
    edgesAt[static_cast<std::size_t>(m_edges[i].a)].push_back(i);
    edgesAt[static_cast<std::size_t>(m_edges[i].b)].push_back(i);
  }
  m_poses.resize(count);
  m_columns.resize(count);
  std::vector<double> lengths(count, std::numeric_limits<double>::infinity());
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  lengths[static_cast<std::size_t>(from)] = 0.0;
  open.emplace(0.0, from);
  while (!open.empty()) {
    const auto [length, node] = open.top();
    open.pop();
    const auto here = static_cast<std::size_t>(node);
    if (m_columns[here]) {
      continue;
    }
    m_columns[here] = node == from ? -1 : kFree * m_unknowns++;
    for (const std::size_t index : edgesAt[here]) {
      const Measured &edge = m_edges[index];
      const auto there = static_cast<std::size_t>(edge.a == node ? edge.b : edge.a);
      if (length + edge.length < lengths[there]) {
        lengths[there] = length + edge.length;
        m_poses[there] = m_poses[here] * (edge.a == node ? edge.aMb : edge.aMb.inverse());
        open.emplace(lengths[there], static_cast<int>(there));
      }
    }
  }
}

/** Gauss-Newton; leaves the information of the last step. */
void Reckoning::Impl::optimise()
{
  if (m_unknowns == 0) {
    return;
  }
  const Eigen::Index size = kFree * m_unknowns;
  Eigen::SparseMatrix<double> information(size, size);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Normal normal{{}, Eigen::VectorXd::Zero(size)};
    for (const Measured &edge : m_edges) {
      const auto a = static_cast<std::size_t>(edge.a);
      const auto b = static_cast<std::size_t>(edge.b);
      if (m_columns[a]) { // then b is reached too
        normal.add(linearise(edge.aMb, m_poses[a], m_poses[b]), {*m_columns[a], *m_columns[b]});
      }
    }
    information.setFromTriplets(normal.entries.begin(), normal.entries.end());
    m_information.compute(information);
    const Eigen::VectorXd step = m_information.solve(normal.gradient);
    for (std::size_t node = 0; node < m_poses.size(); ++node) {
      if (m_columns[node].value_or(-1) >= 0) {
        const Eigen::Index column = *m_columns[node];
        Pose2 &pose = m_poses[node];
        pose = {pose.x - step[column], pose.y - step[column + 1],
                wrapAngle(pose.heading - step[column + 2])};
      }
    }
  }
}

double Reckoning::Impl::sigma(int column) const
{
  if (column < 0) {
    return 0.0;
  }
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(kFree * m_unknowns, 2);
  unit(column, 0) = 1.0;
  unit(column + 1, 1) = 1.0;
  const Eigen::MatrixXd spread = m_information.solve(unit);
  const Eigen::Matrix2d covariance = spread.middleRows<2>(column);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, axes.eigenvalues()[1]));
}

Reckoning::Reckoning(const TopologicalMap &map, NodeId from)
    : m_impl(std::make_unique<Impl>(map, from))
{}

Reckoning::~Reckoning() = default;
Reckoning::Reckoning(Reckoning &&other) noexcept = default;
Reckoning &Reckoning::operator=(Reckoning &&other) noexcept = default;

std::optional<Reckoned> Reckoning::find(NodeId to) const
{
  return m_impl->find(to);
}

std::vector<NodeId> Reckoning::near(const Eigen::Vector2d &point, double metres) const
{
  return m_impl->near(point, metres);
}

} // namespace homeward
