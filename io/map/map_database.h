#pragma once
#include <placegraph/io/map/stored_map.h>

#include <memory>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

struct MapWriter;

/// A saved map that is being written: one SQLite file (docs/map.md).
///
/// A commit is a transaction and writes only what has changed; whatever ends the program between or
/// in commits, the file holds what the last complete one wrote. While it is open the file belongs
/// to this object alone, and its newest part may stand in PATH-wal beside it; finish() makes it one
/// file. Throws FileError, with the file, if it cannot be written.
class MapDatabase {
 public:
  /// Creates a map without content; replaces a file that is there.
  static MapDatabase create(const std::string& path, const MapOrigin& origin);
  /// Opens a map whose run was broken off, to go on writing.
  ///
  /// Throws FileError for a file that is no saved map.
  static MapDatabase open(const std::string& path);
  MapDatabase(MapDatabase&&) noexcept;
  MapDatabase& operator=(MapDatabase&&) noexcept;
  ~MapDatabase();

  /// Writes the changes since the last commit (Slam::take_changes) in one transaction.
  void commit(const MapChanges& changes);
  /// Deletes the content of the map: its run begins again with this origin.
  void clear(const MapOrigin& origin);
  /// Writes the last changes, marks the map as finished and closes the file.
  void finish(const MapChanges& changes);
  /// Closes the file; without finish() before, the map stays marked as broken off.
  void close();

 private:
  friend void write_map(const std::string& path, const StoredMap& stored);
  explicit MapDatabase(std::unique_ptr<MapWriter> writer);
  static std::unique_ptr<MapWriter> made(const std::string& path, const MapOrigin& origin,
                                         bool synchronized);
  std::unique_ptr<MapWriter> writer_;  ///< none once it is closed
};

/// Writes a whole map at once; nobody sees the file before it is complete.
///
/// Throws ArgumentError if the members of a place are not the keyframes that name it, anchor first,
/// then by id; FileError if the file cannot be written.
void write_map(const std::string& path, const StoredMap& stored);

/// Reads a saved map and checks everything: every reference, size and number.
///
/// Throws FileError, one line with file, table and row, for a map that is damaged; with its version
/// for a newer one; and for a file that is no saved map.
StoredMap read_map(const std::string& path);

/// Reads only where a saved map comes from. Throws FileError as read_map.
MapOrigin read_map_origin(const std::string& path);

/// Runs SQLite's own integrity check; returns what it finds, or "ok".
///
/// Throws FileError for a file that is no saved map.
std::string check_map_file(const std::string& path);

/// Whether a file of this name is a saved map whose run was broken off.
///
/// False if there is no such file; throws FileError for a file that is no saved map.
bool is_unfinished_map(const std::string& path);

/// Where the size of a saved map comes from.
struct MapSizes {
  /// Version of the tables; bytes of the file and of the data in three of its tables.
  std::int64_t schema = 0, file_bytes = 0, features_bytes = 0, views_bytes = 0, landmarks_bytes = 0;
};
/// Reads version and sizes of a saved map. Throws FileError for a file that is none.
MapSizes map_sizes(const std::string& path);

}  // namespace placegraph
