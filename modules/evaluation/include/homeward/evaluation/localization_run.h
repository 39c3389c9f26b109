// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/place/bayes_localizer.h>
#include <homeward/place/signature.h>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace homeward
{

/** Places known by sight, and the steps between them. */
struct KnownPlaces
{
  std::vector<NodeId> nodes;         ///< in the order of the belief
  std::vector<Signature> signatures; ///< one a node
  Eigen::MatrixXd steps;             ///< as BayesLocalizer::move() takes them
};

/** Where the robot most probably was when it saw something. */
struct Localization
{
  NodeId node;                ///< the likeliest
  double probability = 0.0;   ///< of that node, 0 to 1
  double kidnapped = 0.0;     ///< probability that it was carried away since the view before
  std::vector<double> belief; ///< by known place
};

/** Steps between places on open floor: their distance over that of close neighbours, rounded. */
Eigen::MatrixXd stepsBetween(const std::vector<Pose2> &places);

/** The place nearest to a pose. @throw LogicError without places */
std::size_t nearestPlace(const std::vector<Pose2> &places, const Pose2 &pose);

/**
 * Follows a drive: the robot sees, moves by about one step, sees again.
 * @param seen in the order they were seen
 * @param start where the drive begins; nothing: it could be anywhere
 * @throw LogicError when signatures cannot be compared, or as BayesLocalizer
 */
std::vector<Localization> localize(const KnownPlaces &known, const std::vector<Signature> &seen,
                                   std::optional<NodeId> start, const BayesOptions &options = {});

} // namespace homeward
