#pragma once
#include <placegraph/io/internal/map/sqlite.h>

namespace placegraph {

/// Makes the tables of a saved map (docs/map.md).
void create_map_tables(SqliteDatabase& database);
/// Throws FileError unless the database is a saved map of a schema this program knows.
void check_map_schema(SqliteDatabase& database);
/// Brings the tables of an older schema up to the present one; what they did not tell is zero.
void upgrade_map_schema(SqliteDatabase& database);
/// Names of all tables but `origin` and `camera`.
constexpr const char* kMapTables[] = {
    "place",   "label",  "appearance",  "keyframe",  "features", "view", "edge",
    "frame",   "online", "loop",        "landmarks", "link",     "part", "motion",
    "revisit", "merged", "merged_part", "parted",    "run"};

}  // namespace placegraph
