#include <placegraph/graph/core/error.h>
#include <placegraph/io/internal/map/map_schema.h>
#include <placegraph/io/map/stored_map.h>

namespace placegraph {
namespace {

constexpr std::int64_t kApplication = 0x50476d70;  // "PGmp"

constexpr const char* kTables = R"(
CREATE TABLE origin (
  id INTEGER PRIMARY KEY CHECK (id = 1), sequence TEXT NOT NULL, sensor INTEGER NOT NULL,
  options TEXT NOT NULL, view_options TEXT NOT NULL, lens_k1 REAL NOT NULL,
  lens_pass INTEGER NOT NULL, baseline_m REAL, camera_height_m REAL, T_cam_depth BLOB,
  depth_sigma_at_1m REAL, metric INTEGER NOT NULL, median_depth_m REAL NOT NULL,
  founded INTEGER NOT NULL, judged_loops INTEGER NOT NULL, finished INTEGER NOT NULL);
CREATE TABLE camera (
  id INTEGER PRIMARY KEY, width INTEGER NOT NULL, height INTEGER NOT NULL, fx REAL NOT NULL,
  fy REAL NOT NULL, cx REAL NOT NULL, cy REAL NOT NULL, distortion INTEGER NOT NULL,
  d1 REAL NOT NULL, d2 REAL NOT NULL, d3 REAL NOT NULL, d4 REAL NOT NULL, d5 REAL NOT NULL);
CREATE TABLE place (
  id INTEGER PRIMARY KEY, anchor_keyframe INTEGER NOT NULL REFERENCES keyframe (id),
  component INTEGER NOT NULL, T_map_place BLOB NOT NULL, scale REAL NOT NULL, reach REAL,
  last_keyframe INTEGER);
CREATE TABLE label (
  place INTEGER NOT NULL REFERENCES place (id), position INTEGER NOT NULL, label TEXT NOT NULL,
  PRIMARY KEY (place, position)) WITHOUT ROWID;
CREATE TABLE appearance (
  place INTEGER PRIMARY KEY REFERENCES place (id), words INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE keyframe (
  id INTEGER PRIMARY KEY, frame INTEGER NOT NULL, stamp_ns INTEGER NOT NULL,
  place INTEGER NOT NULL REFERENCES place (id), T_place_keyframe BLOB NOT NULL,
  scale REAL NOT NULL);
CREATE TABLE features (
  keyframe INTEGER PRIMARY KEY REFERENCES keyframe (id), count INTEGER NOT NULL,
  data BLOB NOT NULL);
CREATE TABLE view (
  keyframe INTEGER PRIMARY KEY REFERENCES keyframe (id), data BLOB NOT NULL);
CREATE TABLE edge (
  kind INTEGER NOT NULL, number INTEGER NOT NULL, from_place INTEGER NOT NULL REFERENCES place (id),
  to_place INTEGER NOT NULL REFERENCES place (id), source INTEGER NOT NULL, kernel INTEGER NOT NULL,
  kernel_width REAL NOT NULL, motion BLOB NOT NULL, information BLOB NOT NULL,
  PRIMARY KEY (kind, number)) WITHOUT ROWID;
CREATE TABLE frame (
  number INTEGER PRIMARY KEY, frame INTEGER NOT NULL, stamp_ns INTEGER NOT NULL,
  keyframe INTEGER NOT NULL, T_keyframe_frame BLOB, inliers INTEGER NOT NULL DEFAULT 0);
CREATE TABLE online (number INTEGER PRIMARY KEY, stamp_ns INTEGER NOT NULL, T_map_cam BLOB);
CREATE TABLE loop (
  number INTEGER PRIMARY KEY, query_frame INTEGER NOT NULL, match_frame INTEGER NOT NULL,
  inliers INTEGER NOT NULL, accepted INTEGER NOT NULL, stage TEXT NOT NULL,
  T_match_query BLOB NOT NULL, model TEXT NOT NULL DEFAULT 'none', lines INTEGER NOT NULL DEFAULT 0,
  likeness REAL NOT NULL DEFAULT 0, probability REAL NOT NULL DEFAULT 0);
CREATE TABLE landmarks (number INTEGER PRIMARY KEY, count INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE link (
  keyframe INTEGER PRIMARY KEY REFERENCES keyframe (id), part INTEGER NOT NULL,
  run INTEGER NOT NULL REFERENCES run (number), from_keyframe INTEGER REFERENCES keyframe (id),
  T_from_this BLOB, information BLOB, source INTEGER, sigma_log_scale REAL, scale REAL);
CREATE TABLE part (
  anchor INTEGER PRIMARY KEY REFERENCES keyframe (id),
  place INTEGER NOT NULL REFERENCES place (id), S_place_part BLOB NOT NULL,
  covariance BLOB NOT NULL, motion_covariance BLOB);
CREATE TABLE motion (
  number INTEGER PRIMARY KEY, from_part INTEGER NOT NULL REFERENCES part (anchor),
  to_part INTEGER NOT NULL REFERENCES part (anchor), T_from_to BLOB NOT NULL,
  covariance BLOB NOT NULL);
CREATE TABLE revisit (
  number INTEGER PRIMARY KEY, query INTEGER NOT NULL REFERENCES keyframe (id),
  match INTEGER NOT NULL REFERENCES keyframe (id), S_match_query BLOB NOT NULL,
  information BLOB NOT NULL);
CREATE TABLE merged (
  number INTEGER PRIMARY KEY, anchor INTEGER NOT NULL REFERENCES part (anchor));
CREATE TABLE merged_part (
  number INTEGER PRIMARY KEY, merged INTEGER NOT NULL REFERENCES merged (number),
  part INTEGER NOT NULL REFERENCES part (anchor), covariance BLOB NOT NULL);
CREATE TABLE parted (
  number INTEGER PRIMARY KEY, one INTEGER NOT NULL REFERENCES keyframe (id),
  other INTEGER NOT NULL REFERENCES keyframe (id));
CREATE TABLE run (number INTEGER PRIMARY KEY, unit_measured INTEGER NOT NULL);
)";

}  // namespace

void create_map_tables(SqliteDatabase& database) {
  database.execute("PRAGMA page_size = 16384");
  database.execute("PRAGMA application_id = " + std::to_string(kApplication));
  database.execute("PRAGMA user_version = " + std::to_string(kMapSchema));
  database.execute(kTables);
}

void check_map_schema(SqliteDatabase& database) {
  if (database.integer("PRAGMA application_id") != kApplication)
    throw FileError(database.path(), "is a database, but no saved map");
  const std::int64_t version = database.integer("PRAGMA user_version");
  if (version > kMapSchema)
    throw FileError(database.path(), "is a map of schema " + std::to_string(version) +
                                         "; this program reads up to " +
                                         std::to_string(kMapSchema));
  if (version < 1)
    throw FileError(database.path(),
                    "is a map of schema " + std::to_string(version) + ", which does not exist");
}

void upgrade_map_schema(SqliteDatabase& database) {
  if (database.integer("PRAGMA user_version") >= 2) return;
  database.execute(
      "BEGIN; ALTER TABLE frame ADD COLUMN inliers INTEGER NOT NULL DEFAULT 0;"
      "ALTER TABLE loop ADD COLUMN model TEXT NOT NULL DEFAULT 'none';"
      "ALTER TABLE loop ADD COLUMN lines INTEGER NOT NULL DEFAULT 0;"
      "ALTER TABLE loop ADD COLUMN likeness REAL NOT NULL DEFAULT 0;"
      "ALTER TABLE loop ADD COLUMN probability REAL NOT NULL DEFAULT 0;"
      "PRAGMA user_version = 2; COMMIT");
}

}  // namespace placegraph
