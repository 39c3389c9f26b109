// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/protocol/aria_parameters.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace homeward
{
namespace
{

constexpr std::size_t kMostSonars = 64;
constexpr double kMillimetre = 1e-3;

/** A value and where it stands. */
struct Entry
{
  int line = 0;
  std::string text;
};

/** The entries of a file; the sonars, whose key comes often, apart. */
class ParameterFile
{
public:
  ParameterFile(const std::string &text, std::string origin) : m_origin(std::move(origin))
  {
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      std::istringstream words(line.substr(0, line.find(';')));
      std::string key;
      std::string value;
      if (!(words >> key)) {
        continue;
      }
      std::getline(words >> std::ws, value);
      if (key == "SonarUnit") {
        m_sonars.push_back({number, value});
      }
      else {
        m_entries.emplace(key, Entry{number, value});
      }
    }
  }

  std::string text(const std::string &key) const
  {
    const auto found = m_entries.find(key);
    std::istringstream words(found == m_entries.end() ? "" : found->second.text);
    std::string word;
    words >> word;
    return word;
  }

  /** Nought where the key is missing. */
  double number(const std::string &key) const
  {
    const auto found = m_entries.find(key);
    return found == m_entries.end() ? 0.0 : numbers(found->second, key, 1).front();
  }

  double positive(const std::string &key) const
  {
    const double value = number(key);
    if (!(value > 0.0)) {
      throw ConfigError(m_origin + ": '" + key + "' is missing or not positive; is it an ARIA " +
                        "parameter file?");
    }
    return value;
  }

  std::vector<SonarMount> sonars() const
  {
    std::vector<SonarMount> mounts;
    for (const Entry &entry : m_sonars) {
      const std::vector<double> values = numbers(entry, "SonarUnit", 4);
      if (!(values[0] >= 0.0 && values[0] < static_cast<double>(kMostSonars))) {
        refuse(entry, "SonarUnit");
      }
      const auto index = static_cast<std::size_t>(values[0]);
      mounts.resize(std::max(mounts.size(), index + 1));
      mounts[index] = {values[1] * kMillimetre, values[2] * kMillimetre, 0.0,
                       wrapAngle(radians(values[3]))};
    }
    return mounts;
  }

private:
  std::vector<double> numbers(const Entry &entry, const std::string &key, std::size_t count) const
  {
    std::istringstream words(entry.text);
    std::vector<double> values(count);
    for (double &value : values) {
      if (!(words >> value) || !std::isfinite(value)) {
        refuse(entry, key);
      }
    }
    return values;
  }

  [[noreturn]] void refuse(const Entry &entry, const std::string &key) const
  {
    throw ConfigError(m_origin + ", line " + std::to_string(entry.line) + ": '" + key + "' is '" +
                      entry.text.substr(0, 40) + "'");
  }

  std::string m_origin;
  std::map<std::string, Entry> m_entries;
  std::vector<Entry> m_sonars;
};

} // namespace

AriaParameters parseAriaParameters(const std::string &text, const std::string &origin)
{
  const ParameterFile file(text, origin);
  AriaParameters parameters;
  parameters.subclass = file.text("Subclass");
  parameters.units.distance = file.positive("DistConvFactor") * kMillimetre;
  parameters.units.angle = file.positive("AngleConvFactor");
  parameters.units.speed = file.positive("VelConvFactor") * kMillimetre;
  parameters.units.range = file.positive("RangeConvFactor") * kMillimetre;
  parameters.units.turnPerDiff = file.positive("DiffConvFactor") / kMillimetre;
  parameters.width = file.number("RobotWidth") * kMillimetre;
  parameters.length = file.number("RobotLength") * kMillimetre;
  parameters.maxSpeed = file.number("MaxVelocity") * kMillimetre;
  parameters.maxTurnRate = radians(file.number("MaxRVelocity"));
  parameters.switchToBaud = static_cast<int>(file.number("SwitchToBaudRate"));
  parameters.sonars = file.sonars();
  return parameters;
}

} // namespace homeward
