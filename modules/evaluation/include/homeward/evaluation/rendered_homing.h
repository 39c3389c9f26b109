// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/homing_task.h>
#include <homeward/evaluation/rendered_views.h>

namespace homeward
{

/** Which homing task is made of a simulated world. */
struct RenderedHomingOptions
{
  LightPreset mapLight = LightPreset::Day; ///< when homes were seen
  LightPreset nowLight = LightPreset::Day; ///< when the way home is looked for
  double spacing = 0.5;                    ///< of the grid of views, metres
  std::uint64_t seed = 1;                  ///< of grid, homes and headings
  HomingPairOptions pairs = {};            ///< which views are asked about which homes
};

/**
 * A task in a simulated world: homes at random places, views on a grid around each that it sees;
 * only what is compared is rendered. The task holds its pictures.
 */
HomingTask renderedHomingTask(const ViewSource &source, const FreeSpace &space,
                              const RenderedHomingOptions &options, const Progress &progress = {});

} // namespace homeward
