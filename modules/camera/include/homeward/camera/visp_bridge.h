// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/core/vpRGBa.h>

namespace homeward
{

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

/** aMb as ViSP writes it. */
vpHomogeneousMatrix toVisp(const Eigen::Isometry3d &aMb);

/** aMb as Eigen writes it. */
Eigen::Isometry3d fromVisp(const vpHomogeneousMatrix &aMb);

/** A copy of a gray ViSP picture, CV_8UC1. */
cv::Mat fromVisp(const vpImage<unsigned char> &image);

/** A copy of a colour ViSP picture, CV_8UC3 BGR; alpha is left out. */
cv::Mat fromVisp(const vpImage<vpRGBa> &image);

/** A gray ViSP copy of a picture. @throw LogicError unless it is CV_8UC1 */
vpImage<unsigned char> toVispGray(const cv::Mat &image);

/** A colour ViSP copy of a picture, opaque. @throw LogicError unless it is CV_8UC3 (BGR) */
vpImage<vpRGBa> toVispColour(const cv::Mat &image);

} // namespace homeward
