// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>

#include <memory>
#include <string>

namespace homeward
{

/** A window of ViSP that shows one picture after the other. */
class ViewWindow
{
public:
  /**
   * Opens it.
   * @param picture the first, CV_8UC3 BGR
   * @param x, y of its upper left corner on the screen, pixels
   * @throw ConfigError when there is no display
   */
  ViewWindow(const std::string &title, const cv::Mat &picture, int x, int y);
  ~ViewWindow();

  /** @param picture of the first one's size, CV_8UC3 BGR */
  void show(const cv::Mat &picture);

private:
  class Display;
  std::unique_ptr<Display> m_display;
};

} // namespace homeward
