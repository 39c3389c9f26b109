// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker_fit.h"

#include <homeward/core/angle.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

constexpr int kUnknowns = 11; ///< four corners in x and y, contrast, darkness, blur
constexpr int kBlur = 10;     ///< pixels

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::Matrix<double, kUnknowns, 1>;

/** How much each cell of a row shows at each place of it, the paper on both sides being cells, too.
 */
struct Shares
{
  Matrix value;   ///< place by cell
  Matrix byPlace; ///< derivative
  Matrix byBlur;  ///< derivative
};

/** @param blur Gaussian, in sides of the marker */
Shares sharesOf(const Eigen::VectorXd &places, Eigen::Index cells, double blur)
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Shares shares{Matrix(places.size(), cells), Matrix(places.size(), cells),
                Matrix(places.size(), cells)};
  const auto border = [&](Eigen::Index i) { // left one of a cell
    const double inside = static_cast<double>(i - 1) / static_cast<double>(cells - 2);
    return i == 0 ? -kInfinity : i == cells ? kInfinity : inside;
  };
  for (Eigen::Index place = 0; place < places.size(); ++place) {
    // Of the step up at a border: value and derivatives.
    const auto step = [&](Eigen::Index i) -> Eigen::Vector3d {
      const double away = (places[place] - border(i)) / blur;
      if (std::isinf(away)) {
        return {away > 0.0 ? 1.0 : 0.0, 0.0, 0.0};
      }
      const double density = std::exp(-0.5 * away * away) / std::sqrt(2.0 * kPi) / blur;
      return {0.5 * std::erfc(-away / std::sqrt(2.0)), density, -away * density};
    };
    Eigen::Vector3d left = step(0);
    for (Eigen::Index cell = 0; cell < cells; ++cell) {
      const Eigen::Vector3d right = step(cell + 1);
      const Eigen::Vector3d share = left - right;
      shares.value(place, cell) = share[0];
      shares.byPlace(place, cell) = share[1];
      shares.byBlur(place, cell) = share[2];
      left = right;
    }
  }
  return shares;
}

/** The marker as it should look: from 0, black, to 1; row by column. */
struct Looks
{
  Matrix value;
  Matrix byX;
  Matrix byY;
  Matrix byBlur; ///< pixels
};

/** A marker's surroundings in a picture, and how much its frame is stretched there. */
class MarkerPatch
{
public:
  MarkerPatch(const cv::Mat1b &picture, const MarkerCells &cells, const ToPicture &toPicture)
      : m_toPicture(toPicture), m_paper(Matrix::Ones(cells.rows() + 2, cells.cols() + 2))
  {
    m_paper.block(1, 1, cells.rows(), cells.cols()) = cells;
    constexpr double kAround = 0.7; // cells of paper
    const double margin = kAround / static_cast<double>(cells.rows());
    Eigen::Matrix2d stretch; // pixels a side
    stretch << toPicture({1.0, 0.5}) - toPicture({0.0, 0.5}),
        toPicture({0.5, 1.0}) - toPicture({0.5, 0.0});
    const Eigen::Matrix2d back = stretch.inverse();
    m_blur = back.rowwise().norm();
    m_cell = 1.0 / (m_blur.maxCoeff() * static_cast<double>(cells.rows()));
    const double longer = stretch.colwise().norm().maxCoeff();
    const int samples = std::clamp(static_cast<int>(1.3 * longer), 24, 64);
    m_places.setLinSpaced(samples, -margin, 1.0 + margin);
    m_box = boxIn(picture);
    if (!m_box.empty()) {
      picture(m_box).convertTo(m_sharp, CV_32F);
    }
  }

  bool shows() const { return !m_box.empty() && std::isfinite(m_cell); }

  /** Width of a cell where it is narrowest, pixels. */
  double cell() const { return m_cell; }

  Eigen::Index samples() const { return m_places.size(); }

