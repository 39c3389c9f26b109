// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/store/node_views.h>

#include <algorithm>

namespace homeward
{

NodeViews::NodeViews(const MapFile &file, std::size_t capacity)
    : m_file(&file), m_capacity(capacity), m_pictureChanges(file.pictureChanges())
{
  if (capacity == 0) {
    throw LogicError("node views: capacity 0, at least 1 is needed");
  }
}

Panorama NodeViews::operator()(NodeId node)
{
  if (m_file->pictureChanges() != m_pictureChanges) {
    m_recent.clear();
    m_pictureChanges = m_file->pictureChanges();
  }
  const auto known = std::find_if(m_recent.begin(), m_recent.end(),
                                  [&](const auto &entry) { return entry.first == node; });
  if (known != m_recent.end()) {
    m_recent.splice(m_recent.begin(), m_recent, known);
    return m_recent.front().second;
  }
  m_recent.emplace_front(node, m_file->panorama(node));
  if (m_recent.size() > m_capacity) {
    m_recent.pop_back();
  }
  return m_recent.front().second;
}

} // namespace homeward
