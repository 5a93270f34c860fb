#pragma once
// Inside io only.
#include <placegraph/graph/core/ids.h>
#include <placegraph/io/map/map_blobs.h>
#include <placegraph/io/map/map_history_writer.h>
#include <placegraph/io/map/map_schema.h>
#include <placegraph/io/map/map_table.h>
#include <placegraph/io/map/stored_map.h>

#include <map>
#include <string>
#include <vector>

namespace placegraph {

/// The open file of a MapDatabase: its tables, and the rows that are already written.
struct MapWriter {
  explicit MapWriter(const std::string& path)
      : database(path, SqliteDatabase::Access::kWrite),
        places(prepared(), "place", "id", 7),
        labels(database, "label", "place", 3),
        appearances(database, "appearance", "place", 3),
        keyframes(database, "keyframe", "id", 6),
        features(database, "features", "keyframe", 3),
        views(database, "view", "keyframe", 2),
        thumbnails(database, "thumbnail", "keyframe", 2),
        observations(database, "observations", "keyframe", 3),
        frames(database, "frame", "number", 8),
        online(database, "online", "number", 3),
        loops(database, "loop", "number", 11),
        landmarks(database, "landmarks", "number", 5),
        history(database),
        notes(database, "note", "number", 5),
        odometry_error(database, "odometry_error", "id", 3),
        stages(database, "stage", "number", 4),
        put_edge(database, MapTable::put_sql("edge", 9)),
        erase_edge(database, "DELETE FROM edge WHERE kind = ? AND number = ?") {
    places.take_keys(database, "id place");
    notes.take_keys(database, "number note");
    odometry_error.take_keys(database, "id odometry_error");
    SqliteRows known(database, "keyframe", "id, frame, stamp_ns");
    while (known.next())
      keyframe_times[KeyframeId(known.integer(0))] = {FrameId(known.integer(1)), known.integer(2)};
  }

  /// Prepares the database: an exclusive lock and a write-ahead log. A commit appends to the log
  /// without waiting for the disk; if the program is killed, all committed data are in the file.
  SqliteDatabase& prepared() {
    database.execute("PRAGMA locking_mode = EXCLUSIVE");
    check_map_schema(database);
    database.text("PRAGMA journal_mode = WAL");
    upgrade_map_schema(database);
    // A power cut, unlike a kill, may lose the last commits, but leaves the file intact.
    database.execute("PRAGMA synchronous = NORMAL");
    return database;
  }

  /// Writes all of `changes` in one transaction, or nothing.
  void commit(const MapChanges& changes, bool finished);
  void put_places(const MapChanges& changes);
  void put_keyframes(const MapChanges& changes);
  void put_observations(const MapChanges& changes);
  void put_frames(const MapChanges& changes);
  void put_constraints(const MapChanges& changes);
  void put_landmarks(const MapChanges& changes);
  void put_run(const RunRecord& run);

  SqliteDatabase database;
  MapTable places, labels, appearances, keyframes, features, views, thumbnails, observations,
      frames, online, loops, landmarks;
  MapHistoryWriter history;
  MapTable notes, odometry_error, stages;
  SqliteStatement put_edge, erase_edge;
  std::map<KeyframeId, std::pair<FrameId, std::int64_t>> keyframe_times;  // frame, stamp
  std::map<PlaceId, std::vector<std::string>> written_labels;
};

}  // namespace placegraph
