#pragma once
#include <placegraph/io/internal/map/sqlite.h>

namespace placegraph {

/// Creates the tables of a saved map (docs/map.md).
void create_map_tables(SqliteDatabase& database);
/// Throws FileError unless the database is a saved map of a supported schema.
void check_map_schema(SqliteDatabase& database);
/// Upgrades the tables of an older schema to the present one; missing data become zero.
void upgrade_map_schema(SqliteDatabase& database);
/// Names of all tables but `origin` and `camera`.
constexpr const char* kMapTables[] = {
    "place",   "label",  "appearance",  "keyframe",  "features", "view", "edge",
    "frame",   "online", "loop",        "landmarks", "link",     "part", "motion",
    "revisit", "merged", "merged_part", "parted",    "run"};

}  // namespace placegraph
