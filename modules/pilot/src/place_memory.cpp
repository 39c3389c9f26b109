// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/pilot/place_memory.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <string>
#include <utility>

namespace homeward
{

Verification WarpingVerifier::verify(const Panorama &current, const Panorama &stored)
{
  const double probability = samePlaceProbability(compare(prepare(current), prepare(stored)));
  return {probability, probability >= kSureProbability};
}

PairLook WarpingVerifier::compare(const View &current, const View &stored) const
{
  PairLook look;
  look.alignedEdges = dissimilarity(current.edges, stored.edges);
  look.jeffrey = dissimilarity(current.histogram, stored.histogram);
  if (const auto match = m_warping.match(current.columns, stored.columns)) {
    look.matchDistance = match->matchDistance;
    look.contrast = match->contrast;
    look.distanceProxy = match->home.distanceProxy;
  }
  return look;
}

WarpingVerifier::View WarpingVerifier::prepare(const Panorama &panorama) const
{
  return {makeSignature(panorama, SignatureKind::AlignedEdges),
          makeSignature(panorama, SignatureKind::Jeffrey), m_warping.prepare(panorama)};
}

PlaceMemory::PlaceMemory(const Options &options)
    : m_options(options),
      m_index(options.recognition == Recognition::Verified ? SignatureKind::AlignedEdges
                                                           : SignatureKind::Jeffrey)
{}

void PlaceMemory::add(NodeId node, const Panorama &panorama)
{
  if (knows(node)) {
    throw LogicError("place " + std::to_string(node.value) + " is known already");
  }
  Place place{panorama, m_verifier.prepare(panorama)};
  m_index.add(node, proposing(place.view));
  m_places.emplace(node, std::move(place));
}

void PlaceMemory::replace(NodeId node, const Panorama &panorama)
{
  place(node); // it is known
  m_index.remove(node);
  m_places.erase(node);
  add(node, panorama);
}

const Signature &PlaceMemory::proposing(const WarpingVerifier::View &view) const
{
  return m_options.recognition == Recognition::Verified ? view.edges : view.histogram;
}

const PlaceMemory::Place &PlaceMemory::place(NodeId node) const
{
  const auto place = m_places.find(node);
  if (place == m_places.end()) {
    throw LogicError("no place " + std::to_string(node.value) + " is known by sight");
  }
  return place->second;
}

const Panorama &PlaceMemory::snapshot(NodeId node) const
{
  return place(node).panorama;
}

double PlaceMemory::standingAt(NodeId node, const Panorama &current) const
{
  const WarpingVerifier::View &view = place(node).view;
  return m_options.recognition == Recognition::Histogram
             ? 1.0
             : standingThereProbability(m_verifier.compare(m_verifier.prepare(current), view));
}

SeenAnew PlaceMemory::seeAnew(NodeId node, const Panorama &current) const
{
  const Signature edges = makeSignature(current, SignatureKind::AlignedEdges);
  const std::vector<PlaceMatch> matches = recognise(current);
  return {standingAt(node, current), !matches.empty() && matches.front().node == node,
          dissimilarity(edges, place(node).view.edges)};
}

std::vector<PlaceMatch> PlaceMemory::recognise(const Panorama &current) const
{
  const bool verified = m_options.recognition == Recognition::Verified;
  const WarpingVerifier::View view = m_verifier.prepare(current);
  const auto candidates =
      m_index.nearest(proposing(view), verified ? m_options.candidates : m_index.size());
  return verified ? byPairs(candidates, view) : byHistogram(candidates);
}

std::vector<PlaceMatch> PlaceMemory::byHistogram(const std::vector<Match> &candidates) const
{
  std::vector<PlaceMatch> matches;
  for (const Match &candidate : candidates) {
    const double counts = candidate.dissimilarity * kReferencePixels;
    const bool nearest = matches.empty() && counts < m_options.histogramThreshold;
    matches.push_back({candidate.node, nearest ? 1.0 : 0.0, nearest, counts});
  }
  return matches;
}

std::vector<PlaceMatch> PlaceMemory::byPairs(const std::vector<Match> &candidates,
                                             const WarpingVerifier::View &view) const
{
  std::vector<PlaceMatch> matches;
  for (const Match &candidate : candidates) {
    const PairLook look = m_verifier.compare(view, place(candidate.node).view);
    const double probability = samePlaceProbability(look);
    matches.push_back({candidate.node, probability, probability >= kSureProbability,
                       look.jeffrey * kReferencePixels});
  }
  std::stable_sort(matches.begin(), matches.end(), [](const PlaceMatch &a, const PlaceMatch &b) {
    return a.probability > b.probability;
  });
  return matches;
}

} // namespace homeward
