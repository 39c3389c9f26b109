// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading_texture.h"

#include "shading_colour.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace homeward
{

namespace
{

constexpr int kWeight = 256; ///< bilinear weights are counted in this many parts
constexpr int kSteps = 1024; ///< entries of the decoding table
constexpr int kShare = 255 * kWeight * kWeight / kSteps; ///< of a weighted sum, an entry

/** Linear value of a weighted sum of four sRGB-coded ones in [0, 255]. */
float decode(int weighted)
{
  static const std::array<float, kSteps + 1> kTable = [] {
    std::array<float, kSteps + 1> table{};
    for (int i = 0; i <= kSteps; ++i) {
      table[static_cast<std::size_t>(i)] = toLinear(static_cast<float>(i) / kSteps);
    }
    return table;
  }();
  return kTable[static_cast<std::size_t>((weighted + kShare / 2) / kShare)];
}

/** round(log2(x)), roughly, for x >= 1, from the bits of the number. */
int nearestPowerOfTwo(float x)
{
  return static_cast<int>(std::bit_cast<std::uint32_t>(x * 1.41421356F) >> 23U) - 127;
}

/** Index of a texel in a row or column that repeats. */
int wrapped(int index, int size)
{
  return index < 0 ? index + size : (index >= size ? index - size : index);
}

} // namespace

Eigen::Vector3f sampleTexture(const Texture &texture, const Eigen::Vector2f &uv, float footprint)
{
  const int last = static_cast<int>(texture.levels.size()) - 1;
  const int level = footprint > 1.0F ? std::min(last, nearestPowerOfTwo(footprint)) : 0;
  const cv::Mat &picture = texture.levels[static_cast<std::size_t>(level)];
  const float x = (uv.x() - std::floor(uv.x())) * static_cast<float>(picture.cols) - 0.5F;
  const float y = (1.0F - (uv.y() - std::floor(uv.y()))) * static_cast<float>(picture.rows) - 0.5F;
  const float left = std::floor(x);
  const float top = std::floor(y);
  const int a = static_cast<int>((x - left) * kWeight);
  const int b = static_cast<int>((y - top) * kWeight);
  const int column0 = wrapped(static_cast<int>(left), picture.cols);
  const int column1 = wrapped(static_cast<int>(left) + 1, picture.cols);
  const cv::Vec3b *row0 = picture.ptr<cv::Vec3b>(wrapped(static_cast<int>(top), picture.rows));
  const cv::Vec3b *row1 = picture.ptr<cv::Vec3b>(wrapped(static_cast<int>(top) + 1, picture.rows));
  Eigen::Vector3f rgb;
  for (int channel = 0; channel < 3; ++channel) {
    const auto at = [channel](const cv::Vec3b *row, int column) {
      return static_cast<int>(row[column][2 - channel]);
    };
    const int upper = kWeight * at(row0, column0) + a * (at(row0, column1) - at(row0, column0));
    const int lower = kWeight * at(row1, column0) + a * (at(row1, column1) - at(row1, column0));
    rgb[channel] = decode(kWeight * upper + b * (lower - upper));
  }
  return rgb;
}

} // namespace homeward
