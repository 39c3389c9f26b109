// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpColVector.h>
#include <visp3/core/vpColor.h>
#include <visp3/core/vpImage.h>
#include <visp3/core/vpMatrix.h>
#include <visp3/core/vpRGBa.h>
#include <visp3/visual_features/vpBasicFeature.h>

#ifdef ENABLE_VISP_NAMESPACE
namespace homeward
{
// Later versions of ViSP may keep their names in a namespace of their own.
using VISP_NAMESPACE_NAME::vpBasicFeature;
using VISP_NAMESPACE_NAME::vpCameraParameters;
using VISP_NAMESPACE_NAME::vpColor;
using VISP_NAMESPACE_NAME::vpColVector;
using VISP_NAMESPACE_NAME::vpImage;
using VISP_NAMESPACE_NAME::vpMatrix;
using VISP_NAMESPACE_NAME::vpRGBa;
} // namespace homeward
#endif
