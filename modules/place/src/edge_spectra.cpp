// SPDX-License-Identifier: GPL-3.0-or-later
#include "narrow_product.h"
#include "signature_values.h"

#include <homeward/core/angle.h>
#include <homeward/place/histogram.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace homeward
{

namespace
{

constexpr int kFrequencies = 30;
/** Rows of edges that share one spectrum; more tolerate more displacement and tell less. */
constexpr int kBandRows = 8;
/** Bands and frequencies of the form in bytes. */
constexpr int kByteBands = 16;
constexpr int kByteFrequencies = 16;
/** Added to gray levels before the logarithm. */
constexpr double kDarkLevel = 4.0;

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/** Entry (n, f) is wave[(n f) mod columns], for half the columns and the lowest frequencies. */
Matrix waves(const std::vector<float> &wave, int frequencies)
{
  const int columns = static_cast<int>(wave.size());
  Matrix matrix = Matrix::Zero(columns / 2 + 1, static_cast<int>(kNarrowColumns));
  for (int n = 0; n < matrix.rows(); ++n) {
    for (int f = 0; f < std::min(frequencies, columns / 2 + 1); ++f) {
      matrix(n, f) = wave[static_cast<std::size_t>(n * f % columns)];
    }
  }
  return matrix;
}

/** Product of a matrix with waves(). Eigen's own would wake threads that spin. */
Matrix product(const Matrix &a, const Matrix &b)
{
  Matrix ab(a.rows(), b.cols());
  narrowProduct(a.data(), static_cast<std::size_t>(a.rows()), static_cast<std::size_t>(a.cols()),
                b.data(), ab.data());
  return ab;
}

/** The lowest frequencies of some rows, by row and frequency (0 first). */
struct Spectra
{
  Matrix real;
  Matrix imaginary;

  Matrix magnitudes() const { return (real.array().square() + imaginary.array().square()).sqrt(); }
};

/**
 * Few of many frequencies are wanted, so a product of matrices beats a fast transform. Columns n
 * and -n share a cosine and, but for its sign, a sine: half of the matrix is enough.
 * @param frequencies at most kNarrowColumns; those that rows are too short for are 0
 */
Spectra rowSpectra(const Matrix &rows, int frequencies)
{
  const auto columns = static_cast<int>(rows.cols());
  const int half = columns / 2;
  const int pairs = (columns - 1) / 2; // columns 1 to pairs have a partner at the other end
  std::vector<float> cosines;
  std::vector<float> sines;
  for (int n = 0; n < columns; ++n) {
    const double angle = 2.0 * kPi * n / columns;
    cosines.push_back(static_cast<float>(std::cos(angle)));
    sines.push_back(static_cast<float>(std::sin(angle)));
  }
  Matrix even = rows.leftCols(half + 1);
  Matrix odd = Matrix::Zero(rows.rows(), half + 1);
  const auto partners = rows.rightCols(pairs).rowwise().reverse();
  even.middleCols(1, pairs) += partners;
  odd.middleCols(1, pairs) = rows.middleCols(1, pairs) - partners;
  return {product(even, waves(cosines, frequencies)).leftCols(frequencies),
          product(odd, waves(sines, frequencies)).leftCols(frequencies)};
}

/** Signed square roots of the vertical steps of the log intensity. */
Matrix verticalEdges(const cv::Mat &gray)
{
  std::array<float, 256> logs{};
  for (std::size_t level = 0; level < logs.size(); ++level) {
    logs[level] = static_cast<float>(std::log(static_cast<double>(level) + kDarkLevel));
  }
  Matrix values(gray.rows, gray.cols);
  for (int row = 0; row < gray.rows; ++row) {
    const auto *pixels = gray.ptr<std::uint8_t>(row);
    std::transform(pixels, pixels + gray.cols, values.row(row).data(),
                   [&](std::uint8_t level) { return logs[level]; });
  }
  const Matrix steps = values.topRows(gray.rows - 1) - values.bottomRows(gray.rows - 1);
  const Matrix roots = steps.array().abs().sqrt();
  return (steps.array() < 0.0F).select(-roots, roots);
}

/** Rising edges of each band, then falling ones; directions of all contrasts count alike. */
Matrix edgesByBand(Matrix edges)
{
  for (Eigen::Index column = 0; column < edges.cols(); ++column) {
    const float sum = edges.col(column).lpNorm<1>();
    edges.col(column) *= sum > 0.0F ? 1.0F / sum : 0.0F;
  }
  Matrix bands(2 * kByteBands, edges.cols());
  for (Eigen::Index i = 0; i < kByteBands; ++i) {
    const Eigen::Index begin = i * edges.rows() / kByteBands;
    const auto band = edges.middleRows(begin, (i + 1) * edges.rows() / kByteBands - begin);
    bands.row(2 * i) = band.cwiseMax(0.0F).colwise().sum();
    bands.row(2 * i + 1) = -band.cwiseMin(0.0F).colwise().sum();
  }
  return bands;
}

/** Sum of some spectra, of length 1: bands count alike, whatever their contrast. */
Eigen::RowVectorXf bandSpectrum(const Matrix &spectra, int begin, int end)
{
  return spectra.middleRows(begin, end - begin).colwise().sum().stableNormalized();
}

} // namespace

std::vector<float> fourierMagnitudes(const cv::Mat &gray)
{
  Matrix rows(gray.rows, gray.cols);
  for (int row = 0; row < gray.rows; ++row) {
    const auto *pixels = gray.ptr<std::uint8_t>(row);
    std::copy(pixels, pixels + gray.cols, rows.row(row).data());
  }
  const Matrix spectra = rowSpectra(rows, kFrequencies).magnitudes();
  return {spectra.data(), spectra.data() + spectra.size()};
}

std::vector<float> edgeMagnitudes(const cv::Mat &gray)
{
  std::vector<float> values;
  if (gray.rows < 2) {
    return values;
  }
  const Matrix spectra = rowSpectra(verticalEdges(gray), kFrequencies).magnitudes();
  const auto rows = static_cast<int>(spectra.rows());
  for (int top = 0; top < rows; top += kBandRows) {
    const Eigen::RowVectorXf band = bandSpectrum(spectra, top, std::min(rows, top + kBandRows));
    values.insert(values.end(), band.begin(), band.end());
  }
  return values;
}

std::vector<float> edgeBytes(const cv::Mat &gray)
{
  std::vector<float> values;
  if (gray.rows <= kByteBands) {
    values.resize(static_cast<std::size_t>(kByteBands) * kByteFrequencies, 0.0F);
    return values;
  }
  const Matrix spectra = rowSpectra(verticalEdges(gray), kByteFrequencies).magnitudes();
  const auto rows = static_cast<int>(spectra.rows());
  for (int i = 0; i < kByteBands; ++i) {
    const Eigen::RowVectorXf band =
        bandSpectrum(spectra, i * rows / kByteBands, (i + 1) * rows / kByteBands);
    std::transform(band.begin(), band.end(), std::back_inserter(values),
                   [](float value) { return std::round(255.0F * value); });
  }
  return values;
}

std::vector<float> alignedEdges(const cv::Mat &gray)
{
  constexpr auto kWaves = static_cast<int>(kTurnFrequencies);
  std::vector<float> values;
  if (gray.rows <= kByteBands) {
    values.resize(std::size_t{4} * kByteBands * kTurnFrequencies, 0.0F);
    return values;
  }
  const Spectra spectra = rowSpectra(edgesByBand(verticalEdges(gray)), kWaves + 1);
  for (Eigen::Index band = 0; band < spectra.real.rows(); ++band) {
    Eigen::RowVectorXf row(2 * kWaves);
    row << spectra.real.row(band).tail(kWaves), spectra.imaginary.row(band).tail(kWaves);
    row.stableNormalize();
    values.insert(values.end(), row.begin(), row.end());
  }
  return values;
}

std::vector<float> alignedBytes(const cv::Mat &gray)
{
  constexpr float kScale = 180.0F; // no number of a band of length 1 is larger than 0.7 or so
  constexpr float kLargest = 127.0F;
  std::vector<float> values = alignedEdges(gray);
  for (float &value : values) {
    value = kZeroByte + std::round(std::clamp(kScale * value, -kLargest, kLargest));
  }
  return values;
}

} // namespace homeward
