// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/bundle.h>

#include "pose_step.h"

#include <homeward/core/error.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace homeward
{
namespace
{

/** Cost of a squared length in units of the scale, and its derivative: the weight. */
struct Penalty
{
  double cost;
  double weight;
};

Penalty penalty(Loss loss, double s2)
{
  constexpr double kHuber = 2.0;
  constexpr double kTukey = 5.0;
  if (loss == Loss::Huber && s2 > kHuber * kHuber) {
    const double s = std::sqrt(s2);
    return {2.0 * kHuber * s - kHuber * kHuber, kHuber / s};
  }
  if (loss == Loss::Tukey) {
    const double rest = std::max(0.0, 1.0 - s2 / (kTukey * kTukey));
    return {kTukey * kTukey / 3.0 * (1.0 - rest * rest * rest), rest * rest};
  }
  return {s2, 1.0};
}

/** One view's share of the normal equations: pose block, coupling with the camera, gradient. */
struct ViewBlock
{
  Eigen::Matrix<double, 6, 6> U = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 6> W;
  CameraTwist g = CameraTwist::Zero();
};

/** J^T J and J^T r at a state. */
struct NormalEquations
{
  Eigen::MatrixXd V; ///< camera block
  Eigen::VectorXd g;
  std::vector<ViewBlock> views;
};

/** The change of everything. */
struct Step
{
  Eigen::VectorXd camera; ///< of the estimated parameters
  std::vector<CameraTwist> poses;
  double predicted = 0.0; ///< how much cheaper the linear model says it becomes
};

class Bundle
{
public:
  Bundle(const std::vector<BoardView> &views, const PointMask &mask, const BundleState &start,
         const BundleOptions &options)
      : m_views(views), m_mask(mask), m_options(options),
        m_unseen(std::hypot(start.model->width(), start.model->height()))
  {
    for (std::size_t i = 0; i < options.estimated.size(); ++i) {
      if (options.estimated[i]) {
        m_columns.push_back(static_cast<Eigen::Index>(i));
      }
    }
  }

  double cost(const BundleState &state) const
  {
    double sum = 0.0;
    for (std::size_t v = 0; v < m_views.size(); ++v) {
      for (std::size_t i = 0; i < m_views[v].pixels.size(); ++i) {
        if (m_mask[v][i]) {
          const auto pixel = state.model->project(state.cMo[v] * m_views[v].board[i]);
          sum += priced(pixel ? (m_views[v].pixels[i] - *pixel).squaredNorm() : m_unseen * m_unseen)
                     .cost;
        }
      }
    }
    return sum * m_options.scale * m_options.scale;
  }

  NormalEquations linearize(const BundleState &state) const
  {
    const auto n = static_cast<Eigen::Index>(m_columns.size());
    NormalEquations result{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n),
                           std::vector<ViewBlock>(m_views.size())};
    for (std::size_t v = 0; v < m_views.size(); ++v) {
      result.views[v].W.setZero(n, 6);
      addView(state, v, result);
    }
    return result;
  }

  /** The damped step; nothing where the equations cannot be solved. */
  std::optional<Step> solve(const NormalEquations &equations, double damping) const;

  /** Inverse covariance of the camera, poses eliminated. */
  Eigen::MatrixXd reduced(const NormalEquations &equations) const
  {
    Eigen::MatrixXd S = equations.V;
    for (const ViewBlock &view : equations.views) {
      if (m_options.holdPoses) {
        break;
      }
      S -= view.W * view.U.ldlt().solve(view.W.transpose());
    }
    return 0.5 * (S + S.transpose());
  }

  /** The state after a step; nothing where the model refuses its parameters. */
  std::optional<BundleState> stepped(const BundleState &state, const Step &step) const
  {
    BundleState next = state;
    Eigen::VectorXd parameters = state.model->parameters();
    for (std::size_t k = 0; k < m_columns.size(); ++k) {
      parameters[m_columns[k]] += step.camera[static_cast<Eigen::Index>(k)];
    }
    if (!m_columns.empty()) {
      try {
        next.model = state.model->with(parameters);
      }
      catch (const LogicError &) {
        return std::nullopt;
      }
    }
    for (std::size_t v = 0; v < next.cMo.size(); ++v) {
      next.cMo[v] = moved(state.cMo[v], step.poses[v]);
    }
    return next;
  }

private:
  Penalty priced(double squared) const
  {
    return penalty(m_options.loss, squared / (m_options.scale * m_options.scale));
  }

  void addView(const BundleState &state, std::size_t v, NormalEquations &equations) const
  {
    const BoardView &view = m_views[v];
    ViewBlock &block = equations.views[v];
    const auto n = static_cast<Eigen::Index>(m_columns.size());
    CameraModel::PointJacobian J_point;
    CameraModel::ParameterJacobian J_all;
    CameraModel::ParameterJacobian J_camera(2, n);
    for (std::size_t i = 0; i < view.pixels.size(); ++i) {
      if (!m_mask[v][i]) {
        continue;
      }
      const Eigen::Vector3d cX = state.cMo[v] * view.board[i];
      const auto pixel = state.model->project(cX, &J_point, n > 0 ? &J_all : nullptr);
      if (!pixel) {
        continue;
      }
      const Eigen::Vector2d residual = view.pixels[i] - *pixel;
      const double weight = priced(residual.squaredNorm()).weight;
      for (Eigen::Index k = 0; k < n; ++k) {
        J_camera.col(k) = J_all.col(m_columns[static_cast<std::size_t>(k)]);
      }
      // The point of a camera that moves with (v, w) moves with -v - w x X.
      Eigen::Matrix3d cross;
      cross << 0.0, -cX.z(), cX.y(), cX.z(), 0.0, -cX.x(), -cX.y(), cX.x(), 0.0;
      Eigen::Matrix<double, 2, 6> J_pose;
      J_pose << -J_point, J_point * cross;
      equations.V.noalias() += weight * J_camera.transpose() * J_camera;
      equations.g.noalias() += weight * J_camera.transpose() * residual;
      if (m_options.holdPoses) {
        continue;
      }
      block.U.noalias() += weight * J_pose.transpose() * J_pose;
      block.g.noalias() += weight * J_pose.transpose() * residual;
      block.W.noalias() += weight * J_camera.transpose() * J_pose;
    }
  }

  const std::vector<BoardView> &m_views;
  const PointMask &m_mask;
  const BundleOptions &m_options;
  double m_unseen;                     ///< pixels
  std::vector<Eigen::Index> m_columns; ///< of the estimated parameters
};

std::optional<Step> Bundle::solve(const NormalEquations &equations, double damping) const
{
  Eigen::MatrixXd S = equations.V;
  S.diagonal() *= 1.0 + damping;
  Eigen::VectorXd g = equations.g;
  std::vector<Eigen::LDLT<Eigen::Matrix<double, 6, 6>>> factors;
  factors.reserve(equations.views.size());
  for (const ViewBlock &view : equations.views) {
    Eigen::Matrix<double, 6, 6> U = view.U;
    U.diagonal() *= 1.0 + damping;
    U.diagonal().array() += 1e-300;
    factors.emplace_back(U);
    S.noalias() -= view.W * factors.back().solve(view.W.transpose());
    g.noalias() -= view.W * factors.back().solve(view.g);
  }
  Step step;
  if (S.rows() > 0) {
    // The parameters differ by many orders of magnitude: equilibrate.
    const Eigen::VectorXd scale = equations.V.diagonal().array().max(1e-300).rsqrt();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * S * scale.asDiagonal();
    const Eigen::LDLT<Eigen::MatrixXd> factor(scaled);
    step.camera = scale.cwiseProduct(factor.solve(scale.cwiseProduct(g)));
  }
  step.predicted = 0.0;
  for (std::size_t v = 0; v < equations.views.size(); ++v) {
    const ViewBlock &view = equations.views[v];
    CameraTwist right = view.g;
    if (S.rows() > 0) {
      right -= view.W.transpose() * step.camera;
    }
    step.poses.push_back(factors[v].solve(right));
    step.predicted +=
        step.poses.back().dot(damping * view.U.diagonal().cwiseProduct(step.poses.back()) + view.g);
    if (!step.poses.back().allFinite()) {
      return std::nullopt;
    }
  }
  if (S.rows() > 0) {
    step.predicted +=
        step.camera.dot(damping * equations.V.diagonal().cwiseProduct(step.camera) + equations.g);
    if (!step.camera.allFinite()) {
      return std::nullopt;
    }
  }
  return step;
}

void checkSizes(const std::vector<BoardView> &views, const PointMask &mask,
                const BundleState &start, const BundleOptions &options)
{
  bool agree =
      views.size() == mask.size() && views.size() == start.cMo.size() &&
      options.estimated.size() == static_cast<std::size_t>(start.model->parameters().size());
  for (std::size_t v = 0; agree && v < views.size(); ++v) {
    agree =
        views[v].board.size() == views[v].pixels.size() && mask[v].size() == views[v].pixels.size();
  }
  if (!agree) {
    throw LogicError("views, points, poses and parameters of a bundle differ in number");
  }
}

} // namespace

