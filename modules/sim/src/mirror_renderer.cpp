// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/mirror_renderer.h>

#include "shading.h"
#include "shading_colour.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

namespace homeward
{

namespace
{

constexpr int kTile = 4;            ///< pixels, side of a packet's tile
constexpr float kSoftEdge = 1.5F;   ///< pixels over which the ring fades to its surroundings
constexpr float kHousing = 0.004F;  ///< linear signal of what hides the scene
constexpr int kToneSteps = 4096;    ///< entries of the tone curve
constexpr int kPacketsPerGrab = 64; ///< a thread takes this many packets at a time

/** A packet as the optics fix it, before the camera is placed in the world. */
struct PixelPacket
{
  RayPacket rays;                         ///< directions in frame p
  std::array<int, kPacket> pixel;         ///< row * width + column
  std::array<float, kPacket> transmitted; ///< vignetting and soft edge, 0 to 1
};

/** One 64-bit number from another, well mixed: the finalizer of SplitMix64. */
std::uint64_t mix(std::uint64_t x)
{
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

/** Nearly normal with deviation 1: three uniform 7-bit numbers out of 21 bits. */
float nearlyNormal(std::uint64_t bits)
{
  const auto sum =
      static_cast<float>((bits & 127U) + ((bits >> 7U) & 127U) + ((bits >> 14U) & 127U));
  return (sum - 190.5F) / 64.0F;
}

std::array<unsigned char, kToneSteps + 1> makeToneCurve()
{
  std::array<unsigned char, kToneSteps + 1> curve{};
  for (int i = 0; i <= kToneSteps; ++i) {
    const float linear = static_cast<float>(i) / kToneSteps;
    curve[static_cast<std::size_t>(i)] =
        static_cast<unsigned char>(std::lround(255.0F * toCoded(linear)));
  }
  return curve;
}

/** Share of a pixel's light that passes: soft edges of the ring, less light towards the rim. */
float transmission(const TrueOptics &optics, const Eigen::Vector2d &pixel, double vignetting)
{
  const double radius = (pixel - optics.centre).norm();
  const double inside = std::clamp((radius - optics.innerRadius) / kSoftEdge + 0.5, 0.0, 1.0);
  const double outside = std::clamp((optics.outerRadius - radius) / kSoftEdge + 0.5, 0.0, 1.0);
  const double share = radius / optics.outerRadius;
  return static_cast<float>(inside * outside * (1.0 - vignetting * share * share));
}

/** Angle between neighbouring rays, the geometric mean of both directions; radians. */
float spreadAt(const TrueOptics &optics, const Eigen::Vector2d &pixel, const Eigen::Vector3d &ray)
{
  const auto right = optics.ray(pixel + Eigen::Vector2d(0.5, 0.0));
  const auto below = optics.ray(pixel + Eigen::Vector2d(0.0, 0.5));
  return right && below
             ? static_cast<float>(2.0 * std::sqrt((*right - ray).cross(*below - ray).norm()))
             : 0.01F;
}

/** The ring's pixels in tiles, each with its ray. */
std::vector<PixelPacket> makePackets(const TrueOptics &optics, double vignetting)
{
  std::vector<PixelPacket> packets;
  for (int top = 0; top < optics.height; top += kTile) {
    for (int left = 0; left < optics.width; left += kTile) {
      PixelPacket packet;
      for (int k = 0; k < kPacket; ++k) {
        const int row = top + k / kTile;
        const int column = left + k % kTile;
        const Eigen::Vector2d pixel(column, row);
        const float passed = transmission(optics, pixel, vignetting);
        const auto ray = optics.ray(pixel);
        if (row >= optics.height || column >= optics.width || passed <= 0.0F || !ray) {
          continue;
        }
        const auto i = static_cast<std::size_t>(packet.rays.count++);
        packet.rays.directions[i] = ray->cast<float>();
        packet.rays.spread[i] = spreadAt(optics, pixel, *ray);
        packet.pixel[i] = row * optics.width + column;
        packet.transmitted[i] = passed;
      }
      if (packet.rays.count > 0) {
        packets.push_back(packet);
      }
    }
  }
  return packets;
}

void check(const RenderOptions &options)
{
  if (options.threads < 1 || options.exposure < 0.0 || options.shotNoise < 0.0 ||
      options.readNoise < 0.0 || options.vignetting < 0.0 || options.vignetting > 1.0) {
    throw LogicError("render options: threads " + std::to_string(options.threads) +
                     " must be at least 1, exposure, noise and vignetting not negative");
  }
}

} // namespace

class MirrorRenderer::Impl
{
public:
  Impl(std::shared_ptr<const Scene> scene, const Lighting &lighting, const TrueOptics &optics,
       const RenderOptions &options)
      : m_options(options), m_lighting(lighting), m_width(optics.width), m_height(optics.height),
        m_shader(std::move(scene), lighting, options.shadows),
        m_packets(makePackets(optics, options.vignetting)), m_toneCurve(makeToneCurve()),
        m_signal(static_cast<std::size_t>(optics.width) * static_cast<std::size_t>(optics.height),
                 Eigen::Vector3f::Constant(kHousing)),
        m_packetSums(m_packets.size())
  {}

