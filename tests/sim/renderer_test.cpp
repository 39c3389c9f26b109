// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/mirror_renderer.h>

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace homeward
{
namespace
{

MirrorCamera nominalCamera()
{
  UnifiedCamera::Parameters parameters;
  parameters.xi = 0.95;
  parameters.fx = parameters.fy = 108.0;
  parameters.cx = 319.5;
  parameters.cy = 239.5;
  return {UnifiedCamera(parameters, 640, 480), {30.0, 236.0}, {-kPi / 2.0, true}};
}

void addBox(Scene &scene, const Eigen::Vector3f &low, const Eigen::Vector3f &high,
            const Eigen::Vector3f &colour)
{
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.emplace_back((corner & 1) != 0 ? high.x() : low.x(),
                               (corner & 2) != 0 ? high.y() : low.y(),
                               (corner & 4) != 0 ? high.z() : low.z());
  }
  for (const auto &[a, b, c, d] : {std::array{0, 1, 3, 2},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 3, 7, 6},
                                   {0, 2, 6, 4},
                                   {1, 3, 7, 5}}) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  }
  Material material;
  material.diffuse = colour;
  scene.materials.push_back(material);
  mesh.material = static_cast<int>(scene.materials.size()) - 1;
  scene.visuals.push_back(mesh);
}

/** A gray room, 8 x 6 x 2.5 m round the origin, with a red pillar ahead and a blue one left. */
std::shared_ptr<const Scene> makeRoom()
{
  auto scene = std::make_shared<Scene>();
  addBox(*scene, {-4.0F, -3.0F, 0.0F}, {4.0F, 3.0F, 2.5F}, {0.4F, 0.4F, 0.4F});
  addBox(*scene, {1.8F, -0.2F, 0.0F}, {2.2F, 0.2F, 1.5F}, {0.8F, 0.02F, 0.02F});
  addBox(*scene, {-0.2F, 1.8F, 0.0F}, {0.2F, 2.2F, 1.5F}, {0.02F, 0.02F, 0.8F});
  return scene;
}

Eigen::Isometry3d mirrorAt(double x, double y, double heading)
{
  Eigen::Isometry3d wMp = Eigen::Isometry3d::Identity();
  wMp.translation() << x, y, 0.9;
  wMp.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return wMp;
}

cv::Mat picture(const std::shared_ptr<const Scene> &scene, LightPreset light, double heading,
                const RenderOptions &options = {}, const MirrorCamera &camera = nominalCamera())
{
  MirrorRenderer renderer(scene, lightingFor(light, *scene), exactOptics(camera), options);
  Random noise(7, 1);
  return renderer.render(mirrorAt(0.0, 0.0, heading), noise);
}

/** Mean position, from the picture's centre, of pixels with far more of one channel (BGR). */
cv::Point2d centroid(const cv::Mat &image, int channel)
{
  cv::Point2d sum;
  int count = 0;
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const auto &pixel = image.at<cv::Vec3b>(v, u);
      if (pixel[channel] > 60 && pixel[channel] > 2 * pixel[2 - channel] &&
          pixel[channel] > 2 * pixel[1]) {
        sum += cv::Point2d(u - 319.5, v - 239.5);
        ++count;
      }
    }
  }
  EXPECT_GT(count, 200);
  return {sum.x / count, sum.y / count};
}

TEST(MirrorRenderer, AheadIsAtTheTopAndLeftIsClockwiseFromThere)
{
  const cv::Mat image = picture(makeRoom(), LightPreset::Day, 0.0);
  const cv::Point2d red = centroid(image, 2);
  EXPECT_NEAR(red.x, 0.0, 2.0);
  EXPECT_LT(red.y, -60.0);
  const cv::Point2d blue = centroid(image, 0);
  EXPECT_GT(blue.x, 60.0);
  EXPECT_NEAR(blue.y, 0.0, 2.0);
}

