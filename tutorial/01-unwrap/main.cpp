// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 01: a mirror picture becomes a panorama.
#include "../support/files.h"

#include <homeward/camera/rim.h>
#include <homeward/camera/unwarper.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdio>

using namespace homeward;

/** The panorama with a line and a name at each quarter of the turn, and the horizon. */
cv::Mat label(const Panorama &panorama)
{
  constexpr int kStrip = 22; // pixels, for the names
  const cv::Scalar yellow(0, 230, 255);
  cv::Mat picture;
  cv::copyMakeBorder(panorama.image, picture, kStrip, 0, 0, 0, cv::BORDER_CONSTANT,
                     {255, 255, 255});
  const int horizon = kStrip + cvRound(panorama.geometry.row(0.0));
  cv::line(picture, {0, horizon}, {picture.cols - 1, horizon}, yellow);
  const struct
  {
    const char *name;
    double azimuth; // degrees, counter-clockwise
  } marks[] = {{"left", 90.0}, {"ahead", 0.0}, {"right", -90.0}, {"behind", 179.0}};
  for (const auto &mark : marks) {
    const int column = cvRound(panorama.geometry.column(radians(mark.azimuth)));
    cv::line(picture, {column, kStrip}, {column, picture.rows - 1}, yellow);
    cv::putText(picture, mark.name, {std::max(2, column - 20), 16}, cv::FONT_HERSHEY_SIMPLEX, 0.5,
                {0, 0, 0}, 1, cv::LINE_AA);
  }
  return picture;
}

int main()
{
  const std::string file = dataFile("cameras/sim_nominal.yaml");
  const MirrorCamera camera = parseMirrorCamera(readText(file), file);
  const cv::Mat picture = cv::imread(dataFile("samples/mirror.jpg"));

  // A camera that got a knock shows it: the mirror's rim is not where the file says.
  const std::optional<Eigen::Vector2d> shift = rimShift(picture, camera);
  const MirrorCamera now = shift ? followRim(camera, {*shift}) : camera;

  // The table of an Unwarper is computed once and serves every picture.
  const Unwarper unwarper(now, PanoramaGeometry{});
  const Panorama panorama = unwarper.unwarp(picture);
  cv::imwrite("01-unwrap.png", label(panorama));

  const PanoramaGeometry &geometry = panorama.geometry;
  std::printf("mirror picture %d x %d, panorama %d x %d\n", picture.cols, picture.rows,
              geometry.width, geometry.height);
  std::printf("the rim has moved by %.0f, %.0f pixels\n", shift->x(), shift->y());
  std::printf("left is column %.1f, ahead %.1f, right %.1f\n", geometry.column(radians(90.0)),
              geometry.column(0.0), geometry.column(radians(-90.0)));
  std::printf("the horizon is row %.1f\n", geometry.row(0.0));
}
