// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/place_trial.h>

#include "parallel.h"

#include <homeward/homing/min_warping.h>
#include <homeward/place/same_place.h>

#include <algorithm>
#include <chrono>

namespace homeward
{

namespace
{

std::vector<Signature> signaturesOf(const PlaceViews &views, SignatureKind kind, int threads)
{
  std::vector<Signature> signatures(views.panoramas.size());
  inParallel(signatures.size(), threads, [&](std::size_t i) {
    signatures[i] = makeSignature(views.panoramas[i], kind, views.visible);
  });
  return signatures;
}

std::vector<ColumnFeatures> featuresOf(const PlaceViews &views, const MinWarping &warping,
                                       int threads)
{
  std::vector<ColumnFeatures> features(views.panoramas.size());
  inParallel(features.size(), threads,
             [&](std::size_t i) { features[i] = warping.prepare(views.panoramas[i]); });
  return features;
}

std::size_t indexOf(const Match &match)
{
  return static_cast<std::size_t>(match.node.value);
}

} // namespace

PlaceViews placeViews(const DataSet &set, const std::string &light)
{
  PlaceViews views;
  views.visible = set.visible();
  for (const std::size_t i : set.viewsOf(light)) {
    views.poses.push_back(set.view(i).pose);
    views.panoramas.push_back(set.colourPanorama(i));
  }
  return views;
}

PlaceTrial::PlaceTrial(const PlaceViews &known, const PlaceViews &queries,
                       const PlaceTrialOptions &options)
    : m_known(known), m_queries(queries), m_options(options)
{}

PlaceTrial::Candidates PlaceTrial::candidates(SignatureKind kind, PlaceFigures &figures) const
{
  return nearest(signaturesOf(m_known, kind, m_options.threads),
                 signaturesOf(m_queries, kind, m_options.threads), figures);
}

PlaceTrial::Candidates PlaceTrial::nearest(const std::vector<Signature> &known,
                                           const std::vector<Signature> &queries,
                                           PlaceFigures &figures) const
{
  if (known.empty()) {
    return Candidates(queries.size());
  }
  PlaceIndex index(known.front().kind);
  for (std::size_t i = 0; i < known.size(); ++i) {
    index.add(NodeId{static_cast<std::int64_t>(i)}, known[i]);
  }
  figures.bytes = queries.empty() ? 0 : byteSize(queries.front());
  const bool same = &m_known == &m_queries;
  const auto begin = std::chrono::steady_clock::now();
  Candidates found = index.nearest(queries, m_options.candidates + (same ? 1 : 0));
  const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - begin;
  figures.microsecondsPerQuery =
      spent.count() / static_cast<double>(std::max<std::size_t>(1, queries.size()));
  for (std::size_t q = 0; q < found.size(); ++q) {
    std::erase_if(found[q], [&](const Match &match) { return same && indexOf(match) == q; });
    found[q].resize(std::min(found[q].size(), m_options.candidates));
  }
  return found;
}

void PlaceTrial::rankAgain(Candidates &candidates) const
{
  const MinWarping warping;
  if (m_knownFeatures.empty()) {
    m_knownFeatures = featuresOf(m_known, warping, m_options.threads);
    m_queryFeatures = featuresOf(m_queries, warping, m_options.threads);
    m_knownEdges = signaturesOf(m_known, SignatureKind::AlignedEdges, m_options.threads);
    m_queryEdges = signaturesOf(m_queries, SignatureKind::AlignedEdges, m_options.threads);
  }
  inParallel(candidates.size(), m_options.threads, [&](std::size_t q) {
    for (Match &candidate : candidates[q]) {
      const std::size_t known = indexOf(candidate);
      const auto match = warping.match(m_queryFeatures[q], m_knownFeatures[known]);
      PairLook look;
      look.alignedEdges = dissimilarity(m_queryEdges[q], m_knownEdges[known]);
      if (match) {
        look.matchDistance = match->matchDistance;
        look.contrast = match->contrast;
        look.distanceProxy = match->home.distanceProxy;
      }
      candidate.dissimilarity = otherPlaceOdds(look);
    }
    std::stable_sort(
        candidates[q].begin(), candidates[q].end(),
        [](const Match &a, const Match &b) { return a.dissimilarity < b.dissimilarity; });
  });
}

PlaceScore PlaceTrial::score(const Candidates &candidates) const
{
  const bool same = &m_known == &m_queries;
  std::vector<PlaceAnswer> answers(candidates.size());
  for (std::size_t q = 0; q < answers.size(); ++q) {
    for (const Match &candidate : candidates[q]) {
      answers[q].right.push_back(distance(q, indexOf(candidate)) <= m_options.sameDistance);
    }
    answers[q].distance = candidates[q].empty() ? 0.0 : distance(q, indexOf(candidates[q].front()));
    answers[q].unlikeness = candidates[q].empty() ? 0.0 : candidates[q].front().dissimilarity;
    for (std::size_t i = 0; i < m_known.poses.size(); ++i) {
      answers[q].known =
          answers[q].known || (!(same && i == q) && distance(q, i) <= m_options.sameDistance);
    }
  }
  return scorePlaces(answers);
}

PlaceFigures PlaceTrial::bySignature(SignatureKind kind) const
{
  PlaceFigures figures;
  figures.score = score(candidates(kind, figures));
  return figures;
}

PlaceFigures PlaceTrial::byNetwork(const EmbeddingNetwork &network) const
{
  const auto embeddings = [&](const PlaceViews &views) {
    std::vector<Signature> signatures;
    for (const Panorama &panorama : views.panoramas) {
      signatures.push_back(network.compute(panorama));
    }
    return signatures;
  };
  PlaceFigures figures;
  figures.score = score(nearest(embeddings(m_known), embeddings(m_queries), figures));
  return figures;
}

PlaceFigures PlaceTrial::byWarping(SignatureKind kind) const
{
  PlaceFigures figures;
  Candidates found = candidates(kind, figures);
  const auto begin = std::chrono::steady_clock::now();
  rankAgain(found);
  const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - begin;
  figures.microsecondsPerQuery += spent.count() * m_options.threads /
                                  static_cast<double>(std::max<std::size_t>(1, found.size()));
  figures.score = score(found);
  figures.surePairs = sureOnes(found);
  for (std::vector<Match> &candidates : found) {
    candidates.resize(std::min<std::size_t>(1, candidates.size()));
  }
  figures.sure = sureOnes(found);
  return figures;
}

SureMatches PlaceTrial::sureOnes(const Candidates &candidates) const
{
  constexpr double kSureOdds = 1.0 / kSureProbability - 1.0;
  SureMatches sure;
  for (std::size_t q = 0; q < candidates.size(); ++q) {
    for (const Match &match : candidates[q]) {
      if (match.dissimilarity <= kSureOdds) {
        ++sure.matches;
        sure.right += distance(q, indexOf(match)) <= m_options.sameDistance ? 1U : 0U;
      }
    }
  }
  return sure;
}

double PlaceTrial::distance(std::size_t query, std::size_t known) const
{
  return (m_queries.poses[query].translation() - m_known.poses[known].translation()).norm();
}

} // namespace homeward
