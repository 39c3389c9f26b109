// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/servo/photometric_sphere.h>
#include <homeward/servo/visp_types.h>

namespace homeward
{

/**
 * The intensities of a whole panorama, without any matching: s and L as PhotometricSphere has them.
 * It sees home from about as far as its low-pass is wide, and then comes very near.
 *
 * As in vpFeatureLuminance, a selection of rows is ignored.
 * \cite Collewet2011 \cite Caron2013
 */
class FeatureSphericalPhotometric : public vpBasicFeature
{
public:
  /** As PhotometricSphere(), whose errors it throws. No picture yet: s and L are zero. */
  explicit FeatureSphericalPhotometric(const PanoramaGeometry &geometry = {},
                                       const PhotometricOptions &options = {},
                                       const cv::Mat &visible = {});

  /**
   * Measures a picture.
   * @return whether it shows anything (PhotometricSphere::measure()); when not, s and L are zero,
   * and so is what vpServo commands
   * @throw LogicError as PhotometricSphere::measure() does; the feature stays as it was
   */
  bool buildFrom(const Panorama &panorama);

  /** Forgets the picture: s and L are zero. */
  void init() override;

  /** n x 6 from the twist (vx, vy, vz, wx, wy, wz) of p to ds/dt. */
  vpMatrix interaction(unsigned int select = FEATURE_ALL) override;

  /** s - wanted. @throw LogicError when `wanted` has another number of cells */
  vpColVector error(const vpBasicFeature &wanted, unsigned int select = FEATURE_ALL) override;

  /** Draws nothing: the picture itself is the feature. */
  void display(const vpCameraParameters &cam, const vpImage<unsigned char> &I,
               const vpColor &color = vpColor::green, unsigned int thickness = 1) const override;
  void display(const vpCameraParameters &cam, const vpImage<vpRGBa> &I,
               const vpColor &color = vpColor::green, unsigned int thickness = 1) const override;

  /** How many cells and how much contrast. */
  void print(unsigned int select = FEATURE_ALL) const override;

  FeatureSphericalPhotometric *duplicate() const override;

private:
  PhotometricSphere m_sphere;
  PhotometricSample m_sample;
};

} // namespace homeward
