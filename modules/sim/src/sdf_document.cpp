// SPDX-License-Identifier: GPL-3.0-or-later
#include "sdf_document.h"

#include <homeward/core/error.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

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
std::string describe(const std::string &tag, const pt::ptree &child)
{
  const std::string fallback = child.get("uri", child.get("include.uri", std::string("unnamed")));
  return tag + " '" + child.get("<xmlattr>.name", child.get("name", fallback)) + "'";
}

/** Why a child of the world cannot be loaded; empty when it can. */
std::string whyBroken(const std::string &tag, const pt::ptree &child, const pt::ptree &sdfElement,
                      const sdf::ParserConfig &config)
{
  pt::ptree document;
  pt::ptree &element = document.add_child("sdf", pt::ptree());
  element.put("<xmlattr>.version", sdfElement.get("<xmlattr>.version", "1.6"));
  pt::ptree &world = element.add_child("world", pt::ptree());
  world.put("<xmlattr>.name", "alone");
  for (const auto &[otherTag, other] : sdfElement.get_child("world")) {
    if (otherTag == "frame") {
      world.add_child(otherTag, other);
    }
  }
  world.add_child(tag, child);
  sdf::Root root;
  const sdf::Errors errors = root.LoadSdfString(toText(document), config);
  const sdf::World *loaded = root.WorldByIndex(0);
  const bool isModel = tag == "model" || tag == "include";
  if (loaded != nullptr && (!isModel || loaded->ModelCount() == 1)) {
    return "";
  }
  return firstMessage(errors);
}

/** Takes out of the tree what cannot be loaded, and names it. */
std::vector<std::string> leaveOutBroken(pt::ptree &sdfElement, const sdf::ParserConfig &config)
{
  std::vector<std::string> problems;
  pt::ptree kept;
  for (const auto &[tag, child] : sdfElement.get_child("world")) {
    const std::string why =
        canBeLeftOut(tag) ? whyBroken(tag, child, sdfElement, config) : std::string();
    if (why.empty()) {
      kept.push_back({tag, child});
    }
    else {
      problems.push_back(describe(tag, child) + ": left out: " + why);
    }
  }
  sdfElement.put_child("world", kept);
  return problems;
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
  SdfDocument document{std::make_unique<sdf::Root>(), {}};
  sdf::Errors errors = document.root->Load(fs::absolute(file).string(), config);
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
