// SPDX-License-Identifier: GPL-3.0-or-later
#include "mission_table.h"

#include <homeward/viewer/line_chart.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>

namespace homeward
{
namespace
{

constexpr int kNameWidth = 38;
constexpr int kColumnWidth = 30;

std::string number(double value, int digits)
{
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

/** "99.2 [98.1, 100.0]". @param factor to the unit that is shown */
std::string shown(const Mean &mean, int digits, double factor = 1.0)
{
  if (mean.count == 0) {
    return "-";
  }
  std::string text = number(factor * mean.value, digits);
  if (mean.interval) {
    text += " [" + number(factor * mean.interval->low, digits) + ", " +
            number(factor * mean.interval->high, digits) + "]";
  }
  return text;
}

/** "19 of 20, 95 % [76, 99]". */
std::string shown(const Share &share)
{
  if (share.trials == 0) {
    return "-";
  }
  const Interval interval = share.interval();
  return std::to_string(share.successes) + " of " + std::to_string(share.trials) + ", " +
         number(100.0 * share.value(), 0) + " % [" + number(100.0 * interval.low, 0) + ", " +
         number(100.0 * interval.high, 0) + "]";
}

std::string line(const std::string &name, const std::vector<std::string> &cells)
{
  std::string text = name;
  text.resize(kNameWidth, ' ');
  for (std::string cell : cells) {
    cell.resize(std::max<std::size_t>(cell.size() + 1, kColumnWidth), ' ');
    text += cell;
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

using Figure = std::function<std::string(const MissionSummary &)>;
using Figures = std::vector<std::pair<std::string, Figure>>;

Figures explorationFigures()
{
  using S = const MissionSummary &;
  return {
      {"explorations that ended by themselves", [](S s) { return shown(s.finished); }},
      {"coverage, %", [](S s) { return shown(s.coverage, 1, 100.0); }},
      {"least coverage, %", [](S s) { return number(100.0 * s.leastCoverage, 1); }},
      {"false edges", [](S s) { return std::to_string(s.falseEdges); }},
      {"duplicate nodes", [](S s) { return std::to_string(s.duplicateNodes); }},
      {"nodes", [](S s) { return shown(s.nodes, 1); }},
      {"homings that arrived", [](S s) { return shown(s.homings); }},
      {"collisions", [](S s) { return std::to_string(s.collisions); }},
      {"unseen contacts", [](S s) { return std::to_string(s.unseenContacts); }},
      {"driven, m", [](S s) { return shown(s.distance, 0); }},
      {"simulated time, s", [](S s) { return shown(s.seconds, 0); }},
      {"oracle tour, m", [](S s) { return shown(s.oracleLength, 1); }},
      {"distance over the oracle's", [](S s) { return shown(s.distanceFactor, 1); }},
      {"time over the oracle's", [](S s) { return shown(s.secondsFactor, 1); }},
  };
}

using Drives = GoalSummary MissionSummary::*;

/** A figure of the drives that arrived. */
std::string ifAny(const GoalSummary &drives, double value, int digits)
{
  return drives.arrived.successes == 0 ? "-" : number(value, digits);
}

Figures goalFigures(Drives drives)
{
  using S = const MissionSummary &;
  return {
      {"goals reached", [=](S s) { return shown((s.*drives).arrived); }},
      {"  said so elsewhere", [=](S s) { return std::to_string((s.*drives).wronglyArrived); }},
      {"  median error, m", [=](S s) { return ifAny(s.*drives, (s.*drives).medianError, 3); }},
      {"  median heading error, degrees",
       [=](S s) { return ifAny(s.*drives, (s.*drives).medianHeadingDeg, 2); }},
      {"  time, s", [=](S s) { return shown((s.*drives).seconds, 0); }},
      {"  collisions", [=](S s) { return std::to_string((s.*drives).collisions); }},
      {"  unseen contacts", [=](S s) { return std::to_string((s.*drives).unseenContacts); }},
  };
}

Figures kidnappingFigures()
{
  using S = const MissionSummary &;
  return {
      {"kidnapped: knew where it was", [](S s) { return shown(s.kidnappings.firstRight); }},
      {"  believed to be elsewhere", [](S s) { return std::to_string(s.kidnappings.firstWrong); }},
      {"  said it was lost", [](S s) { return std::to_string(s.kidnappings.neverKnew); }},
      {"  time until it knew, s", [](S s) { return shown(s.kidnappings.secondsToKnow, 0); }},
  };
}

Figures barredFigures()
{
  using S = const MissionSummary &;
  return {
      {"barred edges: rightly ended", [](S s) { return shown(s.barred.right); }},
      {"  of these unreachable", [](S s) { return std::to_string(s.barred.noWayLeft); }},
      {"  longest meeting, s",
       [](S s) { return s.barred.meetings == 0 ? "-" : number(s.barred.longestMeeting, 0); }},
      {"  collisions", [](S s) { return std::to_string(s.barred.collisions); }},
      {"  unseen contacts", [](S s) { return std::to_string(s.barred.unseenContacts); }},
  };
}

std::string lines(const Figures &figures, const WorldSummaries &worlds)
{
  std::string text;
  for (const auto &[name, figure] : figures) {
    std::vector<std::string> cells;
    for (const auto &[world, summary] : worlds) {
      cells.push_back(figure(summary));
    }
    text += line(name, cells);
  }
  return text;
}

nlohmann::json jsonOf(const Interval &interval)
{
  return {interval.low, interval.high};
}

nlohmann::json jsonOf(const Mean &mean)
{
  nlohmann::json json = {{"mean", mean.value}, {"count", mean.count}};
  if (mean.interval) {
    json["interval"] = jsonOf(*mean.interval);
  }
  return json;
}

nlohmann::json jsonOf(const Share &share)
{
  return {{"successes", share.successes},
          {"trials", share.trials},
          {"share", share.value()},
          {"interval", jsonOf(share.interval())}};
}

nlohmann::json jsonOf(const GoalSummary &drives)
{
  return {{"arrived", jsonOf(drives.arrived)},
          {"wrongly_arrived", drives.wronglyArrived},
          {"error_median_m", drives.medianError},
          {"heading_error_median_deg", drives.medianHeadingDeg},
          {"sim_time_s", jsonOf(drives.seconds)},
          {"collisions", drives.collisions},
          {"unseen_contacts", drives.unseenContacts},
          {"knew_first_place", jsonOf(drives.firstRight)},
          {"wrong_first_place", drives.firstWrong},
          {"lost", drives.neverKnew},
          {"recovery_s", jsonOf(drives.secondsToKnow)}};
}

nlohmann::json jsonOf(const BarredSummary &barred)
{
  return {{"drives", barred.right.trials},       {"right", barred.right.successes},
          {"right_share", jsonOf(barred.right)}, {"no_way_left", barred.noWayLeft},
          {"meetings", barred.meetings},         {"longest_meeting_s", barred.longestMeeting},
          {"collisions", barred.collisions},     {"unseen_contacts", barred.unseenContacts}};
}

nlohmann::json jsonOf(const MissionSummary &summary)
{
  return {{"runs", summary.finished.trials},
          {"finished", summary.finished.successes},
          {"finished_share", jsonOf(summary.finished)},
          {"coverage_mean", summary.coverage.value},
          {"coverage_min", summary.leastCoverage},
          {"coverage", jsonOf(summary.coverage)},
          {"false_edges", summary.falseEdges},
          {"duplicate_nodes", summary.duplicateNodes},
          {"nodes", jsonOf(summary.nodes)},
          {"homings", jsonOf(summary.homings)},
          {"collisions", summary.collisions},
          {"unseen_contacts", summary.unseenContacts},
          {"distance_m", jsonOf(summary.distance)},
          {"sim_time_s", jsonOf(summary.seconds)},
          {"oracle_length_m", jsonOf(summary.oracleLength)},
          {"distance_over_oracle", jsonOf(summary.distanceFactor)},
          {"time_over_oracle", jsonOf(summary.secondsFactor)},
          {"goals", summary.goals.arrived.trials},
          {"reached", summary.goals.arrived.successes},
          {"error_median_m", summary.goals.medianError},
          {"goal_drives", jsonOf(summary.goals)},
          {"kidnaps", summary.kidnappings.arrived.trials},
          {"relocalised", summary.kidnappings.firstRight.successes},
          {"kidnap_drives", jsonOf(summary.kidnappings)},
          {"barred", jsonOf(summary.barred)}};
}

/** Whether any world has some of what a share is of. */
template <class ShareOf> bool any(const WorldSummaries &worlds, ShareOf shareOf)
{
  return std::any_of(worlds.begin(), worlds.end(),
                     [&](const auto &world) { return shareOf(world.second).trials > 0; });
}

} // namespace

std::string missionTable(const WorldSummaries &worlds)
{
  std::vector<std::string> names;
  for (const auto &[name, summary] : worlds) {
    names.push_back(name);
  }
  std::string table = line("mean [95 % confidence]", names);
  table += lines(explorationFigures(), worlds);
  if (any(worlds, [](const MissionSummary &s) { return s.goals.arrived; })) {
    table += lines(goalFigures(&MissionSummary::goals), worlds);
  }
  if (any(worlds, [](const MissionSummary &s) { return s.kidnappings.arrived; })) {
    table += lines(kidnappingFigures(), worlds);
    table += lines(goalFigures(&MissionSummary::kidnappings), worlds);
  }
  if (any(worlds, [](const MissionSummary &s) { return s.barred.right; })) {
    table += lines(barredFigures(), worlds);
  }
  return table;
}

nlohmann::json missionSummaryJson(const WorldSummaries &worlds)
{
  nlohmann::json json = nlohmann::json::object();
  for (const auto &[name, summary] : worlds) {
    json[name] = jsonOf(summary);
  }
  return json;
}

std::string coverageChart(const std::string &world, const std::vector<MissionTrial> &trials)
{
  LineChart chart;
  chart.title = "Coverage of " + world;
  chart.xName = "simulated time, s";
  for (const MissionTrial &trial : trials) {
    LineChart::Series series;
    series.name = "seed " + std::to_string(trial.seed);
    series.end = trial.seconds;
    for (const CoverageSample &sample : trial.coverage) {
      series.points.emplace_back(sample.seconds, sample.coverage);
    }
    chart.series.push_back(series);
  }
  return lineChartSvg(chart);
}

} // namespace homeward
