// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/random.h>
#include <homeward/sim/light_preset.h>
#include <homeward/sim/scene.h>
#include <homeward/sim/true_optics.h>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <memory>

namespace homeward
{

/** How the simulated camera takes its pictures. */
struct RenderOptions
{
  int threads = 2;          ///< at least 1; the picture does not depend on it
  double exposure = 0.0;    ///< fixed gain; 0 chooses one for each frame
  double shotNoise = 0.012; ///< standard deviation at full white, of the linear signal
  double readNoise = 0.002; ///< standard deviation in the dark, of the linear signal
  double vignetting = 0.2;  ///< share of light lost at the rim
  bool shadows = true;      ///< lamps cast shadows
};

/**
 * Pictures of a scene as a camera under a hyperbolic mirror takes them.
 *
 * Every pixel of the ring is rendered by its own ray from the mirror's focus.
 */
class MirrorRenderer
{
public:
  /** @throw LogicError unless threads >= 1 and noise, vignetting and exposure are not negative */
  MirrorRenderer(std::shared_ptr<const Scene> scene, const Lighting &lighting,
                 const TrueOptics &optics, const RenderOptions &options = {});
  ~MirrorRenderer();
  MirrorRenderer(MirrorRenderer &&) noexcept;
  MirrorRenderer &operator=(MirrorRenderer &&) noexcept;

  /**
   * Things that are seen besides, instead of those put before.
   * @param things their lights do not count; null: nothing
   */
  void put(std::shared_ptr<const Scene> things);

  /**
   * One frame.
   * @param wMp the mirror's focus in the world
   * @param noise one draw is taken a frame; the frame's sensor noise follows from it
   * @return CV_8UC3 BGR of the optics' size
   */
  cv::Mat render(const Eigen::Isometry3d &wMp, Random &noise);

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace homeward
