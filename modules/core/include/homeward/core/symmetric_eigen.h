// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace homeward
{

/** Eigenvalues in ascending order; column i is the unit eigenvector of values[i]. */
struct SymmetricEigen
{
  Eigen::VectorXd values;  ///< rising
  Eigen::MatrixXd vectors; ///< a column each, of length 1
};

/** Of a symmetric matrix. Not a template, for Eigen's solver takes seconds to compile. */
SymmetricEigen symmetricEigen(const Eigen::MatrixXd &matrix);

} // namespace homeward
