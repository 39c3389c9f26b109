// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/dataset/data_set.h>

#include "pose_table.h"

#include <homeward/camera/rim.h>
#include <homeward/core/error.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

namespace homeward
{
namespace fs = std::filesystem;

namespace
{

constexpr const char *kPoses = "poses.csv";
constexpr const char *kPanoramaFile = "panorama.yaml";
constexpr const char *kCameraFile = "camera.yaml";

std::string textOf(const fs::path &file)
{
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file, ignored)) {
    throw ConfigError("cannot read " + file.string() + "; check the name and its permissions");
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/** Whether a JPEG lacks its end: the decoder would fill the rest with gray and say nothing. */
bool cutShort(const std::string &bytes)
{
  return bytes.compare(0, 2, "\xff\xd8") == 0 && bytes.rfind("\xff\xd9") == std::string::npos;
}

cv::Mat decode(const fs::path &file)
{
  const std::string bytes = textOf(file);
  cv::Mat picture;
  if (!bytes.empty() && !cutShort(bytes)) {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1,
                      const_cast<char *>(bytes.data())); // NOLINT: only read
    try {
      picture = cv::imdecode(raw, cv::IMREAD_ANYCOLOR);
    }
    catch (const cv::Exception &) {
      picture.release(); // broken all the same
    }
  }
  if (picture.empty()) {
    throw ConfigError("cannot decode the picture " + file.string() +
                      "; replace it or take its line out of " + kPoses);
  }
  return picture;
}

std::string pixelsOf(const cv::Size &size)
{
  return std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels";
}

void writeFile(const fs::path &file, const std::string &text)
{
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    throw StoreError("cannot write " + file.string() + "; check that the folder has room");
  }
}

void writePicture(const fs::path &file, const cv::Mat &picture)
{
  bool written = false;
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  try {
    written = cv::imwrite(file.string(), picture);
  }
  catch (const cv::Exception &) {
    written = false; // an ending that no encoder has
  }
  if (!written) {
    throw StoreError("cannot write the picture " + file.string() +
                     "; check the folder, its room and the file's ending");
  }
}

} // namespace

DataSet::DataSet(const MirrorCamera &camera, const PanoramaGeometry &geometry)
    : m_camera(camera), m_unwarper(std::in_place, camera, geometry),
      m_pictureSize(camera.model.width(), camera.model.height()), m_geometry(geometry)
{}

DataSet::DataSet(const PanoramaLayout &layout, const cv::Size &size)
    : m_layout(layout), m_pictureSize(size), m_geometry(geometryOf(layout, size))
{}

DataSet DataSet::read(const fs::path &folder, const PanoramaGeometry &geometry)
{
  const fs::path table = folder / kPoses;
  std::vector<DataSetView> views = parsePoseTable(textOf(table), table.string());
  for (const DataSetView &view : views) {
    if (!fs::is_regular_file(folder / view.file)) {
      throw ConfigError(table.string() + " names " + view.file + ", which is not in " +
                        folder.string());
    }
  }
  const fs::path panoramaFile = folder / kPanoramaFile;
  const fs::path cameraFile = folder / kCameraFile;
  if (fs::exists(panoramaFile) == fs::exists(cameraFile)) {
    throw ConfigError(folder.string() + " must hold either " + kPanoramaFile + " or " +
                      kCameraFile + ", and " +
                      (fs::exists(cameraFile) ? "has both" : "has neither"));
  }
  DataSet set = fs::exists(cameraFile)
                    ? DataSet(parseMirrorCamera(textOf(cameraFile), cameraFile.string()), geometry)
                    : DataSet(parsePanoramaLayout(textOf(panoramaFile), panoramaFile.string()),
                              decode(folder / views.front().file).size());
  set.m_folder = folder;
  set.m_pictures.resize(views.size());
  set.m_views = std::move(views);
  set.followRim();
  return set;
}

