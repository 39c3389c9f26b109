// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/turned.h>

#include <opencv2/imgproc.hpp>

namespace homeward
{

Panorama turned(const Panorama &panorama, double turn)
{
  const int width = panorama.image.cols;
  const double right = wrapAngle(turn) * width / (2.0 * kPi);
  cv::Mat thrice;
  cv::copyMakeBorder(panorama.image, thrice, 0, 0, width, width, cv::BORDER_WRAP);
  const cv::Matx23d shift(1.0, 0.0, width - right, 0.0, 1.0, 0.0);
  Panorama result{{}, panorama.geometry};
  cv::warpAffine(thrice, result.image, shift, panorama.image.size(),
                 cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
  return result;
}

} // namespace homeward
