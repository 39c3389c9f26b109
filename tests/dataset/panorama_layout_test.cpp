// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/dataset/panorama_layout.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>

namespace homeward
{
namespace
{

using Projection = PanoramaLayout::Projection;
using Columns = PanoramaLayout::Columns;

/** A smooth scene by direction. */
double scene(double azimuth, double elevation)
{
  return 128.0 + 50.0 * std::sin(azimuth) + 25.0 * std::cos(3.0 * azimuth) + 60.0 * elevation;
}

/** What a camera of that layout takes of the scene; the layout's formulas turned round. */
cv::Mat take(const PanoramaLayout &layout, const cv::Size &size)
{
  cv::Mat picture(size, CV_8UC1);
  const double sign = layout.columns == Columns::Clockwise ? -1.0 : 1.0;
  const double top = std::tan(layout.elevationMax);
  const double bottom = std::tan(layout.elevationMin);
  for (int v = 0; v < size.height; ++v) {
    const double share = (v + 0.5) / size.height;
    const double elevation =
        layout.projection == Projection::Cylindrical
            ? std::atan(top + share * (bottom - top))
            : layout.elevationMax + share * (layout.elevationMin - layout.elevationMax);
    for (int u = 0; u < size.width; ++u) {
      const double azimuth = sign * (u - layout.forwardColumn) * 2.0 * kPi / size.width;
      picture.at<unsigned char>(v, u) = cv::saturate_cast<unsigned char>(scene(azimuth, elevation));
    }
  }
  return picture;
}

TEST(PanoramaLayout, whateverTheLayoutThePanoramaShowsTheScene)
{
  for (const Projection projection : {Projection::Equirectangular, Projection::Cylindrical}) {
    for (const Columns columns : {Columns::Clockwise, Columns::CounterClockwise}) {
      for (const double forward : {-0.5, 0.0, 77.25, 179.5, 359.0}) {
        const PanoramaLayout layout{projection, columns, radians(-50.0), radians(40.0), forward};
        const Panorama panorama = toPanorama(take(layout, {360, 120}), layout);
        const PanoramaGeometry &geometry = panorama.geometry;
        double worst = 0.0;
        for (int v = 1; v < geometry.height - 1; ++v) {
          for (int u = 0; u < geometry.width; ++u) {
            worst = std::max(worst, std::abs(panorama.image.at<unsigned char>(v, u) -
                                             scene(geometry.azimuth(u), geometry.elevation(v))));
          }
        }
        EXPECT_LT(worst, 2.5) << "forward column " << forward;
      }
    }
  }
}

TEST(PanoramaLayout, ourOwnPanoramasPassUntouched)
{
  const PanoramaGeometry geometry;
  cv::Mat picture(geometry.height, geometry.width, CV_8UC1);
  cv::randu(picture, 0, 256);
  const Panorama panorama = toPanorama(picture, layoutOf(geometry));
  EXPECT_EQ(panorama.geometry, geometry);
  EXPECT_EQ(cv::countNonZero(panorama.image != picture), 0);
}

TEST(PanoramaLayout, itsTextIsReadBack)
{
  const PanoramaLayout layout{Projection::Cylindrical, Columns::CounterClockwise, radians(-33.3),
                              radians(21.7), 12.125};
  const PanoramaLayout back = parsePanoramaLayout(formatPanoramaLayout(layout), "text");
  EXPECT_EQ(back.projection, layout.projection);
  EXPECT_EQ(back.columns, layout.columns);
  EXPECT_DOUBLE_EQ(back.elevationMin, layout.elevationMin);
  EXPECT_DOUBLE_EQ(back.elevationMax, layout.elevationMax);
  EXPECT_EQ(back.forwardColumn, layout.forwardColumn);
}

} // namespace
} // namespace homeward
