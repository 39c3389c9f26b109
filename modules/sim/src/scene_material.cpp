// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_material.h"

#include "shading_colour.h"

#include <sdf/Element.hh>
#include <sdf/Material.hh>
#include <sdf/Pbr.hh>

#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

namespace homeward
{

namespace
{

struct NamedColour
{
  const char *name;
  Eigen::Vector3f coded; ///< sRGB-coded
};

Eigen::Vector3f toEigen(const ignition::math::Color &colour)
{
  return {colour.R(), colour.G(), colour.B()};
}

/** What a material script says of one material. */
struct ScriptMaterial
{
  std::optional<Eigen::Vector3f> diffuse; ///< sRGB-coded
  std::string texture;
};

/** Reads the first diffuse colour and texture of `material NAME { ... }` in an Ogre script. */
std::optional<ScriptMaterial> parseScript(std::istream &script, const std::string &name)
{
  std::optional<ScriptMaterial> found;
  int depth = 0;
  for (std::string line; std::getline(script, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (depth == 0 && word == "material") {
      if (found) {
        return found;
      }
      std::string other;
      words >> other;
      if (other == name) {
        found.emplace();
      }
    }
    else if (found && word == "diffuse" && !found->diffuse) {
      Eigen::Vector3f colour;
      if (words >> colour.x() >> colour.y() >> colour.z()) {
        found->diffuse = colour;
      }
    }
    else if (found && word == "texture" && found->texture.empty()) {
      words >> found->texture;
    }
    for (const char c : line) {
      depth += c == '{' ? 1 : (c == '}' ? -1 : 0);
    }
  }
  return found;
}

/** The material scripts that a URI means: a file, or all in a folder. */
std::vector<fs::path> scriptFiles(const fs::path &path)
{
  std::vector<fs::path> files;
  if (fs::is_regular_file(path)) {
    files.push_back(path);
  }
  std::error_code ignored;
  for (const fs::directory_entry &entry : fs::directory_iterator(path, ignored)) {
    if (entry.path().extension() == ".material") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> scriptUris(const sdf::Material &source)
{
  std::vector<std::string> uris;
  const sdf::ElementPtr script =
      source.Element() == nullptr ? nullptr : source.Element()->FindElement("script");
  for (sdf::ElementPtr uri = script == nullptr ? nullptr : script->FindElement("uri");
       uri != nullptr; uri = uri->GetNextElement("uri")) {
    uris.push_back(uri->Get<std::string>());
  }
  return uris;
}

} // namespace

std::optional<Eigen::Vector3f> gazeboColour(const std::string &name)
{
  // Diffuse colours of Gazebo 11's gazebo.material; textured ones by their mean.
  static const std::vector<NamedColour> kColours = {{"Grey", {0.7F, 0.7F, 0.7F}},
                                                    {"DarkGrey", {0.175F, 0.175F, 0.175F}},
                                                    {"DarkGray", {0.175F, 0.175F, 0.175F}},
                                                    {"Gray", {0.7F, 0.7F, 0.7F}},
                                                    {"LightGrey", {0.85F, 0.85F, 0.85F}},
                                                    {"White", {1.0F, 1.0F, 1.0F}},
                                                    {"FlatBlack", {0.1F, 0.1F, 0.1F}},
                                                    {"Black", {0.05F, 0.05F, 0.05F}},
                                                    {"Red", {1.0F, 0.0F, 0.0F}},
                                                    {"RedBright", {0.87F, 0.26F, 0.07F}},
                                                    {"Green", {0.0F, 1.0F, 0.0F}},
                                                    {"Blue", {0.0F, 0.0F, 1.0F}},
                                                    {"SkyBlue", {0.13F, 0.44F, 0.70F}},
                                                    {"Yellow", {1.0F, 1.0F, 0.0F}},
                                                    {"ZincYellow", {0.97F, 0.95F, 0.20F}},
                                                    {"DarkYellow", {0.7F, 0.7F, 0.0F}},
                                                    {"Purple", {1.0F, 0.0F, 1.0F}},
                                                    {"Turquoise", {0.0F, 1.0F, 1.0F}},
                                                    {"Orange", {1.0F, 0.51F, 0.04F}},
                                                    {"Indigo", {0.33F, 0.0F, 0.5F}},
                                                    {"Gold", {0.8F, 0.65F, 0.2F}},
                                                    {"Bricks", {0.55F, 0.35F, 0.27F}},
                                                    {"Wood", {0.60F, 0.43F, 0.25F}},
                                                    {"WoodFloor", {0.60F, 0.45F, 0.30F}},
                                                    {"WoodPallet", {0.65F, 0.5F, 0.33F}},
                                                    {"WoodTile", {0.55F, 0.40F, 0.26F}},
                                                    {"Road", {0.25F, 0.25F, 0.26F}},
                                                    {"Residential", {0.40F, 0.40F, 0.41F}},
                                                    {"Grass", {0.30F, 0.45F, 0.20F}},
                                                    {"CeilingTiled", {0.80F, 0.80F, 0.78F}},
                                                    {"PaintedWall", {0.75F, 0.72F, 0.65F}},
                                                    {"Asphalt", {0.25F, 0.25F, 0.26F}},
                                                    {"Pioneer2Body", {0.5F, 0.0F, 0.0F}},
                                                    {"Rockwall", {0.5F, 0.48F, 0.45F}}};
  const std::string plain = name.starts_with("Gazebo/") ? name.substr(7) : name;
  for (const NamedColour &colour : kColours) {
    if (plain == colour.name) {
      return toLinear(colour.coded);
    }
  }
  return std::nullopt;
}

std::optional<Material> SceneMaterials::findInScripts(const sdf::Material &source,
                                                      const std::string &model)
{
  for (const std::string &uri : scriptUris(source)) {
    const std::optional<fs::path> place = m_paths.find(uri, source.FilePath());
    if (!place) {
      continue;
    }
    for (const fs::path &file : scriptFiles(*place)) {
      std::ifstream stream(file);
      const std::optional<ScriptMaterial> script = parseScript(stream, source.ScriptName());
      if (!script) {
        continue;
      }
      Material material;
      if (!script->texture.empty()) {
        material.texture = m_textures.load(script->texture, file, model);
      }
      if (material.texture >= 0) {
        material.diffuse.setOnes();
      }
      else if (script->diffuse) {
        material.diffuse = toLinear(*script->diffuse);
      }
      return material;
    }
  }
  return std::nullopt;
}

std::optional<Material> SceneMaterials::readScript(const sdf::Material &source,
                                                   const std::string &model)
{
  if (const std::optional<Material> material = findInScripts(source, model)) {
    return material;
  }
  Material material;
  const std::optional<Eigen::Vector3f> colour = gazeboColour(source.ScriptName());
  if (!colour) {
    m_scene.problems.push_back("model '" + model + "': material '" + source.ScriptName() +
                               "' not found; drawn in a plain colour");
  }
  material.diffuse = colour.value_or(material.diffuse);
  return material;
}

std::optional<Material> SceneMaterials::read(const sdf::Visual &visual, const std::string &model)
{
  const sdf::Material *source = visual.Material();
  if (source == nullptr) {
    return std::nullopt;
  }
  const sdf::ElementPtr element = source->Element();
  const auto says = [&](const char *key) { return element && element->HasElement(key); };
  std::optional<Material> material;
  const sdf::PbrWorkflow *pbr = source->PbrMaterial() == nullptr
                                    ? nullptr
                                    : source->PbrMaterial()->Workflow(sdf::PbrWorkflowType::METAL);
  if (pbr != nullptr && !pbr->AlbedoMap().empty()) {
    material.emplace();
    const std::optional<fs::path> file = m_paths.find(pbr->AlbedoMap(), source->FilePath());
    material->texture =
        m_textures.load(file ? file->string() : pbr->AlbedoMap(), source->FilePath(), model);
    material->diffuse.setOnes();
  }
  else if (!source->ScriptName().empty()) {
    material = readScript(*source, model);
  }
  else if (says("diffuse") || says("ambient")) {
    material.emplace();
    material->diffuse = toLinear(toEigen(says("diffuse") ? source->Diffuse() : source->Ambient()));
  }
  if (material && says("emissive")) {
    material->emissive = toLinear(toEigen(source->Emissive()));
  }
  if (material && says("diffuse")) {
    material->opacity = source->Diffuse().A();
  }
  return material;
}

} // namespace homeward
