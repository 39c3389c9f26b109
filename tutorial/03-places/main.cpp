// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 03: a place in brief, its signature, is enough to find it again among others.
#include "../support/views.h"

#include <homeward/core/random.h>
#include <homeward/place/place_index.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdio>

using namespace homeward;

/** The places that the robot knows, all over the laboratory. */
const std::vector<Pose2> kPlaces = {{0.0, 0.0, 0.0},  {-0.6, -1.8, 1.0}, {1.4, -2.0, 2.0},
                                    {1.4, 1.2, 3.0},  {-0.9, 1.5, -2.0}, {2.7, 2.2, -1.0},
                                    {4.6, 2.1, 0.5},  {6.2, 2.9, 1.5},   {7.8, 1.8, 2.5},
                                    {7.8, 0.0, -2.5}, {4.2, -1.4, -1.5}, {3.1, -2.8, -0.5}};

/** The same places again, half a step aside and turned: nobody comes back exactly. */
std::vector<Pose2> comeBack()
{
  Random random(/*seed*/ 1, /*stream*/ 0);
  std::vector<Pose2> poses;
  poses.reserve(kPlaces.size());
  for (const Pose2 &place : kPlaces) {
    poses.push_back(place * Pose2{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                                  random.uniform(-kPi, kPi)});
  }
  return poses;
}

std::vector<Signature> describe(const DataSet &views, SignatureKind kind)
{
  std::vector<Signature> signatures;
  for (std::size_t i = 0; i < views.size(); ++i) {
    signatures.push_back(makeSignature(views.panorama(i), kind, views.visible()));
  }
  return signatures;
}

/** How many of the views seen are nearest to the place where they were taken. */
int countFound(const std::vector<Signature> &known, const std::vector<Signature> &seen)
{
  PlaceIndex index(known[0].kind);
  for (std::size_t i = 0; i < known.size(); ++i) {
    index.add(NodeId{static_cast<std::int64_t>(i)}, known[i]);
  }
  int found = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Match best = index.nearest(seen[i], 1).front();
    found += best.node == NodeId{static_cast<std::int64_t>(i)} ? 1 : 0;
  }
  return found;
}

/** A row for each view, a column for each place: dark is alike, a ring marks the row's darkest. */
cv::Mat draw(const std::string &title, const std::vector<Signature> &known,
             const std::vector<Signature> &seen)
{
  constexpr int kCell = 26; // pixels
  constexpr int kTop = 50;
  cv::Mat1d unlike(static_cast<int>(seen.size()), static_cast<int>(known.size()));
  unlike.forEach([&](double &value, const int *at) {
    value = dissimilarity(seen[static_cast<std::size_t>(at[0])],
                          known[static_cast<std::size_t>(at[1])]);
  });
  cv::Mat picture;
  cv::normalize(unlike, picture, 20, 255, cv::NORM_MINMAX, CV_8U);
  cv::resize(picture, picture, {}, kCell, kCell, cv::INTER_NEAREST);
  cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
  for (int row = 0; row < unlike.rows; ++row) {
    cv::Point darkest;
    cv::minMaxLoc(unlike.row(row), nullptr, nullptr, &darkest);
    const cv::Scalar colour = darkest.x == row ? cv::Scalar(200, 140, 0) : cv::Scalar(0, 100, 230);
    cv::circle(picture, {darkest.x * kCell + kCell / 2, row * kCell + kCell / 2}, 8, colour, 3,
               cv::LINE_AA);
  }
  cv::copyMakeBorder(picture, picture, kTop, 10, 10, 10, cv::BORDER_CONSTANT, {255, 255, 255});
  const auto write = [&](const std::string &text, int row, double size) {
    cv::putText(picture, text, {10, row}, cv::FONT_HERSHEY_SIMPLEX, size, {0, 0, 0}, 1,
                cv::LINE_AA);
  };
  write(title, 20, 0.6);
  write("across: places by day; down: views at night", 40, 0.4);
  return picture;
}

int main()
{
  const Laboratory laboratory = loadLaboratory();
  const DataSet places = takePictures(laboratory, kPlaces, LightPreset::Day);
  const DataSet byDay = takePictures(laboratory, comeBack(), LightPreset::Day);
  const DataSet atNight = takePictures(laboratory, comeBack(), LightPreset::Night);

  std::printf("%zu places known; each view is given the place most like it\n", kPlaces.size());
  std::printf("signature      by day  at night\n");
  std::vector<cv::Mat> pictures;
  for (const SignatureKind kind : {SignatureKind::Jeffrey, SignatureKind::AlignedEdges}) {
    const std::vector<Signature> known = describe(places, kind);
    const std::vector<Signature> seen = describe(atNight, kind);
    const std::string title(name(kind));
    std::printf("%-13s  %2d right  %2d right\n", title.c_str(),
                countFound(known, describe(byDay, kind)), countFound(known, seen));
    pictures.push_back(draw(title, known, seen));
  }
  cv::Mat picture;
  cv::hconcat(pictures, picture);
  cv::imwrite("03-places.png", picture);
}
