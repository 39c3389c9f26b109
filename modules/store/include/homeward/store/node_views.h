// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/store/map_file.h>

#include <list>
#include <utility>

namespace homeward
{

/** The pictures of a map's places, read when asked for; the latest ones stay in memory. */
class NodeViews
{
public:
  /** @param file must outlive this; @param capacity pictures kept, 1 or more (LogicError) */
  explicit NodeViews(const MapFile &file, std::size_t capacity = 32);

  /** The picture of a node; its pixels are shared, do not write to them. Throws as MapFile::view()
   */
  Panorama operator()(NodeId node);

private:
  const MapFile *m_file;
  std::size_t m_capacity;
  std::int64_t m_pictureChanges;                   ///< of the file, when the pictures were read
  std::list<std::pair<NodeId, Panorama>> m_recent; ///< latest first
};

} // namespace homeward
