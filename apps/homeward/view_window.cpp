// SPDX-License-Identifier: GPL-3.0-or-later
#include "view_window.h"

#include <homeward/core/error.h>

#include <visp3/core/vpImageConvert.h>
#include <visp3/gui/vpDisplayX.h>

#include <cstdlib>

namespace homeward
{

#ifdef VISP_HAVE_X11

class ViewWindow::Display
{
public:
  Display(const std::string &title, const cv::Mat &picture, int x, int y)
  {
    vpImageConvert::convert(picture, m_image);
    m_display.init(m_image, x, y, title);
  }

  void show(const cv::Mat &picture)
  {
    vpImageConvert::convert(picture, m_image);
    vpDisplay::display(m_image);
    vpDisplay::flush(m_image);
  }

private:
  vpImage<vpRGBa> m_image;
  vpDisplayX m_display; // after the image that it belongs to
};

ViewWindow::ViewWindow(const std::string &title, const cv::Mat &picture, int x, int y)
{
  const char *screen = std::getenv("DISPLAY");
  if (screen == nullptr || *screen == '\0') {
    throw ConfigError("--view needs a display and DISPLAY names none; --video F writes a file");
  }
  try {
    m_display = std::make_unique<Display>(title, picture, x, y);
    m_display->show(picture);
  }
  catch (const vpException &) {
    throw ConfigError("--view: the display '" + std::string(screen) +
                      "' cannot be opened; --video F writes a file");
  }
}

void ViewWindow::show(const cv::Mat &picture)
{
  m_display->show(picture);
}

#else

class ViewWindow::Display
{};

ViewWindow::ViewWindow(const std::string &, const cv::Mat &, int, int)
{
  throw ConfigError("--view: this ViSP was built without X11; --video F writes a file");
}

void ViewWindow::show(const cv::Mat &) {}

#endif

ViewWindow::~ViewWindow() = default;

} // namespace homeward
