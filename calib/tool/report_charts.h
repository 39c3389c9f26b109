// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "report.h"

#include <string>

namespace homeward
{

// SVG pictures of a calibration. Colours are Okabe and Ito's, told apart by the colour-blind.
inline constexpr const char *kBlue = "#0072B2";
inline constexpr const char *kVermilion = "#D55E00";
inline constexpr const char *kGray = "#777777";

/** printf("%.*f"). */
std::string fixed(double value, int places);

/** A picture, at most `width` pixels wide, as a data URI (JPEG). */
std::string dataUri(const cv::Mat &picture, int width);

/** Where in the picture the points lie, and their residuals as arrows. */
std::string residualChart(const ReportContent &content);

/** How often which residual occurs, along both axes of the picture. */
std::string histogramChart(const ReportContent &content);

/** All points over the mirror, and the sectors that have none. */
std::string coverageChart(const ReportContent &content);

/** A picture with the points found in it. */
std::string pointsPicture(const ReportContent &content, std::size_t view);

} // namespace homeward
