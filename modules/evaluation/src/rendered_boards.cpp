// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/rendered_boards.h>

#include <homeward/core/random.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace homeward
{

namespace
{

constexpr std::uint32_t kHeldStream = 402;
constexpr std::uint32_t kBoardNoiseStream = 403;
constexpr double kResolution = 4000.0; ///< pixels a metre of the print
constexpr double kGoldenAngle = 2.399963;
constexpr double kPaper = 0.85; ///< what paper and ink reflect, linear
constexpr double kInk = 0.03;

/** The pixels of a row that lie between two places, and how much of each. */
struct Covered
{
  cv::Range pixels;
  cv::Mat1f shares; ///< a row
};

Covered covered(double from, double to)
{
  Covered result{{cvFloor(from), cvCeil(to)}, {}};
  result.shares.create(1, result.pixels.size());
  for (int i = 0; i < result.pixels.size(); ++i) {
    const double left = result.pixels.start + i;
    result.shares(i) = static_cast<float>(std::min(to, left + 1.0) - std::max(from, left));
  }
  return result;
}

/** The art as a printer lays it down, CV_8UC3, sRGB-coded. */
cv::Mat printed(const TargetArt &art)
{
  constexpr int kShift = 8; // pixels are given in 1/256
  const cv::Size size(cvRound(art.width * kResolution), cvRound(art.height * kResolution));
  cv::Mat1b discs(size, uchar{0});
  const auto at = [](double metres) { return cvRound((metres * kResolution - 0.5) * 256.0); };
  for (const ArtDisc &disc : art.discs) {
    cv::circle(discs, {at(disc.x), at(disc.y)}, cvRound(disc.radius * kResolution * 256.0),
               cv::Scalar::all(255), cv::FILLED, cv::LINE_AA, kShift);
  }
  cv::Mat1f ink;
  discs.convertTo(ink, CV_32F, 1.0 / 255.0);
  for (const ArtRectangle &r : art.rectangles) {
    const Covered across = covered(r.x * kResolution, (r.x + r.width) * kResolution);
    const Covered down = covered(r.y * kResolution, (r.y + r.height) * kResolution);
    ink(down.pixels, across.pixels) += down.shares.t() * across.shares;
  }
  cv::Mat reflected;
  ink.convertTo(reflected, CV_32F, kInk - kPaper, kPaper);
  cv::pow(reflected, 1.0 / 2.2, reflected);
  cv::Mat print;
  reflected.convertTo(print, CV_8U, 255.0);
  cv::cvtColor(print, print, cv::COLOR_GRAY2BGR);
  return print;
}

/** The room with a printed sheet in it, to be moved about. */
class SheetInRoom
{
public:
  SheetInRoom(const Scene &room, const TargetArt &art) : m_scene(room), m_origin(art.origin)
  {
    const cv::Mat print = printed(art);
    m_width = print.cols / kResolution;
    m_height = print.rows / kResolution;
    Material paper;
    paper.diffuse.setOnes();
    paper.texture = static_cast<int>(m_scene.textures.size());
    m_scene.textures.push_back(makeTexture(print));
    Mesh sheet;
    sheet.model = "board";
    sheet.material = static_cast<int>(m_scene.materials.size());
    m_scene.materials.push_back(paper);
    sheet.uvs = {{0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.0F}, {0.0F, 0.0F}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    m_scene.visuals.push_back(sheet);
  }

  /** The scene with the target's frame o at wMo. */
  std::shared_ptr<const Scene> at(const Eigen::Isometry3d &wMo)
  {
    std::vector<Eigen::Vector3f> &vertices = m_scene.visuals.back().vertices;
    vertices.clear();
    for (const Eigen::Vector2d &corner :
         {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(m_width, 0.0),
          Eigen::Vector2d(m_width, m_height), Eigen::Vector2d(0.0, m_height)}) {
      const Eigen::Vector2d onBoard = corner - m_origin;
      const Eigen::Vector3d inWorld = wMo * Eigen::Vector3d(onBoard.x(), onBoard.y(), 0.0);
      vertices.emplace_back(inWorld.cast<float>());
    }
    return std::make_shared<const Scene>(m_scene);
  }

private:
  Scene m_scene;
  Eigen::Vector2d m_origin;
  double m_width = 0.0;
  double m_height = 0.0;
};

} // namespace

std::vector<Eigen::Isometry3d> heldBoardPoses(const Target &target, const HeldBoards &held)
{
  const auto points = targetPoints(target);
  const Eigen::Vector3d middle =
      std::accumulate(points.begin(), points.end(), Eigen::Vector3d(0.0, 0.0, 0.0)) /
      static_cast<double>(points.size());
  Random random(held.seed, kHeldStream);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < held.count; ++i) {
    const double azimuth = kGoldenAngle * i; // spreads them
    const double elevation = held.highest - radians(20.0) * (i % 3);
    const Eigen::Vector3d towards(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    Eigen::Matrix3d facing; // z away from the mirror, y down
    facing.col(2) = towards;
    facing.col(0) = towards.cross(Eigen::Vector3d::UnitZ()).normalized();
    facing.col(1) = facing.col(2).cross(facing.col(0));
    Eigen::Isometry3d pMo = Eigen::Isometry3d::Identity();
    pMo.linear() = facing;
    for (int axis = 0; axis < 3; ++axis) {
      const double most = axis == 2 ? held.turn : held.tilt;
      pMo.rotate(Eigen::AngleAxisd(random.uniform(-most, most), Eigen::Vector3d::Unit(axis)));
    }
    pMo.translation() =
        random.uniform(held.nearest, held.farthest) * towards - pMo.linear() * middle;
    poses.push_back(pMo);
  }
  return poses;
}

std::vector<cv::Mat> renderBoards(const BoardStudio &studio, const Target &target,
                                  const std::vector<Eigen::Isometry3d> &poses,
                                  const Progress &progress)
{
  checkTarget(target);
  SheetInRoom sheet(*studio.room, drawTarget(target));
  const Lighting lighting = lightingFor(studio.light, *studio.room);
  const TrueOptics optics = exactOptics(studio.camera);
  Random noise(studio.seed, kBoardNoiseStream);
  std::vector<cv::Mat> pictures;
  for (const Eigen::Isometry3d &pMo : poses) {
    MirrorRenderer renderer(sheet.at(studio.wMp * pMo), lighting, optics, studio.rendering);
    cv::Mat gray;
    cv::cvtColor(renderer.render(studio.wMp, noise), gray, cv::COLOR_BGR2GRAY);
    pictures.push_back(gray);
    if (progress) {
      progress(pictures.size(), poses.size());
    }
  }
  return pictures;
}

} // namespace homeward
