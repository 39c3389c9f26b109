// SPDX-License-Identifier: GPL-3.0-or-later
#define SQLITE_ENABLE_SESSION 1        // NOLINT: sqlite3.h asks for it
#define SQLITE_ENABLE_PREUPDATE_HOOK 1 // NOLINT: sqlite3.h asks for it
#include "change_recorder.h"

#include <sqlite3.h>

#include <memory>

namespace homeward
{

namespace
{

constexpr const char *kRecorded[] = {"node", "direction", "edge", "view"};

struct FreeBySqlite
{
  void operator()(void *memory) const { sqlite3_free(memory); }
};

using SqliteMemory = std::unique_ptr<void, FreeBySqlite>;

int refuseConflict(void *, int, sqlite3_changeset_iter *)
{
  return SQLITE_CHANGESET_ABORT;
}

} // namespace

ChangeRecorder::ChangeRecorder(Database &database) : m_database(&database)
{
  database.check(sqlite3session_create(database.m_handle, "main", &m_session));
  for (const char *table : kRecorded) {
    const int code = sqlite3session_attach(m_session, table);
    if (code != SQLITE_OK) {
      sqlite3session_delete(m_session);
      database.fail(code);
    }
  }
}

ChangeRecorder::~ChangeRecorder()
{
  sqlite3session_delete(m_session);
}

std::vector<unsigned char> ChangeRecorder::changes() const
{
  int size = 0;
  void *data = nullptr;
  m_database->check(sqlite3session_changeset(m_session, &size, &data));
  const SqliteMemory owner(data);
  const auto *bytes = static_cast<const unsigned char *>(data);
  return {bytes, bytes + size};
}

bool takeBack(Database &database, std::span<const unsigned char> changes)
{
  int size = 0;
  void *inverse = nullptr;
  database.check(
      sqlite3changeset_invert(static_cast<int>(changes.size()), changes.data(), &size, &inverse));
  const SqliteMemory owner(inverse);
  const int code =
      sqlite3changeset_apply(database.m_handle, size, inverse, nullptr, refuseConflict, nullptr);
  if (code == SQLITE_ABORT) {
    return false;
  }
  database.check(code);
  return true;
}

} // namespace homeward
