// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/store/map_file.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <unistd.h>

#include <string>

namespace homeward
{

/** A folder of its own for each test, removed at the end. */
class StoreTest : public ::testing::Test
{
protected:
  StoreTest()
  {
    const auto *info = ::testing::UnitTest::GetInstance()->current_test_info();
    m_folder = std::filesystem::temp_directory_path() /
               ("homeward-" + std::to_string(::getpid()) + "-" + info->name());
    std::filesystem::create_directories(m_folder);
  }

  ~StoreTest() override { std::filesystem::remove_all(m_folder); }

  StoreTest(const StoreTest &) = delete;
  StoreTest &operator=(const StoreTest &) = delete;

  std::filesystem::path folder() const { return m_folder; }
  std::filesystem::path path() const { return m_folder / "test.hwm"; }

  /** Names of the files in the folder, in order. */
  std::vector<std::string> files() const
  {
    std::vector<std::string> names;
    for (const auto &entry : std::filesystem::directory_iterator(m_folder)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

private:
  std::filesystem::path m_folder;
};

inline MapHeader smallHeader()
{
  return {"00c0ffee00c0ffee", {32, 8, -0.75, 0.5}, "histogram", 2, {{"same_place", 0.125}}};
}

/** A picture that tells its seed. */
inline Panorama smallPanorama(int seed, int type = CV_8UC1)
{
  Panorama panorama{cv::Mat(8, 32, type), smallHeader().panorama};
  for (int v = 0; v < 8; ++v) {
    for (int u = 0; u < 32 * panorama.image.channels(); ++u) {
      panorama.image.ptr(v)[u] = static_cast<unsigned char>((40 * seed + 3 * u + 10 * v) % 256);
    }
  }
  return panorama;
}

/** Node `id` with one driven and one open direction, and its view. */
inline MapUpdate nodeUpdate(std::int64_t id)
{
  return {
      .changes = {NodeAdded{
          {{id},
           {{{0}, 0.1 + static_cast<double>(id), 0.25, DirectionState::Driven, "came from there"},
            {{1}, -1.0 / 3.0, 0.5}}}}},
      .view = NewView{{id}, encodeView(smallPanorama(static_cast<int>(id)))},
      .log = {{static_cast<double>(id), "node " + std::to_string(id)}}};
}

/** Nodes 0 to 2, a way 0 - 1 - 2, and node 1's open direction closed. */
inline void fill(MapFile &file)
{
  file.append(nodeUpdate(0));
  file.append(nodeUpdate(1));
  file.append({.changes = {EdgeAdded{{{0}, {0}, {1}, 0.5, -2.0}}}});
  file.append(nodeUpdate(2));
  file.append({.changes = {EdgeAdded{{{1}, {2}, {1}, 1.5, std::nullopt}},
                           DirectionSettled{{1}, {1}, DirectionState::Closed, "blocked"}},
               .values = {{"at_node", "2"}}});
}

} // namespace homeward