  /** @param pixels Gaussian, on top of the picture's own */
  void soften(double pixels)
  {
    if (pixels > 0.0) {
      cv::GaussianBlur(m_sharp, m_soft, {}, pixels);
    }
    else {
      m_soft = m_sharp;
    }
  }

  /** How much each corner's move moves a place of the marker. */
  Eigen::Vector4d holds(Eigen::Index row, Eigen::Index column) const
  {
    const double x = m_places[column];
    const double y = m_places[row];
    return {(1.0 - x) * (1.0 - y), x * (1.0 - y), x * y, (1.0 - x) * y};
  }

  /** The picture at the places of a marker whose corners stand elsewhere by `moves`. */
  Matrix seen(const Vector &unknowns) const
  {
    const auto side = static_cast<int>(samples());
    cv::Mat2f map(side, side);
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        const Eigen::Vector2d place(m_places[column], m_places[row]);
        const Eigen::Vector2d pixel = m_toPicture(
            place + Eigen::Matrix<double, 2, 4>(unknowns.head<8>().data()) * holds(row, column));
        map(row, column) = {static_cast<float>(pixel.x() - m_box.x),
                            static_cast<float>(pixel.y() - m_box.y)};
      }
    }
    cv::Mat1f sampled;
    cv::remap(m_soft, sampled, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    return Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
               sampled.ptr<float>(), side, side)
        .cast<double>();
  }

  /** @param blur Gaussian, pixels */
  Looks looks(double blur) const
  {
    const Shares across = sharesOf(m_places, m_paper.cols(), blur * m_blur.x());
    const Shares down = sharesOf(m_places, m_paper.rows(), blur * m_blur.y());
    const Matrix row = m_paper * across.value.transpose();
    const Matrix column = down.value * m_paper;
    return {down.value * row, column * across.byPlace.transpose(), down.byPlace * row,
            m_blur.y() * down.byBlur * row + m_blur.x() * column * across.byBlur.transpose()};
  }

private:
  cv::Rect boxIn(const cv::Mat1b &picture) const
  {
    constexpr int kBorder = 12; // pixels, for blur and moves
    std::vector<cv::Point2f> outline;
    const double first = m_places[0];
    const double last = m_places[samples() - 1];
    for (const Eigen::Index i : {Eigen::Index{0}, samples() / 2, samples() - 1}) {
      for (const Eigen::Vector2d &place :
           {Eigen::Vector2d(m_places[i], first), Eigen::Vector2d(m_places[i], last),
            Eigen::Vector2d(first, m_places[i]), Eigen::Vector2d(last, m_places[i])}) {
        const Eigen::Vector2f pixel = m_toPicture(place).cast<float>();
        outline.emplace_back(pixel.x(), pixel.y());
      }
    }
    const cv::Rect box = cv::boundingRect(outline);
    return (box + cv::Size(2 * kBorder, 2 * kBorder) - cv::Point(kBorder, kBorder)) &
           cv::Rect({}, picture.size());
  }

  const ToPicture &m_toPicture;
  Matrix m_paper;           ///< cells with the white paper round them
  Eigen::Vector2d m_blur;   ///< what a pixel's blur is in x and y, sides of the marker
  double m_cell = 0.0;      ///< pixels
  Eigen::VectorXd m_places; ///< of the samples in x and in y, sides of the marker
  cv::Rect m_box;
  cv::Mat1f m_sharp;
  cv::Mat1f m_soft;
};

/** Contrast and darkness that fit best. */
Eigen::Vector2d levelsOf(const Matrix &seen, const Matrix &looks)
{
  const double mean = looks.mean();
  const double spread = (looks.array() - mean).square().sum();
  const double contrast =
      ((looks.array() - mean) * (seen.array() - seen.mean())).sum() / std::max(spread, 1e-9);
  return {contrast, seen.mean() - contrast * mean};
}

/**
 * Gauss-Newton from `unknowns`. @return what is left unexplained by the corner where most is, as a
 * share of the contrast
 */
