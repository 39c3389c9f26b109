// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_views.h"
#include "omnidir.h"
#include "test_paths.h"

#include <homeward/calib/calibration.h>

#include <gtest/gtest.h>

#include <iostream>

namespace homeward
{
namespace
{

/** Seven views of a real mirror camera, corners as stock OpenCV's sample found them. */
class RealViews : public testing::Test
{
protected:
  void SetUp() override
  {
    HOMEWARD_NEEDS_OUTSIDE_DATA("calibration/mirror_corners.csv");
    views = readCorners(outsideDataDir() / "calibration/mirror_corners.csv", 1280, 960);
  }

  BoardViews views;
};

TEST_F(RealViews, FitNoWorseThanStockOpencv)
{
  const StockCalibration stock = calibrateWithOpencv(views);
  const Calibration ours = calibrate(views);
  std::cout << "pixels: stock " << stock.rms << ", ours robust " << ours.robustRms
            << ", with outliers " << ours.rms << ", held out " << *ours.heldoutRms << ", outliers "
            << ours.outliers << "\n";
  EXPECT_EQ(stock.views, 7);
  EXPECT_LE(ours.robustRms, stock.rms);
  // All points together are what stock OpenCV minimises; believing fewer costs little there.
  EXPECT_LE(ours.rms, 1.05 * stock.rms);
  EXPECT_LE(ours.outliers, 8);
  EXPECT_NEAR(ours.model->parameters()[0], stock.xi, 0.1);
  EXPECT_NEAR(ours.model->parameters()[3], stock.K(0, 2), 1.5);
}

TEST_F(RealViews, AViewLeftOutFitsAsTheOthersDo)
{
  const Calibration ours = calibrate(views);
  EXPECT_LE(*ours.heldoutRms, 1.15 * ours.robustRms);
  for (const CalibratedView &view : ours.views) {
    EXPECT_GE(*view.heldoutRms, 0.99 * view.rms);
    EXPECT_LE(*view.heldoutRms, 1.5 * view.rms);
  }
}

TEST_F(RealViews, EveryModelFits)
{
  for (const char *model : {"extended_unified", "double_sphere", "kannala_brandt", "ocam"}) {
    CalibrationOptions options;
    options.model = model;
    const Calibration ours = calibrate(views, options);
    std::cout << model << ": " << ours.robustRms << " pixels, held out " << *ours.heldoutRms
              << "\n";
    EXPECT_EQ(ours.model->name(), model);
    EXPECT_LT(ours.robustRms, 2.5) << model;
    EXPECT_LT(*ours.heldoutRms, 1.5 * ours.robustRms) << model;
  }
}

} // namespace
} // namespace homeward
