// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

namespace homeward
{

/** What a careful look at two panoramas says. */
struct Verification
{
  double probability = 0.0; ///< that both show the same neighbourhood, 0 to 1
  bool verified = false;    ///< sure enough to act on
};

/** Decides, from the pictures themselves, whether a candidate of PlaceIndex is the place. */
class PairVerifier
{
public:
  virtual ~PairVerifier() = default;

  /** Compares two panoramas of one geometry. */
  virtual Verification verify(const Panorama &current, const Panorama &stored) = 0;
};

} // namespace homeward
