#pragma once
#include <placegraph/io/map/stored_map.h>

#include <memory>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

struct MapWriter;

/// A saved map that is being written: one SQLite file (docs/map.md). A commit is a transaction and
/// writes only what has changed; whatever ends the program between or in commits, the file holds
/// what the last one wrote. While it is open the file belongs to this object alone, and its newest
/// part may stand in PATH-wal beside it; finish() makes it one file.
///
/// Throws FileError, with the file, if it cannot be written.
class MapDatabase {
 public:
  /// A new one, without content; takes the place of a file that is there.
  static MapDatabase create(const std::string& path, const MapOrigin& origin);
  /// One that was broken off, to go on writing. Throws FileError for a file that is no saved map.
  static MapDatabase open(const std::string& path);
  MapDatabase(MapDatabase&&) noexcept;
  MapDatabase& operator=(MapDatabase&&) noexcept;
  ~MapDatabase();

  void commit(const MapChanges& changes);
  /// Nothing of the map is kept: its run begins anew with this origin.
  void clear(const MapOrigin& origin);
  /// The last commit. Nothing can be written afterwards.
  void finish(const MapChanges& changes);
  void close();

 private:
  friend void write_map(const std::string& path, const StoredMap& stored);
  explicit MapDatabase(std::unique_ptr<MapWriter> writer);
  static std::unique_ptr<MapWriter> made(const std::string& path, const MapOrigin& origin,
                                         bool synchronized);
  std::unique_ptr<MapWriter> writer_;  ///< none once it is closed
};

/// Writes a whole map at once. Throws ArgumentError if the members of its places are not the
/// keyframes that hang on them, anchor first, then by id.
void write_map(const std::string& path, const StoredMap& stored);

/// Reads and checks everything: every reference, size and number. Throws FileError, one line with
/// file, table and row, for a map that is damaged, FileError with its version for a newer one, and
/// says so of a file that is no saved map.
StoredMap read_map(const std::string& path);

/// Of the same, where it comes from.
MapOrigin read_map_origin(const std::string& path);

/// SQLite's own check of the file; what it finds, or "ok".
std::string check_map_file(const std::string& path);

/// Whether a file of this name is a saved map whose run was broken off.
bool is_unfinished_map(const std::string& path);

/// Bytes of the tables' blobs, for those who ask where the size comes from.
struct MapSizes {
  std::int64_t schema = 0, file_bytes = 0, features_bytes = 0, views_bytes = 0, landmarks_bytes = 0;
};
MapSizes map_sizes(const std::string& path);

}  // namespace placegraph
