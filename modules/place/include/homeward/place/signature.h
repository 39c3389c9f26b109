// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace homeward
{

/** What of a panorama is kept to recognise a place, and how two are compared. */
enum class SignatureKind
{
  Jeffrey,             ///< gray histogram of 256 bins, Jeffrey divergence
  ChiSquare,           ///< the same histogram, chi-square
  AbsoluteDifferences, ///< the same histogram, L1
  Hellinger,           ///< the same histogram, Hellinger distance
  Bands,               ///< gray histograms of 32 bins of 8 bands of elevation, L1
  Hsv,                 ///< 16 hues x 4 saturations x 4 values, Hellinger distance
  Opponent,     ///< red-green x yellow-blue (8 x 8, by brightness) x 4 brightnesses, Hellinger
  Fourier,      ///< magnitudes of 30 row-wise frequencies, L1
  EdgeFourier,  ///< the same of edges in row bands, cosine distance: survives changed light
  EdgeBytes,    ///< the same of edges in 16 bands x 16 frequencies of a byte, L1
  AlignedEdges, ///< rising and falling edges in 16 bands x 16 frequencies with their phases, the
                ///< best correlation over all turns: finds a place in any light
  AlignedBytes, ///< the same with each number as a byte, 128 for zero
  Embedding     ///< the output of an EmbeddingNetwork, cosine distance
};

/** How two vectors of values are compared; each has its function in histogram.h. */
enum class SignatureDistance
{
  Jeffrey,
  ChiSquare,
  L1,
  Hellinger,
  Cosine,
  TurnCorrelation
};

/** What is known of a kind before any picture. */
struct SignatureTraits
{
  SignatureKind kind;         ///< of which this is said
  std::string_view name;      ///< as users write it
  SignatureDistance distance; ///< that compares two
  bool perPixel;              ///< the distance grows with the panorama and is divided by its pixels
  bool bytes;                 ///< values are whole numbers, 0 to 255
  std::string_view invariances; ///< what, besides a turn on the spot, does not change it
};

/** Every kind that makeSignature() makes, in the order of the enumeration. */
std::span<const SignatureTraits> signatureKinds();

/** What is known of the kind. */
const SignatureTraits &traits(SignatureKind kind);

/** @throw ConfigError naming the known names */
SignatureKind parseSignatureKind(std::string_view name);

/** The name that parseSignatureKind() reads back. */
std::string_view name(SignatureKind kind);

/** Version of the numbers in a Signature; it changes whenever stored thresholds lose meaning. */
inline constexpr int kSignatureVersion = 1;

/**
 * A place in brief. How unlike another it is does not change when the robot turns on the spot; nor
 * do the values themselves, but for the phases of TurnCorrelation.
 */
struct Signature
{
  SignatureKind kind = SignatureKind::Jeffrey; ///< says what the values are
  int pixels = 0;                              ///< how many went into it
  /**
   * >= 0: counts by bin, or magnitudes by row (band) and frequency. TurnCorrelation: spectra, see
   * turnCorrelationDistance().
   */
  std::vector<float> values;
};

/** Bytes of the values as PlaceIndex keeps them, without its padding. */
std::size_t byteSize(const Signature &signature);

/**
 * The signature of a panorama. Kinds on gray turn colour to 8-bit gray first; kinds on colour take
 * a gray picture as a colourless one.
 * @param visible CV_8UC1 of the picture's size, 0 where it shows no scene (Unwarper::visible()), or
 * empty. Rows with a hidden pixel are left out: what hides pixels turns with the robot, the scene
 * does not.
 * @throw LogicError when picture, geometry or mask do not fit, or for Embedding
 */
Signature makeSignature(const Panorama &panorama, SignatureKind kind,
                        const cv::Mat &visible = cv::Mat());

/**
 * How unlike two signatures are, >= 0. Where SignatureTraits::perPixel it is per pixel, so that a
 * threshold holds for panoramas of any size; the other kinds give 0 to 1 whatever the size.
 * @throw LogicError when the kinds, pixel counts or sizes differ
 */
double dissimilarity(const Signature &a, const Signature &b);

/** Pixels of the panorama on whose counts the published thresholds (400, 500, 600) stand. */
inline constexpr double kReferencePixels = 20000.0;

/** A published threshold on raw counts, as a dissimilarity per pixel. */
constexpr double thresholdPerPixel(double countThreshold)
{
  return countThreshold / kReferencePixels;
}

} // namespace homeward
