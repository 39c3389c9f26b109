// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/recorded_camera.h>

#include "visp_frame.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <visp3/io/vpDiskGrabber.h>
#include <visp3/io/vpVideoReader.h>

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace homeward
{
namespace
{

/** True when the pattern holds one %d with an optional width and no other conversion. */
bool isPattern(const std::string &pattern)
{
  const std::size_t percent = pattern.find('%');
  if (percent == std::string::npos || pattern.find('%', percent + 1) != std::string::npos) {
    return false;
  }
  const std::size_t letter = pattern.find_first_not_of("0123456789", percent + 1);
  return letter != std::string::npos && letter - percent <= 3 && pattern[letter] == 'd';
}

std::string fileName(const std::string &pattern, long number)
{
  const std::size_t percent = pattern.find('%');
  const std::size_t letter = pattern.find('d', percent);
  const std::string width = pattern.substr(percent + 1, letter - percent - 1);
  std::string digits = std::to_string(number);
  const std::size_t wanted = width.empty() ? 0 : std::stoul(width);
  digits.insert(0, wanted > digits.size() ? wanted - digits.size() : 0, '0');
  return pattern.substr(0, percent) + digits + pattern.substr(letter + 1);
}

} // namespace

struct FolderCamera::Reader
{
  std::string pattern;
  vpDiskGrabber grabber;
  vpImage<vpRGBa> picture;
  long next = 0;
};

FolderCamera::FolderCamera(const std::string &pattern, long first)
    : m_reader(std::make_unique<Reader>())
{
  if (!isPattern(pattern)) {
    throw ConfigError("picture pattern '" + pattern + "': one number such as %04d is expected");
  }
  const std::string file = fileName(pattern, first);
  if (!std::filesystem::exists(file)) {
    throw ConfigError(file + ": no such picture");
  }
  m_reader->pattern = pattern;
  m_reader->next = first;
  m_reader->grabber.setGenericName(pattern);
}

FolderCamera::~FolderCamera() = default;

std::optional<Frame> FolderCamera::grab()
{
  const std::string file = fileName(m_reader->pattern, m_reader->next);
  if (!std::filesystem::exists(file)) {
    return std::nullopt;
  }
  try {
    m_reader->grabber.acquire(m_reader->picture, m_reader->next);
  }
  catch (const vpException &error) {
    throw DeviceError(file + ": not a picture: " + error.what());
  }
  ++m_reader->next;
  return toFrame(m_reader->picture);
}

struct VideoCamera::Reader
{
  vpVideoReader reader;
  vpImage<vpRGBa> picture;
};

VideoCamera::VideoCamera(const std::string &file) : m_reader(std::make_unique<Reader>())
{
  if (!std::filesystem::exists(file)) {
    throw ConfigError(file + ": no such film");
  }
  try {
    m_reader->reader.setFileName(file);
    m_reader->reader.open(m_reader->picture);
  }
  catch (const vpException &error) {
    throw ConfigError(file + ": not a film: " + error.what());
  }
}

VideoCamera::~VideoCamera() = default;

std::optional<Frame> VideoCamera::grab()
{
  vpVideoReader &reader = m_reader->reader;
  // The reader counts the frames that acquire() has given; open() leaves it before the first one.
  if (reader.getFrameIndex() >= reader.getLastFrameIndex()) {
    return std::nullopt;
  }
  reader.acquire(m_reader->picture);
  return toFrame(m_reader->picture);
}

} // namespace homeward
