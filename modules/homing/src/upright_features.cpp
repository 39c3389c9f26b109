// SPDX-License-Identifier: GPL-3.0-or-later
#include "upright_features.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace homeward
{

namespace
{

constexpr int kIntervals = 3; ///< scales looked at from one octave to the next
constexpr int kLevels = kIntervals + 3;
constexpr double kSigma = 1.6;       ///< of the first level, pixels of its octave
constexpr double kCameraSigma = 0.5; ///< what pictures come with
constexpr double kEdgeRatio = 10.0;  ///< of the principal curvatures, beyond which it is an edge
constexpr int kLeastRows = 16;       ///< of an octave
constexpr int kBorder = 4;           ///< pixels of an octave that have no features
constexpr int kSeam = 64;            ///< columns repeated beyond the seam on either side

constexpr std::size_t kGrid = 16; ///< samples along a side of the patch
constexpr std::size_t kCells = 4; ///< histograms along a side
constexpr std::size_t kTurns = 8; ///< bins of a histogram
constexpr std::size_t kNumbers = kCells * kCells * kTurns;
constexpr float kMostShare = 0.2F;  ///< of one number in the length of the descriptor
constexpr float kByteUnit = 512.0F; ///< byte steps of the length
/** Side of a histogram's cell over the scale of the feature. */
constexpr float kCellSide = 4.0F;

/** One octave of scale space; the same size all. */
struct Octave
{
  std::array<cv::Mat, kLevels> gaussians;       ///< CV_32F
  std::array<cv::Mat, kLevels - 1> differences; ///< CV_32F
};

double sigmaOf(double level)
{
  return kSigma * std::pow(2.0, level / kIntervals);
}

Octave makeOctave(const cv::Mat &base)
{
  Octave octave;
  octave.gaussians[0] = base;
  for (int i = 1; i < kLevels; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double more = std::sqrt(sigmaOf(i) * sigmaOf(i) - sigmaOf(i - 1) * sigmaOf(i - 1));
    cv::GaussianBlur(octave.gaussians[at - 1], octave.gaussians[at], {}, more, more,
                     cv::BORDER_REPLICATE);
    octave.differences[at - 1] = octave.gaussians[at] - octave.gaussians[at - 1];
  }
  return octave;
}

/** An extremum, in pixels and levels of its octave. */
struct Extremum
{
  float x;
  float y;
  float level;
  float response;
};

bool isExtremum(const std::array<cv::Mat, kLevels - 1> &d, std::size_t level, int y, int x)
{
  const float value = d[level].at<float>(y, x);
  const float sign = value > 0.0F ? 1.0F : -1.0F;
  for (std::size_t l = level - 1; l <= level + 1; ++l) {
    for (int dy = -1; dy <= 1; ++dy) {
      const float *row = d[l].ptr<float>(y + dy) + x;
      if (sign * row[-1] > sign * value || sign * row[0] > sign * value ||
          sign * row[1] > sign * value) {
        return false;
      }
    }
  }
  return true;
}

/** The vertex of the quadric through a grid extremum, unless it is weak or lies along an edge. */
std::optional<Extremum> refine(const std::array<cv::Mat, kLevels - 1> &d, int level, int y, int x,
                               float least)
{
  const auto at = [&](int dl, int dy, int dx) {
    const int plane = level + dl;
    return d[static_cast<std::size_t>(plane)].at<float>(y + dy, x + dx);
  };
  const float value = at(0, 0, 0);
  const cv::Vec3f gradient((at(0, 0, 1) - at(0, 0, -1)) / 2.0F, (at(0, 1, 0) - at(0, -1, 0)) / 2.0F,
                           (at(1, 0, 0) - at(-1, 0, 0)) / 2.0F);
  const float xx = at(0, 0, 1) + at(0, 0, -1) - 2.0F * value;
  const float yy = at(0, 1, 0) + at(0, -1, 0) - 2.0F * value;
  const float ll = at(1, 0, 0) + at(-1, 0, 0) - 2.0F * value;
  const float xy = (at(0, 1, 1) - at(0, 1, -1) - at(0, -1, 1) + at(0, -1, -1)) / 4.0F;
  const float xl = (at(1, 0, 1) - at(1, 0, -1) - at(-1, 0, 1) + at(-1, 0, -1)) / 4.0F;
  const float yl = (at(1, 1, 0) - at(1, -1, 0) - at(-1, 1, 0) + at(-1, -1, 0)) / 4.0F;
  const float trace = xx + yy;
  const float determinant = xx * yy - xy * xy;
  constexpr auto kEdge = static_cast<float>((kEdgeRatio + 1.0) * (kEdgeRatio + 1.0) / kEdgeRatio);
  if (determinant <= 0.0F || trace * trace >= kEdge * determinant) {
    return std::nullopt;
  }
  const cv::Vec3f step =
      -cv::Matx33f(xx, xy, xl, xy, yy, yl, xl, yl, ll).solve(gradient, cv::DECOMP_LU);
  // A vertex a pixel off would have been found there.
  if (!(std::abs(step[0]) < 1.0F && std::abs(step[1]) < 1.0F && std::abs(step[2]) < 1.0F)) {
    return std::nullopt;
  }
  const float response = std::abs(value + 0.5F * gradient.dot(step));
  if (response < least) {
    return std::nullopt;
  }
  return Extremum{static_cast<float>(x) + step[0], static_cast<float>(y) + step[1],
                  static_cast<float>(level) + step[2], response};
}

/** Marks what of a row is beyond the least value and the four neighbours; loops that are vectors.
 */
void markCandidates(const cv::Mat &d, int y, float least, std::vector<std::uint8_t> &marks)
{
  const float *above = d.ptr<float>(y - 1);
  const float *here = d.ptr<float>(y);
  const float *below = d.ptr<float>(y + 1);
  for (int x = kBorder; x < d.cols - kBorder; ++x) {
    const float value = here[x];
    const float high = std::max(std::max(here[x - 1], here[x + 1]), std::max(above[x], below[x]));
    const float low = std::min(std::min(here[x - 1], here[x + 1]), std::min(above[x], below[x]));
    marks[static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(
        static_cast<int>(value >= high) * static_cast<int>(value > least) +
        static_cast<int>(value <= low) * static_cast<int>(value < -least));
  }
}

std::vector<Extremum> findExtrema(const Octave &octave, float least)
{
  std::vector<Extremum> found;
  const cv::Size size = octave.gaussians[0].size();
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(size.width));
  for (int level = 1; level <= kIntervals; ++level) {
    const auto at = static_cast<std::size_t>(level);
    for (int y = kBorder; y < size.height - kBorder; ++y) {
      markCandidates(octave.differences[at], y, 0.5F * least, marks);
      for (int x = kBorder; x < size.width - kBorder; ++x) {
        if (marks[static_cast<std::size_t>(x)] != 0 && isExtremum(octave.differences, at, y, x)) {
          if (const auto extremum = refine(octave.differences, level, y, x, least)) {
            found.push_back(*extremum);
          }
        }
      }
    }
  }
  return found;
}

/** What is the same for every feature: weights of samples, and directions of gradients. */
struct PatchWeights
{
  std::array<float, kGrid> window;     ///< of a row or a column
  std::array<std::size_t, kGrid> cell; ///< first of the two padded cells a row or column is in
  std::array<float, kGrid> share;      ///< of it in the second
  std::array<float, kTurns / 2> cosines;
  std::array<float, kTurns / 2> sines;

  PatchWeights()
  {
    for (std::size_t i = 0; i < kGrid; ++i) {
      const double middle = (static_cast<double>(i) + 0.5) / kGrid;
      const double at = middle * kCells + 0.5;
      cell[i] = static_cast<std::size_t>(at);
      share[i] = static_cast<float>(at - std::floor(at));
      window[i] = static_cast<float>(std::exp(-(2.0 * middle - 1.0) * (2.0 * middle - 1.0) / 2.0));
    }
    for (std::size_t k = 0; k < kTurns / 2; ++k) {
      const double turn = 2.0 * CV_PI * static_cast<double>(k) / kTurns;
      cosines[k] = static_cast<float>(std::cos(turn));
      sines[k] = static_cast<float>(std::sin(turn));
    }
  }
};

using Histogram = std::array<float, kTurns>;

/** to += part * from; short loops of one length, which compilers make vectors of. */
void addPart(Histogram &to, float part, const Histogram &from)
{
  for (std::size_t k = 0; k < kTurns; ++k) {
    to[k] += part * from[k];
  }
}

/** Unit length, no number above its most, as bytes. */
void writeDescriptor(std::array<float, kNumbers> numbers, std::uint8_t *descriptor)
{
  const auto length = [&numbers] {
    float square = 1e-12F;
    for (const float number : numbers) {
      square += number * number;
    }
    return std::sqrt(square);
  };
  const float most = kMostShare * length();
  for (float &number : numbers) {
    number = std::min(number, most);
  }
  const float unit = kByteUnit / length();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    descriptor[k] = cv::saturate_cast<std::uint8_t>(unit * numbers[k]);
  }
}

/** Histograms of gradients round a place of a picture that is smoothed to the feature's scale. */
void describe(const cv::Mat &smooth, float x, float y, float sigma, std::uint8_t *descriptor)
{
  static const PatchWeights weights;
  constexpr std::size_t kPadded = kCells + 2; // cells beyond the rim take what falls off it
  std::array<std::array<Histogram, kPadded>, kPadded> sums{};
  const float step = kCellSide * sigma * kCells / kGrid;
  const auto sampled = [&](float middle, std::size_t i) {
    return cvRound(middle + (static_cast<float>(i) - (kGrid - 1) / 2.0F) * step);
  };
  for (std::size_t i = 0; i < kGrid; ++i) {
    const int v = sampled(y, i);
    if (v < 1 || v >= smooth.rows - 1) {
      continue;
    }
    const float *above = smooth.ptr<float>(v - 1);
    const float *here = smooth.ptr<float>(v);
    const float *below = smooth.ptr<float>(v + 1);
    std::array<Histogram, kPadded> line{};
    for (std::size_t j = 0; j < kGrid; ++j) {
      const int u = sampled(x, j);
      if (u < 1 || u >= smooth.cols - 1) {
        continue;
      }
      const float gx = here[u + 1] - here[u - 1];
      const float gy = below[u] - above[u];
      Histogram along;
      for (std::size_t k = 0; k < kTurns / 2; ++k) {
        const float part = gx * weights.cosines[k] + gy * weights.sines[k];
        along[k] = std::abs(part) + part; // twice the part, or nothing
        along[k + kTurns / 2] = std::abs(part) - part;
      }
      addPart(line[weights.cell[j]], weights.window[j] * (1.0F - weights.share[j]), along);
      addPart(line[weights.cell[j] + 1], weights.window[j] * weights.share[j], along);
    }
    for (std::size_t c = 1; c <= kCells; ++c) {
      addPart(sums[weights.cell[i]][c], weights.window[i] * (1.0F - weights.share[i]), line[c]);
      addPart(sums[weights.cell[i] + 1][c], weights.window[i] * weights.share[i], line[c]);
    }
  }
  std::array<float, kNumbers> numbers;
  auto next = numbers.begin();
  for (std::size_t row = 1; row <= kCells; ++row) {
    for (std::size_t c = 1; c <= kCells; ++c) {
      next = std::copy(sums[row][c].begin(), sums[row][c].end(), next);
    }
  }
  writeDescriptor(numbers, descriptor);
}

/** A feature, and where in scale space its surroundings are to be looked at. */
struct Found
{
  std::size_t octave;
  Extremum extremum;
  cv::KeyPoint point; ///< in the picture
};

} // namespace

