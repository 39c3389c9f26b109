// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/run/drive_mapper.h>

#include <homeward/core/error.h>
#include <homeward/laser/half_scans.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

constexpr double kLeastWay = 0.5;    ///< metres between places
constexpr double kPlaceRadius = 1.0; ///< metres within which a place is recognised

double bearing(const Pose2 &aMb)
{
  return std::atan2(aMb.y, aMb.x);
}

} // namespace

DriveMapper::DriveMapper(const MirrorCamera &camera, const Eigen::Isometry3d &rMl, MapFile &file,
                         const DriveMapperOptions &options)
    : m_camera(camera), m_rMl(rMl), m_file(file), m_options(options),
      m_unwarper(camera, options.panorama), m_places(options.places)
{}

void DriveMapper::take(const BaseState &state)
{
  constexpr std::size_t kPast = 100;
  if (!m_past.empty()) {
    m_travelled += (state.odometry.translation() - m_past.back().odometry.translation()).norm();
  }
  m_past.push_back(state);
  if (m_past.size() > kPast) {
    m_past.pop_front();
  }
}

void DriveMapper::take(const Scan &scan)
{
  m_scan = scan;
}

Pose2 DriveMapper::poseAt(Time instant) const
{
  const auto nearest =
      std::min_element(m_past.begin(), m_past.end(), [=](const BaseState &a, const BaseState &b) {
        return std::chrono::abs(a.stamp - instant) < std::chrono::abs(b.stamp - instant);
      });
  return nearest->odometry * integrate(nearest->velocity, toSeconds(instant - nearest->stamp));
}

void DriveMapper::take(const Frame &frame)
{
  const cv::Size size(m_camera.model.width(), m_camera.model.height());
  if (frame.image.size() != size) {
    throw ConfigError("a picture of " + std::to_string(frame.image.cols) + " x " +
                      std::to_string(frame.image.rows) +
                      " pixels is none of the rig's camera, of " + std::to_string(size.width) +
                      " x " + std::to_string(size.height));
  }
  if (m_past.empty() || !m_scan || (m_here && m_travelled - m_lookedAt < m_options.lookEvery)) {
    return;
  }
  m_lookedAt = m_travelled;
  Panorama view = m_unwarper.unwarp(frame.image);
  if (view.image.channels() == 3) {
    cv::cvtColor(view.image, view.image, cv::COLOR_BGR2GRAY);
  }
  look(poseAt(frame.stamp), view);
}

void DriveMapper::look(const Pose2 &oMr, const Panorama &view)
{
  m_seen = {oMr, view};
  if (!m_here) {
    add(oMr, view);
    return;
  }
  const std::optional<NodeId> known = recognise(oMr, view);
  if (known && *known != *m_here) {
    comeTo(*known, oMr, view);
  }
  else if (!known && sinceLast() >= m_options.forwardDistance) {
    add(oMr, view);
  }
}

/** What looks like a place for sure and is where odometry lets it be. */
std::optional<NodeId> DriveMapper::recognise(const Pose2 &oMr, const Panorama &view) const
{
  for (const PlaceMatch &match : m_places.recognise(view)) {
    const Stood &stood = m_stood.at(match.node);
    const double off = (stood.oMplace.translation() - oMr.translation()).norm();
    const double allowed = kPlaceRadius + m_options.odometryError * (m_travelled - stood.travelled);
    if (match.verified && off <= allowed) {
      return match.node;
    }
  }
  return std::nullopt;
}

/** The update that joins the place stood at last with another, if nothing does yet. */
MapUpdate DriveMapper::edgeTo(NodeId node, const Pose2 &oMplace) const
{
  MapUpdate update;
  const Pose2 &oMhere = m_stood.at(*m_here).oMplace;
  const Pose2 there = oMhere.inverse() * oMplace;
  const Pose2 back = oMplace.inverse() * oMhere;
  const TopologicalMap &map = m_file.map();
  if (map.contains(node) && map.edgeBetween(*m_here, node)) {
    return update;
  }
  update.changes.emplace_back(EdgeAdded{{.id = map.nextEdgeId(),
                                         .a = *m_here,
                                         .b = node,
                                         .bearingAtA = bearing(there),
                                         .bearingAtB = bearing(back),
                                         .length = there.translation().norm()}});
  const auto settle = [&](NodeId at, double towards) {
    for (const Direction &direction : map.node(at).directions) {
      if (direction.state == DirectionState::Open &&
          std::abs(wrapAngle(direction.bearing - towards)) < kTakenOver) {
        update.changes.emplace_back(
            DirectionSettled{at, direction.id, DirectionState::Driven, "driven"});
      }
    }
  };
  settle(*m_here, bearing(there));
  if (map.contains(node)) {
    settle(node, bearing(back));
  }
  return update;
}

void DriveMapper::comeTo(NodeId node, const Pose2 &oMr, const Panorama &view)
{
  const auto home = m_compass.compute(view, m_places.snapshot(node));
  if (!home || sinceLast() < kLeastWay) {
    return;
  }
  const Pose2 oMplace{oMr.x, oMr.y, wrapAngle(oMr.heading - home->headingChange)};
  const MapUpdate update = edgeTo(node, oMplace);
  if (!update.changes.empty()) {
    m_file.append(update);
  }
  ++m_recognitions;
  m_stood[node] = {oMplace, m_travelled};
  m_here = node;
}

/** By what the laser sees from here; behind it there may be more. */
std::vector<Direction> DriveMapper::directionsAt(const Pose2 &oMr) const
{
  const Scan seen = joinScans({{*m_scan, oMr.inverse() * poseAt(m_scan->stamp)}}, m_rMl);
  std::vector<Direction> directions;
  for (const OpenDirection &open : findOpenDirections(seen, m_options.directions)) {
    directions.push_back({.id = DirectionId{static_cast<std::int64_t>(directions.size())},
                          .bearing = open.bearing,
                          .width = open.width});
  }
  return directions;
}

void DriveMapper::add(const Pose2 &oMr, const Panorama &view)
{
  const NodeId node = m_file.map().nextNodeId();
  MapUpdate update;
  Node added{.id = node, .directions = directionsAt(oMr)};
  if (m_here) {
    update = edgeTo(node, oMr);
    const double back = bearing(oMr.inverse() * m_stood.at(*m_here).oMplace);
    for (Direction &direction : added.directions) {
      if (std::abs(wrapAngle(direction.bearing - back)) < kTakenOver) {
        direction.state = DirectionState::Driven;
        direction.reason = "driven";
      }
    }
  }
  update.changes.insert(update.changes.begin(), NodeAdded{added});
  update.view = NewView{node, encodeView(view)};
  const Panorama stored = decodeView(update.view->bytes, view.geometry);
  m_file.append(update);
  m_places.add(node, stored);
  m_stood[node] = {oMr, m_travelled};
  m_here = node;
}

void DriveMapper::finish()
{
  if (m_here && m_seen && sinceLast() >= kLeastWay && !recognise(m_seen->first, m_seen->second)) {
    add(m_seen->first, m_seen->second);
  }
}

} // namespace homeward
