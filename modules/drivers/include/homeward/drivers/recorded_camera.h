// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/robot/image_source.h>

#include <memory>
#include <string>

namespace homeward
{

/** Pictures from numbered files, CV_8UC3, stamped with the steady clock when they are grabbed. */
class FolderCamera final : public ImageSource
{
public:
  /**
   * @param pattern of the file names, printf style with one number: `pictures/%04d.png`
   * @param first number of the first picture
   * @throw ConfigError when there is no such picture
   */
  FolderCamera(const std::string &pattern, long first);
  ~FolderCamera() override;

  /** The next picture; nothing at the first number that has no file.
   * @throw DeviceError when a file is no picture */
  std::optional<Frame> grab() override;

private:
  struct Reader;
  std::unique_ptr<Reader> m_reader;
};

/** Pictures from a film, CV_8UC3, stamped with the steady clock when they are grabbed. */
class VideoCamera final : public ImageSource
{
public:
  /** @throw ConfigError when the film cannot be opened */
  explicit VideoCamera(const std::string &file);
  ~VideoCamera() override;

  /** The next picture; nothing after the last. */
  std::optional<Frame> grab() override;

private:
  struct Reader;
  std::unique_ptr<Reader> m_reader;
};

} // namespace homeward
