// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures.h"

#include <homeward/core/error.h>
#include <homeward/drivers/recorded_camera.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <glob.h>
#include <set>

namespace homeward
{
namespace fs = std::filesystem;

namespace
{

bool looksLikePicture(const fs::path &file)
{
  static const std::set<std::string> kEndings{".png", ".jpg", ".jpeg", ".tif", ".tiff",
                                              ".bmp", ".pgm", ".ppm",  ".webp"};
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return kEndings.count(ending) > 0;
}

std::vector<std::string> filesOf(const std::string &source)
{
  std::error_code ignored;
  std::vector<std::string> files;
  if (fs::is_directory(source, ignored)) {
    for (const auto &entry : fs::directory_iterator(source, ignored)) {
      if (entry.is_regular_file(ignored) && looksLikePicture(entry.path())) {
        files.push_back(entry.path().string());
      }
    }
    if (files.empty()) {
      throw ConfigError("the folder " + source + " holds no pictures");
    }
  }
  else if (source.find_first_of("*?[") != std::string::npos && !fs::exists(source, ignored)) {
    glob_t found{};
    if (glob(source.c_str(), 0, nullptr, &found) == 0) {
      files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    }
    globfree(&found);
    if (files.empty()) {
      throw ConfigError("no picture is named " + source);
    }
  }
  else {
    files.push_back(source);
  }
  std::sort(files.begin(), files.end());
  return files;
}

/** 8 bits a channel; 16-bit pictures often use a part of their range. */
cv::Mat toEightBits(const cv::Mat &picture)
{
  if (picture.depth() == CV_8U) {
    return picture;
  }
  double lowest = 0.0;
  double highest = 0.0;
  cv::minMaxLoc(picture.reshape(1), &lowest, &highest);
  const double scale = highest > lowest ? 255.0 / (highest - lowest) : 1.0;
  cv::Mat result;
  picture.convertTo(result, CV_8U, scale, -lowest * scale);
  return result;
}

cv::Mat readPicture(const std::string &file)
{
  cv::Mat picture;
  try {
    picture = cv::imread(file, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
  }
  catch (const cv::Exception &) {
    picture.release();
  }
  if (picture.empty()) {
    throw ConfigError("cannot read the picture " + file +
                      "; is it a PNG, JPEG or other image file?");
  }
  return toEightBits(picture);
}

bool same(const cv::Mat &a, const cv::Mat &b)
{
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

/** Adds a picture; one that is there already would count twice and is left out. */
void add(Pictures &pictures, const std::string &name, const cv::Mat &image)
{
  const auto twin = std::find_if(pictures.images.begin(), pictures.images.end(),
                                 [&](const cv::Mat &other) { return same(other, image); });
  if (twin != pictures.images.end()) {
    std::fprintf(stderr, "homeward-calibrate: %s shows the same as %s, pixel by pixel; left out\n",
                 name.c_str(),
                 pictures.names[static_cast<std::size_t>(twin - pictures.images.begin())].c_str());
    return;
  }
  if (!pictures.images.empty() && pictures.images[0].size() != image.size()) {
    const cv::Mat &first = pictures.images[0];
    throw ConfigError(name + " has " + std::to_string(image.cols) + " x " +
                      std::to_string(image.rows) + " pixels, " + pictures.names[0] + " has " +
                      std::to_string(first.cols) + " x " + std::to_string(first.rows) +
                      "; the pictures must come from one camera");
  }
  pictures.names.push_back(name);
  pictures.images.push_back(image);
}

/** So many of the pictures, evenly. */
Pictures thinned(const Pictures &pictures, std::size_t count)
{
  Pictures result;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = i * pictures.images.size() / count;
    result.names.push_back(pictures.names[from]);
    result.images.push_back(pictures.images[from]);
  }
  return result;
}

} // namespace

Pictures readPictures(const std::vector<std::string> &sources)
{
  Pictures pictures;
  for (const std::string &source : sources) {
    for (const std::string &file : filesOf(source)) {
      add(pictures, file, readPicture(file));
    }
  }
  return pictures;
}

Pictures readFilm(const std::string &file, int most)
{
  // Films do not say how long they are: every frame is kept until there are twice too many, then
  // every other one goes.
  VideoCamera film(file);
  Pictures pictures;
  const auto wanted = static_cast<std::size_t>(most);
  long step = 1;
  for (long number = 0;; ++number) {
    const auto frame = film.grab();
    if (!frame) {
      break;
    }
    if (number % step != 0 ||
        (!pictures.images.empty() && same(pictures.images.back(), frame->image))) {
      continue; // what cannot be decoded shows the frame before
    }
    add(pictures, file + " frame " + std::to_string(number), frame->image.clone());
    if (pictures.images.size() >= 2 * wanted) {
      pictures = thinned(pictures, wanted);
      step *= 2;
    }
  }
  if (pictures.images.size() > wanted) {
    pictures = thinned(pictures, wanted);
  }
  if (pictures.images.empty()) {
    throw ConfigError("the film " + file + " holds no pictures");
  }
  return pictures;
}

cv::Mat grayOf(const cv::Mat &picture)
{
  if (picture.channels() == 1) {
    return picture;
  }
  cv::Mat gray;
  cv::cvtColor(picture, gray, picture.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return gray;
}

cv::Mat meanOf(const std::vector<cv::Mat> &grays)
{
  cv::Mat sum(grays.at(0).size(), CV_32F, cv::Scalar(0.0));
  for (const cv::Mat &gray : grays) {
    cv::accumulate(gray, sum);
  }
  cv::Mat mean;
  sum.convertTo(mean, CV_8U, 1.0 / static_cast<double>(grays.size()));
  return mean;
}

} // namespace homeward
