// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace homeward
{

/** Pictures of one camera. */
struct Pictures
{
  std::vector<std::string> names;
  std::vector<cv::Mat> images; ///< CV_8UC1 or CV_8UC3, all of one size
};

/**
 * Reads pictures: files, all pictures of a folder, or names with * and ?. Pictures of 16 bits
 * are stretched to 8; colour stays.
 * @throw ConfigError naming the file that cannot be read, or differs in size from the others
 */
Pictures readPictures(const std::vector<std::string> &sources);

/**
 * Frames of a film, evenly spread over it.
 * @throw ConfigError when it is none
 */
Pictures readFilm(const std::string &file, int most);

/** 8-bit gray. */
cv::Mat grayOf(const cv::Mat &picture);

/** The mean of all pictures, gray: what stands still stays sharp. */
cv::Mat meanOf(const std::vector<cv::Mat> &grays);

} // namespace homeward