TEST(MirrorRenderer, AFlippedPictureShowsLeftOnTheOtherSide)
{
  MirrorCamera camera = nominalCamera();
  camera.mount.leftIsClockwise = false;
  const cv::Mat image = picture(makeRoom(), LightPreset::Day, 0.0, {}, camera);
  EXPECT_LT(centroid(image, 0).x, -60.0);
  EXPECT_LT(centroid(image, 2).y, -60.0);
}

TEST(MirrorRenderer, TurningLeftMovesTheSceneTheOtherWayRound)
{
  const cv::Mat image = picture(makeRoom(), LightPreset::Day, radians(30.0));
  const cv::Point2d red = centroid(image, 2);
  // Now 30 degrees to the right, counter-clockwise from the top.
  EXPECT_NEAR(degrees(std::atan2(-red.x, -red.y)), 30.0, 1.0);
}

TEST(MirrorRenderer, APillarsEdgesAreWhereItsRaysMeetThem)
{
  RenderOptions options;
  options.shotNoise = options.readNoise = 0.0;
  const cv::Mat image = picture(makeRoom(), LightPreset::Day, 0.0, options);
  const TrueOptics optics = exactOptics(nominalCamera());
  const auto isRed = [&](double y, double z) {
    const auto at = optics.project({1.8, y, z - 0.9});
    const auto &pixel = image.at<cv::Vec3b>(static_cast<int>(std::lround(at->y())),
                                            static_cast<int>(std::lround(at->x())));
    return pixel[2] > 2 * pixel[0];
  };
  EXPECT_TRUE(isRed(0.18, 0.5));
  EXPECT_FALSE(isRed(0.22, 0.5));
  EXPECT_TRUE(isRed(-0.18, 0.5));
  EXPECT_FALSE(isRed(-0.22, 0.5));
  EXPECT_TRUE(isRed(0.0, 1.47));
  EXPECT_FALSE(isRed(0.0, 1.54));
}

TEST(MirrorRenderer, ThePictureDoesNotDependOnTheNumberOfThreads)
{
  const auto scene = makeRoom();
  RenderOptions one;
  one.threads = 1;
  RenderOptions three;
  three.threads = 3;
  const cv::Mat a = picture(scene, LightPreset::Day, 0.3, one);
  const cv::Mat b = picture(scene, LightPreset::Day, 0.3, three);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0.0);
}

TEST(MirrorRenderer, NoiseDiffersFromFrameToFrameAndRepeatsWithTheSeed)
{
  const auto scene = makeRoom();
  MirrorRenderer renderer(scene, lightingFor(LightPreset::Day, *scene),
                          exactOptics(nominalCamera()));
  Random noise(1, 1);
  Random again(1, 1);
  const cv::Mat first = renderer.render(mirrorAt(0.0, 0.0, 0.0), noise);
  const cv::Mat second = renderer.render(mirrorAt(0.0, 0.0, 0.0), noise);
  const cv::Mat repeated = renderer.render(mirrorAt(0.0, 0.0, 0.0), again);
  EXPECT_GT(cv::norm(first, second, cv::NORM_INF), 0.0);
  EXPECT_LT(cv::norm(first, second, cv::NORM_L1) / (3.0 * 640.0 * 480.0), 4.0);
  EXPECT_EQ(cv::norm(first, repeated, cv::NORM_INF), 0.0);
}

TEST(MirrorRenderer, RobotAndSurroundingsOfTheMirrorAreDark)
{
  const cv::Mat image = picture(makeRoom(), LightPreset::Day, 0.0);
  EXPECT_LT(cv::mean(image(cv::Rect(305, 225, 30, 30)))[1], 25.0);
  EXPECT_LT(cv::mean(image(cv::Rect(0, 0, 60, 60)))[1], 25.0);
}

TEST(MirrorRenderer, OptionsOutsideTheirRangeAreRefused)
{
  const auto scene = makeRoom();
  RenderOptions options;
  options.threads = 0;
  EXPECT_THROW(MirrorRenderer(scene, Lighting(), exactOptics(nominalCamera()), options),
               LogicError);
}

} // namespace
} // namespace homeward
