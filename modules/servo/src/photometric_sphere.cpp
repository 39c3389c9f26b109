// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/servo/photometric_sphere.h>

#include "visible_mask.h"

#include <homeward/camera/gray_picture.h>
#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace homeward
{

namespace
{

/** Gray levels. */
constexpr double kLeastContrast = 1.0;
/** Share of a cell that must be seen. */
constexpr double kLeastSeen = 0.25;

void require(bool good, const char *what, double value, const char *rule)
{
  if (!good) {
    throw LogicError(std::string(what) + " is " + std::to_string(value) + ", must be " + rule);
  }
}

void checkOptions(const PanoramaGeometry &geometry, const PhotometricOptions &options)
{
  require(geometry.width >= 4 && geometry.height >= 3, "number of pixels",
          geometry.width * geometry.height, "at least 4 x 3");
  require(geometry.elevationMin >= -kPi / 2.0 && geometry.elevationMax <= kPi / 2.0 &&
              geometry.elevationMin < geometry.elevationMax,
          "elevationMin", geometry.elevationMin, "below elevationMax, both within +-pi/2");
  require(options.columns >= 4 && options.columns <= geometry.width, "columns", options.columns,
          "at least 4 and at most the panorama's");
  require(options.rows >= 1 && options.rows <= geometry.height, "rows", options.rows,
          "at least 1 and at most the panorama's");
  require(options.lowPass >= 0.0 && options.lowPass <= kPi / 6.0, "lowPass", options.lowPass,
          "0 to pi/6");
  require(options.range > 0.0 && std::isfinite(options.range), "range", options.range,
          "finite and positive");
  require(options.cameraHeight >= 0.0 && std::isfinite(options.cameraHeight), "cameraHeight",
          options.cameraHeight, "finite and not negative");
}

/** With so many columns of the other end beside each end. */
cv::Mat wrapped(const cv::Mat &picture, int columns)
{
  cv::Mat wide;
  cv::copyMakeBorder(picture, wide, 0, 0, columns, columns, cv::BORDER_WRAP);
  return wide;
}

cv::Mat unwrapped(const cv::Mat &wide, int columns)
{
  return wide.colRange(columns, wide.cols - columns);
}

/** 255 where a pixel and its four neighbours are visible. */
cv::Mat innerPart(const cv::Mat &visible)
{
  cv::Mat inner;
  cv::erode(wrapped(visible, 1), inner, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}),
            {-1, -1}, 1, cv::BORDER_CONSTANT, 0.0);
  return unwrapped(inner, 1).clone();
}

} // namespace

PhotometricSphere::PhotometricSphere(const PanoramaGeometry &geometry,
                                     const PhotometricOptions &options, const cv::Mat &visible)
    : m_geometry(geometry), m_options(options)
{
  checkOptions(geometry, options);
  m_visible = visibleMask(geometry, visible);
  for (int u = 0; u < geometry.width; ++u) {
    m_ahead.emplace_back(std::cos(geometry.azimuth(u)), std::sin(geometry.azimuth(u)));
  }
}

double PhotometricSphere::cellsOfLowPass() const
{
  const double column = 2.0 * kPi / m_options.columns;
  const double row = (m_geometry.elevationMax - m_geometry.elevationMin) / m_options.rows;
  // Area of a Gaussian as seen by white noise.
  return std::max(1.0, 4.0 * kPi * m_options.lowPass * m_options.lowPass / (column * row));
}

double PhotometricSphere::range(double elevation) const
{
  const double down = std::sin(-elevation);
  const bool floor = m_options.cameraHeight > 0.0 && down > 0.0;
  return floor ? std::min(m_options.range, m_options.cameraHeight / down) : m_options.range;
}

/** Visible share, intensity and the six changes of every pixel, zero where not `inner`; CV_32F. */
std::array<cv::Mat, 8> PhotometricSphere::planes(const cv::Mat &gray, const cv::Mat &inner) const
{
  const PanoramaGeometry &g = m_geometry;
  const double perAzimuth = -g.width / (2.0 * kPi) / 2.0;
  const double perElevation = -g.height / (g.elevationMax - g.elevationMin) / 2.0;
  std::array<cv::Mat, 8> planes;
  for (cv::Mat &plane : planes) {
    plane = cv::Mat::zeros(g.height, g.width, CV_32F);
  }
  for (int v = 1; v + 1 < g.height; ++v) {
    const double ce = std::cos(g.elevation(v));
    const double se = std::sin(g.elevation(v));
    const double r = range(g.elevation(v));
    const auto *row = gray.ptr<std::uint8_t>(v);
    for (int u = 0; u < g.width; ++u) {
      if (inner.at<std::uint8_t>(v, u) == 0) {
        continue;
      }
      const double ca = m_ahead[static_cast<std::size_t>(u)].x();
      const double sa = m_ahead[static_cast<std::size_t>(u)].y();
      const int right = row[(u + 1) % g.width];
      const int left = row[(u + g.width - 1) % g.width];
      const int below = gray.at<std::uint8_t>(v + 1, u);
      const int above = gray.at<std::uint8_t>(v - 1, u);
      const double ga = perAzimuth * (right - left) / ce; // along (-sa, ca, 0)
      const double ge = perElevation * (below - above);   // along (-se ca, -se sa, ce)
      const std::array<double, 8> pixel{1.0,
                                        static_cast<double>(row[u]),
                                        (-sa * ga - se * ca * ge) / r,
                                        (ca * ga - se * sa * ge) / r,
                                        ce * ge / r,
                                        -se * ca * ga + sa * ge,
                                        -se * sa * ga - ca * ge,
                                        ce * ga};
      for (std::size_t i = 0; i < pixel.size(); ++i) {
        planes[i].at<float>(v, u) = static_cast<float>(pixel[i]);
      }
    }
  }
  return planes;
}

