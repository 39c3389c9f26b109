// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/mission/report.h>

namespace homeward
{

const char *name(HomingEnd end)
{
  switch (end) {
  case HomingEnd::Arrived:
    return "arrived";
  case HomingEnd::Blocked:
    return "blocked";
  case HomingEnd::Lost:
    return "lost";
  case HomingEnd::TimedOut:
    return "timed out";
  }
  return "?";
}

} // namespace homeward
