#pragma once
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_blobs.h>
#include <placegraph/io/map/sqlite.h>
#include <placegraph/io/map/stored_map.h>

#include <string>

// Columns of the rows of a map, checked: FileError names the file, the table, the row and the
// column.
namespace placegraph {

/// The result of `read` for all bytes of a column.
template <class Read>
auto decoded(const SqliteRows& rows, std::string_view bytes, const char* column, Read read) {
  try {
    BlobReader reader(bytes);
    auto value = read(reader);
    reader.end();
    return value;
  } catch (const ArgumentError& error) {
    rows.refuse(std::string(column) + ": " + error.what());
  }
}

SE3 pose_column(const SqliteRows& rows, int column, const char* name);
Sim3 similarity_column(const SqliteRows& rows, int column, const char* name);
/// A symmetric matrix of `size` rows.
Information symmetric_column(const SqliteRows& rows, int column, const char* name, int size);

/// The keyframe, or place, of the map that a column names by its id, a number of the file.
Keyframe& keyframe_of(StoredMap& stored, const SqliteRows& rows, std::int64_t id,
                      const char* column);
Place& place_of(StoredMap& stored, const SqliteRows& rows, std::int64_t id, const char* column);

/// Checks that the row number in the first column, from 0, is `expected`.
void require_next(const SqliteRows& rows, std::size_t expected);

}  // namespace placegraph
