// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/signature.h>

#include <homeward/core/error.h>
#include <homeward/place/histogram.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace homeward
{

namespace
{

constexpr int kFrequencies = 30;
constexpr int kGrayLevels = 256;
/** Rows of edges that share one spectrum; more tolerate more displacement and tell less. */
constexpr int kBandRows = 8;
/** Added to gray levels before the logarithm. */
constexpr double kDarkLevel = 4.0;

constexpr std::array<std::pair<std::string_view, SignatureKind>, 5> kNames{{
    {"jeffrey", SignatureKind::Jeffrey},
    {"chi_square", SignatureKind::ChiSquare},
    {"sad", SignatureKind::AbsoluteDifferences},
    {"fourier", SignatureKind::Fourier},
    {"edge_fourier", SignatureKind::EdgeFourier},
}};

/** The rows that show the scene all round, in gray. */
cv::Mat visibleGray(const Panorama &panorama, const cv::Mat &visible)
{
  const cv::Mat &image = panorama.image;
  if (image.empty() || image.cols != panorama.geometry.width ||
      image.rows != panorama.geometry.height ||
      (image.type() != CV_8UC1 && image.type() != CV_8UC3)) {
    throw LogicError("panorama picture must be 8-bit gray or BGR and of its geometry's size, is " +
                     std::to_string(image.cols) + " x " + std::to_string(image.rows) +
                     " of OpenCV type " + std::to_string(image.type()));
  }
  cv::Mat gray = image;
  if (image.type() == CV_8UC3) {
    cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
  }
  if (visible.empty()) {
    return gray;
  }
  if (visible.size() != image.size() || visible.type() != CV_8UC1) {
    throw LogicError("mask of visible pixels must be 8-bit gray and of the picture's size");
  }
  cv::Mat kept;
  for (int row = 0; row < gray.rows; ++row) {
    if (cv::countNonZero(visible.row(row)) == visible.cols) {
      kept.push_back(gray.row(row));
    }
  }
  return kept;
}

std::vector<float> histogram(const cv::Mat &gray)
{
  std::vector<float> counts(kGrayLevels, 0.0F);
  for (int row = 0; row < gray.rows; ++row) {
    const auto *pixels = gray.ptr<std::uint8_t>(row);
    for (int u = 0; u < gray.cols; ++u) {
      counts[pixels[u]] += 1.0F;
    }
  }
  return counts;
}

/** Magnitudes of the lowest frequencies of each row, by row and frequency (0 first). */
cv::Mat rowSpectra(const cv::Mat &rows)
{
  cv::Mat transformed;
  cv::dft(rows, transformed, cv::DFT_ROWS | cv::DFT_COMPLEX_OUTPUT);
  cv::Mat magnitudes = cv::Mat::zeros(rows.rows, kFrequencies, CV_32F);
  for (int row = 0; row < rows.rows; ++row) {
    for (int f = 0; f < std::min(kFrequencies, rows.cols / 2 + 1); ++f) {
      const auto &value = transformed.at<cv::Vec2f>(row, f);
      magnitudes.at<float>(row, f) = std::hypot(value[0], value[1]);
    }
  }
  return magnitudes;
}

/** Signed square roots of the vertical steps of the log intensity. */
cv::Mat verticalEdges(const cv::Mat &gray)
{
  cv::Mat logs;
  gray.convertTo(logs, CV_32F, 1.0, kDarkLevel);
  cv::log(logs, logs);
  cv::Mat steps = logs.rowRange(0, logs.rows - 1) - logs.rowRange(1, logs.rows);
  for (int row = 0; row < steps.rows; ++row) {
    auto *values = steps.ptr<float>(row);
    for (int u = 0; u < steps.cols; ++u) {
      values[u] = std::copysign(std::sqrt(std::abs(values[u])), values[u]);
    }
  }
  return steps;
}

std::vector<float> fourier(const cv::Mat &gray)
{
  cv::Mat rows;
  gray.convertTo(rows, CV_32F);
  const cv::Mat spectra = rowSpectra(rows);
  return {spectra.begin<float>(), spectra.end<float>()};
}

std::vector<float> edgeFourier(const cv::Mat &gray)
{
  if (gray.rows < 2) {
    return {};
  }
  const cv::Mat spectra = rowSpectra(verticalEdges(gray));
  std::vector<float> values;
  for (int top = 0; top < spectra.rows; top += kBandRows) {
    const cv::Mat rows = spectra.rowRange(top, std::min(spectra.rows, top + kBandRows));
    cv::Mat band;
    cv::reduce(rows, band, 0, cv::REDUCE_SUM);
    // Bands count alike, whatever their contrast.
    const double length = cv::norm(band);
    band *= length > 0.0 ? 1.0 / length : 0.0;
    values.insert(values.end(), band.begin<float>(), band.end<float>());
  }
  return values;
}

} // namespace

SignatureKind parseSignatureKind(std::string_view name)
{
  for (const auto &[known, kind] : kNames) {
    if (known == name) {
      return kind;
    }
  }
  throw ConfigError("signature '" + std::string(name) +
                    "' is unknown, use jeffrey, chi_square, sad, fourier or edge_fourier");
}

std::string_view name(SignatureKind kind)
{
  const auto *const found = std::find_if(kNames.begin(), kNames.end(),
                                         [&](const auto &entry) { return entry.second == kind; });
  return found->first;
}

Signature makeSignature(const Panorama &panorama, SignatureKind kind, const cv::Mat &visible)
{
  const cv::Mat gray = visibleGray(panorama, visible);
  if (gray.empty()) {
    throw LogicError("mask of visible pixels leaves no whole row of the panorama");
  }
  Signature signature;
  signature.kind = kind;
  signature.pixels = static_cast<int>(gray.total());
  switch (kind) {
  case SignatureKind::Jeffrey:
  case SignatureKind::ChiSquare:
  case SignatureKind::AbsoluteDifferences:
    signature.values = histogram(gray);
    break;
  case SignatureKind::Fourier:
    signature.values = fourier(gray);
    break;
  case SignatureKind::EdgeFourier:
    signature.values = edgeFourier(gray);
    break;
  }
  return signature;
}

double dissimilarity(const Signature &a, const Signature &b)
{
  if (a.kind != b.kind || a.pixels != b.pixels || a.values.size() != b.values.size()) {
    throw LogicError("signatures " + std::string(name(a.kind)) + " of " + std::to_string(a.pixels) +
                     " pixels and " + std::string(name(b.kind)) + " of " +
                     std::to_string(b.pixels) + " pixels cannot be compared");
  }
  const double pixels = std::max(1, a.pixels);
  switch (a.kind) {
  case SignatureKind::Jeffrey:
    return jeffreyDivergence(a.values, b.values) / pixels;
  case SignatureKind::ChiSquare:
    return chiSquare(a.values, b.values) / pixels;
  case SignatureKind::AbsoluteDifferences:
  case SignatureKind::Fourier:
    return sumOfAbsoluteDifferences(a.values, b.values) / pixels;
  case SignatureKind::EdgeFourier:
    break;
  }
  return cosineDistance(a.values, b.values);
}

} // namespace homeward
