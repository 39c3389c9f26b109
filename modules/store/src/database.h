// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace homeward
{

class Statement;

/** An open SQLite file; every failure is a StoreError of one line with the file and the reason. */
class Database
{
public:
  enum class Mode
  {
    Create,    ///< made if absent
    ReadWrite, ///< must exist
    Read       ///< must exist
  };

  Database(std::filesystem::path file, Mode mode);
  ~Database();
  Database(const Database &) = delete;
  Database &operator=(const Database &) = delete;

  const std::filesystem::path &file() const { return m_file; }

  /** Runs statements whose rows do not matter. */
  void execute(const char *sql);

  /** First column of the first row. */
  std::int64_t integer(const char *sql);

  /** First column of the first row. */
  std::string text(const char *sql);

  /** One statement with ? for values. */
  Statement prepare(const char *sql);

  /** Throws away every table, even those of a damaged file. */
  void reset();

  /** Closes the file; nothing may be asked any more. */
  void close();

  /** Whether a transaction is open. */
  bool inTransaction() const;

private:
  friend class Statement;
  friend class ChangeRecorder;
  friend bool takeBack(Database &database, std::span<const unsigned char> changes);

  /** @throw StoreError for an SQLite result code */
  [[noreturn]] void fail(int code) const;

  /** @throw StoreError unless the code is one of success */
  void check(int code) const;

  std::filesystem::path m_file;
  sqlite3 *m_handle = nullptr;
};

/** A prepared statement: bind values in order, then step through its rows. */
class Statement
{
public:
  Statement(Database &database, const char *sql);
  ~Statement();
  Statement(const Statement &) = delete;
  Statement &operator=(const Statement &) = delete;

  Statement &bind(std::int64_t value);
  Statement &bind(double value);
  Statement &bind(const std::optional<double> &value);
  Statement &bind(std::string_view value);
  Statement &bind(std::span<const unsigned char> value);

  /** Goes to the next row; false when there is none. */
  bool step();

  /** Steps to the end and makes the statement ready for new values. */
  void run();

  std::int64_t integer(int column) const;
  std::optional<double> real(int column) const; ///< nothing for NULL
  std::string text(int column) const;
  std::vector<unsigned char> blob(int column) const;

private:
  Database *m_database;
  sqlite3_stmt *m_handle = nullptr;
  int m_bound = 0;
};

/** Rolls back unless committed. */
class Transaction
{
public:
  explicit Transaction(Database &database);
  ~Transaction();
  Transaction(const Transaction &) = delete;
  Transaction &operator=(const Transaction &) = delete;

  void commit();

private:
  Database *m_database;
};

/** Lifts a reader's ban on writing while it lives: SQLite's holds for other files too. */
class MayWrite
{
public:
  explicit MayWrite(Database &database);
  ~MayWrite();
  MayWrite(const MayWrite &) = delete;
  MayWrite &operator=(const MayWrite &) = delete;

private:
  Database &m_database;
  bool m_banned;
};

} // namespace homeward
