#pragma once
#include <placegraph/io/map/map_blobs.h>
#include <placegraph/io/map/map_history_reader.h>
#include <placegraph/io/map/map_schema.h>
#include <placegraph/io/map/run_reader.h>
#include <placegraph/io/map/stored_map.h>

#include <limits>
#include <memory>

namespace placegraph {

/// Reads the tables in turn; references to other tables are checked against the rows already read.
class MapReader {
 public:
  explicit MapReader(const std::string& path) : opened_(open_present_schema(path)) {}

  StoredMap read() {
    read_origin();
    read_overlays(database_, stored_.origin);
    read_keyframes();
    read_places();
    read_members();
    read_appearances();
    read_views();
    read_thumbnails();
    read_observations();
    read_edges();
    read_frames();
    read_loops();
    read_landmarks();
    read_history(database_, stored_);
    read_judgement(database_, stored_);
    read_run(database_, stored_);
    return std::move(stored_);
  }
  MapOrigin origin() {
    read_origin();
    read_overlays(database_, stored_.origin);
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
  void read_thumbnails();
  void read_observations();
  void read_edges();
  void read_frames();
  void read_loops();
  void read_landmarks();

  static constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  std::unique_ptr<SqliteDatabase> opened_;
  SqliteDatabase& database_ = *opened_;
  StoredMap stored_;
};

}  // namespace placegraph
