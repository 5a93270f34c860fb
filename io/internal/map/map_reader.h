#pragma once
#include <placegraph/io/internal/map/map_blobs.h>
#include <placegraph/io/internal/map/map_history_reader.h>
#include <placegraph/io/internal/map/map_schema.h>
#include <placegraph/io/map/stored_map.h>

#include <limits>

namespace placegraph {

/// Reads the tables in turn; references to other tables are checked against the rows already read.
class MapReader {
 public:
  explicit MapReader(const std::string& path) : database_(path, SqliteDatabase::Access::kRead) {
    check_map_schema(database_);
    schema_ = database_.integer("PRAGMA user_version");
  }

  StoredMap read() {
    read_origin();
    read_keyframes();
    read_places();
    read_members();
    read_appearances();
    read_views();
    read_edges();
    read_frames();
    read_loops();
    read_landmarks();
    read_history(database_, stored_);
    return std::move(stored_);
  }
  MapOrigin origin() {
    read_origin();
    return stored_.origin;
  }

 private:
  void read_origin();
  void read_camera(std::int64_t id, Camera& camera);
  void read_keyframes();
  void read_features();
  void read_places();
  void read_members();
  void read_appearances();
  void read_views();
  void read_edges();
  void read_frames();
  void read_loops();
  void read_landmarks();

  static constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  SqliteDatabase database_;
  std::int64_t schema_ = 0;
  StoredMap stored_;
};

}  // namespace placegraph
