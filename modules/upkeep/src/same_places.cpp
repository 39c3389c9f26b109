// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/upkeep/same_places.h>

#include <homeward/homing/min_warping.h>
#include <homeward/pilot/place_memory.h>
#include <homeward/topology/reckoning.h>

#include <algorithm>
#include <map>

namespace homeward
{

namespace
{

constexpr double kAlone = 0.99;    ///< probability that a single pair must have
constexpr double kApart = 1.0;     ///< metres between the places of a pair
constexpr double kSigmas = 2.0;    ///< of the ways
constexpr double kTurnError = 0.5; ///< radians, two sigma of a chain of bearings

std::optional<double> turnBetween(const Panorama &a, const Panorama &b)
{
  MinWarping warping;
  const auto home = warping.compute(b, a); // knows the turn of displaced views, as no compass does
  return home ? std::optional(home->headingChange) : std::nullopt;
}

/** Where the nodes of a map stand, seen from each that is asked for. */
class Reckonings
{
public:
  explicit Reckonings(const TopologicalMap &map) : m_map(map) {}

  std::optional<Reckoned> find(NodeId from, NodeId to)
  {
    return m_reckonings.try_emplace(from, m_map, from).first->second.find(to);
  }

private:
  const TopologicalMap &m_map;
  std::map<NodeId, Reckoning> m_reckonings;
};

/** Whether the ways of both maps lead alike from the places of one pair to those of another. */
bool agree(Reckonings &a, Reckonings &b, const PlacePair &one, const PlacePair &other)
{
  if (one.a == other.a || one.b == other.b) {
    return false;
  }
  const std::optional<Reckoned> inA = a.find(one.a, other.a);
  const std::optional<Reckoned> inB = b.find(one.b, other.b);
  if (!inA || !inB) {
    return false;
  }
  // The way in b as it is seen from the place in a: both places of a pair taken for one.
  const Pose2 seen = Pose2{0.0, 0.0, one.turn} * inB->fromMto * Pose2{0.0, 0.0, -other.turn};
  const double apart = (seen.translation() - inA->fromMto.translation()).norm();
  return apart < 2.0 * kApart + kSigmas * std::hypot(inA->sigma, inB->sigma) &&
         std::abs(wrapAngle(seen.heading - inA->fromMto.heading)) < kTurnError;
}

bool likelier(const PlacePair &one, const PlacePair &other)
{
  return one.probability > other.probability;
}

} // namespace

PlaceLook comparePlaces(const Panorama &a, const Panorama &b)
{
  WarpingVerifier verifier;
  return {verifier.verify(b, a).probability, turnBetween(a, b)};
}

std::vector<PlacePair> alikePlaces(const MapFile &a, const MapFile &b)
{
  b.expectMadeWith(a.header());
  PlaceMemory memory({});
  for (const auto &[id, node] : a.map().nodes()) {
    memory.add(id, a.panorama(id));
  }
  std::vector<PlacePair> pairs;
  for (const auto &[id, node] : b.map().nodes()) {
    const Panorama view = b.panorama(id);
    for (const PlaceMatch &match : memory.recognise(view)) {
      const auto turn =
          match.verified ? turnBetween(memory.snapshot(match.node), view) : std::optional<double>{};
      if (turn) {
        pairs.push_back({match.node, id, match.probability, *turn});
      }
    }
  }
  return pairs;
}

std::vector<PlacePair> agreeingPairs(const TopologicalMap &a, const TopologicalMap &b,
                                     const std::vector<PlacePair> &pairs)
{
  std::vector<PlacePair> likely = pairs;
  std::stable_sort(likely.begin(), likely.end(), likelier);
  Reckonings inA(a);
  Reckonings inB(b);
  std::vector<PlacePair> best;
  for (const PlacePair &first : likely) {
    std::vector<PlacePair> set{first};
    for (const PlacePair &next : likely) {
      if (std::all_of(set.begin(), set.end(),
                      [&](const PlacePair &member) { return agree(inA, inB, member, next); })) {
        set.push_back(next);
      }
    }
    if (set.size() > best.size()) {
      best = set;
    }
  }
  std::stable_sort(best.begin(), best.end(), likelier);
  const bool enough = best.size() > 1 || (best.size() == 1 && best.front().probability >= kAlone);
  return enough ? best : std::vector<PlacePair>{};
}

} // namespace homeward
