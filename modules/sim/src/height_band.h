// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/floor_raster.h>
#include <homeward/sim/ray_caster.h>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

namespace homeward
{

/** Around what stands between two heights, infinite meshes left out. Metres. */
Eigen::AlignedBox2d boundsBetween(const std::vector<Mesh> &meshes, double zMin, double zMax);

/** CV_8UC1, 255 in every cell that a surface enters between two heights, metres. */
cv::Mat drawBetween(const std::vector<Mesh> &meshes, double zMin, double zMax,
                    const FloorRaster &raster);

/**
 * Marks the inside of closed solids: an enclosed patch of unmarked cells, smaller than 20 m^2, from
 * where every ray meets the back of a surface. (Triangles wind counter-clockwise seen from
 * outside. A larger patch is taken for a room whose walls were drawn inside out.)
 * @param z height of the rays, metres
 */
void fillSolids(const RayCaster &collisions, double z, const FloorRaster &raster,
                cv::Mat &occupied);

} // namespace homeward
