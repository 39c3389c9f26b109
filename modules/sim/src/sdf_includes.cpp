// SPDX-License-Identifier: GPL-3.0-or-later
#include "sdf_includes.h"

#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>

namespace fs = std::filesystem;
namespace pt = boost::property_tree;

namespace homeward
{

namespace
{

constexpr int kDeepest = 10; ///< includes in includes, more would be a circle

constexpr std::array kInvisible = {"inertial", "surface", "plugin",  "sensor",
                                   "joint",    "gripper", "physics", "audio_source"};

bool isInvisible(const std::string &tag)
{
  return std::find(kInvisible.begin(), kInvisible.end(), tag) != kInvisible.end();
}

std::optional<pt::ptree> readXml(const fs::path &file)
{
  std::ifstream stream(file);
  pt::ptree tree;
  try {
    pt::read_xml(stream, tree, pt::xml_parser::no_comments | pt::xml_parser::trim_whitespace);
  }
  catch (const pt::xml_parser_error &) {
    return std::nullopt;
  }
  return tree;
}

/** The SDF file of a model's folder: the newest that its model.config names. */
fs::path modelFile(const fs::path &found)
{
  if (!fs::is_directory(found)) {
    return found;
  }
  const std::optional<pt::ptree> config = readXml(found / "model.config");
  std::string name = "model.sdf";
  std::string newest;
  for (const auto &[tag, child] : config ? config->get_child("model", pt::ptree()) : pt::ptree()) {
    const std::string version = child.get("<xmlattr>.version", std::string("0"));
    if (tag == "sdf" && version >= newest) {
      newest = version;
      name = child.get_value<std::string>();
    }
  }
  return found / name;
}

/** Makes paths that are relative to `folder` absolute; URIs with a scheme stay. */
void anchorPaths(pt::ptree &element, const fs::path &folder)
{
  for (auto &[tag, child] : element) {
    if (tag == "uri" || tag == "albedo_map") {
      const auto text = child.get_value<std::string>();
      if (text.find("://") == std::string::npos && fs::exists(folder / text)) {
        child.put_value(fs::absolute(folder / text).lexically_normal().string());
      }
    }
    anchorPaths(child, folder);
  }
}

class Expander
{
public:
  Expander(const std::string &version, const SdfPaths &paths) : m_version(version), m_paths(paths)
  {}

  void expand(pt::ptree &element, int depth)
  {
    pt::ptree kept;
    for (auto &[tag, child] : element) {
      if (isInvisible(tag)) {
        continue;
      }
      if (tag == "include" && depth < kDeepest) {
        if (const std::optional<pt::ptree> model = included(child, depth)) {
          kept.push_back({"model", *model});
          continue;
        }
      }
      if (tag != "<xmlattr>") {
        expand(child, depth);
      }
      kept.push_back({tag, child});
    }
    kept.data() = element.data();
    element.swap(kept);
  }

private:
  /** The model that an include means, under the name and pose that it gives. */
  std::optional<pt::ptree> included(const pt::ptree &include, int depth)
  {
    for (const auto &[tag, child] : include) {
      if (tag != "uri" && tag != "name" && tag != "pose" && tag != "static") {
        return std::nullopt;
      }
    }
    std::optional<pt::ptree> model = modelNamed(include.get("uri", std::string()), depth);
    if (!model) {
      return std::nullopt;
    }
    if (const auto name = include.get_optional<std::string>("name")) {
      model->put("<xmlattr>.name", *name);
    }
    for (const char *tag : {"pose", "static"}) {
      if (const auto own = include.get_child_optional(tag)) {
        model->erase(tag);
        model->push_back({tag, *own});
      }
    }
    return model;
  }

  std::optional<pt::ptree> modelNamed(const std::string &uri, int depth)
  {
    const std::optional<fs::path> found = m_paths.find(uri);
    if (!found) {
      return std::nullopt;
    }
    const fs::path file = modelFile(*found);
    const auto known = m_models.find(file);
    if (known != m_models.end()) {
      return known->second;
    }
    std::optional<pt::ptree> model;
    if (const std::optional<pt::ptree> tree = readXml(file)) {
      const bool sameVersion = tree->get("sdf.<xmlattr>.version", std::string()) == m_version;
      const auto element = tree->get_child_optional("sdf.model");
      if (sameVersion && element) {
        model = *element;
        anchorPaths(*model, file.parent_path());
        expand(*model, depth + 1);
      }
    }
    m_models[file] = model;
    return model;
  }

  std::string m_version;
  const SdfPaths &m_paths;
  std::map<fs::path, std::optional<pt::ptree>> m_models; ///< by file; nothing: left to libsdformat
};

} // namespace

void expandIncludes(pt::ptree &element, const std::string &version, const SdfPaths &paths)
{
  Expander(version, paths).expand(element, 0);
}

} // namespace homeward
