// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/mission_trial_json.h>

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace homeward
{
using nlohmann::json;

namespace
{

Outcome parseOutcome(const std::string &word)
{
  for (const Outcome outcome : {Outcome::Done, Outcome::Stopped, Outcome::Failed}) {
    if (word == name(outcome)) {
      return outcome;
    }
  }
  throw ConfigError("'" + word + "' is no outcome");
}

json toJson(const Eigen::Vector2d &point)
{
  return {point.x(), point.y()};
}

Eigen::Vector2d pointFrom(const json &value)
{
  return {value.at(0).get<double>(), value.at(1).get<double>()};
}

json toJson(const GoalDrive &drive)
{
  json value = {{"goal", drive.goal.value},
                {"start_x_m_y_m_heading_rad", {drive.start.x, drive.start.y, drive.start.heading}},
                {"outcome", name(drive.outcome)},
                {"reason", drive.reason},
                {"arrived", drive.arrived()},
                {"error_m", drive.error},
                {"heading_error_rad", drive.headingError},
                {"distance_m", drive.distance},
                {"sim_time_s", drive.seconds},
                {"collisions", drive.collisions},
                {"unseen_contacts", drive.unseenContacts}};
  if (drive.from) {
    value["from"] = drive.from->value;
  }
  if (drive.first) {
    value["first_place"] = {{"node", drive.first->node.value},
                            {"error_m", drive.first->error},
                            {"sim_time_s", drive.first->seconds}};
  }
  return value;
}

GoalDrive driveFrom(const json &value)
{
  GoalDrive drive;
  drive.goal = NodeId{value.at("goal").get<std::int64_t>()};
  const json &start = value.at("start_x_m_y_m_heading_rad");
  drive.start = {start.at(0).get<double>(), start.at(1).get<double>(), start.at(2).get<double>()};
  drive.outcome = parseOutcome(value.at("outcome").get<std::string>());
  drive.reason = value.at("reason").get<std::string>();
  drive.error = value.at("error_m").get<double>();
  drive.headingError = value.at("heading_error_rad").get<double>();
  drive.distance = value.at("distance_m").get<double>();
  drive.seconds = value.at("sim_time_s").get<double>();
  drive.collisions = value.at("collisions").get<int>();
  drive.unseenContacts = value.at("unseen_contacts").get<int>();
  if (value.contains("from")) {
    drive.from = NodeId{value.at("from").get<std::int64_t>()};
  }
  if (value.contains("first_place")) {
    const json &first = value.at("first_place");
    drive.first =
        FirstPlace{NodeId{first.at("node").get<std::int64_t>()}, first.at("error_m").get<double>(),
                   first.at("sim_time_s").get<double>()};
  }
  return drive;
}

json toJson(const BarredDrive &barred)
{
  json value = toJson(barred.drive);
  value["edge"] = barred.edge.value;
  value["barrier_width_m"] = barred.barrierWidth;
  value["no_way_left"] = barred.noWayLeft;
  value["right"] = barred.right();
  value["meetings_s"] = barred.meetings;
  return value;
}

BarredDrive barredFrom(const json &value)
{
  return {EdgeId{value.at("edge").get<std::int64_t>()}, value.at("barrier_width_m").get<double>(),
          driveFrom(value), value.at("no_way_left").get<bool>(),
          value.at("meetings_s").get<std::vector<double>>()};
}

template <class Drive> json toJson(const std::vector<Drive> &drives)
{
  json values = json::array();
  for (const Drive &drive : drives) {
    values.push_back(toJson(drive));
  }
  return values;
}

template <class Drive>
std::vector<Drive> drivesFrom(const json &values, Drive (*driveFrom)(const json &value))
{
  std::vector<Drive> drives;
  std::transform(values.begin(), values.end(), std::back_inserter(drives), driveFrom);
  return drives;
}

json oracleJson(const MissionTrial &trial)
{
  json value = {{"length_m", trial.oracle.length},
                {"sim_time_s", trial.oracleSeconds},
                {"coverage", trial.oracle.coverage},
                {"places_x_m_y_m", json::array()}};
  for (const Eigen::Vector2d &place : trial.oracle.places) {
    value["places_x_m_y_m"].push_back(toJson(place));
  }
  return value;
}

json coverageJson(const std::vector<CoverageSample> &samples)
{
  json values = json::array();
  for (const CoverageSample &sample : samples) {
    values.push_back({sample.seconds, sample.coverage});
  }
  return values;
}

void readExploration(const json &value, MissionTrial &trial)
{
  trial.outcome = parseOutcome(value.at("outcome").get<std::string>());
  trial.reason = value.at("reason").get<std::string>();
  trial.nodes = value.at("nodes").get<std::size_t>();
  trial.edges = value.at("edges").get<std::size_t>();
  trial.openDirections = value.at("open_directions").get<int>();
  trial.homings = {value.at("homings").at("tried").get<int>(),
                   value.at("homings").at("arrived").get<int>()};
  trial.collisions = value.at("collisions").get<int>();
  trial.unseenContacts = value.at("unseen_contacts").get<int>();
  trial.distance = value.at("distance_m").get<double>();
  trial.seconds = value.at("sim_time_s").get<double>();
  const json &truth = value.at("truth");
  trial.truth = {truth.at("coverage").get<double>(), truth.at("false_edges").get<int>(),
                 truth.at("duplicate_nodes").get<int>()};
  for (const json &sample : value.at("coverage_time_s_share")) {
    trial.coverage.push_back({sample.at(0).get<double>(), sample.at(1).get<double>()});
  }
}

void readOracle(const json &value, MissionTrial &trial)
{
  trial.oracle.length = value.at("length_m").get<double>();
  trial.oracleSeconds = value.at("sim_time_s").get<double>();
  trial.oracle.coverage = value.at("coverage").get<double>();
  for (const json &place : value.at("places_x_m_y_m")) {
    trial.oracle.places.push_back(pointFrom(place));
  }
}

} // namespace

std::string missionTrialJson(const MissionTrial &trial)
{
  const json value = {
      {"world", trial.world},
      {"seed", trial.seed},
      {"outcome", name(trial.outcome)},
      {"reason", trial.reason},
      {"nodes", trial.nodes},
      {"edges", trial.edges},
      {"open_directions", trial.openDirections},
      {"homings",
       {{"tried", trial.homings.homingsTried}, {"arrived", trial.homings.homingsArrived}}},
      {"collisions", trial.collisions},
      {"unseen_contacts", trial.unseenContacts},
      {"distance_m", trial.distance},
      {"sim_time_s", trial.seconds},
      {"explore_wall_time_s", trial.wallSeconds},
      {"truth",
       {{"coverage", trial.truth.coverage},
        {"false_edges", trial.truth.falseEdges},
        {"duplicate_nodes", trial.truth.duplicateNodes}}},
      {"coverage_time_s_share", coverageJson(trial.coverage)},
      {"oracle", oracleJson(trial)},
      {"goals", toJson(trial.goals)},
      {"kidnappings", toJson(trial.kidnappings)},
      {"barred", toJson(trial.barred)},
      {"wall_time_s", trial.allWallSeconds}};
  return value.dump(1);
}

MissionTrial parseMissionTrial(const std::string &text)
{
  try {
    const json value = json::parse(text);
    MissionTrial trial;
    trial.world = value.at("world").get<std::string>();
    trial.seed = value.at("seed").get<std::uint64_t>();
    readExploration(value, trial);
    readOracle(value.at("oracle"), trial);
    trial.goals = drivesFrom(value.at("goals"), driveFrom);
    trial.kidnappings = drivesFrom(value.at("kidnappings"), driveFrom);
    trial.barred = drivesFrom(value.value("barred", json::array()), barredFrom); // newer
    trial.wallSeconds = value.at("explore_wall_time_s").get<double>();
    trial.allWallSeconds = value.at("wall_time_s").get<double>();
    return trial;
  }
  catch (const json::exception &error) {
    throw ConfigError(std::string("not the result of a mission: ") + error.what());
  }
}

} // namespace homeward
