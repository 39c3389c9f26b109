// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_file.h>
#include <homeward/camera/unwarper.h>
#include <homeward/core/pose2.h>
#include <homeward/dataset/panorama_layout.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** One picture of a data set, and where it was taken. */
struct DataSetView
{
  std::string file;  ///< name in the folder, of a format that OpenCV reads
  Pose2 pose;        ///< wMr
  std::string light; ///< any word
};

/**
 * Pictures taken at known places: a folder with `poses.csv` (header
 * `file,x_m,y_m,heading_rad,light`), the pictures it names, and `panorama.yaml` (PanoramaLayout)
 * when they are panoramas or `camera.yaml` (MirrorCamera) when they are mirror pictures.
 *
 * Views keep the order of the file. All panoramas have one geometry, whatever the pictures are. A
 * camera that has shifted since its file was written is followed, see followRim(); the file stays.
 */
class DataSet
{
public:
  /** An empty set of mirror pictures, unwarped to `geometry`. */
  explicit DataSet(const MirrorCamera &camera, const PanoramaGeometry &geometry = {});

  /** An empty set of panoramas that lie as `layout` says. */
  DataSet(const PanoramaLayout &layout, const cv::Size &size);

  /**
   * Reads a folder; pictures but the first are decoded when asked for.
   * @param geometry of the panoramas made from mirror pictures; panoramas keep their own
   * @throw ConfigError, one line naming file, line and what to do
   */
  static DataSet read(const std::filesystem::path &folder, const PanoramaGeometry &geometry = {});

  /**
   * Adds a view whose picture stays in memory.
   * @throw LogicError when the picture's size or type differs from the set's, or another view has
   * the same file
   */
  void add(const DataSetView &view, const cv::Mat &picture);

  /**
   * Unwarps from now on as the rim says in up to 15 of the pictures, evenly spread. read() has done
   * so.
   * @throw ConfigError as panorama()
   */
  void followRim();

  /** The same by these pictures; those of another size do not count. */
  void followRim(const std::vector<cv::Mat> &pictures);

  /**
   * Writes the folder and every picture as the file that its view names, without loss for PNG.
   * @throw StoreError naming the file that cannot be written; ConfigError for a picture that cannot
   * be read
   */
  void write(const std::filesystem::path &folder) const;

  /** Number of pictures. */
  std::size_t size() const { return m_views.size(); }
  /** @throw std::out_of_range */
  const DataSetView &view(std::size_t index) const { return m_views.at(index); }
  /** All, in the order of the file. */
  const std::vector<DataSetView> &views() const { return m_views; }

  /** The lights, in the order of their first view. */
  std::vector<std::string> lights() const;

  /** Indices of the views of a light, in order. */
  std::vector<std::size_t> viewsOf(const std::string &light) const;

  /** Geometry of every panorama(). */
  const PanoramaGeometry &geometry() const { return m_geometry; }

  /** CV_8UC1, 255 where panoramas show the scene; empty when all of it does. */
  cv::Mat visible() const;

  /**
   * The panorama of a view, gray; safe to call from several threads.
   * @throw ConfigError naming a picture that is missing, broken or of the wrong size
   */
  Panorama panorama(std::size_t index) const;

  /** As panorama(), in colour where the picture is. */
  Panorama colourPanorama(std::size_t index) const;

  /**
   * The picture of a view as it was given or stored.
   * @throw ConfigError as panorama()
   */
  cv::Mat picture(std::size_t index) const;

  /**
   * The panorama of any picture of this set's kind, gray.
   * @param name for the message
   * @throw ConfigError naming a picture of the wrong size
   */
  Panorama panoramaOf(const cv::Mat &picture, const std::string &name) const;

private:
  Panorama toGeometry(const cv::Mat &picture) const;

  void checkSize(const cv::Mat &picture, const std::string &name) const;

  /** What is in memory, or nothing when the picture is a file of m_folder. */
  std::vector<cv::Mat> m_pictures;
  std::vector<DataSetView> m_views;
  std::filesystem::path m_folder;
  std::optional<MirrorCamera> m_camera; ///< of mirror pictures
  std::optional<Unwarper> m_unwarper;   ///< likewise
  PanoramaLayout m_layout;              ///< of panoramas
  cv::Size m_pictureSize;
  PanoramaGeometry m_geometry;
};

} // namespace homeward