UprightFeatures uprightFeatures(const cv::Mat &gray, double contrast, int most)
{
  const int seam = std::min(kSeam, gray.cols / 2);
  cv::Mat base;
  cv::copyMakeBorder(gray, base, 0, 0, seam, seam, cv::BORDER_WRAP);
  base.convertTo(base, CV_32F);
  const double more = std::sqrt(kSigma * kSigma - kCameraSigma * kCameraSigma);
  cv::GaussianBlur(base, base, {}, more, more, cv::BORDER_REPLICATE);
  const auto least = static_cast<float>(255.0 * contrast / kIntervals);

  std::vector<Octave> octaves;
  std::vector<Found> found;
  for (double pixel = 1.0; base.rows >= kLeastRows; pixel *= 2.0) {
    octaves.push_back(makeOctave(base));
    const Octave &octave = octaves.back();
    for (const Extremum &extremum : findExtrema(octave, least)) {
      // Reduced pictures keep the first pixel of each two: places multiply.
      cv::KeyPoint point(static_cast<float>(extremum.x * pixel) - static_cast<float>(seam),
                         static_cast<float>(extremum.y * pixel),
                         static_cast<float>(2.0 * sigmaOf(extremum.level) * pixel), -1.0F,
                         extremum.response);
      if (point.pt.x >= -0.5F && point.pt.x < static_cast<float>(gray.cols) - 0.5F) {
        found.push_back({octaves.size() - 1, extremum, point});
      }
    }
    cv::resize(octave.gaussians[kIntervals], base, {}, 0.5, 0.5, cv::INTER_NEAREST);
  }

  if (std::ssize(found) > most) {
    std::nth_element(
        found.begin(), found.begin() + most, found.end(),
        [](const Found &a, const Found &b) { return a.extremum.response > b.extremum.response; });
    found.resize(static_cast<std::size_t>(most));
  }
  std::sort(found.begin(), found.end(), [](const Found &a, const Found &b) {
    return std::pair(a.point.pt.y, a.point.pt.x) < std::pair(b.point.pt.y, b.point.pt.x);
  });
  UprightFeatures result;
  result.descriptors.create(static_cast<int>(found.size()), static_cast<int>(kNumbers), CV_8U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Extremum &extremum = found[i].extremum;
    const auto level = static_cast<std::size_t>(std::lround(extremum.level));
    describe(octaves[found[i].octave].gaussians[level], extremum.x, extremum.y,
             static_cast<float>(sigmaOf(extremum.level)),
             result.descriptors.ptr<std::uint8_t>(static_cast<int>(i)));
    result.points.push_back(found[i].point);
  }
  return result;
}

} // namespace homeward
