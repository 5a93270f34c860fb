#pragma once
#include <placegraph/io/map/sqlite.h>

#include <memory>
#include <string>

namespace placegraph {

/// Creates the tables of a saved map (docs/map.md).
void create_map_tables(SqliteDatabase& database);
/// Throws FileError unless the database is a saved map of a supported schema.
void check_map_schema(SqliteDatabase& database);
/// Upgrades the tables of an older schema to the present one; missing data become zero or NULL.
void upgrade_map_schema(SqliteDatabase& database);
/// Opens a saved map for reading in the present schema: one of an older schema as an upgraded copy
/// in memory. Throws as check_map_schema.
std::unique_ptr<SqliteDatabase> open_present_schema(const std::string& path);
/// Computes the checksums of all rows of a table again.
void update_checksums(SqliteDatabase& database, const std::string& table);
/// Throws FileError with table and row of the first row whose checksum differs from its content.
void check_checksums(SqliteDatabase& database);

}  // namespace placegraph
