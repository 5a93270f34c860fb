#pragma once
#include <placegraph/io/map/map_blobs.h>
#include <placegraph/io/map/map_schema.h>
#include <placegraph/io/map/stored_map.h>

#include <limits>
#include <set>

namespace placegraph {

/// Reads the tables in turn; what refers to others is checked against what has been read.
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
    read_links();
    read_parts();
    read_history();
    read_mergers();
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
  void read_links();
  void read_parts();
  void read_history();
  void read_mergers();
  template <class Read>
  static auto decoded(const SqliteRows& rows, std::string_view bytes, const char* column,
                      Read read);
  static SE3 pose(const SqliteRows& rows, int column, const char* name);
  static Sim3 similarity(const SqliteRows& rows, int column, const char* name);
  static Information symmetric(const SqliteRows& rows, int column, const char* name, int size);
  Keyframe& keyframe_of(const SqliteRows& rows, std::int64_t id, const char* column);
  Place& place_of(const SqliteRows& rows, std::int64_t id, const char* column);
  /// Rows that are counted from 0.
  static void require_next(const SqliteRows& rows, std::size_t expected);

  static constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  SqliteDatabase database_;
  std::int64_t schema_ = 0;
  StoredMap stored_;
  std::set<std::int64_t> parts_;
};

}  // namespace placegraph
