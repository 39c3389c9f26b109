// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "database.h"

#include <homeward/store/map_file.h>

namespace homeward
{

/** Makes the tables of a new map and marks the file as one. */
void createTables(Database &database);

/** @throw StoreError unless the file is a sound map of a version that can be read */
void checkTables(Database &database);

/** Brings a map of an older version to today's, all or nothing; for files opened to be written. */
void migrateTables(Database &database);

void writeHeader(Database &database, const MapHeader &header);

/** @throw StoreError when a key is missing or no number where one is needed */
MapHeader readHeader(Database &database);

void writeChange(Database &database, const MapChange &change);
void writeView(Database &database, const NewView &view);
void writeLog(Database &database, const std::vector<LogLine> &lines);
void writeValues(Database &database, const std::map<std::string, std::string> &values);

/** @throw StoreError when the rows break a rule of TopologicalMap */
TopologicalMap readMap(Database &database);

} // namespace homeward
