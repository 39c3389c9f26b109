// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/mission/explorer.h>

#include "explorer_stepper.h"

namespace homeward
{

using Phase = ExplorerState::Phase;

Explorer::Explorer(const ExplorerOptions &options) : m_options(options)
{
  if (!(options.forwardDistance > 0.0)) {
    throw LogicError("forwardDistance must be positive, not " +
                     std::to_string(options.forwardDistance));
  }
}

Step<ExplorerState> Explorer::start(const TopologicalMap &map) const
{
  return resume(ExplorerState{}, map);
}

Step<ExplorerState> Explorer::resume(const State &state, const TopologicalMap &map) const
{
  ExplorerStepper stepper(m_options, state, map);
  stepper.begin();
  return stepper.take();
}

Command Explorer::pending(const State &state, const TopologicalMap &map) const
{
  return ExplorerCommands(m_options, map, state).pending();
}

Step<ExplorerState> Explorer::next(const State &state, const TopologicalMap &map,
                                   const Report &report) const
{
  ExplorerStepper stepper(m_options, state, map);
  if (std::holds_alternative<Interrupted>(report)) {
    stepper.interrupt();
    return stepper.take();
  }
  switch (state.phase) {
  case Phase::Surveying:
    stepper.surveyed(answer<Surveyed>(report));
    break;
  case Phase::Driving:
    stepper.driven(answer<Driven>(report));
    break;
  case Phase::Classifying:
    stepper.classified(answer<Recognised>(report));
    break;
  case Phase::Homing:
    stepper.homed(answer<Homed>(report));
    break;
  case Phase::Following:
    stepper.followed(answer<Homed>(report));
    break;
  case Phase::Striding:
    stepper.strode(answer<Driven>(report));
    break;
  case Phase::Retreating:
    stepper.retreated(answer<Driven>(report));
    break;
  case Phase::Relocating:
    stepper.relocated(answer<Recognised>(report));
    break;
  case Phase::Returning:
    stepper.returned(answer<Homed>(report));
    break;
  case Phase::Finished:
    throw LogicError("the exploration has finished; no report can follow");
  }
  return stepper.take();
}

} // namespace homeward
