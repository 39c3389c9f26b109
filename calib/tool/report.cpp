// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include "report_charts.h"

#include <homeward/core/angle.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <map>

namespace homeward
{
namespace
{

constexpr const char *kStyle = R"(<style>
body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:1360px;padding:0 1em;color:#222}
h1{font-size:1.5em}h2{font-size:1.15em;margin:1.6em 0 .4em}
table{border-collapse:collapse}td,th{padding:.2em .9em .2em 0;text-align:right;vertical-align:top}
td:first-child,th:first-child{text-align:left}th{border-bottom:1px solid #999}
.charts{display:grid;grid-template-columns:repeat(auto-fit,minmax(540px,1fr));gap:1.6em}
.views{display:grid;grid-template-columns:repeat(auto-fill,minmax(300px,1fr));gap:1em}
figure{margin:0}figcaption{overflow-wrap:anywhere;color:#444;font-size:.9em}
svg,img{width:100%;height:auto;display:block}svg text{font:16px system-ui,sans-serif;fill:#222}
.warning{border-left:4px solid #D55E00;padding:.3em .8em;margin:.4em 0;background:#fdf1e9}
.numbers{display:flex;flex-wrap:wrap;gap:3em}
</style>)";

std::string escaped(const std::string &text)
{
  std::string result;
  for (const char c : text) {
    switch (c) {
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '&':
      result += "&amp;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += c;
    }
  }
  return result;
}

std::string row(const std::string &first, const std::vector<std::string> &rest)
{
  std::string html = "<tr><td>" + first + "</td>";
  for (const std::string &cell : rest) {
    html += "<td>" + cell + "</td>";
  }
  return html + "</tr>\n";
}

std::string parameterTable(const Calibration &calibration)
{
  std::string html = "<table><tr><th>parameter</th><th>value</th><th>1 sigma</th></tr>\n";
  const std::vector<std::string> names = calibration.model->parameterNames();
  const Eigen::VectorXd values = calibration.model->parameters();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const bool pixels = names[i][0] == 'f' || names[i][0] == 'c';
    const int places = pixels ? 3 : 6;
    const bool estimated = i >= calibration.estimated.size() || calibration.estimated[i];
    html += row(escaped(names[i]) + (pixels ? " (px)" : ""),
                {fixed(values(k), places),
                 estimated ? fixed(std::sqrt(calibration.covariance(k, k)), places) : "held"});
  }
  return html + "</table>\n";
}

/** A cell the redder the more a pair of parameters can stand in for each other. */
std::string correlationCell(double correlation)
{
  return "<td style=\"background:rgba(213,94,0," + fixed(0.6 * correlation * correlation, 2) +
         ")\">" + fixed(correlation, 2) + "</td>";
}

std::string correlationTable(const Calibration &calibration)
{
  const std::vector<std::string> names = calibration.model->parameterNames();
  const Eigen::MatrixXd correlations = calibration.correlations();
  std::string head = "<table><tr><th></th>";
  std::string rows;
  for (Eigen::Index i = 0; i < correlations.rows(); ++i) {
    if (correlations(i, i) == 0.0) {
      continue; // held
    }
    const std::string name = escaped(names[static_cast<std::size_t>(i)]);
    head += "<th>" + name + "</th>";
    rows += "<tr><td>" + name + "</td>";
    for (Eigen::Index k = 0; k <= i; ++k) {
      rows += correlations(k, k) == 0.0 ? "" : correlationCell(correlations(i, k));
    }
    rows += "</tr>\n";
  }
  return head + "</tr>\n" + rows + "</table>\n";
}

std::string numbersTable(const ReportContent &content)
{
  const Calibration &calibration = content.calibration;
  std::string html = "<table><tr><th>fit</th><th></th></tr>\n";
  html += row("rms, all points", {fixed(calibration.rms, 3) + " px"});
  html += row("rms, without outliers", {fixed(calibration.robustRms, 3) + " px"});
  if (calibration.heldoutRms) {
    html += row("rms of views left out in turn", {fixed(*calibration.heldoutRms, 3) + " px"});
  }
  html += row("outliers", {std::to_string(calibration.outliers)});
  html += row("views", {std::to_string(content.views.views.size())});
  html += row("pictures without a board", {std::to_string(content.missed.size())});
  html += "<tr><th>before and after</th><th></th></tr>\n";
  html += row("bend of the boards' lines, usual mirror", {fixed(content.bendBefore, 3) + "&deg;"});
  html += row("the same, calibrated", {fixed(content.bendAfter, 3) + "&deg;"});
  return html + "</table>\n";
}

std::string figure(const std::string &title, const std::string &drawing, const std::string &caption)
{
  return "<figure><h2>" + title + "</h2>" + drawing + "<figcaption>" + caption +
         "</figcaption></figure>\n";
}

std::string viewFigures(const ReportContent &content)
{
  std::string html = "<h2>Points found</h2><div class=\"views\">\n";
  for (std::size_t i = 0; i < content.views.views.size(); ++i) {
    const CalibratedView &view = content.calibration.views[i];
    html += "<figure>" + pointsPicture(content, i) + "<figcaption>" +
            escaped(content.views.views[i].name) + ": " +
            std::to_string(content.views.views[i].ids.size()) + " points, rms " +
            fixed(view.rms, 3) + " px" +
            (view.heldoutRms ? ", left out " + fixed(*view.heldoutRms, 3) + " px" : "") +
            "</figcaption></figure>\n";
  }
  return html + "</div>\n";
}

} // namespace

std::string reportHtml(const ReportContent &content)
{
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                     "<title>Camera calibration</title>";
  html += kStyle;
  html += "</head><body>\n<h1>Camera calibration</h1>\n<p>Model " +
          escaped(content.calibration.model->name()) + ", " + std::to_string(content.views.width) +
          " x " + std::to_string(content.views.height) + " pixels; target " +
          escaped(content.target) + ".</p>\n";
  for (const std::string &warning : content.calibration.warnings) {
    html += "<p class=\"warning\">" + escaped(warning) + "</p>\n";
  }
  for (const std::string &missed : content.missed) {
    html += "<p class=\"warning\">No board was found in " + escaped(missed) + ".</p>\n";
  }
  html += "<div class=\"numbers\">" + parameterTable(content.calibration) + numbersTable(content) +
          "</div>\n<div class=\"charts\">\n";
  html += figure("Residuals", residualChart(content),
                 "Arrows that point the same way in one region mean that the model does not fit.");
  html += figure("Coverage", coverageChart(content),
                 "Where no points were seen, the camera is extrapolated.");
  html +=
      figure("Residual histogram", histogramChart(content), "Points a bin; outliers are left out.");
  html += figure("Correlations", correlationTable(content.calibration),
                 "Of a pair near 1 or -1 only a combination is known well, such as the "
                 "ratio of the focal lengths.");
  html += "</div>\n";
  if (!content.panorama.empty()) {
    html += figure("Unwrapped",
                   "<img alt=\"Panorama\" src=\"" + dataUri(content.panorama, 1440) + "\">",
                   "The first picture with the camera found: what is straight and upright in the "
                   "room is upright here.");
  }
  html += viewFigures(content);
  return html + "</body></html>\n";
}

double bendOfBoards(const BoardViews &views, const CameraModel &model)
{
  double sum = 0.0;
  int count = 0;
  for (const BoardView &view : views.views) {
    // Points of one row or one column of the board, by axis and place in micrometres.
    std::map<std::pair<int, long>, std::vector<Eigen::Vector3d>> lines;
    for (std::size_t i = 0; i < view.pixels.size(); ++i) {
      if (const auto ray = model.unproject(view.pixels[i])) {
        for (int axis = 0; axis < 2; ++axis) {
          lines[{axis, std::lround(view.board[i][axis] * 1e6)}].push_back(*ray);
        }
      }
    }
    for (const auto &[place, rays] : lines) {
      if (rays.size() < 4) {
        continue;
      }
      Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
      for (const Eigen::Vector3d &ray : rays) {
        spread += ray * ray.transpose();
      }
      sum += std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues()(0));
      count += static_cast<int>(rays.size());
    }
  }
  return count > 0 ? degrees(std::sqrt(sum / count)) : 0.0;
}

} // namespace homeward
