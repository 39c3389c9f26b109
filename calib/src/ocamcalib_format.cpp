// SPDX-License-Identifier: GPL-3.0-or-later
#include "format_parts.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace homeward
{
namespace
{

/** The numbers of a calib_results.txt, block by block. */
class Numbers
{
public:
  Numbers(const std::string &text, const std::string &origin) : m_origin(origin)
  {
    std::istringstream lines(text);
    std::string numbers;
    for (std::string line; std::getline(lines, line);) {
      numbers += line.substr(0, line.find('#')) + "\n";
    }
    m_in.str(numbers);
  }

  double next(const std::string &what)
  {
    double value = 0.0;
    if (!(m_in >> value) || !std::isfinite(value)) {
      throw ConfigError(m_origin + ": " + what +
                        " is missing or no number; an OCamCalib file holds polynomial, inverse "
                        "polynomial, center, affine parameters and image size");
    }
    return value;
  }

  std::vector<double> list(const std::string &what)
  {
    const double count = next("the length of " + what);
    constexpr double kLongest = 40.0;
    if (count < 1.0 || count > kLongest || count != std::floor(count)) {
      throw ConfigError(m_origin + ": the length of " + what + " is " + digits(count) +
                        ", which is no length");
    }
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < static_cast<int>(count); ++i) {
      values.push_back(next(what));
    }
    return values;
  }

private:
  std::istringstream m_in;
  const std::string &m_origin;
};

/** world2cam's polynomial: the radius from atan(z / across) with OCamCalib's z. */
Eigen::VectorXd inversePolynomial(const CameraModel &model)
{
  constexpr Eigen::Index kTerms = 13;
  constexpr Eigen::Index kSamples = 400;
  const Eigen::VectorXd p = model.parameters();
  const Eigen::Vector2d centre = p.tail<2>();
  const double farthest =
      std::max({centre.norm(), (centre - Eigen::Vector2d(model.width(), model.height())).norm(),
                (centre - Eigen::Vector2d(model.width(), 0.0)).norm(),
                (centre - Eigen::Vector2d(0.0, model.height())).norm()});
  std::vector<double> radii;
  std::vector<double> angles;
  for (Eigen::Index i = 1; i <= kSamples; ++i) {
    const double radius = farthest * static_cast<double>(i) / kSamples;
    // Along the columns, where (x, y) is the radius itself.
    const auto ray = model.unproject(centre + radius * Eigen::Vector2d(1.0, p[p.size() - 4]));
    if (ray) {
      radii.push_back(radius);
      angles.push_back(std::atan2(-ray->z(), ray->head<2>().norm()));
    }
  }
  const auto rows = static_cast<Eigen::Index>(radii.size());
  const Eigen::Index terms = std::min(kTerms, std::max<Eigen::Index>(rows / 4, 1));
  Eigen::MatrixXd A(rows, terms);
  Eigen::VectorXd b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    b[i] = radii[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < terms; ++k) {
      A(i, k) = std::pow(angles[static_cast<std::size_t>(i)], static_cast<double>(k));
    }
  }
  return A.colPivHouseholderQr().solve(b);
}

} // namespace

ModelPointer parseOcamcalib(const std::string &text, const std::string &origin)
{
  Numbers in(text, origin);
  const auto polynomial = in.list("the polynomial");
  in.list("the inverse polynomial");
  const double row = in.next("the center's row");
  const double column = in.next("the center's column");
  const double c = in.next("c");
  const double d = in.next("d");
  const double e = in.next("e");
  const double height = in.next("the image's height");
  const double width = in.next("the image's width");
  if (polynomial.size() < 3 || polynomial[1] != 0.0) {
    throw ConfigError(origin + ": the polynomial must have a second coefficient of zero and a "
                               "third one, as OCamCalib's have");
  }
  const auto terms = static_cast<Eigen::Index>(polynomial.size()) - 1;
  Eigen::VectorXd p(terms + 5);
  p[0] = -polynomial[0];
  for (Eigen::Index i = 1; i < terms; ++i) {
    p[i] = -polynomial[static_cast<std::size_t>(i) + 1];
  }
  p.tail<5>() << c, d, e, column, row;
  return modelFrom("ocam", p, sizeOr(width, height, std::nullopt, origin), origin);
}

std::string formatOcamcalib(const CameraModel &model)
{
  if (model.name() != "ocam") {
    cannotHold("OCamCalib", model, "anything");
  }
  const Eigen::VectorXd p = model.parameters();
  const Eigen::Index terms = p.size() - 5;
  std::string out =
      "#polynomial coefficients for the DIRECT mapping function (ocam_model.ss in MATLAB). These "
      "are used by cam2world\n\n" +
      std::to_string(terms + 1) + " " + digits(-p[0]) + " 0";
  for (Eigen::Index i = 1; i < terms; ++i) {
    out.append(1, ' ').append(digits(-p[i]));
  }
  const Eigen::VectorXd inverse = inversePolynomial(model);
  out += "\n\n#polynomial coefficients for the inverse mapping function (ocam_model.invpol in "
         "MATLAB). These are used by world2cam\n\n" +
         std::to_string(inverse.size());
  for (const double coefficient : inverse) {
    out.append(1, ' ').append(digits(coefficient));
  }
  const Eigen::VectorXd affine = p.tail<5>();
  return out + "\n\n#center: \"row\" and \"column\", starting from 0 (C convention)\n\n" +
         digits(affine[4]) + " " + digits(affine[3]) +
         "\n\n#affine parameters \"c\", \"d\", \"e\"\n\n" + digits(affine[0]) + " " +
         digits(affine[1]) + " " + digits(affine[2]) +
         "\n\n#image size: \"height\" and \"width\"\n\n" + std::to_string(model.height()) + " " +
         std::to_string(model.width()) + "\n";
}

} // namespace homeward
