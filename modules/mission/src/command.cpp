// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/mission/command.h>

namespace homeward
{

const char *name(Outcome outcome)
{
  switch (outcome) {
  case Outcome::Done:
    return "done";
  case Outcome::Stopped:
    return "stopped";
  case Outcome::Failed:
    break;
  }
  return "failed";
}

} // namespace homeward
