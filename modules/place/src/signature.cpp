// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/signature.h>

#include "signature_values.h"

#include <homeward/core/error.h>
#include <homeward/place/histogram.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace homeward
{

namespace
{

using Kind = SignatureKind;
using Distance = SignatureDistance;

constexpr std::array kKinds{
    SignatureTraits{Kind::Jeffrey, "jeffrey", Distance::Jeffrey, true, false, "none"},
    SignatureTraits{Kind::ChiSquare, "chi_square", Distance::ChiSquare, true, false, "none"},
    SignatureTraits{Kind::AbsoluteDifferences, "sad", Distance::L1, true, false, "none"},
    SignatureTraits{Kind::Hellinger, "hellinger", Distance::Hellinger, false, false, "none"},
    SignatureTraits{Kind::Bands, "bands", Distance::L1, true, false, "none"},
    SignatureTraits{Kind::Hsv, "hsv", Distance::Hellinger, false, false, "none"},
    SignatureTraits{Kind::Opponent, "opponent", Distance::Hellinger, false, false,
                    "brightness, but for its four levels"},
    SignatureTraits{Kind::Fourier, "fourier", Distance::L1, true, false, "none"},
    SignatureTraits{Kind::EdgeFourier, "edge_fourier", Distance::Cosine, false, false,
                    "gain, contrast of each band"},
    SignatureTraits{Kind::EdgeBytes, "edge_bytes", Distance::L1, false, true,
                    "gain, contrast of each band"},
    SignatureTraits{Kind::AlignedEdges, "aligned_edges", Distance::TurnCorrelation, false, false,
                    "gain, contrast of each band and of each direction"},
    SignatureTraits{Kind::AlignedBytes, "aligned_bytes", Distance::TurnCorrelation, false, true,
                    "gain, contrast of each band and of each direction"},
    SignatureTraits{Kind::Embedding, "embedding", Distance::Cosine, false, false,
                    "what the network learnt not to mind"},
};

/** The rows that show the scene all round. */
cv::Mat visibleRows(const Panorama &panorama, const cv::Mat &visible)
{
  const cv::Mat &image = panorama.image;
  if (image.empty() || image.cols != panorama.geometry.width ||
      image.rows != panorama.geometry.height ||
      (image.type() != CV_8UC1 && image.type() != CV_8UC3)) {
    throw LogicError("panorama picture must be 8-bit gray or BGR and of its geometry's size, is " +
                     std::to_string(image.cols) + " x " + std::to_string(image.rows) +
                     " of OpenCV type " + std::to_string(image.type()));
  }
  if (visible.empty()) {
    return image;
  }
  if (visible.size() != image.size() || visible.type() != CV_8UC1) {
    throw LogicError("mask of visible pixels must be 8-bit gray and of the picture's size");
  }
  cv::Mat kept;
  for (int row = 0; row < image.rows; ++row) {
    if (cv::countNonZero(visible.row(row)) == visible.cols) {
      kept.push_back(image.row(row));
    }
  }
  if (kept.empty()) {
    throw LogicError("mask of visible pixels leaves no whole row of the panorama");
  }
  return kept;
}

cv::Mat inGray(const cv::Mat &image)
{
  cv::Mat gray = image;
  if (image.type() == CV_8UC3) {
    cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
  }
  return gray;
}

cv::Mat inColour(const cv::Mat &image)
{
  cv::Mat bgr = image;
  if (image.type() == CV_8UC1) {
    cv::cvtColor(image, bgr, cv::COLOR_GRAY2BGR);
  }
  return bgr;
}

std::vector<float> valuesOf(const cv::Mat &image, SignatureKind kind)
{
  switch (kind) {
  case Kind::Bands:
    return bandHistograms(inGray(image));
  case Kind::Hsv:
    return hsvHistogram(inColour(image));
  case Kind::Opponent:
    return opponentHistogram(inColour(image));
  case Kind::Fourier:
    return fourierMagnitudes(inGray(image));
  case Kind::EdgeFourier:
    return edgeMagnitudes(inGray(image));
  case Kind::EdgeBytes:
    return edgeBytes(inGray(image));
  case Kind::AlignedEdges:
    return alignedEdges(inGray(image));
  case Kind::AlignedBytes:
    return alignedBytes(inGray(image));
  case Kind::Embedding:
    throw LogicError("an embedding is made by an EmbeddingNetwork");
  case Kind::Jeffrey:
  case Kind::ChiSquare:
  case Kind::AbsoluteDifferences:
  case Kind::Hellinger:
    break;
  }
  return grayHistogram(inGray(image));
}

/** The spectra themselves. */
std::vector<float> spectraOf(const Signature &signature)
{
  std::vector<float> spectra = signature.values;
  if (traits(signature.kind).bytes) {
    for (float &value : spectra) {
      value -= kZeroByte;
    }
  }
  return spectra;
}

double distanceOf(SignatureDistance distance, const Signature &a, const Signature &b)
{
  switch (distance) {
  case Distance::Jeffrey:
    return jeffreyDivergence(a.values, b.values);
  case Distance::ChiSquare:
    return chiSquare(a.values, b.values);
  case Distance::L1:
    return sumOfAbsoluteDifferences(a.values, b.values);
  case Distance::Hellinger:
    return hellingerDistance(a.values, b.values);
  case Distance::TurnCorrelation:
    return turnCorrelationDistance(spectraOf(a), spectraOf(b));
  case Distance::Cosine:
    break;
  }
  return cosineDistance(a.values, b.values);
}

} // namespace

std::span<const SignatureTraits> signatureKinds()
{
  return std::span(kKinds).first(kKinds.size() - 1);
}

const SignatureTraits &traits(SignatureKind kind)
{
  return kKinds.at(static_cast<std::size_t>(kind));
}

SignatureKind parseSignatureKind(std::string_view name)
{
  std::string known;
  for (const SignatureTraits &candidate : signatureKinds()) {
    if (candidate.name == name) {
      return candidate.kind;
    }
    known += (known.empty() ? "" : ", ") + std::string(candidate.name);
  }
  throw ConfigError("signature '" + std::string(name) + "' is unknown, use one of " + known);
}

std::string_view name(SignatureKind kind)
{
  return traits(kind).name;
}

std::size_t byteSize(const Signature &signature)
{
  return signature.values.size() * (traits(signature.kind).bytes ? 1 : sizeof(float));
}

double dissimilarityUnit(const Signature &signature)
{
  const SignatureTraits &kind = traits(signature.kind);
  if (kind.perPixel) {
    return std::max(1, signature.pixels);
  }
  constexpr double kByteRange = 255.0;
  return kind.bytes && kind.distance != SignatureDistance::TurnCorrelation
             ? kByteRange * static_cast<double>(std::max<std::size_t>(1, signature.values.size()))
             : 1.0;
}

Signature makeSignature(const Panorama &panorama, SignatureKind kind, const cv::Mat &visible)
{
  const cv::Mat image = visibleRows(panorama, visible);
  return {kind, static_cast<int>(image.total()), valuesOf(image, kind)};
}

double dissimilarity(const Signature &a, const Signature &b)
{
  if (a.kind != b.kind || a.pixels != b.pixels || a.values.size() != b.values.size()) {
    throw LogicError("signatures " + std::string(name(a.kind)) + " of " + std::to_string(a.pixels) +
                     " pixels and " + std::string(name(b.kind)) + " of " +
                     std::to_string(b.pixels) + " pixels cannot be compared");
  }
  return distanceOf(traits(a.kind).distance, a, b) / dissimilarityUnit(a);
}

} // namespace homeward
