// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_chains.h"

#include <homeward/core/angle.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace homeward
{
namespace
{

constexpr std::array<std::array<int, 2>, 8> kAround{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/** Next edge pixel beside one, straight neighbours first; none at the end of a chain. */
std::optional<cv::Point> nextOf(const cv::Mat1b &edges, const cv::Point &pixel)
{
  for (const auto &[dx, dy] : kAround) {
    const cv::Point next(pixel.x + dx, pixel.y + dy);
    if (next.x >= 0 && next.y >= 0 && next.x < edges.cols && next.y < edges.rows &&
        edges(next) != 0) {
      return next;
    }
  }
  return std::nullopt;
}

/** Takes the chain that starts at an edge pixel out of the edges, both ways. */
std::vector<cv::Point> takeChain(cv::Mat1b &edges, const cv::Point &start)
{
  std::vector<cv::Point> chain{start};
  edges(start) = 0;
  for (int way = 0; way < 2; ++way) {
    while (const auto next = nextOf(edges, chain.back())) {
      chain.push_back(*next);
      edges(*next) = 0;
    }
    std::reverse(chain.begin(), chain.end());
  }
  return chain;
}

/** Cuts a chain where it turns sharply. */
std::vector<std::vector<cv::Point>> smoothPieces(const std::vector<cv::Point> &chain)
{
  constexpr std::size_t kStep = 6;
  constexpr double kSharp = radians(30.0);
  std::vector<std::vector<cv::Point>> pieces(1);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (i >= kStep && i + kStep < chain.size()) {
      const cv::Point before = chain[i] - chain[i - kStep];
      const cv::Point after = chain[i + kStep] - chain[i];
      const double turn = std::atan2(before.cross(after), before.dot(after));
      if (std::abs(turn) > kSharp) {
        pieces.emplace_back();
        continue;
      }
    }
    pieces.back().push_back(chain[i]);
  }
  return pieces;
}

/** The steepest place near an edge pixel, across the edge. */
Eigen::Vector2d onTheEdge(const cv::Mat1f &dx, const cv::Mat1f &dy, const cv::Point &pixel)
{
  const Eigen::Vector2d at(pixel.x, pixel.y);
  Eigen::Vector2d across(dx(pixel), dy(pixel));
  if (!(across.norm() > 1e-6)) {
    return at;
  }
  across /= across.cwiseAbs().maxCoeff();
  const auto slope = [&](int side) {
    const cv::Point there(std::clamp(pixel.x + cvRound(side * across.x()), 0, dx.cols - 1),
                          std::clamp(pixel.y + cvRound(side * across.y()), 0, dx.rows - 1));
    return std::hypot(static_cast<double>(dx(there)), static_cast<double>(dy(there)));
  };
  const double before = slope(-1);
  const double here = slope(0);
  const double after = slope(1);
  const double bend = before - 2.0 * here + after;
  const double offset = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
  return at + std::clamp(offset, -0.5, 0.5) * across;
}

} // namespace

std::vector<EdgeChain> findEdgeChains(const cv::Mat1b &picture, const cv::Mat &mask, int shortest)
{
  cv::Mat smooth;
  cv::GaussianBlur(picture, smooth, {}, 1.2);
  cv::Mat1s across;
  cv::Mat1s down;
  cv::Sobel(smooth, across, CV_16S, 1, 0);
  cv::Sobel(smooth, down, CV_16S, 0, 1);
  cv::Mat1b edges;
  cv::Canny(across, down, edges, 40.0, 110.0, true);
  edges.setTo(0, mask == 0);
  cv::Mat1f dx;
  cv::Mat1f dy;
  across.convertTo(dx, CV_32F);
  down.convertTo(dy, CV_32F);
  std::vector<EdgeChain> chains;
  for (int v = 0; v < edges.rows; ++v) {
    for (int u = 0; u < edges.cols; ++u) {
      if (edges(v, u) == 0) {
        continue;
      }
      for (const auto &piece : smoothPieces(takeChain(edges, {u, v}))) {
        if (static_cast<int>(piece.size()) < shortest) {
          continue;
        }
        EdgeChain chain;
        for (const cv::Point &pixel : piece) {
          chain.push_back(onTheEdge(dx, dy, pixel));
        }
        chains.push_back(std::move(chain));
      }
    }
  }
  return chains;
}

} // namespace homeward
