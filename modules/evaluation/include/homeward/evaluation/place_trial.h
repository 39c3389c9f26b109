// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/dataset/data_set.h>
#include <homeward/evaluation/place_score.h>
#include <homeward/homing/column_features.h>
#include <homeward/place/embedding_network.h>
#include <homeward/place/place_index.h>

#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** How places are searched and what counts as found. */
struct PlaceTrialOptions
{
  double sameDistance = 1.0;   ///< metres up to which two views are of one place
  std::size_t candidates = 20; ///< the most similar signatures, ranked again where asked for
  int threads = 2;             ///< the figures but for times do not depend on it
};

/** Views known by sight, and views whose place is looked for among them. */
struct PlaceViews
{
  std::vector<Pose2> poses;        ///< wMr
  std::vector<Panorama> panoramas; ///< one a pose
  cv::Mat visible;                 ///< of all panoramas, see makeSignature()
};

/** The views of a light, in colour where the pictures are. @throw ConfigError as panorama() */
PlaceViews placeViews(const DataSet &set, const std::string &light);

/** Candidates given kSureProbability or more, and how many of them are right. */
struct SureMatches
{
  std::size_t matches = 0; ///< of that probability
  std::size_t right = 0;   ///< of these, of the right place
};

/** What one way of recognising places achieved. */
struct PlaceFigures
{
  PlaceScore score;                     ///< of one signature
  std::size_t bytes = 0;                ///< of a signature
  double microsecondsPerQuery = 0.0;    ///< of one thread, without making the signature
  std::optional<SureMatches> sure;      ///< among first candidates, where ranked again
  std::optional<SureMatches> surePairs; ///< among all
};

/**
 * Looks for the place of every query among those known, by one kind of signature after the other.
 * A query that is one of the known views (the same object) is not looked for in itself.
 */
class PlaceTrial
{
public:
  /** @param known, queries places to know and views to recognise */
  PlaceTrial(const PlaceViews &known, const PlaceViews &queries, const PlaceTrialOptions &options);

  /** Ranked by signature alone. */
  PlaceFigures bySignature(SignatureKind kind) const;

  /** Ranked by the embeddings of a network alone. @throw ConfigError as it */
  PlaceFigures byNetwork(const EmbeddingNetwork &network) const;

  /** The candidates of a signature, ranked again by otherPlaceOdds(). */
  PlaceFigures byWarping(SignatureKind kind) const;

private:
  using Candidates = std::vector<std::vector<Match>>;

  Candidates candidates(SignatureKind kind, PlaceFigures &figures) const;
  Candidates nearest(const std::vector<Signature> &known, const std::vector<Signature> &queries,
                     PlaceFigures &figures) const;
  void rankAgain(Candidates &candidates) const;
  PlaceScore score(const Candidates &candidates) const;
  SureMatches sureOnes(const Candidates &candidates) const;
  double distance(std::size_t query, std::size_t known) const; ///< metres

  const PlaceViews &m_known;
  const PlaceViews &m_queries;
  PlaceTrialOptions m_options;
  mutable std::vector<ColumnFeatures> m_knownFeatures; ///< made when first needed
  mutable std::vector<ColumnFeatures> m_queryFeatures;
  mutable std::vector<Signature> m_knownEdges; ///< likewise
  mutable std::vector<Signature> m_queryEdges;
};

} // namespace homeward
