// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/dataset/data_set.h>

#include <string>
#include <vector>

namespace homeward
{

/**
 * Reads the text of `poses.csv`.
 * @param origin the file's name, for messages
 * @throw ConfigError naming file and line
 */
std::vector<DataSetView> parsePoseTable(const std::string &text, const std::string &origin);

/** The text that parsePoseTable() reads back, to the last digit. */
std::string formatPoseTable(const std::vector<DataSetView> &views);

} // namespace homeward
