// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/store/map_file.h>

namespace homeward
{

/** How two places look to each other. */
struct PlaceLook
{
  double probability = 0.0; ///< that they are the same, to a metre
  /** heading(b) - heading(a), radians, as their pictures were stored: a bearing at a is that at b
   * plus this. Nothing where the pictures show no heading. */
  std::optional<double> turn = std::nullopt;
};

/** Compares the pictures of two places. @throw LogicError when their geometries differ */
PlaceLook comparePlaces(const Panorama &a, const Panorama &b);

/** A place of one map that is one of another map. */
struct PlacePair
{
  NodeId a;                 ///< of the one map
  NodeId b;                 ///< of the other map
  double probability = 0.0; ///< that they are one place
  double turn = 0.0;        ///< PlaceLook::turn

  bool operator==(const PlacePair &) const = default;
};

/**
 * The places of two maps that look the same for sure (kSureProbability): every picture of `b` is
 * compared with the 40 of `a` that are most alike. A place may be in several pairs.
 * @throw StoreError when the maps were made with different cameras or panoramas
 */
std::vector<PlacePair> alikePlaces(const MapFile &a, const MapFile &b);

/**
 * Those of `pairs` that agree about how the places lie: for each two of them the ways driven lead
 * in both maps from the one to the other by the same direction, distance and turn, as far as one
 * metre between the places of a pair and the error of the ways allow; no place is in two. Of all
 * such sets the one found by adding the likeliest that agree with each pair in turn that has the
 * most pairs. Empty unless it has two pairs, or one of a probability of 0.99 or more.
 */
std::vector<PlacePair> agreeingPairs(const TopologicalMap &a, const TopologicalMap &b,
                                     const std::vector<PlacePair> &pairs);

} // namespace homeward
