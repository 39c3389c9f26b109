// SPDX-License-Identifier: GPL-3.0-or-later
#include "target_print.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <array>
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cmath>
#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

constexpr double kPoints = 72.0 / 0.0254; ///< a metre
constexpr double kBorder = 0.006;         ///< metres that printers leave white
constexpr double kCaption = 0.014;        ///< metres for scale and text

struct Paper
{
  const char *name;
  double width;  ///< metres, upright
  double height; ///< metres
};

constexpr std::array<Paper, 6> kPapers{{{"a4", 0.210, 0.297},
                                        {"a3", 0.297, 0.420},
                                        {"a2", 0.420, 0.594},
                                        {"a1", 0.594, 0.841},
                                        {"a0", 0.841, 1.189},
                                        {"letter", 0.2159, 0.2794}}};

std::string millimetres(double metres)
{
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g mm", metres * 1000.0);
  return text.data();
}

/** Width and height of the page: the paper turned as the target needs it. */
Eigen::Vector2d pageSize(const TargetArt &art, const std::string &paper)
{
  const Eigen::Vector2d needed(std::max(art.width, 0.14), art.height + kCaption + kBorder);
  if (paper.empty()) {
    return needed;
  }
  const auto *found =
      std::find_if(kPapers.begin(), kPapers.end(), [&](const Paper &p) { return paper == p.name; });
  if (found == kPapers.end()) {
    throw ConfigError("there is no paper '" + paper + "'; there are a4, a3, a2, a1, a0 and letter");
  }
  const Eigen::Vector2d upright(found->width, found->height);
  for (const Eigen::Vector2d &page : {upright, Eigen::Vector2d(upright.reverse())}) {
    if (needed.x() <= page.x() && needed.y() <= page.y()) {
      return page;
    }
  }
  throw ConfigError("the target with its margin and scale needs " + millimetres(needed.x()) +
                    " by " + millimetres(needed.y()) + "; paper " + paper + " has " +
                    millimetres(upright.x()) + " by " + millimetres(upright.y()) +
                    "; take a smaller pitch, fewer columns or larger paper");
}

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t append(void *text, const unsigned char *data, unsigned int length)
{
  static_cast<std::string *>(text)->append(reinterpret_cast<const char *>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

Surface surfaceFor(TargetPage::Format format, const Eigen::Vector2d &page, std::string &text)
{
  const Eigen::Vector2d points = page * kPoints;
  if (format == TargetPage::Format::Svg) {
    Surface surface(cairo_svg_surface_create_for_stream(append, &text, points.x(), points.y()),
                    &cairo_surface_destroy);
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PT);
    return surface;
  }
  return {cairo_pdf_surface_create_for_stream(append, &text, points.x(), points.y()),
          &cairo_surface_destroy};
}

/** Everything black in one path, so that neighbouring cells show no seams. */
void drawArt(cairo_t *context, const TargetArt &art)
{
  for (const ArtRectangle &r : art.rectangles) {
    cairo_rectangle(context, r.x, r.y, r.width, r.height);
  }
  for (const ArtDisc &disc : art.discs) {
    cairo_new_sub_path(context);
    cairo_arc(context, disc.x, disc.y, disc.radius, 0.0, 2.0 * M_PI);
  }
  cairo_fill(context);
}

/** A scale of 100 mm with the target's name above it. */
void drawCaption(cairo_t *context, const std::string &text)
{
  constexpr double kScale = 0.1;
  constexpr double kTick = 0.002;
  cairo_set_line_width(context, 0.0002);
  for (int i = 0; i <= 10; ++i) {
    const double tick = i % 5 == 0 ? kTick : kTick / 2.0;
    cairo_move_to(context, kScale * i / 10.0, 0.0);
    cairo_rel_line_to(context, 0.0, -tick);
  }
  cairo_move_to(context, 0.0, 0.0);
  cairo_rel_line_to(context, kScale, 0.0);
  cairo_stroke(context);
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, 0.003);
  cairo_move_to(context, 0.0, -0.0035);
  cairo_show_text(context, text.c_str());
  cairo_move_to(context, kScale + 0.002, 0.0);
  cairo_show_text(context, "100 mm");
}

} // namespace

std::string describe(const Target &target)
{
  std::string text = nameOf(target.kind) + " " + std::to_string(target.columns) + " x " +
                     std::to_string(target.rows) + ", pitch " + millimetres(target.pitch);
  if (target.kind == TargetKind::AprilGrid || target.kind == TargetKind::Charuco) {
    text += ", marker " + millimetres(target.markerSide());
  }
  return text;
}

std::string printTarget(const Target &target, const TargetPage &page)
{
  const TargetArt art = drawTarget(target);
  const Eigen::Vector2d size = pageSize(art, page.paper);
  std::string text;
  {
    const Surface surface = surfaceFor(page.format, size, text);
    const Context context(cairo_create(surface.get()), &cairo_destroy);
    cairo_scale(context.get(), kPoints, kPoints);
    cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
    cairo_paint(context.get());
    cairo_set_source_rgb(context.get(), 0.0, 0.0, 0.0);
    cairo_save(context.get());
    cairo_translate(context.get(), (size.x() - art.width) / 2.0,
                    (size.y() - kCaption - art.height) / 2.0);
    drawArt(context.get(), art);
    cairo_restore(context.get());
    cairo_translate(context.get(), 2.0 * kBorder, size.y() - kBorder);
    drawCaption(context.get(), describe(target));
    cairo_surface_finish(surface.get());
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) {
      throw RuntimeError("the target cannot be drawn: " +
                         std::string(cairo_status_to_string(cairo_surface_status(surface.get()))));
    }
  }
  return text;
}

} // namespace homeward