/** Averages in cells, then the low-pass; rows beyond the picture count as unseen. */
cv::Mat PhotometricSphere::reduce(const cv::Mat &plane) const
{
  cv::Mat small;
  cv::resize(plane, small, {m_options.columns, m_options.rows}, 0.0, 0.0, cv::INTER_AREA);
  const double across = m_options.lowPass * m_options.columns / (2.0 * kPi);
  const double down =
      m_options.lowPass * m_options.rows / (m_geometry.elevationMax - m_geometry.elevationMin);
  if (m_options.lowPass <= 0.0) {
    return small;
  }
  const int columns = std::min(m_options.columns, static_cast<int>(std::ceil(4.0 * across)) + 1);
  const int rows = static_cast<int>(std::ceil(4.0 * down));
  cv::Mat smooth;
  cv::GaussianBlur(wrapped(small, columns), smooth, {2 * columns - 1, 2 * rows + 1}, across, down,
                   cv::BORDER_CONSTANT);
  return unwrapped(smooth, columns);
}

PhotometricSphere::Cells PhotometricSphere::cells(const cv::Mat &gray, const cv::Mat &inner) const
{
  const std::array<cv::Mat, 8> all = planes(gray, inner);
  Cells cells(size(), 8);
  for (std::size_t plane = 0; plane < all.size(); ++plane) {
    const cv::Mat small = reduce(all[plane]);
    for (int row = 0; row < small.rows; ++row) {
      for (int column = 0; column < small.cols; ++column) {
        cells(row * small.cols + column, static_cast<Eigen::Index>(plane)) =
            small.at<float>(row, column);
      }
    }
  }
  return cells;
}

std::optional<PhotometricSample> PhotometricSphere::measure(const Panorama &panorama,
                                                            const cv::Mat &alsoVisible) const
{
  if (!(panorama.geometry == m_geometry)) {
    throw LogicError("panorama has another geometry than the sphere that measures it");
  }
  const cv::Mat gray = grayPicture(panorama);
  const cv::Mat visible =
      alsoVisible.empty() ? m_visible : cv::Mat(m_visible & visibleMask(m_geometry, alsoVisible));
  Cells seen = cells(gray, innerPart(visible));

  Eigen::VectorXd weights(size());
  for (int i = 0; i < size(); ++i) {
    const double share = seen(i, 0);
    const int row = i / m_options.columns;
    const double middle = (row + 0.5) * m_geometry.height / m_options.rows - 0.5;
    weights[i] = share >= kLeastSeen ? std::cos(m_geometry.elevation(middle)) : 0.0;
    seen.row(i) *= share >= kLeastSeen ? 1.0 / share : 0.0;
  }
  const double total = weights.sum();
  if (!(total > 0.0)) {
    return std::nullopt;
  }
  weights /= total;

  PhotometricSample sample;
  Eigen::VectorXd levels = seen.col(1).array() - weights.dot(seen.col(1));
  sample.contrast = std::sqrt(weights.dot(levels.cwiseAbs2()));
  if (!(sample.contrast >= kLeastContrast)) {
    return std::nullopt;
  }
  levels /= sample.contrast;
  Eigen::Matrix<double, Eigen::Dynamic, 6> L = seen.rightCols<6>();
  const Eigen::Matrix<double, 1, 6> offset = weights.transpose() * L;
  const Eigen::Matrix<double, 1, 6> gain = weights.cwiseProduct(levels).transpose() * L;
  L.rowwise() -= offset;
  L -= levels * gain;
  const Eigen::VectorXd scale = weights.cwiseSqrt();
  sample.values = scale.cwiseProduct(levels);
  sample.changes = scale.asDiagonal() * L / sample.contrast;
  return sample;
}

} // namespace homeward
