// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/pilot/place_memory.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <string>

namespace homeward
{

Verification WarpingVerifier::verify(const Panorama &current, const Panorama &stored)
{
  return compare(prepare(current), prepare(stored)).verification;
}

WarpingVerifier::Comparison WarpingVerifier::compare(const ColumnFeatures &current,
                                                     const ColumnFeatures &stored) const
{
  const auto match = m_warping.match(current, stored);
  if (!match) {
    return {};
  }
  const auto share = [](double value, double same, double other) {
    return std::clamp((other - value) / (other - same), 0.0, 1.0);
  };
  Comparison comparison;
  comparison.verification.probability =
      share(match->matchDistance, m_options.sameMatch, m_options.otherMatch) *
      share(match->contrast, m_options.sameContrast, m_options.otherContrast);
  comparison.verification.verified =
      match->matchDistance <= m_options.sameMatch && match->contrast <= m_options.sameContrast;
  if (match->contrast <= m_options.otherContrast) {
    comparison.distanceProxy = match->home.distanceProxy;
  }
  return comparison;
}

PlaceMemory::PlaceMemory(const Options &options)
    : m_options(options), m_verifier(options.verifier), m_index(SignatureKind::Jeffrey)
{}

void PlaceMemory::add(NodeId node, const Panorama &panorama)
{
  if (knows(node)) {
    throw LogicError("place " + std::to_string(node.value) + " is known already");
  }
  m_index.add(node, makeSignature(panorama, m_index.kind()));
  m_places.emplace(node, Place{panorama, m_verifier.prepare(panorama)});
}

const Panorama &PlaceMemory::snapshot(NodeId node) const
{
  const auto place = m_places.find(node);
  if (place == m_places.end()) {
    throw LogicError("no place " + std::to_string(node.value) + " is known by sight");
  }
  return place->second.panorama;
}

double PlaceMemory::landmarkRange(const ColumnFeatures &current,
                                  const std::optional<Left> &left) const
{
  constexpr double kShortest = 0.8; // metres; a shorter drive tells little
  if (!left || left->distance < kShortest || !knows(left->node)) {
    return m_options.landmarkRange;
  }
  const auto proxy = m_verifier.compare(current, m_places.at(left->node).features).distanceProxy;
  return proxy ? std::clamp(left->distance / *proxy, m_options.landmarkRangeMin,
                            m_options.landmarkRangeMax)
               : m_options.landmarkRange;
}

std::vector<PlaceMatch> PlaceMemory::recognise(const Panorama &current,
                                               const std::optional<Left> &left) const
{
  const Signature signature = makeSignature(current, m_index.kind());
  const ColumnFeatures features = m_verifier.prepare(current);
  const double range = m_options.verify ? landmarkRange(features, left) : 0.0;
  std::vector<PlaceMatch> matches;
  for (const Match &candidate : m_index.nearest(signature, m_options.candidates)) {
    PlaceMatch match{candidate.node, 0.0, false, candidate.dissimilarity * kReferencePixels};
    if (m_options.verify) {
      const auto same = m_verifier.compare(features, m_places.at(candidate.node).features);
      const bool justLeft = left && left->node == candidate.node;
      const double distance = justLeft ? left->distance : range * same.distanceProxy.value_or(1e3);
      match.probability = same.verification.probability;
      match.verified = same.verification.verified && distance <= m_options.sameDistance;
    }
    else if (matches.empty() && match.dissimilarity < m_options.histogramThreshold) {
      match.probability = 1.0;
      match.verified = true;
    }
    matches.push_back(match);
  }
  std::stable_sort(matches.begin(), matches.end(), [](const PlaceMatch &a, const PlaceMatch &b) {
    return std::make_pair(a.verified, a.probability) > std::make_pair(b.verified, b.probability);
  });
  return matches;
}

} // namespace homeward
