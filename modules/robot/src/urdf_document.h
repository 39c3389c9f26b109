// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <urdf_model/model.h>
#include <urdf_world/types.h>

namespace homeward
{

/**
 * The model of a URDF document, with nothing printed to the console.
 * @throw ConfigError in one line with the parser's first complaint
 */
urdf::ModelInterfaceSharedPtr parseUrdfDocument(const std::string &xml, const std::string &origin);

} // namespace homeward
