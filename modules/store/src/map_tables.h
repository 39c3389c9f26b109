// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "database.h"

namespace homeward
{

/** Makes the tables of a new map and marks the file as one. */
void createTables(Database &database);

/** Which version of the tables a file has. */
std::int64_t tableVersion(Database &database);

/** @throw StoreError unless the file is a map of a version that can be read */
void checkVersion(Database &database);

/** What is wrong with the pages and with rows that name others, one line each; empty: nothing. */
std::vector<std::string> tableFindings(Database &database);

/** Brings a map of an older version to today's, all or nothing; for files opened to be written. */
void migrateTables(Database &database);

/** @throw StoreError: the file is damaged */
[[noreturn]] void damaged(const Database &database, const std::string &why);

} // namespace homeward
