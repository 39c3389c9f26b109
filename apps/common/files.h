// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <string>

namespace homeward
{

/** A file of data/: from $HOMEWARD_DATA, else the installed share/homeward, else the source tree.
 */
std::filesystem::path shippedFile(const std::string &name);

/** The whole of a text file. @throw ConfigError naming the file when it cannot be read */
std::string readText(const std::filesystem::path &file, const std::string &what);

/** Writes all or nothing; "-" is standard output. @throw RuntimeError naming the file */
void writeText(const std::string &file, const std::string &text);

/** From now on only writeText() writes to standard output; what is printed goes to standard error.
 */
void keepStandardOutputForFiles();

/** A picture, gray or BGR, 8 bits. @throw ConfigError naming the file when it cannot be read */
cv::Mat readPicture(const std::string &file);

/** The bytes of a picture file of the kind its name ends in. @throw ConfigError naming the file */
std::string encodePicture(const std::string &file, const cv::Mat &picture);

/** The bytes of a PNG file. */
std::string encodePng(const cv::Mat &picture);

/** The keys that the JSON of every command has. */
nlohmann::json jsonHeader(const std::string &command);

/** Writes JSON to a file or "-"; does nothing for an empty name. @throw RuntimeError naming the
 * file */
void writeJson(const std::string &file, const nlohmann::json &json);

} // namespace homeward
