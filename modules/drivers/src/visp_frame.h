// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/steady_clock.h>
#include <homeward/robot/image_source.h>

#include <visp3/core/vpImageConvert.h>

namespace homeward
{

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

/** A picture of ViSP's, stamped now. C++17, for ViSP's sake. */
inline Frame toFrame(const vpImage<vpRGBa> &picture)
{
  Frame frame;
  frame.stamp = SteadyClock().now();
  vpImageConvert::convert(picture, frame.image);
  return frame;
}

} // namespace homeward
