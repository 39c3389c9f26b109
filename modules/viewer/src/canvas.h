// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>
#include <vector>

namespace homeward
{

struct Colour
{
  unsigned char r = 0;
  unsigned char g = 0;
  unsigned char b = 0;
};

/** How a shape looks; without a colour that part is not drawn. */
struct Style
{
  std::optional<Colour> fill = std::nullopt;
  std::optional<Colour> stroke = std::nullopt;
  double width = 1.0; ///< of the stroke, pixels
};

enum class Anchor
{
  Left,
  Middle,
  Right
};

using Point = Eigen::Vector2d; ///< pixels from the upper left corner, y down

/** Something to draw on. Later shapes cover earlier ones. */
class Canvas
{
public:
  virtual ~Canvas() = default;

  virtual void line(const std::vector<Point> &points, const Style &style) = 0;
  virtual void polygon(const std::vector<Point> &points, const Style &style) = 0;
  virtual void circle(const Point &centre, double radius, const Style &style) = 0;
  /** @param at left end, middle or right end of the text's base line; size: height of a capital */
  virtual void text(const Point &at, const std::string &words, double size, Colour colour,
                    Anchor anchor) = 0;
  /** @param picture CV_8UC3 BGR, stretched to `size` pixels */
  virtual void image(const cv::Mat &picture, const Point &corner, const Point &size) = 0;

protected:
  Canvas() = default;
  Canvas(const Canvas &) = default;
  Canvas &operator=(const Canvas &) = default;
};

/** Draws into SVG text. */
class SvgCanvas : public Canvas
{
public:
  /** Sizes in pixels. */
  SvgCanvas(int width, int height);

  void line(const std::vector<Point> &points, const Style &style) override;
  void polygon(const std::vector<Point> &points, const Style &style) override;
  void circle(const Point &centre, double radius, const Style &style) override;
  void text(const Point &at, const std::string &words, double size, Colour colour,
            Anchor anchor) override;
  void image(const cv::Mat &picture, const Point &corner, const Point &size) override;

  std::string svg() const { return m_svg + "</svg>\n"; }

private:
  std::string m_svg;
};

/** Draws into a picture, finer than asked for and averaged at the end. */
class RasterCanvas : public Canvas
{
public:
  /** Sizes in pixels. */
  RasterCanvas(int width, int height);

  void line(const std::vector<Point> &points, const Style &style) override;
  void polygon(const std::vector<Point> &points, const Style &style) override;
  void circle(const Point &centre, double radius, const Style &style) override;
  void text(const Point &at, const std::string &words, double size, Colour colour,
            Anchor anchor) override;
  void image(const cv::Mat &picture, const Point &corner, const Point &size) override;

  /** CV_8UC3 BGR. */
  cv::Mat picture() const;

private:
  cv::Size m_size;
  cv::Mat m_fine;
};

} // namespace homeward
