// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

#include <string_view>
#include <vector>

namespace homeward
{

/** What of a panorama is kept to recognise a place, and how two are compared. */
enum class SignatureKind
{
  Jeffrey,             ///< gray histogram of 256 bins, Jeffrey divergence
  ChiSquare,           ///< the same histogram, chi-square
  AbsoluteDifferences, ///< the same histogram, sum of absolute differences
  Fourier,             ///< magnitudes of 30 row-wise frequencies, L1
  EdgeFourier          ///< the same of edges in row bands, cosine distance: survives changed light
};

/** @throw ConfigError naming the known names: jeffrey, chi_square, sad, fourier, edge_fourier */
SignatureKind parseSignatureKind(std::string_view name);

/** The name that parseSignatureKind() reads back. */
std::string_view name(SignatureKind kind);

/** Version of the numbers in a Signature; it changes whenever stored thresholds lose meaning. */
inline constexpr int kSignatureVersion = 1;

/** A place in brief. It does not change when the robot turns on the spot. */
struct Signature
{
  SignatureKind kind = SignatureKind::Jeffrey;
  int pixels = 0;            ///< how many went into it
  std::vector<float> values; ///< counts of 256 gray levels, or magnitudes by row (band), frequency
};

/**
 * The signature of a panorama; colour is turned to 8-bit gray first.
 * @param visible CV_8UC1 of the picture's size, 0 where it shows no scene (Unwarper::visible()), or
 * empty. Rows with a hidden pixel are left out: what hides pixels turns with the robot, the scene
 * does not.
 * @throw LogicError when picture, geometry or mask do not fit
 */
Signature makeSignature(const Panorama &panorama, SignatureKind kind,
                        const cv::Mat &visible = cv::Mat());

/**
 * How unlike two signatures are, >= 0. Per pixel, so that a threshold holds for panoramas of any
 * size; EdgeFourier gives 0 to 1 whatever the size.
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
