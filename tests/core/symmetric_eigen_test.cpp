// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/symmetric_eigen.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

TEST(SymmetricEigen, ValuesAscendAndTheirVectorsRebuildTheMatrix)
{
  Eigen::MatrixXd matrix(3, 3);
  matrix << 2.0, -1.0, 0.5, //
      -1.0, 3.0, 0.25,      //
      0.5, 0.25, -1.0;
  const SymmetricEigen eigen = symmetricEigen(matrix);
  EXPECT_LT(eigen.values(0), eigen.values(1));
  EXPECT_LT(eigen.values(1), eigen.values(2));
  const Eigen::MatrixXd rebuilt =
      eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose();
  EXPECT_LT((rebuilt - matrix).norm(), 1e-12);
  EXPECT_LT((eigen.vectors.transpose() * eigen.vectors - Eigen::Matrix3d::Identity()).norm(),
            1e-12);
}

} // namespace
} // namespace homeward
