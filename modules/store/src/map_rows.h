// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "database.h"

#include <homeward/store/map_file.h>

namespace homeward
{

void writeHeader(Database &database, const MapHeader &header);

/** @throw StoreError when a key is missing or no number where one is needed */
MapHeader readHeader(Database &database);

/** Makes of the rows of `before` those of `after`; the views of what is gone go too. */
void writeDifference(Database &database, const TopologicalMap &before, const TopologicalMap &after);

void writeView(Database &database, const NewView &view);
/** The node has a view. */
void replaceView(Database &database, const NewView &view);

void writeLog(Database &database, const std::vector<LogLine> &lines);
void writeValues(Database &database, const std::map<std::string, std::string> &values);

/** @throw StoreError when the rows break a rule of TopologicalMap */
TopologicalMap readMap(Database &database);

} // namespace homeward
