// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace homeward
{

/** How intensities are taken from a panorama. */
struct PhotometricOptions
{
  int columns = 72;              ///< cells round the full turn
  int rows = 16;                 ///< cells from top to bottom
  double lowPass = radians(5.0); ///< sigma, rad; a wider one sees home from farther, a narrower
                                 ///< one more exactly
  double range = 2.0;            ///< of all that is no floor, metres; a rough one will do
  double cameraHeight = 0.0;     ///< p above a flat floor, metres; 0 (unknown): `range` there too
};

/** Intensities of a panorama, normalised, and how they change with motion. */
struct PhotometricSample
{
  Eigen::VectorXd values;                           ///< n; of length 1, weighted mean 0
  Eigen::Matrix<double, Eigen::Dynamic, 6> changes; ///< n x 6: d values / dt of the twist of p
  double contrast = 0.0;                            ///< standard deviation before, gray levels
};

/**
 * Intensities of panoramas of one geometry, low-passed and averaged in columns x rows cells, with
 * their interaction matrix for the twist (vx, vy, vz, wx, wy, wz) of p.
 *
 * At a fixed direction s, a scene of constant brightness at range r changes by
 *
 *     dI / dt = -(grad_s I)^T L_s (v, w),  L_s = (-(I - s s^T) / r, [s]x)
 *             = (grad_s I)^T v / r + (s x grad_s I)^T w
 *
 * with central differences, round the seam. Averages and the low-pass are linear and stand still in
 * p, so the cells change by the same averages of dI / dt, whatever the low-pass. Below the horizon
 * r = cameraHeight / sin(-elevation), never more than `range`.
 *
 * With the weights w_i = cos(elevation) of cells that are seen, sum W, mean m and standard
 * deviation d, values are s_i = sqrt(w_i / W) (I_i - m) / d: a unit vector, so that s^T s* is the
 * correlation of two panoramas, and gain and offset of the exposure drop out. Its matrix is the
 * exact one,
 *
 *     L_i = sqrt(w_i / W) / d (L_I,i - mean(L_I) - (I_i - m) / d mean((I - m) / d L_I)).
 *
 * Cells that are not seen have rows of zero. \cite Collewet2011 \cite Caron2013
 */
class PhotometricSphere
{
public:
  /**
   * @param visible CV_8UC1 of the panorama's size, not zero where it shows the scene; empty:
   * everywhere
   * @throw LogicError when options are no use, there are more cells than pixels, or `visible` has
   * another size or type
   */
  explicit PhotometricSphere(const PanoramaGeometry &geometry,
                             const PhotometricOptions &options = {}, const cv::Mat &visible = {});

  /**
   * @param alsoVisible as `visible`, for this picture
   * @return nothing for a picture without contrast (less than one gray level) or without a seen
   * cell
   * @throw LogicError when the panorama has another geometry, or is not 8-bit gray or BGR of its
   * size
   */
  std::optional<PhotometricSample> measure(const Panorama &panorama,
                                           const cv::Mat &alsoVisible = {}) const;

  /** Of the panoramas that it takes. */
  const PanoramaGeometry &geometry() const { return m_geometry; }
  /** As it was made. */
  const PhotometricOptions &options() const { return m_options; }

  /** Cells, and so the rows of a sample. */
  int size() const { return m_options.columns * m_options.rows; }

  /** Cells that the low-pass makes one of, 1 or more. */
  double cellsOfLowPass() const;

  /** Range at an elevation, metres. */
  double range(double elevation) const;

private:
  /** Share of a cell that is seen, its intensity, its changes: cells x 8. */
  using Cells = Eigen::Matrix<double, Eigen::Dynamic, 8>;

  std::array<cv::Mat, 8> planes(const cv::Mat &gray, const cv::Mat &inner) const;
  cv::Mat reduce(const cv::Mat &plane) const;
  Cells cells(const cv::Mat &gray, const cv::Mat &inner) const;

  PanoramaGeometry m_geometry;
  PhotometricOptions m_options;
  cv::Mat m_visible;                    ///< CV_8UC1, 0 or 255
  std::vector<Eigen::Vector2d> m_ahead; ///< cosine and sine of each column's azimuth
};

} // namespace homeward
