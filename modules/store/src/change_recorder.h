// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "database.h"

struct sqlite3_session;

namespace homeward
{

/** Records what becomes of the graph and the pictures of a map file from now on (SQLite's
 * sessions). */
class ChangeRecorder
{
public:
  explicit ChangeRecorder(Database &database);
  ~ChangeRecorder();
  ChangeRecorder(const ChangeRecorder &) = delete;
  ChangeRecorder &operator=(const ChangeRecorder &) = delete;

  /** All of it as a changeset; empty when nothing changed. */
  std::vector<unsigned char> changes() const;

private:
  Database *m_database;
  sqlite3_session *m_session = nullptr;
};

/**
 * Takes back what a changeset did.
 * @return false, with nothing changed, when the rows are no longer as it left them
 * @throw StoreError when the changeset or the file is damaged
 */
bool takeBack(Database &database, std::span<const unsigned char> changes);

} // namespace homeward
