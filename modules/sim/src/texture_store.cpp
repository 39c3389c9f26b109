// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture_store.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cctype>

namespace fs = std::filesystem;

namespace homeward
{

namespace
{

std::string lowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/** The model's folder: the nearest above `file` with a description in it. */
fs::path modelFolder(const fs::path &file)
{
  for (fs::path folder = file.parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    if (fs::exists(folder / "model.config") || fs::exists(folder / "model.sdf")) {
      return folder;
    }
  }
  return file.parent_path();
}

} // namespace

const TextureStore::FileIndex &TextureStore::filesBelow(const fs::path &folder)
{
  const auto [entry, isNew] = m_indices.try_emplace(folder);
  if (isNew) {
    std::error_code ignored;
    std::vector<fs::path> files;
    for (fs::recursive_directory_iterator it(folder, ignored), end; it != end;
         it.increment(ignored)) {
      if (it->is_regular_file(ignored)) {
        files.push_back(it->path());
      }
    }
    std::sort(files.begin(), files.end()); // the first of equal names, wherever it runs
    for (const fs::path &file : files) {
      entry->second.try_emplace(lowerCase(file.filename().string()), file);
    }
  }
  return entry->second;
}

std::optional<fs::path> TextureStore::find(const std::string &named, const fs::path &besideFile)
{
  const fs::path path = named;
  const fs::path direct = path.is_absolute() ? path : besideFile.parent_path() / path;
  if (fs::is_regular_file(direct)) {
    return direct.lexically_normal();
  }
  const std::string name = lowerCase(path.filename().string());
  const fs::path model = modelFolder(besideFile);
  const fs::path family = model.parent_path();
  std::vector<fs::path> folders{model};
  if (family.filename() == "models") {
    folders.insert(folders.end(), {family, family.parent_path() / "photos"});
  }
  for (const fs::path &folder : folders) {
    const FileIndex &files = filesBelow(folder);
    const auto found = files.find(name);
    if (found != files.end()) {
      return found->second;
    }
  }
  return std::nullopt;
}

int TextureStore::add(const std::string &key, const cv::Mat &picture, const std::string &model)
{
  int index = -1;
  if (picture.empty()) {
    m_scene.problems.push_back("model '" + model + "': texture '" + key +
                               "' cannot be read; drawn in a plain colour");
  }
  else {
    index = static_cast<int>(m_scene.textures.size());
    m_scene.textures.push_back(makeTexture(picture));
  }
  m_loaded[key] = index;
  return index;
}

int TextureStore::load(const std::string &named, const fs::path &besideFile,
                       const std::string &model)
{
  std::string name = named.starts_with("file://") ? named.substr(7) : named;
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::optional<fs::path> file = find(name, besideFile);
  if (!file) {
    m_scene.problems.push_back("model '" + model + "': texture '" + named +
                               "' not found; drawn in a plain colour");
    return -1;
  }
  const auto known = m_loaded.find(file->string());
  if (known != m_loaded.end()) {
    return known->second;
  }
  return add(file->string(), cv::imread(file->string(), cv::IMREAD_COLOR), model);
}

int TextureStore::decode(const std::vector<unsigned char> &bytes, const std::string &named,
                         const fs::path &besideFile, const std::string &model)
{
  const std::string key = besideFile.string() + ":" + named;
  const auto known = m_loaded.find(key);
  return known != m_loaded.end() ? known->second
                                 : add(key, cv::imdecode(bytes, cv::IMREAD_COLOR), model);
}

} // namespace homeward
