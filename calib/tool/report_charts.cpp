// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_charts.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace homeward
{
namespace
{

constexpr double kChartWidth = 640.0;

std::string base64(const std::vector<uchar> &bytes)
{
  constexpr const char *kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    unsigned int word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8U | (k < left ? bytes[i + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= left ? kDigits[word >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

std::string openSvg(double width, double height, const std::string &label)
{
  return "<svg viewBox=\"0 0 " + fixed(width, 0) + " " + fixed(height, 0) +
         "\" role=\"img\" aria-label=\"" + label + "\">";
}

std::string textAt(double x, double y, const std::string &text, const std::string &anchor = "start")
{
  return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" text-anchor=\"" + anchor +
         "\">" + text + "</text>";
}

std::string line(const Eigen::Vector2d &from, const Eigen::Vector2d &to, const std::string &style)
{
  return "<line x1=\"" + fixed(from.x(), 1) + "\" y1=\"" + fixed(from.y(), 1) + "\" x2=\"" +
         fixed(to.x(), 1) + "\" y2=\"" + fixed(to.y(), 1) + "\" " + style + "/>";
}

std::string dot(const Eigen::Vector2d &at, double radius, const std::string &style)
{
  return "<circle cx=\"" + fixed(at.x(), 1) + "\" cy=\"" + fixed(at.y(), 1) + "\" r=\"" +
         fixed(radius, 1) + "\" " + style + "/>";
}

std::string stroke(const char *colour, double width)
{
  return std::string("fill=\"none\" stroke=\"") + colour + "\" stroke-width=\"" + fixed(width, 1) +
         "\"";
}

std::string fill(const char *colour)
{
  return std::string("fill=\"") + colour + "\"";
}

/** The frame of the picture, and the mirror's circles in it. */
std::string outline(const ReportContent &content, double scale)
{
  std::string svg = "<rect width=\"" + fixed(content.views.width * scale, 1) + "\" height=\"" +
                    fixed(content.views.height * scale, 1) + "\" " + stroke(kGray, 1.0) + "/>";
  if (content.mirror) {
    for (const Circle &circle : {content.mirror->inner, content.mirror->outer}) {
      svg += dot(circle.centre * scale, circle.radius * scale,
                 stroke(kGray, 1.0) + " stroke-dasharray=\"4 3\"");
    }
  }
  return svg;
}

/** A round number near `value`: 1, 2 or 5 times a power of ten. */
double roundNumber(double value)
{
  const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-9))));
  const double share = value / power;
  return power * (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0);
}

} // namespace

std::string fixed(double value, int places)
{
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", places, value);
  return text.data();
}

std::string dataUri(const cv::Mat &picture, int width)
{
  cv::Mat small = picture;
  if (picture.cols > width) {
    const double scale = static_cast<double>(width) / picture.cols;
    cv::resize(picture, small, {}, scale, scale, cv::INTER_AREA);
  }
  std::vector<uchar> bytes;
  cv::imencode(".jpg", small, bytes, {cv::IMWRITE_JPEG_QUALITY, 80});
  return "data:image/jpeg;base64," + base64(bytes);
}

std::string residualChart(const ReportContent &content)
{
  const double scale = kChartWidth / content.views.width;
  const double height = content.views.height * scale;
  const double typical = std::max(content.calibration.robustRms, 1e-6);
  const double gain = 14.0 / typical; // chart pixels a pixel
  std::string svg = openSvg(kChartWidth, height + 34.0, "Residuals as arrows");
  svg += outline(content, scale);
  for (std::size_t i = 0; i < content.views.views.size(); ++i) {
    const CalibratedView &view = content.calibration.views[i];
    for (std::size_t k = 0; k < view.residuals.size(); ++k) {
      const Eigen::Vector2d at = content.views.views[i].pixels[k] * scale;
      if (!view.residuals[k].allFinite() || view.outliers[k]) {
        svg += line(at - Eigen::Vector2d(4, 4), at + Eigen::Vector2d(4, 4), stroke(kVermilion, 2));
        svg +=
            line(at - Eigen::Vector2d(4, -4), at + Eigen::Vector2d(4, -4), stroke(kVermilion, 2));
        continue;
      }
      svg += dot(at, 1.2, fill(kBlue));
      svg += line(at, at + gain * view.residuals[k], stroke(kBlue, 1.0));
    }
  }
  const double unit = roundNumber(2.0 * typical);
  const double base = height + 22.0;
  svg += dot({8.0, base - 4.0}, 1.2, fill(kBlue)) +
         line({8.0, base - 4.0}, {8.0 + gain * unit, base - 4.0}, stroke(kBlue, 1.5)) +
         textAt(14.0 + gain * unit, base,
                fixed(unit, unit < 0.1 ? 2 : 1) + " px, seen minus predicted");
  svg += line({380, base - 8}, {388, base}, stroke(kVermilion, 2)) +
         line({380, base}, {388, base - 8}, stroke(kVermilion, 2)) +
         textAt(396.0, base, std::to_string(content.calibration.outliers) + " outliers, not used");
  return svg + "</svg>";
}

std::string histogramChart(const ReportContent &content)
{
  constexpr int kBins = 31;
  constexpr double kHeight = 220.0;
  const double range = 4.0 * std::max(content.calibration.robustRms, 1e-6);
  std::array<std::array<int, kBins>, 2> counts{};
  int most = 1;
  for (const CalibratedView &view : content.calibration.views) {
    for (std::size_t k = 0; k < view.residuals.size(); ++k) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double value = view.residuals[k][static_cast<Eigen::Index>(axis)];
        if (std::isfinite(value) && !view.outliers[k]) {
          const auto bin = static_cast<int>((value / range + 1.0) / 2.0 * kBins);
          most = std::max(most,
                          ++counts[axis][static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1))]);
        }
      }
    }
  }
  std::string svg = openSvg(kChartWidth, kHeight + 62.0, "Histogram of the residuals");
  constexpr double kLeft = 44.0;
  const double step = (kChartWidth - kLeft - 10.0) / kBins;
  for (std::size_t i = 0; i < kBins; ++i) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double bar = kHeight * counts[axis][i] / most;
      svg +=
          "<rect x=\"" +
          fixed(kLeft + (static_cast<double>(i) + 0.06 + 0.44 * static_cast<double>(axis)) * step,
                1) +
          "\" y=\"" + fixed(10.0 + kHeight - bar, 1) + "\" width=\"" + fixed(0.44 * step, 1) +
          "\" height=\"" + fixed(bar, 1) + "\" " + fill(axis == 0 ? kBlue : kVermilion) + "/>";
    }
  }
  const double floor = 10.0 + kHeight;
  svg += line({kLeft, floor}, {kChartWidth - 10.0, floor}, stroke(kGray, 1.0));
  svg += textAt(kLeft - 6.0, 20.0, std::to_string(most), "end") +
         textAt(kLeft - 6.0, floor, "0", "end");
  for (const int tick : {-4, -2, 0, 2, 4}) {
    const double x = kLeft + (tick / 8.0 + 0.5) * step * kBins;
    svg += textAt(x, floor + 18.0, fixed(tick * range / 4.0, 3) + (tick == 4 ? " px" : ""),
                  tick == 4 ? "end" : "middle");
  }
  svg += "<rect x=\"60\" y=\"" + fixed(floor + 32.0, 1) + "\" width=\"12\" height=\"12\" " +
         fill(kBlue) + "/>" + textAt(78.0, floor + 43.0, "along the columns (u)") +
         "<rect x=\"270\" y=\"" + fixed(floor + 32.0, 1) + "\" width=\"12\" height=\"12\" " +
         fill(kVermilion) + "/>" + textAt(288.0, floor + 43.0, "along the rows (v)");
  return svg + "</svg>";
}

