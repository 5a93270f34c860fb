#pragma once
#include <placegraph/io/map/stored_map.h>

namespace placegraph {

class SqliteDatabase;

/// Reads the tables that a map is gone on with (runs, links, parts, motions, revisits, mergers)
/// into `stored.history`; keyframes and places of the map must have been read. Throws FileError
/// naming the table and row of what contradicts them.
void read_history(SqliteDatabase& database, StoredMap& stored);

}  // namespace placegraph
