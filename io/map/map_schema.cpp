#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_schema.h>
#include <placegraph/io/map/stored_map.h>

#include <filesystem>
#include <string>
#include <vector>

namespace placegraph {
namespace {

constexpr std::int64_t kApplication = 0x50476d70;  // "PGmp"

constexpr const char* kTables = R"(
CREATE TABLE origin (
  id INTEGER PRIMARY KEY CHECK (id = 1), sequence TEXT NOT NULL, sensor INTEGER NOT NULL,
  options TEXT NOT NULL, view_options TEXT NOT NULL, lens_k1 REAL NOT NULL,
  lens_pass INTEGER NOT NULL, baseline_m REAL, camera_height_m REAL, T_cam_depth BLOB,
  depth_sigma_at_1m REAL, metric INTEGER NOT NULL, median_depth_m REAL NOT NULL,
  founded INTEGER NOT NULL, judged_loops INTEGER NOT NULL, finished INTEGER NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE camera (
  id INTEGER PRIMARY KEY, width INTEGER NOT NULL, height INTEGER NOT NULL, fx REAL NOT NULL,
  fy REAL NOT NULL, cx REAL NOT NULL, cy REAL NOT NULL, distortion INTEGER NOT NULL,
  d1 REAL NOT NULL, d2 REAL NOT NULL, d3 REAL NOT NULL, d4 REAL NOT NULL, d5 REAL NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE place (
  id INTEGER PRIMARY KEY, anchor_keyframe INTEGER NOT NULL REFERENCES keyframe (id),
  component INTEGER NOT NULL, T_map_place BLOB NOT NULL, scale REAL NOT NULL, reach REAL,
  last_keyframe INTEGER, checksum INTEGER NOT NULL);
CREATE TABLE label (
  place INTEGER NOT NULL REFERENCES place (id), position INTEGER NOT NULL, label TEXT NOT NULL,
  checksum INTEGER NOT NULL, PRIMARY KEY (place, position)) WITHOUT ROWID;
CREATE TABLE appearance (
  place INTEGER PRIMARY KEY REFERENCES place (id), words INTEGER NOT NULL, data BLOB NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE keyframe (
  id INTEGER PRIMARY KEY, frame INTEGER NOT NULL, stamp_ns INTEGER NOT NULL,
  place INTEGER NOT NULL REFERENCES place (id), T_place_keyframe BLOB NOT NULL,
  scale REAL NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE features (
  keyframe INTEGER PRIMARY KEY REFERENCES keyframe (id), count INTEGER NOT NULL,
  data BLOB NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE view (
  keyframe INTEGER PRIMARY KEY REFERENCES keyframe (id), data BLOB NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE edge (
  kind INTEGER NOT NULL, number INTEGER NOT NULL, from_place INTEGER NOT NULL REFERENCES place (id),
  to_place INTEGER NOT NULL REFERENCES place (id), source INTEGER NOT NULL, kernel INTEGER NOT NULL,
  kernel_width REAL NOT NULL, motion BLOB NOT NULL, information BLOB NOT NULL,
  checksum INTEGER NOT NULL, PRIMARY KEY (kind, number)) WITHOUT ROWID;
CREATE TABLE frame (
  number INTEGER PRIMARY KEY, frame INTEGER NOT NULL, stamp_ns INTEGER NOT NULL,
  keyframe INTEGER NOT NULL, T_keyframe_frame BLOB, inliers INTEGER NOT NULL, confidence REAL,
  reason TEXT NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE online (
  number INTEGER PRIMARY KEY, stamp_ns INTEGER NOT NULL, T_map_cam BLOB,
  checksum INTEGER NOT NULL);
CREATE TABLE loop (
  number INTEGER PRIMARY KEY, query_frame INTEGER NOT NULL, match_frame INTEGER NOT NULL,
  inliers INTEGER NOT NULL, accepted INTEGER NOT NULL, stage TEXT NOT NULL,
  T_match_query BLOB NOT NULL, model TEXT NOT NULL, lines INTEGER NOT NULL,
  similarity REAL NOT NULL, probability REAL NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE landmarks (
  number INTEGER PRIMARY KEY, count INTEGER NOT NULL, data BLOB NOT NULL, colours BLOB,
  covariances BLOB, checksum INTEGER NOT NULL);
CREATE TABLE link (
  keyframe INTEGER PRIMARY KEY REFERENCES keyframe (id), segment INTEGER NOT NULL,
  track_segment INTEGER NOT NULL REFERENCES track_segment (number),
  from_keyframe INTEGER REFERENCES keyframe (id), T_from_this BLOB, information BLOB,
  source INTEGER, sigma_log_scale REAL, scale REAL, checksum INTEGER NOT NULL);
CREATE TABLE segment (
  anchor INTEGER PRIMARY KEY REFERENCES keyframe (id),
  place INTEGER NOT NULL REFERENCES place (id), S_place_segment BLOB NOT NULL,
  covariance BLOB NOT NULL, motion_covariance BLOB, checksum INTEGER NOT NULL);
CREATE TABLE motion (
  number INTEGER PRIMARY KEY, from_segment INTEGER NOT NULL REFERENCES segment (anchor),
  to_segment INTEGER NOT NULL REFERENCES segment (anchor), T_from_to BLOB NOT NULL,
  covariance BLOB NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE loop_constraint (
  number INTEGER PRIMARY KEY, query INTEGER NOT NULL REFERENCES keyframe (id),
  match INTEGER NOT NULL REFERENCES keyframe (id), S_match_query BLOB NOT NULL,
  information BLOB NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE merged (
  number INTEGER PRIMARY KEY, anchor INTEGER NOT NULL REFERENCES segment (anchor),
  checksum INTEGER NOT NULL);
CREATE TABLE merged_segment (
  number INTEGER PRIMARY KEY, merged INTEGER NOT NULL REFERENCES merged (number),
  segment INTEGER NOT NULL REFERENCES segment (anchor), covariance BLOB NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE separated (
  number INTEGER PRIMARY KEY, one INTEGER NOT NULL REFERENCES keyframe (id),
  other INTEGER NOT NULL REFERENCES keyframe (id), checksum INTEGER NOT NULL);
CREATE TABLE track_segment (
  number INTEGER PRIMARY KEY, scale_measured INTEGER NOT NULL, checksum INTEGER NOT NULL);
)";

// What schema 3 has and schema 2 has not.
constexpr const char* kTables3 = R"(
CREATE TABLE observations (
  keyframe INTEGER PRIMARY KEY REFERENCES keyframe (id), count INTEGER NOT NULL,
  data BLOB NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE thumbnail (
  keyframe INTEGER PRIMARY KEY REFERENCES keyframe (id), data BLOB NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE inertial_state (
  keyframe INTEGER PRIMARY KEY REFERENCES keyframe (id), v_map_body BLOB NOT NULL,
  gyroscope_bias BLOB NOT NULL, accelerometer_bias BLOB NOT NULL, covariance BLOB,
  checksum INTEGER NOT NULL);
CREATE TABLE judgement (
  id INTEGER PRIMARY KEY CHECK (id = 1), verdict TEXT NOT NULL, metric INTEGER NOT NULL,
  why_metric TEXT NOT NULL, expected_drift_m REAL, checksum INTEGER NOT NULL);
CREATE TABLE finding (
  number INTEGER PRIMARY KEY, cause TEXT NOT NULL, text TEXT NOT NULL,
  doubts_scale INTEGER NOT NULL, advice TEXT NOT NULL, checksum INTEGER NOT NULL);
CREATE VIEW frame_component AS
  SELECT frame.number AS number, place.component AS component FROM frame
  JOIN keyframe ON keyframe.id = frame.keyframe JOIN place ON place.id = keyframe.place
  WHERE frame.T_keyframe_frame IS NOT NULL;
CREATE VIEW component AS
  SELECT component AS number, count(*) AS posed, min(number) AS first_frame,
    max(number) AS last_frame
  FROM frame_component GROUP BY component;
)";

// What schema 4 has and schema 3 has not: what a run learns besides its map.
constexpr const char* kTables4 = R"(
CREATE TABLE overlay (
  number INTEGER PRIMARY KEY, mask BLOB NOT NULL, cause TEXT NOT NULL, text TEXT NOT NULL,
  doubts_scale INTEGER NOT NULL, advice TEXT NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE evidence (
  id INTEGER PRIMARY KEY CHECK (id = 1), data BLOB NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE note (
  number INTEGER PRIMARY KEY, cause TEXT NOT NULL, text TEXT NOT NULL,
  doubts_scale INTEGER NOT NULL, advice TEXT NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE odometry_error (
  id INTEGER PRIMARY KEY CHECK (id = 1), independent BLOB NOT NULL, shared BLOB NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE stage (
  number INTEGER PRIMARY KEY, name TEXT NOT NULL, cpu_s REAL NOT NULL, calls INTEGER NOT NULL,
  checksum INTEGER NOT NULL);
)";

// Schema 2 added columns, schema 3 the checksums, the new tables and present names.
constexpr const char* kTo2 = R"(
ALTER TABLE frame ADD COLUMN inliers INTEGER NOT NULL DEFAULT 0;
ALTER TABLE loop ADD COLUMN model TEXT NOT NULL DEFAULT 'none';
ALTER TABLE loop ADD COLUMN lines INTEGER NOT NULL DEFAULT 0;
ALTER TABLE loop ADD COLUMN likeness REAL NOT NULL DEFAULT 0;
ALTER TABLE loop ADD COLUMN probability REAL NOT NULL DEFAULT 0;
)";
constexpr const char* kTo3 = R"(
ALTER TABLE loop RENAME COLUMN likeness TO similarity;
ALTER TABLE part RENAME TO segment;
ALTER TABLE segment RENAME COLUMN S_place_part TO S_place_segment;
ALTER TABLE run RENAME TO track_segment;
ALTER TABLE track_segment RENAME COLUMN unit_measured TO scale_measured;
ALTER TABLE link RENAME COLUMN part TO segment;
ALTER TABLE link RENAME COLUMN run TO track_segment;
ALTER TABLE motion RENAME COLUMN from_part TO from_segment;
ALTER TABLE motion RENAME COLUMN to_part TO to_segment;
ALTER TABLE revisit RENAME TO loop_constraint;
ALTER TABLE merged_part RENAME TO merged_segment;
ALTER TABLE merged_segment RENAME COLUMN part TO segment;
ALTER TABLE parted RENAME TO separated;
ALTER TABLE frame ADD COLUMN confidence REAL;
ALTER TABLE frame ADD COLUMN reason TEXT NOT NULL DEFAULT '';
ALTER TABLE landmarks ADD COLUMN colours BLOB;
ALTER TABLE landmarks ADD COLUMN covariances BLOB;
)";

std::vector<std::string> tables_of(SqliteDatabase& database) {
  std::vector<std::string> tables;
  SqliteRows rows(database, "sqlite_master", "name", "WHERE type = 'table' ORDER BY name");
  while (rows.next()) tables.emplace_back(rows.text(0));
  return tables;
}

/// The columns of a table that its checksum covers, with commas between them.
std::string covered_columns(SqliteDatabase& database, const std::string& table) {
  std::string list;
  for (const std::string& column : database.columns(table))
    if (column != "checksum") list += (list.empty() ? "" : ", ") + column;
  return list;
}

/// SQLite fills a last page that is cut off with zeros. Of a map that is being written the newest
/// pages are in its log.
void check_whole(SqliteDatabase& database) {
  const std::string& path = database.path();
  if (std::filesystem::exists(path + "-wal")) return;
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(path));
  const std::int64_t whole =
      database.integer("PRAGMA page_count") * database.integer("PRAGMA page_size");
  if (bytes < whole)
    throw FileError(path, "is cut off: it has " + std::to_string(bytes) + " of " +
                              std::to_string(whole) + " bytes");
}

}  // namespace

void create_map_tables(SqliteDatabase& database) {
  database.execute("PRAGMA page_size = 16384");
  database.execute("PRAGMA application_id = " + std::to_string(kApplication));
  database.execute("PRAGMA user_version = " + std::to_string(kMapSchema));
  database.execute(kTables);
  database.execute(kTables3);
  database.execute(kTables4);
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
  const std::int64_t version = database.integer("PRAGMA user_version");
  if (version >= kMapSchema) return;
  database.execute("BEGIN");
  if (version < 2) database.execute(kTo2);
  if (version < 3) {
    database.execute(kTo3);
    for (const std::string& table : tables_of(database)) {
      database.execute("ALTER TABLE " + table + " ADD COLUMN checksum INTEGER NOT NULL DEFAULT 0");
      update_checksums(database, table);
    }
    database.execute(kTables3);
  }
  database.execute(kTables4);
  database.execute("PRAGMA user_version = " + std::to_string(kMapSchema));
  database.execute("COMMIT");
}

std::unique_ptr<SqliteDatabase> open_present_schema(const std::string& path) {
  auto database = std::make_unique<SqliteDatabase>(path, SqliteDatabase::Access::kRead);
  check_map_schema(*database);
  check_whole(*database);
  if (database->integer("PRAGMA user_version") == kMapSchema) return database;
  auto copy = database->copy_in_memory();
  upgrade_map_schema(*copy);
  return copy;
}

void update_checksums(SqliteDatabase& database, const std::string& table) {
  database.execute("UPDATE " + table + " SET checksum = row_checksum(" +
                   covered_columns(database, table) + ")");
}

void check_checksums(SqliteDatabase& database) {
  for (const std::string& table : tables_of(database)) {
    const std::string covered = covered_columns(database, table);
    SqliteRows rows(database, table, database.columns(table).front(),
                    "WHERE checksum IS NOT row_checksum(" + covered + ") LIMIT 1");
    if (rows.next()) rows.refuse("its bytes have changed since it was written (checksum)");
  }
}

}  // namespace placegraph
