// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/servo/feature_spherical_photometric.h>

#include "feature_support.h"

#include <iostream>
#include <utility>

namespace homeward
{

FeatureSphericalPhotometric::FeatureSphericalPhotometric(const PanoramaGeometry &geometry,
                                                         const PhotometricOptions &options,
                                                         const cv::Mat &visible)
    : m_sphere(geometry, options, visible)
{
  init();
}

void FeatureSphericalPhotometric::init()
{
  dim_s = static_cast<unsigned int>(m_sphere.size());
  s.resize(dim_s);
  m_sample.values.setZero(m_sphere.size());
  m_sample.changes.setZero(m_sphere.size(), 6);
  m_sample.contrast = 0.0;
}

bool FeatureSphericalPhotometric::buildFrom(const Panorama &panorama)
{
  std::optional<PhotometricSample> sample = m_sphere.measure(panorama);
  if (!sample) {
    init();
    return false;
  }
  m_sample = std::move(*sample);
  for (unsigned int row = 0; row < dim_s; ++row) {
    s[row] = m_sample.values[row];
  }
  return true;
}

vpMatrix FeatureSphericalPhotometric::interaction(unsigned int /*select*/)
{
  vpMatrix L(dim_s, 6);
  for (unsigned int row = 0; row < dim_s; ++row) {
    for (unsigned int column = 0; column < 6; ++column) {
      L[row][column] = m_sample.changes(row, column);
    }
  }
  return L;
}

vpColVector FeatureSphericalPhotometric::error(const vpBasicFeature &wanted,
                                               unsigned int /*select*/)
{
  return difference(s, wanted);
}

void FeatureSphericalPhotometric::display(const vpCameraParameters & /*cam*/,
                                          const vpImage<unsigned char> & /*I*/,
                                          const vpColor & /*color*/,
                                          unsigned int /*thickness*/) const
{}

void FeatureSphericalPhotometric::display(const vpCameraParameters & /*cam*/,
                                          const vpImage<vpRGBa> & /*I*/, const vpColor & /*color*/,
                                          unsigned int /*thickness*/) const
{}

void FeatureSphericalPhotometric::print(unsigned int /*select*/) const
{
  std::cout << "Panorama: " << dim_s << " cells, contrast " << m_sample.contrast
            << " gray levels\n";
}

FeatureSphericalPhotometric *FeatureSphericalPhotometric::duplicate() const
{
  return new FeatureSphericalPhotometric(*this);
}

} // namespace homeward
