#pragma once
#include <placegraph/io/map/stored_map.h>

#include <memory>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

struct MapWriter;

/// A saved map that is being written: one SQLite file (docs/map.md).
///
/// A commit is a transaction and writes only what has changed. If the program ends between or
/// during commits, the file contains the state of the last complete commit. While the file is open,
/// no other program can use it, and its newest part may be in PATH-wal beside it; finish() merges
/// both into one file. Throws FileError, which names the file, if it cannot be written.
///
/// A run that restarts writes PATH.restart beside the file, which keeps its content until the
/// restarted run has as many frames; then PATH.restart takes its place.
class MapDatabase {
 public:
  /// Creates an empty map; an existing file is replaced.
  static MapDatabase create(const std::string& path, const MapOrigin& origin);
  /// Opens the map of an interrupted run to continue writing, at interrupted_map_path().
  ///
  /// Throws FileError for a file that is not a saved map.
  static MapDatabase open(const std::string& path);
  MapDatabase(MapDatabase&&) noexcept;
  MapDatabase& operator=(MapDatabase&&) noexcept;
  ~MapDatabase();

  /// Writes the changes since the last commit (Slam::take_changes) in one transaction, which also
  /// removes a judgement of the map before.
  void commit(const MapChanges& changes);
  /// Begins an empty map, as the run restarts with this origin; `run`: its report until now.
  void restart(const MapOrigin& origin, const RunRecord& run);
  /// Writes the last changes, marks the map as finished and closes the file.
  void finish(const MapChanges& changes);
  /// Closes the file; without an earlier finish(), the map remains marked as unfinished.
  void close();

 private:
  friend void write_map(const std::string& path, const StoredMap& stored);
  explicit MapDatabase(std::unique_ptr<MapWriter> writer);
  static std::unique_ptr<MapWriter> made(const std::string& path, const MapOrigin& origin,
                                         const RunRecord& run);
  void keep(const std::string& path);
  void replace_kept();
  std::unique_ptr<MapWriter> writer_;  ///< null after close()
  std::string kept_path_;              ///< the map that a restarted run will replace; empty: none
  std::size_t kept_frames_ = 0;        ///< number of its frames
};

/// Path of the file with which the interrupted run of a map goes on.
///
/// It is `path`, or that of the restarted run as long as this is the shorter one.
std::string interrupted_map_path(const std::string& path);

/// Writes a whole map at once; the file appears only when it is complete.
///
/// Throws ArgumentError if the members of a place are not the keyframes that name it, anchor first,
/// then by id; FileError if the file cannot be written.
void write_map(const std::string& path, const StoredMap& stored);

/// Writes the judgement of the run of a saved map; replaces an earlier one.
///
/// It decides whether the lengths of the map are metres. The run may have been interrupted.
/// Throws FileError for a file that is not a saved map or cannot be written.
void write_judgement(const std::string& path, const Judgement& judgement);

/// Reads a saved map and checks everything: every reference, size and number.
///
/// Throws FileError, one line with file, table and row, for a map that is damaged; with its version
/// for a newer one; and for a file that is not a saved map.
StoredMap read_map(const std::string& path);

/// Reads only the origin of a saved map. Throws FileError as read_map.
MapOrigin read_map_origin(const std::string& path);

/// Runs SQLite's own integrity check; returns what it finds first, in one line, or "ok".
///
/// Throws FileError for a file that is not a saved map.
std::string check_map_file(const std::string& path);

/// Compares every row of a saved map with its checksum.
///
/// Throws FileError, with table and row, where a byte of a row has changed since it was written.
/// Maps of schema 1 and 2 have no checksums.
void check_map_checksums(const std::string& path);

/// Whether a file of this name is the saved map of an interrupted run.
///
/// False if there is no such file; throws FileError for a file that is not a saved map.
bool is_unfinished_map(const std::string& path);

/// Version of a saved map, and the sizes of its parts.
struct MapSizes {
  /// Version of the tables; bytes of the file and of the data in three of its tables.
  std::int64_t schema = 0, file_bytes = 0, features_bytes = 0, views_bytes = 0, landmarks_bytes = 0;
};
/// Reads version and sizes of a saved map. Throws FileError for any other file.
MapSizes map_sizes(const std::string& path);

}  // namespace placegraph
