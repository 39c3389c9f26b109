// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pictures.h"

#include <homeward/calib/target.h>
#include <homeward/robot/image_source.h>

#include <string>

namespace homeward
{

/** Pictures with boards, each unlike the others, as a camera took them. */
struct LiveViews
{
  Pictures pictures;
};

/**
 * Watches a source until its views will do or there are `most`, and says on standard error what to
 * do with the board next.
 * @param name of the source, for the pictures' names
 */
LiveViews watch(ImageSource &source, const std::string &name, const Target &target, int most);

/** watch() on a camera of the system. @throw ConfigError when it cannot be opened */
LiveViews watchCamera(const std::string &device, const Target &target, int most);

} // namespace homeward
