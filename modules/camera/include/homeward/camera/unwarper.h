// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_file.h>
#include <homeward/camera/panorama.h>

namespace homeward
{

/** Turns mirror pictures into panoramas through a table computed once. */
class Unwarper
{
public:
  /** @throw LogicError for a geometry without pixels or with elevations beyond +-90 degrees */
  Unwarper(const MirrorCamera &camera, const PanoramaGeometry &geometry);

  /**
   * The panorama of a mirror picture, bilinear; black where the mirror shows nothing (see
   * visible()).
   * @param picture CV_8UC1 or CV_8UC3 of the camera's size; the channels are kept
   * @throw LogicError when size or type differ
   */
  Panorama unwarp(const cv::Mat &picture) const;

  /** CV_8UC1, 255 where the panorama shows the scene. */
  const cv::Mat &visible() const { return m_visible; }

  /** Of the panoramas that it makes. */
  const PanoramaGeometry &geometry() const { return m_geometry; }

private:
  PanoramaGeometry m_geometry;
  cv::Size m_pictureSize;
  cv::Mat m_map1; ///< CV_16SC2
  cv::Mat m_map2; ///< CV_16UC1
  cv::Mat m_visible;
};

} // namespace homeward
