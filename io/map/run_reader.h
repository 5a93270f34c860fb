#pragma once
#include <placegraph/io/map/stored_map.h>

namespace placegraph {

class SqliteDatabase;

// What a run says besides its map. FileError names the file, the table, the row and the column.

/// Reads the static overlays that the run masks.
void read_overlays(SqliteDatabase& database, MapOrigin& origin);
/// Reads notes, errors and times of the run.
void read_run(SqliteDatabase& database, StoredMap& stored);
/// Reads the judgement of the run, if there is one.
void read_judgement(SqliteDatabase& database, StoredMap& stored);

}  // namespace placegraph
