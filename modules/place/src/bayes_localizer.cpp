// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/bayes_localizer.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace homeward
{

namespace
{

/** Probabilities, sum 1, from logarithms of any scale. */
std::vector<double> normalized(const std::vector<double> &logs)
{
  const double highest = *std::max_element(logs.begin(), logs.end());
  std::vector<double> probabilities;
  probabilities.reserve(logs.size());
  for (const double value : logs) {
    probabilities.push_back(std::exp(value - highest));
  }
  const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
  for (double &probability : probabilities) {
    probability /= sum;
  }
  return probabilities;
}

double standardDeviation(std::span<const double> values)
{
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - mean) * (value - mean);
  }
  return std::sqrt(squares / count);
}

} // namespace

BayesLocalizer::BayesLocalizer(std::vector<NodeId> nodes, std::optional<NodeId> start,
                               const BayesOptions &options)
    : m_nodes(std::move(nodes)), m_options(options)
{
  if (m_nodes.empty()) {
    throw LogicError("a localizer needs at least one node");
  }
  if (!(options.motionSigma > 0.0)) {
    throw LogicError("motionSigma is " + std::to_string(options.motionSigma) +
                     ", must be positive");
  }
  if (!(options.publishedPixels > 0.0)) {
    throw LogicError("publishedPixels is " + std::to_string(options.publishedPixels) +
                     ", must be positive");
  }
  if (!(options.kidnapping >= 0.0 && options.kidnapping < 1.0)) {
    throw LogicError("kidnapping is " + std::to_string(options.kidnapping) +
                     ", must be a probability below 1");
  }
  m_carried.assign(m_nodes.size(), 0.0);
  m_belief.assign(m_nodes.size(), 1.0 / static_cast<double>(m_nodes.size()));
  if (start) {
    const auto found = std::find(m_nodes.begin(), m_nodes.end(), *start);
    if (found == m_nodes.end()) {
      throw LogicError("start node " + std::to_string(start->value) + " is not among the nodes");
    }
    std::fill(m_belief.begin(), m_belief.end(), 0.0);
    m_belief[static_cast<std::size_t>(found - m_nodes.begin())] = 1.0;
  }
}

double BayesLocalizer::logKernel(double distance, double sigma) const
{
  return m_options.kernel == BayesKernel::Gaussian ? -distance * distance / (2.0 * sigma * sigma)
                                                   : -distance / (sigma * sigma);
}

void BayesLocalizer::move(const Eigen::MatrixXd &steps)
{
  const auto count = static_cast<Eigen::Index>(m_nodes.size());
  if (steps.rows() != count || steps.cols() != count) {
    throw LogicError("step distances are " + std::to_string(steps.rows()) + " x " +
                     std::to_string(steps.cols()) + ", there are " + std::to_string(count) +
                     " nodes");
  }
  if (!(steps.array() >= 0.0).all()) {
    throw LogicError("step distances must not be negative or not a number");
  }
  std::vector<double> predicted(m_nodes.size(), 0.0);
  for (Eigen::Index to = 0; to < count; ++to) {
    for (Eigen::Index from = 0; from < count; ++from) {
      const double likelihood = std::exp(logKernel(steps(to, from), m_options.motionSigma));
      predicted[static_cast<std::size_t>(to)] +=
          likelihood * m_belief[static_cast<std::size_t>(from)];
    }
  }
  for (double &probability : predicted) {
    probability = std::log(probability);
  }
  if (*std::max_element(predicted.begin(), predicted.end()) >
      -std::numeric_limits<double>::infinity()) {
    m_belief = normalized(predicted);
  }
  const double anywhere = m_options.kidnapping / static_cast<double>(m_nodes.size());
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    m_belief[i] = (1.0 - m_options.kidnapping) * m_belief[i] + anywhere;
    m_carried[i] = anywhere / std::max(m_belief[i], std::numeric_limits<double>::min());
  }
  m_kidnapped = m_options.kidnapping;
}

void BayesLocalizer::observe(std::span<const double> dissimilarities)
{
  if (dissimilarities.size() != m_nodes.size()) {
    throw LogicError(std::to_string(dissimilarities.size()) + " dissimilarities for " +
                     std::to_string(m_nodes.size()) + " nodes");
  }
  if (!std::all_of(dissimilarities.begin(), dissimilarities.end(),
                   [](double value) { return value >= 0.0 && std::isfinite(value); })) {
    throw LogicError("dissimilarities must be finite and not negative");
  }
  const double scale = m_options.kernel == BayesKernel::Published ? m_options.publishedPixels : 1.0;
  const double sigma = scale * standardDeviation(dissimilarities);
  if (!(sigma > 0.0)) {
    return; // all places look equally like the view: it tells nothing
  }
  std::vector<double> logs;
  logs.reserve(m_nodes.size());
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    logs.push_back(std::log(m_belief[i]) + logKernel(scale * dissimilarities[i], sigma));
  }
  m_belief = normalized(logs);
  m_kidnapped = std::inner_product(m_belief.begin(), m_belief.end(), m_carried.begin(), 0.0);
}

NodeId BayesLocalizer::mostProbable() const
{
  const auto best = std::max_element(m_belief.begin(), m_belief.end());
  return m_nodes[static_cast<std::size_t>(best - m_belief.begin())];
}

} // namespace homeward
