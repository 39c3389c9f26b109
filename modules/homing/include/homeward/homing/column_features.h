// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

#include <cstdint>
#include <vector>

namespace homeward
{

/** How a panorama becomes columns that compare well across light changes. */
struct ColumnFeatureOptions
{
  int columns = 144;               ///< round the full turn; even, 8 to 360
  int rows = 80;                   ///< edge values in a column, 8 to 512
  int magnifications = 5;          ///< magnified versions, the first is the picture itself
  double magnificationStep = 1.19; ///< factor from one version to the next, > 1
  double darkLevel = 4.0;          ///< added to intensities (0 to 255) before the logarithm
  double blankContrast = 0.02;     ///< a column with a smaller mean root of edge strength is blank

  friend bool operator==(const ColumnFeatureOptions &a, const ColumnFeatureOptions &b)
  {
    return a.columns == b.columns && a.rows == b.rows && a.magnifications == b.magnifications &&
           a.magnificationStep == b.magnificationStep && a.darkLevel == b.darkLevel &&
           a.blankContrast == b.blankContrast;
  }
};

/**
 * Edge columns of one panorama at several magnifications about the horizon.
 *
 * log intensity -> vertical first difference -> signed square root -> L1 norm of each column. The
 * values are bytes, 128 + kColumnUnit * (value / mean magnitude), saturated. In a version magnified
 * by s, elevation e shows what stands at atan(tan(e) / s). \cite Moeller2010
 */
struct ColumnFeatures
{
  ColumnFeatureOptions options; ///< they were made with
  /** versions[m][i * rows + r]: column i at azimuth +2 pi i / columns, row 0 on top. */
  std::vector<std::vector<std::uint8_t>> versions;
  double texturedShare = 0.0; ///< share of columns that are not blank
};

/** Byte steps of the mean magnitude of a column. */
inline constexpr int kColumnUnit = 24;

/** @throw LogicError when a value is out of the range its comment states */
void checkColumnFeatureOptions(const ColumnFeatureOptions &options);

/**
 * @throw LogicError for an empty picture, a wrong type or size, a panorama without the horizon, or
 * options out of range
 */
ColumnFeatures makeColumnFeatures(const Panorama &panorama, const ColumnFeatureOptions &options);

} // namespace homeward
