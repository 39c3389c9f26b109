// SPDX-License-Identifier: GPL-3.0-or-later
#include "sdf_document.h"

#include "sdf_includes.h"

#include <homeward/core/error.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;
namespace pt = boost::property_tree;

namespace homeward
{

namespace
{

sdf::ParserConfig makeParserConfig(const SdfPaths &paths)
{
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetFindCallback([paths](const std::string &uri) {
    const std::optional<fs::path> found = paths.find(uri);
    if (!found) {
      return std::string();
    }
    // A model folder without its model.config is common and clear enough.
    if (fs::is_directory(*found) && !fs::exists(*found / "model.config") &&
        fs::exists(*found / "model.sdf")) {
      return (*found / "model.sdf").string();
    }
    return found->string();
  });
  return config;
}

pt::ptree readXml(const fs::path &file)
{
  std::ifstream stream(file);
  if (!stream) {
    throw ConfigError("world " + file.string() +
                      ": cannot be opened; give the path of an SDF world file");
  }
  pt::ptree tree;
  try {
    pt::read_xml(stream, tree, pt::xml_parser::no_comments);
  }
  catch (const pt::xml_parser_error &error) {
    throw ConfigError("world " + file.string() + ": not XML (" + error.message() + ", line " +
                      std::to_string(error.line()) + "); give an SDF world file");
  }
  return tree;
}

std::string firstMessage(const sdf::Errors &errors)
{
  if (errors.empty()) {
    return "no reason given";
  }
  std::string message = errors.front().Message();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

std::string toText(const pt::ptree &tree)
{
  std::ostringstream text;
  pt::write_xml(text, tree);
  return text.str();
}

bool canBeLeftOut(const std::string &tag)
{
  return tag == "model" || tag == "include" || tag == "light" || tag == "actor" ||
         tag == "population" || tag == "road";
}

/** What to call a child of the world in a message. */
std::string describe(const std::pair<std::string, pt::ptree> &entry)
{
  const auto &[tag, child] = entry;
  const std::string fallback = child.get("uri", child.get("include.uri", std::string("unnamed")));
  return tag + " '" + child.get("<xmlattr>.name", child.get("name", fallback)) + "'";
}

using Child = std::pair<std::string, pt::ptree>;
using Children = std::vector<Child>;

/** Finds out which parts of a world libsdformat cannot load, by halving. */
class Sieve
{
public:
  Sieve(const pt::ptree &sdfElement, const sdf::ParserConfig &config)
      : m_version(sdfElement.get("<xmlattr>.version", "1.6")), m_config(config)
  {
    for (const auto &child : sdfElement.get_child("world")) {
      if (child.first == "frame") {
        m_frames.emplace_back(child);
      }
    }
  }

  /** Appends to `kept` what can be loaded of `children`. */
  void sift(const Children &children, Children &kept)
  {
    sdf::Root root;
    const sdf::Errors errors = root.LoadSdfString(toText(worldOf(children)), m_config);
    if (children.size() == 1 && !isUsable(root, children.front().first)) {
      problems.push_back(describe(children.front()) + ": left out: " + firstMessage(errors));
    }
    else if (children.size() <= 1 || errors.empty()) {
      kept.insert(kept.end(), children.begin(), children.end());
    }
    else {
      const auto middle = children.begin() + static_cast<std::ptrdiff_t>(children.size() / 2);
      sift(Children(children.begin(), middle), kept);
      sift(Children(middle, children.end()), kept);
    }
  }

  std::vector<std::string> problems; ///< one line for each part left out

private:
  static bool isUsable(const sdf::Root &root, const std::string &tag)
  {
    const sdf::World *world = root.WorldByIndex(0);
    const bool isModel = tag == "model" || tag == "include";
    return world != nullptr && (!isModel || world->ModelCount() == 1);
  }

  pt::ptree worldOf(const Children &children) const
  {
    pt::ptree world;
    world.put("<xmlattr>.name", "part");
    for (const Children *list : {&m_frames, &children}) {
      for (const auto &child : *list) {
        world.push_back({child.first, child.second});
      }
    }
    pt::ptree document;
    document.put("sdf.<xmlattr>.version", m_version);
    document.put_child("sdf.world", world);
    return document;
  }

  std::string m_version;
  const sdf::ParserConfig &m_config;
  Children m_frames; ///< that poses may refer to
};

/** Takes out of the world what cannot be loaded, and names it. */
std::vector<std::string> leaveOutBroken(pt::ptree &sdfElement, const sdf::ParserConfig &config)
{
  Children kept;
  Children doubtful;
  for (const auto &child : sdfElement.get_child("world")) {
    (canBeLeftOut(child.first) ? doubtful : kept).emplace_back(child);
  }
  Sieve sieve(sdfElement, config);
  sieve.sift(doubtful, kept);
  pt::ptree world;
  for (const auto &child : kept) {
    world.push_back({child.first, child.second});
  }
  sdfElement.put_child("world", world);
  return sieve.problems;
}

} // namespace

SdfDocument readSdf(const fs::path &file, const SdfPaths &paths)
{
  sdf::Console::Instance()->SetQuiet(true);
  if (fs::is_directory(file)) {
    throw ConfigError("world " + file.string() + ": is a folder; give an SDF world file");
  }
  pt::ptree tree = readXml(file);
  const auto sdfElement = tree.get_child_optional("sdf");
  if (!sdfElement ||
      (!sdfElement->get_child_optional("world") && !sdfElement->get_child_optional("model"))) {
    throw ConfigError("world " + file.string() +
                      ": no <sdf> with a <world> or <model> in it; give an SDF world file");
  }
  const sdf::ParserConfig config = makeParserConfig(paths);
  expandIncludes(*sdfElement, sdfElement->get("<xmlattr>.version", std::string()), paths);
  SdfDocument document{std::make_unique<sdf::Root>(), {}};
  sdf::Errors errors = document.root->LoadSdfString(toText(tree), config);
  if (!errors.empty() && sdfElement->get_child_optional("world")) {
    document.problems = leaveOutBroken(*sdfElement, config);
    if (!document.problems.empty()) {
      document.root = std::make_unique<sdf::Root>();
      errors = document.root->LoadSdfString(toText(tree), config);
    }
  }
  if (document.root->WorldCount() == 0 && document.root->Model() == nullptr) {
    throw ConfigError("world " + file.string() + ": not valid SDF (" + firstMessage(errors) + ")");
  }
  return document;
}

} // namespace homeward
