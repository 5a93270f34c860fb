#pragma once
#include <placegraph/graph/map_changes.h>
#include <placegraph/graph/measurements/frame.h>

#include <memory>
#include <optional>
#include <string>

namespace placegraph {

struct StoredMap;

/// Version of the tables (`PRAGMA user_version`): one that is newer is refused.
constexpr int kMapSchema = 2;

/// What a map was made from, and how.
struct MapOrigin {
  std::string sequence;  ///< as it can be opened again
  Sensor sensor = Sensor::kMono;
  std::optional<Calibration> calibration;  ///< without one no pose of the map means anything
  std::string options;                     ///< of the run, YAML
  std::string view_options;                ///< of the keyframes' views, YAML
  double lens_k1 = 0;                      ///< radial distortion that was taken out of the images
  int lens_pass = 0;                       ///< how many times the run has begun anew to do so
};

/// Everything of a map that is saved.
struct StoredMap {
  MapOrigin origin;
  Map map;
  PlaceHistory history;  ///< empty for a map that no run can go on with
  bool finished = true;  ///< false: the run that made it was broken off
};

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
  struct Impl;
  explicit MapDatabase(std::unique_ptr<Impl> impl);
  static std::unique_ptr<Impl> made(const std::string& path, const MapOrigin& origin,
                                    bool synchronized);
  std::unique_ptr<Impl> impl_;
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
