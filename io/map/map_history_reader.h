#pragma once
#include <placegraph/io/map/stored_map.h>

namespace placegraph {

class SqliteDatabase;

/// Reads the tables that are needed to continue a map (runs, links, parts, motions, revisits,
/// mergers) into `stored.history`; keyframes and places of the map must have been read. Throws
/// FileError that names the table and row of contradictory data.
void read_history(SqliteDatabase& database, StoredMap& stored);

}  // namespace placegraph
