// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/unwarper.h>
#include <homeward/laser/open_directions.h>
#include <homeward/pilot/place_memory.h>
#include <homeward/robot/image_source.h>
#include <homeward/robot/mobile_base.h>
#include <homeward/store/map_file.h>

#include <Eigen/Geometry>

#include <deque>
#include <map>
#include <optional>

namespace homeward
{

/** How a map is made of a drive. */
struct DriveMapperOptions
{
  double forwardDistance = 2.0;    ///< metres driven from one place to the next
  double lookEvery = 0.4;          ///< metres driven after which known places are looked for
  double odometryError = 0.1;      ///< of the way: how far off a known place may seem
  PlaceMemory::Options places;     ///< when a view surely shows a known place
  OpenDirectionOptions directions; ///< of a place, from its scan
  PanoramaGeometry panorama;       ///< of the views
};

/**
 * Makes a topological map of a drive that somebody else steered: what the robot saw comes in, in
 * the order of its time, and a place is added wherever it has driven far enough and knows none.
 * Places that follow on each other get an edge; so does one that is recognised where odometry says
 * that it may be.
 */
class DriveMapper
{
public:
  /** @param file open for writing; outlives the object, as the camera and the laser's place do */
  DriveMapper(const MirrorCamera &camera, const Eigen::Isometry3d &rMl, MapFile &file,
              const DriveMapperOptions &options);

  /** Follows the odometry. */
  void take(const BaseState &state);
  /** The newest scan gives a new place its open directions. */
  void take(const Scan &scan);

  /** Looks at it where the way since the last look asks for it. @throw ConfigError when it has
   * another size than the camera's */
  void take(const Frame &frame);

  /** The drive ends here, which is a place too when the last one is far. */
  void finish();

  /** Times that a known place was recognised after another one. */
  int recognitions() const { return m_recognitions; }

  /** Metres driven, by odometry. */
  double travelled() const { return m_travelled; }

private:
  /** A place as the robot stood there last, by odometry. */
  struct Stood
  {
    Pose2 oMplace;
    double travelled = 0.0;
  };

  Pose2 poseAt(Time instant) const;
  void look(const Pose2 &oMr, const Panorama &view);
  std::optional<NodeId> recognise(const Pose2 &oMr, const Panorama &view) const;
  void comeTo(NodeId node, const Pose2 &oMr, const Panorama &view);
  void add(const Pose2 &oMr, const Panorama &view);
  std::vector<Direction> directionsAt(const Pose2 &oMr) const;
  MapUpdate edgeTo(NodeId node, const Pose2 &oMplace) const;
  double sinceLast() const { return m_travelled - m_stood.at(*m_here).travelled; }

  const MirrorCamera &m_camera;
  const Eigen::Isometry3d &m_rMl;
  MapFile &m_file;
  DriveMapperOptions m_options;
  Unwarper m_unwarper;
  PlaceMemory m_places;
  MinWarping m_compass;
  std::deque<BaseState> m_past; ///< a few seconds, oldest first
  std::optional<Scan> m_scan;   ///< newest
  double m_travelled = 0.0;
  double m_lookedAt = 0.0; ///< travelled then
  std::map<NodeId, Stood> m_stood;
  std::optional<NodeId> m_here;                     ///< the place stood at last
  std::optional<std::pair<Pose2, Panorama>> m_seen; ///< the last view
  int m_recognitions = 0;
};

} // namespace homeward