  cv::Mat render(const Eigen::Isometry3d &wMp, std::uint64_t frameSeed)
  {
    const Eigen::Matrix3f wRp = wMp.linear().cast<float>();
    const Eigen::Vector3f origin = wMp.translation().cast<float>();
    inParallel(m_packets.size(), [&](std::size_t i) { renderPacket(i, wRp, origin); });
    const auto gain = static_cast<float>(exposure());
    cv::Mat picture(m_height, m_width, CV_8UC3);
    inParallel(static_cast<std::size_t>(m_height),
               [&](std::size_t row) { develop(static_cast<int>(row), gain, frameSeed, picture); });
    return picture;
  }

  void put(std::shared_ptr<const Scene> things) { m_shader.put(std::move(things)); }

private:
  /** Calls work(0) to work(count - 1), in any order, on the threads that the options allow. */
  template <typename Work> void inParallel(std::size_t count, const Work &work) const
  {
    std::atomic<std::size_t> next{0};
    const auto run = [&] {
      for (std::size_t first = next.fetch_add(kPacketsPerGrab); first < count;
           first = next.fetch_add(kPacketsPerGrab)) {
        const std::size_t end = std::min(count, first + kPacketsPerGrab);
        for (std::size_t i = first; i < end; ++i) {
          work(i);
        }
      }
    };
    std::vector<std::jthread> helpers;
    for (int i = 1; i < m_options.threads; ++i) {
      helpers.emplace_back(run);
    }
    run();
  }

  void renderPacket(std::size_t index, const Eigen::Matrix3f &wRp, const Eigen::Vector3f &origin)
  {
    const PixelPacket &packet = m_packets[index];
    RayPacket rays = packet.rays;
    const auto count = static_cast<std::size_t>(rays.count);
    for (std::size_t i = 0; i < count; ++i) {
      rays.directions[i] = wRp * packet.rays.directions[i];
    }
    const RadiancePacket radiance = m_shader.radiance(origin, rays);
    float sum = 0.0F;
    for (std::size_t i = 0; i < count; ++i) {
      m_signal[static_cast<std::size_t>(packet.pixel[i])] = packet.transmitted[i] * radiance[i];
      // A meter does not let a lamp in sight darken everything else.
      sum += packet.transmitted[i] * std::min(1.5F, radiance[i].mean());
    }
    m_packetSums[index] = sum;
  }

  /** The gain that brings the ring's mean to the target, within the lighting's limits. */
  double exposure() const
  {
    if (m_options.exposure > 0.0) {
      return m_options.exposure;
    }
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < m_packets.size(); ++i) {
      sum += static_cast<double>(m_packetSums[i]);
      count += m_packets[i].rays.count;
    }
    const double mean = std::max(sum / std::max(count, 1.0), 1e-6);
    return std::clamp(static_cast<double>(m_lighting.exposureTarget) / mean,
                      static_cast<double>(m_lighting.exposureMin),
                      static_cast<double>(m_lighting.exposureMax));
  }

  /** Noise and tone curve on one row. A pixel's noise depends on the frame and the pixel only. */
  void develop(int row, float gain, std::uint64_t frameSeed, cv::Mat &picture) const
  {
    const auto shot = static_cast<float>(m_options.shotNoise);
    const auto read = static_cast<float>(m_options.readNoise);
    auto *out = picture.ptr<cv::Vec3b>(row);
    for (int column = 0; column < m_width; ++column) {
      const int pixel = row * m_width + column;
      std::uint64_t bits =
          mix(frameSeed + 0x9e3779b97f4a7c15ULL * (static_cast<std::uint64_t>(pixel) + 1U));
      const Eigen::Vector3f signal = gain * m_signal[static_cast<std::size_t>(pixel)];
      const float deviation = std::sqrt(read * read + shot * shot * signal.mean());
      for (int channel = 0; channel < 3; ++channel) {
        const float noisy =
            std::clamp(signal[channel] + deviation * nearlyNormal(bits), 0.0F, 1.0F);
        out[column][2 - channel] = m_toneCurve[static_cast<std::size_t>(noisy * kToneSteps + 0.5F)];
        bits >>= 21U;
      }
    }
  }

  RenderOptions m_options;
  Lighting m_lighting;
  int m_width;
  int m_height;
  Shader m_shader;
  std::vector<PixelPacket> m_packets;
  std::array<unsigned char, kToneSteps + 1> m_toneCurve;
  std::vector<Eigen::Vector3f> m_signal; ///< linear RGB by pixel, before exposure
  std::vector<float> m_packetSums;       ///< brightness by packet, for the exposure
};

MirrorRenderer::MirrorRenderer(std::shared_ptr<const Scene> scene, const Lighting &lighting,
                               const TrueOptics &optics, const RenderOptions &options)
{
  check(options);
  m_impl = std::make_unique<Impl>(std::move(scene), lighting, optics, options);
}

MirrorRenderer::~MirrorRenderer() = default;
MirrorRenderer::MirrorRenderer(MirrorRenderer &&) noexcept = default;
MirrorRenderer &MirrorRenderer::operator=(MirrorRenderer &&) noexcept = default;

void MirrorRenderer::put(std::shared_ptr<const Scene> things)
{
  m_impl->put(std::move(things));
}

cv::Mat MirrorRenderer::render(const Eigen::Isometry3d &wMp, Random &noise)
{
  return m_impl->render(wMp, noise.bits());
}

} // namespace homeward
