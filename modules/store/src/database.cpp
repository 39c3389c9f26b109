// SPDX-License-Identifier: GPL-3.0-or-later
#include "database.h"

#include <homeward/core/error.h>

#include <sqlite3.h>

namespace homeward
{

namespace
{

constexpr int kBusyTimeout = 250; // milliseconds to wait for another program's transaction

int openFlags(Database::Mode mode)
{
  switch (mode) {
  case Database::Mode::Create:
    return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  case Database::Mode::ReadWrite:
  case Database::Mode::Read: // what a killed writer left half done must be undone to read the file
    return SQLITE_OPEN_READWRITE;
  }
  throw LogicError("database: unknown mode");
}

std::string explain(int code, const std::string &message)
{
  switch (code & 0xff) {
  case SQLITE_NOTADB:
    return "is not a Homeward map; give a file that `homeward explore` wrote";
  case SQLITE_FULL:
    return "cannot grow, the disk is full; free some space and try again";
  case SQLITE_IOERR:
    return "cannot be read or written (" + message + "); check the disk and its free space";
  case SQLITE_BUSY:
  case SQLITE_LOCKED:
    return "is being written by another program; wait for it to end";
  case SQLITE_READONLY:
  case SQLITE_PERM:
  case SQLITE_CANTOPEN:
    return "cannot be opened (" + message + "); check the permissions of file and folder";
  default:
    return "is damaged (" + message + "); use a copy of it";
  }
}

} // namespace

Database::Database(std::filesystem::path file, Mode mode) : m_file(std::move(file))
{
  const int code = sqlite3_open_v2(m_file.c_str(), &m_handle, openFlags(mode), nullptr);
  if (code != SQLITE_OK) {
    const std::string reason = explain(code, sqlite3_errstr(code));
    sqlite3_close_v2(m_handle);
    throw StoreError("map " + m_file.string() + " " + reason);
  }
  sqlite3_extended_result_codes(m_handle, 1);
  sqlite3_busy_timeout(m_handle, kBusyTimeout);
  if (mode == Mode::Read) {
    execute("PRAGMA query_only = ON");
  }
}

Database::~Database()
{
  sqlite3_close_v2(m_handle);
}

void Database::close()
{
  const int code = sqlite3_close(m_handle);
  if (code != SQLITE_OK) {
    fail(code);
  }
  m_handle = nullptr;
}

void Database::fail(int code) const
{
  throw StoreError("map " + m_file.string() + " " + explain(code, sqlite3_errmsg(m_handle)));
}

void Database::check(int code) const
{
  if (code != SQLITE_OK && code != SQLITE_ROW && code != SQLITE_DONE) {
    fail(code);
  }
}

void Database::execute(const char *sql)
{
  const int code = sqlite3_exec(m_handle, sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) {
    fail(code);
  }
}

Statement Database::prepare(const char *sql)
{
  return {*this, sql};
}

std::int64_t Database::integer(const char *sql)
{
  Statement statement(*this, sql);
  return statement.step() ? statement.integer(0) : 0;
}

std::string Database::text(const char *sql)
{
  Statement statement(*this, sql);
  return statement.step() ? statement.text(0) : "";
}

void Database::reset()
{
  // The way that SQLite's documentation of SQLITE_DBCONFIG_RESET_DATABASE prescribes.
  sqlite3_db_config(m_handle, SQLITE_DBCONFIG_RESET_DATABASE, 1, nullptr);
  execute("VACUUM");
  sqlite3_db_config(m_handle, SQLITE_DBCONFIG_RESET_DATABASE, 0, nullptr);
}

bool Database::inTransaction() const
{
  return sqlite3_get_autocommit(m_handle) == 0;
}

Statement::Statement(Database &database, const char *sql) : m_database(&database)
{
  m_database->check(sqlite3_prepare_v2(database.m_handle, sql, -1, &m_handle, nullptr));
}

Statement::~Statement()
{
  sqlite3_finalize(m_handle);
}

Statement &Statement::bind(std::int64_t value)
{
  m_database->check(sqlite3_bind_int64(m_handle, ++m_bound, value));
  return *this;
}

Statement &Statement::bind(double value)
{
  m_database->check(sqlite3_bind_double(m_handle, ++m_bound, value));
  return *this;
}

Statement &Statement::bind(const std::optional<double> &value)
{
  if (value) {
    return bind(*value);
  }
  m_database->check(sqlite3_bind_null(m_handle, ++m_bound));
  return *this;
}

Statement &Statement::bind(std::string_view value)
{
  // A null pointer would mean NULL, and an empty view may hold one.
  const char *data = value.empty() ? "" : value.data();
  m_database->check(sqlite3_bind_text(m_handle, ++m_bound, data, static_cast<int>(value.size()),
                                      SQLITE_TRANSIENT));
  return *this;
}

Statement &Statement::bind(std::span<const unsigned char> value)
{
  // As above, of an empty vector.
  const unsigned char none = 0;
  m_database->check(sqlite3_bind_blob64(m_handle, ++m_bound, value.empty() ? &none : value.data(),
                                        value.size(), SQLITE_TRANSIENT));
  return *this;
}

bool Statement::step()
{
  const int code = sqlite3_step(m_handle);
  m_database->check(code);
  return code == SQLITE_ROW;
}

void Statement::run()
{
  while (step()) {
  }
  m_database->check(sqlite3_reset(m_handle));
  m_bound = 0;
}

std::int64_t Statement::integer(int column) const
{
  return sqlite3_column_int64(m_handle, column);
}

std::optional<double> Statement::real(int column) const
{
  if (sqlite3_column_type(m_handle, column) == SQLITE_NULL) {
    return std::nullopt;
  }
  return sqlite3_column_double(m_handle, column);
}

std::string Statement::text(int column) const
{
  const unsigned char *data = sqlite3_column_text(m_handle, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(m_handle, column));
  return data == nullptr ? std::string() : std::string(data, data + size);
}

std::vector<unsigned char> Statement::blob(int column) const
{
  const auto *data = static_cast<const unsigned char *>(sqlite3_column_blob(m_handle, column));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(m_handle, column));
  return data == nullptr ? std::vector<unsigned char>()
                         : std::vector<unsigned char>(data, data + size);
}

Transaction::Transaction(Database &database) : m_database(&database)
{
  database.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction()
{
  // SQLite itself rolls back after some failures, a full disk among them.
  if (m_database != nullptr && m_database->inTransaction()) {
    try {
      m_database->execute("ROLLBACK");
    }
    catch (const StoreError &) { // NOLINT(bugprone-empty-catch): the first failure is on its way
    }
  }
}

void Transaction::commit()
{
  m_database->execute("COMMIT");
  m_database = nullptr;
}

MayWrite::MayWrite(Database &database)
    : m_database(database), m_banned(database.integer("PRAGMA query_only") != 0)
{
  m_database.execute("PRAGMA query_only = OFF");
}

MayWrite::~MayWrite()
{
  try {
    if (m_banned) {
      m_database.execute("PRAGMA query_only = ON");
    }
  }
  catch (const std::exception &) { // NOLINT(bugprone-empty-catch): nobody could be told
  }
}

} // namespace homeward
