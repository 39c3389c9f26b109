// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/formats.h>
#include <homeward/camera/camera_models.h>

#include <gtest/gtest.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/core/vpXmlParserCamera.h>

#include <cstdio>
#include <fstream>

namespace homeward
{
namespace
{

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

/** What ViSP reads from a file that we write. */
vpCameraParameters readByVisp(const CameraModel &model, int type)
{
  const std::string file = testing::TempDir() + "homeward_visp_format_test.xml";
  std::ofstream(file) << formatCamera(model, CameraFormat::Visp);
  vpCameraParameters camera;
  vpXmlParserCamera parser;
  const auto projection = static_cast<vpCameraParameters::vpCameraParametersProjType>(type);
  EXPECT_EQ(parser.parse(camera, file, "Camera", projection, 1280, 960),
            vpXmlParserCamera::SEQUENCE_OK);
  std::remove(file.c_str());
  return camera;
}

void expectSamePixel(const CameraModel &model, const vpCameraParameters &camera)
{
  const double x = 0.4;
  const double y = -0.7;
  double u = 0.0;
  double v = 0.0;
  vpMeterPixelConversion::convertPoint(camera, x, y, u, v);
  const auto pixel = model.project({x, y, 1.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(u, pixel->x(), 1e-9);
  EXPECT_NEAR(v, pixel->y(), 1e-9);
}

TEST(VispFormat, VispSeesTheSamePixels)
{
  Eigen::VectorXd fisheye(8);
  fisheye << 0.01, -0.002, 1e-3, -1e-4, 300, 301, 641, 478;
  const auto kannala = makeCameraModel("kannala_brandt", fisheye, 1280, 960);
  expectSamePixel(*kannala,
                  readByVisp(*kannala, vpCameraParameters::ProjWithKannalaBrandtDistortion));

  Eigen::VectorXd lens = Eigen::VectorXd::Zero(10);
  lens.head<6>() << 0.0, 600, 610, 641, 478, -0.1;
  const auto pinhole = makeCameraModel("unified", lens, 1280, 960);
  expectSamePixel(*pinhole,
                  readByVisp(*pinhole, vpCameraParameters::perspectiveProjWithDistortion));
}

} // namespace
} // namespace homeward