std::string coverageChart(const ReportContent &content)
{
  const double scale = kChartWidth / content.views.width;
  const double height = content.views.height * scale;
  std::string svg = openSvg(kChartWidth, height + 34.0, "Where points were seen");
  svg += outline(content, scale);
  std::size_t points = 0;
  for (const BoardView &view : content.views.views) {
    points += view.pixels.size();
    for (const Eigen::Vector2d &pixel : view.pixels) {
      svg += dot(pixel * scale, 2.2, fill(kBlue) + " fill-opacity=\"0.5\"");
    }
  }
  svg += dot({8.0, height + 18.0}, 3.0, fill(kBlue)) +
         textAt(18.0, height + 22.0, std::to_string(points) + " points") +
         line({150.0, height + 18.0}, {180.0, height + 18.0},
              stroke(kGray, 1.0) + " stroke-dasharray=\"4 3\"") +
         textAt(188.0, height + 22.0, "the mirror's circles");
  return svg + "</svg>";
}

std::string pointsPicture(const ReportContent &content, std::size_t view)
{
  const double scale = kChartWidth / content.views.width;
  std::string svg = openSvg(kChartWidth, content.views.height * scale, "Points found");
  svg += "<image width=\"" + fixed(kChartWidth, 0) + "\" height=\"" +
         fixed(content.views.height * scale, 1) + "\" href=\"" +
         dataUri(content.pictures[view], static_cast<int>(kChartWidth)) + "\"/>";
  const BoardView &board = content.views.views[view];
  for (std::size_t k = 0; k < board.pixels.size(); ++k) {
    const bool outlier = content.calibration.views[view].outliers[k];
    svg += dot(board.pixels[k] * scale, 2.5, stroke(outlier ? kVermilion : "#56B4E9", 1.4));
  }
  return svg + "</svg>";
}

} // namespace homeward
