// SPDX-License-Identifier: GPL-3.0-or-later
#include "canvas.h"

#include <opencv2/imgcodecs.hpp>

#include <array>
#include <charconv>
#include <cmath>

namespace homeward
{

namespace
{

/** A length with two decimals at most; never depends on the locale. */
std::string number(double value)
{
  const double rounded = std::round(value * 100.0) / 100.0 + 0.0;
  std::array<char, 64> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded == 0.0 ? 0.0 : rounded);
  return {buffer.data(), end.ptr};
}

std::string hex(Colour colour)
{
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const unsigned part : {colour.r, colour.g, colour.b}) {
    text += kDigits[part >> 4U];
    text += kDigits[part & 15U];
  }
  return text;
}

std::string look(const Style &style)
{
  std::string text = " fill=\"" + (style.fill ? hex(*style.fill) : "none") + "\"";
  if (style.stroke) {
    text += " stroke=\"" + hex(*style.stroke) + "\" stroke-width=\"" + number(style.width) +
            "\" stroke-linejoin=\"round\" stroke-linecap=\"round\"";
  }
  return text;
}

std::string list(const std::vector<Point> &points)
{
  std::string text;
  for (const Point &point : points) {
    text += text.empty() ? "" : " ";
    text += number(point.x()) + "," + number(point.y());
  }
  return text;
}

std::string escaped(const std::string &words)
{
  std::string text;
  for (const char c : words) {
    if (c == '<') {
      text += "&lt;";
    }
    else if (c == '&') {
      text += "&amp;";
    }
    else {
      text += c;
    }
  }
  return text;
}

std::string base64(const std::vector<unsigned char> &bytes)
{
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = (group << 8U) | (k < count ? bytes[i + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[(group >> (18U - 6U * k)) & 63U] : '=';
    }
  }
  return text;
}

} // namespace

SvgCanvas::SvgCanvas(int width, int height)
{
  const std::string w = std::to_string(width);
  const std::string h = std::to_string(height);
  m_svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
          "\" viewBox=\"0 0 " + w + " " + h +
          "\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">\n"
          "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
}

void SvgCanvas::line(const std::vector<Point> &points, const Style &style)
{
  if (points.size() < 2) {
    return;
  }
  m_svg += "<polyline points=\"" + list(points) + "\"" +
           look({std::nullopt, style.stroke, style.width}) + "/>\n";
}

void SvgCanvas::polygon(const std::vector<Point> &points, const Style &style)
{
  m_svg += "<polygon points=\"" + list(points) + "\"" + look(style) + "/>\n";
}

void SvgCanvas::circle(const Point &centre, double radius, const Style &style)
{
  m_svg += "<circle cx=\"" + number(centre.x()) + "\" cy=\"" + number(centre.y()) + "\" r=\"" +
           number(radius) + "\"" + look(style) + "/>\n";
}

void SvgCanvas::text(const Point &at, const std::string &words, double size, Colour colour,
                     Anchor anchor)
{
  constexpr double kEmPerCapital = 1.37; // of DejaVu Sans
  const std::string place = anchor == Anchor::Left     ? "start"
                            : anchor == Anchor::Middle ? "middle"
                                                       : "end";
  m_svg += "<text x=\"" + number(at.x()) + "\" y=\"" + number(at.y()) + "\" font-size=\"" +
           number(size * kEmPerCapital) + "\" fill=\"" + hex(colour) + "\" text-anchor=\"" + place +
           "\">" + escaped(words) + "</text>\n";
}

void SvgCanvas::image(const cv::Mat &picture, const Point &corner, const Point &size)
{
  std::vector<unsigned char> png;
  cv::imencode(".png", picture, png);
  m_svg += "<image x=\"" + number(corner.x()) + "\" y=\"" + number(corner.y()) + "\" width=\"" +
           number(size.x()) + "\" height=\"" + number(size.y()) +
           "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," + base64(png) + "\"/>\n";
}

} // namespace homeward