double settle(const MarkerPatch &patch, Vector &unknowns)
{
  constexpr int kSteps = 12;
  constexpr double kSharpest = 0.3; // pixels
  constexpr double kRests = 1e-5;   // sides of the marker
  constexpr double kBy = 0.6;       // share in a corner's moves
  Eigen::Array4d squares = Eigen::Array4d::Constant(std::numeric_limits<double>::infinity());
  for (int i = 0; i < kSteps; ++i) {
    const Matrix seen = patch.seen(unknowns);
    const Looks looks = patch.looks(unknowns[kBlur]);
    if (i == 0) {
      unknowns.segment<2>(8) = levelsOf(seen, looks.value);
    }
    const double contrast = unknowns[8];
    Eigen::Matrix<double, kUnknowns, kUnknowns> A =
        Eigen::Matrix<double, kUnknowns, kUnknowns>::Identity() * 1e-9;
    Vector b = Vector::Zero();
    squares.setZero();
    Eigen::Array4d counts = Eigen::Array4d::Constant(1e-9);
    for (Eigen::Index row = 0; row < patch.samples(); ++row) {
      for (Eigen::Index column = 0; column < patch.samples(); ++column) {
        const Eigen::Vector4d holds = patch.holds(row, column);
        const double value = looks.value(row, column);
        const double error = seen(row, column) - contrast * value - unknowns[9];
        Vector J;
        for (int k = 0; k < 4; ++k) {
          J[2 * k] = holds[k] * contrast * looks.byX(row, column);
          J[2 * k + 1] = holds[k] * contrast * looks.byY(row, column);
        }
        J.tail<3>() << -value, -1.0, -contrast * looks.byBlur(row, column);
        A.selfadjointView<Eigen::Lower>().rankUpdate(J);
        b += error * J;
        const Eigen::Array4d by = (holds.array() > kBy).cast<double>();
        squares += by * error * error;
        counts += by;
      }
    }
    squares /= counts * contrast * contrast;
    const Vector step = A.selfadjointView<Eigen::Lower>().ldlt().solve(b);
    if (!step.allFinite() || !(contrast > 0.0)) {
      return std::numeric_limits<double>::infinity();
    }
    unknowns -= step;
    unknowns[kBlur] = std::clamp(unknowns[kBlur], kSharpest, 2.0 * patch.cell() + 1.0);
    if (step.head<8>().norm() < kRests) {
      break;
    }
  }
  return std::sqrt(squares.maxCoeff());
}

} // namespace

std::optional<std::array<Eigen::Vector2d, 4>>
fitMarker(const cv::Mat1b &picture, const MarkerCells &cells, const ToPicture &toPicture)
{
  constexpr double kLeastContrast = 12.0; // gray levels
  constexpr double kMostRest = 0.25;      // of the contrast
  constexpr double kFarthest = 0.15;      // sides of the marker
  constexpr double kOwnBlur = 0.5;        // of the picture, pixels
  MarkerPatch patch(picture, cells, toPicture);
  if (!patch.shows()) {
    return std::nullopt;
  }
  Vector unknowns = Vector::Zero();
  double rest = 0.0;
  // First so soft that half a cell is no way; then a little, against jagged edges.
  for (const double soft : {std::max(1.0, 0.3 * patch.cell()), 0.0}) {
    patch.soften(soft);
    unknowns[kBlur] = std::hypot(soft, kOwnBlur);
    rest = settle(patch, unknowns);
  }
  const Eigen::Matrix<double, 2, 4> moves(unknowns.data());
  if (!(rest < kMostRest) || unknowns[8] < kLeastContrast ||
      !(moves.cwiseAbs().maxCoeff() < kFarthest)) {
    return std::nullopt;
  }
  const std::array<Eigen::Vector2d, 4> corners{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}};
  std::array<Eigen::Vector2d, 4> result;
  for (std::size_t k = 0; k < 4; ++k) {
    result[k] = toPicture(corners[k] + moves.col(static_cast<Eigen::Index>(k)));
  }
  return result;
}

} // namespace homeward
