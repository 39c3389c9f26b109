// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>
#include <homeward/core/id.h>
#include <homeward/homing/min_warping.h>
#include <homeward/mission/report.h>
#include <homeward/place/pair_verifier.h>
#include <homeward/place/place_index.h>

#include <map>
#include <optional>
#include <vector>

namespace homeward
{

/** Says by min-warping whether two panoramas show the same surroundings, and how far apart. */
class WarpingVerifier : public PairVerifier
{
public:
  struct Options
  {
    double sameMatch = 0.53;     ///< match distance up to which they show the same surroundings
    double otherMatch = 0.57;    ///< match distance from which they surely do not
    double sameContrast = 0.91;  ///< contrast of the search up to which its answer is distinct
    double otherContrast = 0.95; ///< contrast from which there is no answer
  };

  explicit WarpingVerifier(const Options &options) : m_options(options) {}

  /** What a comparison says, and how far apart the views are where they show the same surroundings.
   */
  struct Comparison
  {
    Verification verification;
    std::optional<double> distanceProxy; ///< see HomeVector
  };

  Verification verify(const Panorama &current, const Panorama &stored) override;

  /** As verify(), on prepared panoramas. */
  Comparison compare(const ColumnFeatures &current, const ColumnFeatures &stored) const;

  ColumnFeatures prepare(const Panorama &panorama) const { return m_warping.prepare(panorama); }

private:
  Options m_options;
  MinWarping m_warping;
};

/** The places the robot knows by sight. */
class PlaceMemory
{
public:
  struct Options
  {
    /** Jeffrey divergence, seed's scale, up to which a place is a candidate without verification.
     */
    double histogramThreshold = 500.0;
    std::size_t candidates =
        40;             ///< places compared pair by pair, the most similar histograms first
    bool verify = true; ///< false: the nearest histogram below the threshold decides, as the seed
    double sameDistance = 1.25;    ///< metres up to which two views are one place
    double landmarkRange = 2.6;    ///< metres that a distance proxy of 1 stands for, where unknown
    double landmarkRangeMin = 1.5; ///< metres, bounds of what is learnt from a drive
    double landmarkRangeMax = 7.0;
    WarpingVerifier::Options verifier;
  };

  /** A place that the robot has just left and how far it is by odometry, straight, metres. */
  struct Left
  {
    NodeId node;
    double distance = 0.0;
  };

  explicit PlaceMemory(const Options &options);

  /** @throw LogicError when the node is known already */
  void add(NodeId node, const Panorama &panorama);

  bool knows(NodeId node) const { return m_places.contains(node); }

  /** @throw LogicError for an unknown node */
  const Panorama &snapshot(NodeId node) const;

  /**
   * Which known places this view may show, best first.
   *
   * Two panoramas tell a distance only up to the range of the landmarks. The drive from the place
   * just left tells that range, so that "the same place" means the same metres in a corridor and in
   * a hall.
   */
  std::vector<PlaceMatch> recognise(const Panorama &current,
                                    const std::optional<Left> &left = std::nullopt) const;

private:
  double landmarkRange(const ColumnFeatures &current, const std::optional<Left> &left) const;

  struct Place
  {
    Panorama panorama;
    ColumnFeatures features;
  };

  Options m_options;
  WarpingVerifier m_verifier;
  PlaceIndex m_index;
  std::map<NodeId, Place> m_places;
};

} // namespace homeward
