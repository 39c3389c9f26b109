// SPDX-License-Identifier: GPL-3.0-or-later
#include "recoveries.h"

#include <limits>
#include <map>

namespace homeward
{
namespace
{

using SwitchOff = void (*)(MissionTrialOptions &);

constexpr double kNever = std::numeric_limits<double>::infinity();

void inHomings(MissionTrialOptions &options, void (*change)(HomingRunOptions &))
{
  change(options.exploring.homing);
  change(options.navigating.homing);
}

const std::map<std::string, SwitchOff> &recoveries()
{
  static const std::map<std::string, SwitchOff> all{
      {"retry", [](MissionTrialOptions &options) { options.explorer.homingTries = 1; }},
      {"relocate", [](MissionTrialOptions &options) { options.explorer.relocates = false; }},
      {"check-ways", [](MissionTrialOptions &options) { options.explorer.checksWays = false; }},
      {"go-back", [](MissionTrialOptions &options) { options.explorer.retreats = false; }},
      {"stride", [](MissionTrialOptions &options) { options.explorer.strides = false; }},
      {"rescue", [](MissionTrialOptions &options) { options.explorer.rescueTries = 0; }},
      {"sure", [](MissionTrialOptions &options) { options.explorer.surelyBeyond = kNever; }},
      {"ways",
       [](MissionTrialOptions &options) {
         options.explorer.placeSigma = kNever;
         options.explorer.nearPlace = kNever;
       }},
      {"search",
       [](MissionTrialOptions &options) {
         inHomings(options, [](HomingRunOptions &homing) { homing.searches = 0; });
       }},
      {"retreat",
       [](MissionTrialOptions &options) {
         inHomings(options, [](HomingRunOptions &homing) { homing.retreats = 0; });
       }},
      {"detour",
       [](MissionTrialOptions &options) {
         inHomings(options, [](HomingRunOptions &homing) { homing.detours = 0; });
       }},
      {"beside",
       [](MissionTrialOptions &options) {
         inHomings(options, [](HomingRunOptions &homing) { homing.beside = 0.0; });
       }},
  };
  return all;
}

} // namespace

std::vector<std::string> recoveryNames()
{
  std::vector<std::string> names;
  for (const auto &[name, unused] : recoveries()) {
    names.push_back(name);
  }
  return names;
}

void switchOff(const std::vector<std::string> &names, MissionTrialOptions &options)
{
  for (const std::string &name : names) {
    recoveries().at(name)(options);
  }
}

} // namespace homeward
