// SPDX-License-Identifier: GPL-3.0-or-later
// Includes every header that a ViSP program may use, and lets a servo decide once.
#include <all_headers.h>

#include <cstdio>

int main()
{
  homeward::HomingServo servo(Eigen::Isometry3d::Identity(), {});
  homeward::HomeVector home;
  home.direction = 0.2;
  home.distanceProxy = 0.5;
  home.confidence = 1.0;
  const homeward::Twist2 twist = servo.approach(home);
  std::printf("%s\n", twist.v > 0.0 && twist.w > 0.0 ? "towards home" : "astray");
  return twist.v > 0.0 && twist.w > 0.0 ? 0 : 1;
}
