// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <visp3/core/vpColVector.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpMatrix.h>
#include <visp3/robot/vpRobot.h>
#include <visp3/robot/vpUnicycle.h>

#ifdef ENABLE_VISP_NAMESPACE
namespace homeward
{
// Later versions of ViSP may keep their names in a namespace of their own.
using VISP_NAMESPACE_NAME::vpColVector;
using VISP_NAMESPACE_NAME::vpHomogeneousMatrix;
using VISP_NAMESPACE_NAME::vpMatrix;
using VISP_NAMESPACE_NAME::vpRobot;
using VISP_NAMESPACE_NAME::vpUnicycle;
} // namespace homeward
#endif
