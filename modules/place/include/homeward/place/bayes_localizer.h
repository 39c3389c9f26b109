// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/id.h>
#include <homeward/place/signature.h>

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace homeward
{

/** How a probability falls with a distance. */
enum class BayesKernel
{
  Gaussian, ///< exp(-d^2 / (2 sigma^2))
  Published ///< exp(-d / sigma^2), on counts of so many pixels; the more there are, the flatter
};

/** What BayesLocalizer may be told. */
struct BayesOptions
{
  BayesKernel kernel = BayesKernel::Gaussian; ///< of motion and of views
  double motionSigma = 1.0;                   ///< graph steps, > 0
  double publishedPixels = kReferencePixels;  ///< of Published, > 0
  /** Probability that the robot is carried anywhere else between two views; 0 as published,
   * below 1.
   */
  double kidnapping = 0.0;
};

/**
 * Discrete Bayes filter over the nodes of a map:
 *
 *     bel'(x) = sum over y of p(x | u, y) bel(y),   bel(x) = eta p(z | x) bel'(x)
 *
 * Motion is judged by the steps between nodes, a view by its dissimilarities to all nodes, with
 * their standard deviation as sigma. \cite Thrun2005
 */
class BayesLocalizer
{
public:
  /**
   * @param nodes in the order of every argument and result
   * @param start where the robot is; nothing: it could be anywhere
   * @throw LogicError without nodes, with an unknown start or bad options
   */
  explicit BayesLocalizer(std::vector<NodeId> nodes, std::optional<NodeId> start = std::nullopt,
                          const BayesOptions &options = {});

  /**
   * The robot moved by about one step.
   * @param steps [to, from] graph steps between nodes, infinite where there is no way
   * @throw LogicError when the size differs or a value is negative or not a number
   */
  void move(const Eigen::MatrixXd &steps);

  /**
   * The robot sees something.
   * @param dissimilarities per pixel, of the view to every node
   * @throw LogicError when the size differs or a value is negative or not finite
   */
  void observe(std::span<const double> dissimilarities);

  /** Probability that the robot was carried away since the view before. */
  double kidnapped() const { return m_kidnapped; }

  /** The arg max; the first of equals. */
  NodeId mostProbable() const;

  /** Probabilities by node, sum 1. */
  const std::vector<double> &belief() const { return m_belief; }

  /** In the order of every argument and result. */
  const std::vector<NodeId> &nodes() const { return m_nodes; }

private:
  double logKernel(double distance, double sigma) const;

  std::vector<NodeId> m_nodes;
  BayesOptions m_options;
  std::vector<double> m_belief;
  std::vector<double> m_carried; ///< share of it, by node, of a robot carried away just now
  double m_kidnapped = 0.0;
};

} // namespace homeward
