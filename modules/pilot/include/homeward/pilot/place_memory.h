// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>
#include <homeward/core/id.h>
#include <homeward/homing/min_warping.h>
#include <homeward/mission/report.h>
#include <homeward/place/pair_verifier.h>
#include <homeward/place/place_index.h>
#include <homeward/place/same_place.h>

#include <map>
#include <vector>

namespace homeward
{

/** Says by aligned edges and min-warping whether two panoramas were taken within a metre. */
class WarpingVerifier : public PairVerifier
{
public:
  /** What is compared of a panorama. */
  struct View
  {
    Signature edges;        ///< AlignedEdges
    Signature histogram;    ///< Jeffrey
    ColumnFeatures columns; ///< for min-warping
  };

  Verification verify(const Panorama &current, const Panorama &stored) override;

  /** Looks at both in every way that samePlaceProbability() asks for. */
  PairLook compare(const View &current, const View &stored) const;

  /** What is compared of it, computed once. */
  View prepare(const Panorama &panorama) const;

private:
  MinWarping m_warping;
};

/** How known places are recognised. */
enum class Recognition
{
  Verified, ///< the most alike in aligned edges, each compared by WarpingVerifier
  Histogram ///< the nearest gray histogram below a threshold, as published
};

/** The places the robot knows by sight. */
class PlaceMemory
{
public:
  /** How places are recognised. */
  struct Options
  {
    Recognition recognition = Recognition::Verified; ///< by which of the two
    /** Of Histogram: Jeffrey divergence on kReferencePixels up to which a place is recognised. */
    double histogramThreshold = 500.0;
    std::size_t candidates =
        40; ///< of Verified: places compared pair by pair, the most alike first
  };

  /** Knows no place at first. */
  explicit PlaceMemory(const Options &options);

  /** @throw LogicError when the node is known already */
  void add(NodeId node, const Panorama &panorama);

  /** The place is known by another picture from now on. @throw LogicError for an unknown node */
  void replace(NodeId node, const Panorama &panorama);

  /** Whether add() was called for the node. */
  bool knows(NodeId node) const { return m_places.contains(node); }

  /** @throw LogicError for an unknown node */
  const Panorama &snapshot(NodeId node) const;

  /** Which known places this view may show, best first. */
  std::vector<PlaceMatch> recognise(const Panorama &current) const;

  /**
   * Probability that this view was taken where the node was, not at a place that looks alike; 1
   * where places are not verified.
   * @throw LogicError for an unknown node
   */
  double standingAt(NodeId node, const Panorama &current) const;

  /** Compares the place with a view from there. @throw LogicError for an unknown node */
  SeenAnew seeAnew(NodeId node, const Panorama &current) const;

private:
  struct Place
  {
    Panorama panorama;
    WarpingVerifier::View view;
  };

  const Place &place(NodeId node) const;
  /** The signature that proposes candidates. */
  const Signature &proposing(const WarpingVerifier::View &view) const;
  std::vector<PlaceMatch> byHistogram(const std::vector<Match> &candidates) const;
  std::vector<PlaceMatch> byPairs(const std::vector<Match> &candidates,
                                  const WarpingVerifier::View &view) const;

  Options m_options;
  WarpingVerifier m_verifier;
  PlaceIndex m_index;
  std::map<NodeId, Place> m_places;
};

} // namespace homeward
