// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/angle.h>

#include <opencv2/core/mat.hpp>

namespace homeward
{

/**
 * Geometry of an equirectangular panorama in frame p, as a person standing there would see it:
 * forward in the middle, columns grow clockwise, row 0 on top.
 */
struct PanoramaGeometry
{
  int width = 720;                      ///< columns round the full turn
  int height = 160;                     ///< rows
  double elevationMin = radians(-45.0); ///< lower edge of the last row, radians
  double elevationMax = radians(35.0);  ///< upper edge of row 0, radians

  /** Azimuth of a (fractional) column's centre: pi - 2 pi (u + 0.5) / width, radians. */
  double azimuth(double column) const { return kPi - 2.0 * kPi * (column + 0.5) / width; }

  /** Inverse of azimuth(), in [-0.5, width - 0.5). */
  double column(double azimuth) const
  {
    const double turn = (kPi - wrapAngle(azimuth)) / (2.0 * kPi) * width;
    return (turn >= width ? turn - width : turn) - 0.5;
  }

  /** Elevation of a (fractional) row's centre, radians. */
  double elevation(double row) const
  {
    return elevationMax - (elevationMax - elevationMin) * (row + 0.5) / height;
  }

  /** Inverse of elevation(). */
  double row(double elevation) const
  {
    return (elevationMax - elevation) / (elevationMax - elevationMin) * height - 0.5;
  }

  friend bool operator==(const PanoramaGeometry &a, const PanoramaGeometry &b)
  {
    return a.width == b.width && a.height == b.height && a.elevationMin == b.elevationMin &&
           a.elevationMax == b.elevationMax;
  }
};

/** A picture of everything around one place. */
struct Panorama
{
  cv::Mat image;             ///< CV_8UC1 or CV_8UC3 (BGR), geometry.height x geometry.width
  PanoramaGeometry geometry; ///< which pixel shows which direction
};

} // namespace homeward
