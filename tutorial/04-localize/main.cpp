// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 04: along a route, what was likely a step ago says what is likely now.
#include "../support/views.h"

#include <homeward/core/random.h>
#include <homeward/place/bayes_localizer.h>
#include <homeward/place/signature.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdio>

using namespace homeward;

/** A place every 0.6 m along a lap round the laboratory's big table, heading along it. */
std::vector<Pose2> lap()
{
  const std::vector<Eigen::Vector2d> corners = {{0.0, 0.0}, {1.4, -1.6}, {4.3, -1.4}, {6.4, -0.6},
                                                {7.7, 0.4}, {7.6, 1.8},  {6.0, 2.8},  {4.0, 2.2},
                                                {1.4, 1.2}, {0.0, 0.6}};
  std::vector<Pose2> places;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Eigen::Vector2d way = corners[i + 1] - corners[i];
    const int count = static_cast<int>(way.norm() / 0.6);
    for (int k = 0; k < count; ++k) {
      const Eigen::Vector2d point = corners[i] + way * k / count;
      places.push_back({point.x(), point.y(), std::atan2(way.y(), way.x())});
    }
  }
  return places;
}

/** The lap driven again, aside of the first time. */
std::vector<Pose2> lapAgain()
{
  Random random(/*seed*/ 1, /*stream*/ 0);
  std::vector<Pose2> poses = lap();
  for (Pose2 &pose : poses) {
    pose = pose * Pose2{random.uniform(-0.15, 0.15), random.uniform(-0.3, 0.3), random.normal(0.3)};
  }
  return poses;
}

std::vector<Signature> describe(const DataSet &views)
{
  std::vector<Signature> signatures;
  for (std::size_t i = 0; i < views.size(); ++i) {
    signatures.push_back(
        makeSignature(views.panorama(i), SignatureKind::EdgeFourier, views.visible()));
  }
  return signatures;
}

/** Steps from place to place: one to the next, and the lap closes. */
Eigen::MatrixXd stepsAlong(std::size_t places)
{
  const auto count = static_cast<Eigen::Index>(places);
  Eigen::MatrixXd steps(count, count);
  for (Eigen::Index to = 0; to < count; ++to) {
    for (Eigen::Index from = 0; from < count; ++from) {
      const Eigen::Index apart = std::abs(to - from);
      steps(to, from) = static_cast<double>(std::min(apart, count - apart));
    }
  }
  return steps;
}

int main()
{
  const Laboratory laboratory = loadLaboratory();
  const auto known = describe(takePictures(laboratory, lap(), LightPreset::Day));
  const auto seen = describe(takePictures(laboratory, lapAgain(), LightPreset::Night));

  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < known.size(); ++i) {
    nodes.push_back(NodeId{static_cast<std::int64_t>(i)});
  }
  BayesLocalizer localizer(nodes); // no start: the robot could be anywhere
  const Eigen::MatrixXd steps = stepsAlong(known.size());
  const int count = static_cast<int>(known.size());
  cv::Mat1b belief(count, count);
  int byLook = 0;
  int byFilter = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    std::vector<double> unlike(known.size());
    std::transform(known.begin(), known.end(), unlike.begin(),
                   [&](const Signature &place) { return dissimilarity(seen[i], place); });
    if (i > 0) {
      localizer.move(steps); // it has driven about one step, we do not know which way
    }
    localizer.observe(unlike);
    const auto likest = std::min_element(unlike.begin(), unlike.end()) - unlike.begin();
    byLook += nodes[static_cast<std::size_t>(likest)] == nodes[i] ? 1 : 0;
    byFilter += localizer.mostProbable() == nodes[i] ? 1 : 0;
    for (int k = 0; k < count; ++k) {
      belief(static_cast<int>(i), k) =
          cv::saturate_cast<uchar>(255.0 * (1.0 - localizer.belief()[static_cast<std::size_t>(k)]));
    }
  }

  constexpr int kCell = 18; // pixels
  cv::resize(belief, belief, {}, kCell, kCell, cv::INTER_NEAREST);
  cv::copyMakeBorder(belief, belief, 30, 10, 10, 10, cv::BORDER_CONSTANT, 200);
  cv::putText(belief, "across: place; down: time; black: the robot is surely there", {10, 20},
              cv::FONT_HERSHEY_SIMPLEX, 0.45, 0, 1, cv::LINE_AA);
  cv::imwrite("04-localize.png", belief);

  std::printf("%d places seen by day, driven along again at night\n", count);
  std::printf("by the look alone  %2d right\n", byLook);
  std::printf("with the filter    %2d right\n", byFilter);
}