void DataSet::followRim()
{
  constexpr std::size_t kEnough = 15;
  if (!m_camera || !m_camera->rim) {
    return;
  }
  std::vector<cv::Mat> pictures;
  const std::size_t count = std::min(kEnough, size());
  for (std::size_t i = 0; i < count; ++i) {
    pictures.push_back(picture(i * size() / count));
  }
  followRim(pictures);
}

void DataSet::followRim(const std::vector<cv::Mat> &pictures)
{
  if (!m_camera) {
    return;
  }
  std::vector<Eigen::Vector2d> shifts;
  for (const cv::Mat &picture : pictures) {
    const auto shift =
        picture.size() == m_pictureSize ? rimShift(picture, *m_camera) : std::nullopt;
    if (shift) {
      shifts.push_back(*shift);
    }
  }
  m_unwarper.emplace(homeward::followRim(*m_camera, shifts), m_geometry);
}

void DataSet::add(const DataSetView &view, const cv::Mat &picture)
{
  if (picture.size() != m_pictureSize || (picture.type() != CV_8UC1 && picture.type() != CV_8UC3)) {
    throw LogicError(view.file + " has " + pixelsOf(picture.size()) + ", must have " +
                     pixelsOf(m_pictureSize) + ", 8 bits, gray or BGR");
  }
  if (std::any_of(m_views.begin(), m_views.end(),
                  [&](const DataSetView &other) { return other.file == view.file; })) {
    throw LogicError(view.file + " is in the data set already");
  }
  m_views.push_back(view);
  m_pictures.push_back(picture);
}

void DataSet::write(const fs::path &folder) const
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw StoreError("cannot make the folder " + folder.string() + ": " + error.message());
  }
  for (std::size_t i = 0; i < size(); ++i) {
    writePicture(folder / m_views[i].file, picture(i));
  }
  if (m_camera) {
    writeFile(folder / kCameraFile, formatMirrorCamera(*m_camera));
  }
  else {
    writeFile(folder / kPanoramaFile, formatPanoramaLayout(m_layout));
  }
  writeFile(folder / kPoses, formatPoseTable(m_views)); // last: a folder without it is no data set
}

std::vector<std::string> DataSet::lights() const
{
  std::vector<std::string> lights;
  for (const DataSetView &view : m_views) {
    if (std::find(lights.begin(), lights.end(), view.light) == lights.end()) {
      lights.push_back(view.light);
    }
  }
  return lights;
}

std::vector<std::size_t> DataSet::viewsOf(const std::string &light) const
{
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < size(); ++i) {
    if (m_views[i].light == light) {
      found.push_back(i);
    }
  }
  return found;
}

cv::Mat DataSet::visible() const
{
  return m_unwarper ? m_unwarper->visible() : cv::Mat();
}

cv::Mat DataSet::picture(std::size_t index) const
{
  if (!m_pictures.at(index).empty()) {
    return m_pictures[index];
  }
  const fs::path file = m_folder / m_views[index].file;
  cv::Mat picture = decode(file);
  checkSize(picture, file.string());
  return picture;
}

void DataSet::checkSize(const cv::Mat &picture, const std::string &name) const
{
  if (picture.size() != m_pictureSize) {
    throw ConfigError(name + " has " + pixelsOf(picture.size()) + ", " +
                      (m_camera ? "its camera " : "the first picture ") + pixelsOf(m_pictureSize) +
                      ": all must be alike");
  }
}

Panorama DataSet::panorama(std::size_t index) const
{
  return panoramaOf(picture(index), m_views[index].file);
}

Panorama DataSet::panoramaOf(const cv::Mat &picture, const std::string &name) const
{
  checkSize(picture, name);
  cv::Mat gray = picture;
  if (gray.channels() == 3) {
    cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
  }
  return toGeometry(gray);
}

Panorama DataSet::colourPanorama(std::size_t index) const
{
  const cv::Mat taken = picture(index);
  checkSize(taken, m_views[index].file);
  return toGeometry(taken);
}

Panorama DataSet::toGeometry(const cv::Mat &picture) const
{
  return m_unwarper ? m_unwarper->unwarp(picture) : toPanorama(picture, m_layout);
}

} // namespace homeward
