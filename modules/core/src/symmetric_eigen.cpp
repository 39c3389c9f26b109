// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/symmetric_eigen.h>

#include <Eigen/Eigenvalues>

namespace homeward
{

SymmetricEigen symmetricEigen(const Eigen::MatrixXd &matrix)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

} // namespace homeward
