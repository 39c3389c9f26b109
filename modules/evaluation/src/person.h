// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/random.h>
#include <homeward/sim/scene.h>

#include <array>
#include <string>

namespace homeward
{

/** Half of what a person takes of the floor, metres along x and y. */
inline const Eigen::Vector2f kHalfPerson{0.15F, 0.22F};

/** Of legs, body and head, linear RGB. */
using PersonColours = std::array<Eigen::Vector3f, 3>;

PersonColours drawPersonColours(Random &random);

/** The space of a person who stands at a point of the floor, metres. */
Eigen::AlignedBox3f personBox(const Eigen::Vector2f &at);

/**
 * A box for all to see and touch.
 * @param material index into Scene::materials
 * @param wMb the box's frame in the world
 */
void addSolidBox(Scene &scene, const std::string &model, const Eigen::AlignedBox3f &box,
                 int material, const Eigen::Affine3f &wMb = Eigen::Affine3f::Identity());

/** Legs, body and head, a box each. */
void addPerson(Scene &scene, const std::string &name, const Eigen::Vector2f &at,
               const PersonColours &colours);

} // namespace homeward