BundleResult adjustBundle(const std::vector<BoardView> &views, const PointMask &mask,
                          const BundleState &start, const BundleOptions &options)
{
  checkSizes(views, mask, start, options);
  const Bundle bundle(views, mask, start, options);
  BundleResult result;
  result.state = start;
  result.cost = bundle.cost(start);
  double damping = 1e-4;
  double growth = 2.0;
  NormalEquations equations = bundle.linearize(start);
  for (; result.iterations < options.iterations && !result.converged; ++result.iterations) {
    const auto step = bundle.solve(equations, damping);
    const auto next = step ? bundle.stepped(result.state, *step) : std::nullopt;
    const double cost = next ? bundle.cost(*next) : std::numeric_limits<double>::infinity();
    const double gain = result.cost - cost;
    if (step && step->predicted <= options.still * result.cost + 1e-20) {
      result.converged = true;
    }
    if (std::isfinite(cost) && gain >= 0.0) {
      const double ratio = step->predicted > 0.0 ? gain / step->predicted : 1.0;
      damping *= std::max(1.0 / 10.0, 1.0 - std::pow(2.0 * ratio - 1.0, 3.0));
      damping = std::max(damping, 1e-14);
      growth = 2.0;
      result.state = *next;
      result.cost = cost;
      equations = bundle.linearize(result.state);
    }
    else {
      damping *= growth;
      growth *= 2.0;
      if (damping > 1e12) {
        break; // at a border of the model's parameters
      }
    }
  }
  result.information = bundle.reduced(equations);
  return result;
}

std::vector<Eigen::Vector2d> residuals(const BoardView &view, const CameraModel &model,
                                       const Eigen::Isometry3d &cMo)
{
  std::vector<Eigen::Vector2d> result;
  result.reserve(view.pixels.size());
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    const auto pixel = model.project(cMo * view.board[i]);
    result.push_back(pixel ? Eigen::Vector2d(view.pixels[i] - *pixel)
                           : Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
  return result;
}

} // namespace homeward
