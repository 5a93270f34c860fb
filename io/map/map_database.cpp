#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/map/map_writer.h>

#include <filesystem>

namespace placegraph {
namespace {

namespace fs = std::filesystem;

void remove_with_journal(const std::string& path) {
  for (const char* ending : {"", "-wal", "-shm", "-journal"}) fs::remove(path + ending);
}

/// The path that a map of that name is written to: the target of a link; only a plain file is
/// allowed.
std::string target_of(const std::string& path) {
  std::error_code ignored;
  const std::string target =
      fs::is_symlink(path, ignored) ? fs::weakly_canonical(path).string() : path;
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored))
    throw FileError(path, "cannot be written: is not a plain file");
  return target;
}

/// Replaces `path` with `fresh`, which is closed. The newest commits of the old map are in its log,
/// which must not be left beside the new one: they are moved into the old file first, so that a
/// whole map is there at any moment.
void replace(const std::string& fresh, const std::string& path) {
  if (fs::exists(path + "-wal") && fs::is_regular_file(path))
    SqliteDatabase(path, SqliteDatabase::Access::kWrite).merge_log();
  for (const char* ending : {"-wal", "-shm", "-journal"}) fs::remove(path + ending);
  replace_file(fresh, path);
}

/// Path of the file of a restarted run.
std::string restarted_map_path(const std::string& path) { return path + ".restart"; }

void insert_camera(SqliteDatabase& database, std::int64_t id, const Camera& camera) {
  SqliteStatement put(database, MapTable::put_sql("camera", 13));
  put << id << std::int64_t{camera.width} << std::int64_t{camera.height} << camera.fx << camera.fy
      << camera.cx << camera.cy << static_cast<std::int64_t>(camera.distortion);
  for (const double coefficient : camera.coefficients) put << coefficient;
  put.run();
}

/// Replaces origin and cameras.
void write_origin(SqliteDatabase& database, const MapOrigin& origin) {
  database.execute("DELETE FROM origin");
  database.execute("DELETE FROM camera");
  SqliteStatement put(
      database, "INSERT INTO origin VALUES (1, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, 0, 10, 0, 0, 0, 0)");
  put.text(origin.sequence) << static_cast<std::int64_t>(origin.sensor);
  put.text(origin.options).text(origin.view_options);
  put << origin.lens_k1 << std::int64_t{origin.lens_pass};
  const auto& calibration = origin.calibration;
  std::string T_cam_depth;
  calibration ? put << calibration->baseline_m : put.null();
  calibration && calibration->camera_height_m ? put << *calibration->camera_height_m : put.null();
  if (calibration && calibration->depth) {
    BlobWriter(T_cam_depth).pose(calibration->depth->T_cam_depth);
    put.blob(T_cam_depth) << calibration->depth->sigma_at_1m;
  } else {
    put.null().null();
  }
  put.run();
  update_checksums(database, "origin");
  MapTable overlays(database, "overlay", "number", 6);
  std::int64_t number = 0;
  for (const MaskedOverlay& overlay : origin.overlays)
    overlays.write(number++, MapRow().blob(encode_png(overlay.mask)).note(overlay.note));
  if (!calibration) return;
  insert_camera(database, 1, calibration->camera);
  if (calibration->depth) insert_camera(database, 2, calibration->depth->camera);
}

}  // namespace

MapDatabase::MapDatabase(std::unique_ptr<MapWriter> writer) : writer_(std::move(writer)) {}
MapDatabase::MapDatabase(MapDatabase&&) noexcept = default;
MapDatabase& MapDatabase::operator=(MapDatabase&&) noexcept = default;
MapDatabase::~MapDatabase() = default;

std::unique_ptr<MapWriter> MapDatabase::made(const std::string& path, const MapOrigin& origin,
                                             const RunRecord& run) {
  // The file is created under another name, so that it has all of this when it appears.
  const std::string fresh = path + ".new";
  remove_with_journal(fresh);
  {
    SqliteDatabase database(fresh, SqliteDatabase::Access::kCreate);
    database.execute("PRAGMA synchronous = OFF");
    create_map_tables(database);
    database.execute("BEGIN");
    write_origin(database, origin);
    database.execute("COMMIT");
  }
  if (!run.stages.empty()) {
    MapWriter writer(fresh);
    MapChanges changes;
    changes.run = run;
    writer.commit(changes, false);
    writer.database.text("PRAGMA journal_mode = DELETE");
  }
  replace(fresh, path);
  return std::make_unique<MapWriter>(path);
}

MapDatabase MapDatabase::create(const std::string& path, const MapOrigin& origin) {
  const std::string target = target_of(path);
  MapDatabase database(made(target, origin, {}));
  remove_with_journal(restarted_map_path(target));
  return database;
}

MapDatabase MapDatabase::open(const std::string& path) {
  const std::string target = target_of(path), current = interrupted_map_path(path);
  MapDatabase database(std::make_unique<MapWriter>(current));
  if (current != target) database.keep(target);
  return database;
}

void MapDatabase::keep(const std::string& path) {
  SqliteDatabase kept(path, SqliteDatabase::Access::kRead);
  kept_path_ = path;
  kept_frames_ = static_cast<std::size_t>(kept.integer("SELECT count(*) FROM frame"));
}

void MapDatabase::commit(const MapChanges& changes) {
  writer_->commit(changes, false);
  if (kept_path_.empty() || changes.first_frame + changes.frames.size() < kept_frames_) return;
  writer_.reset();
  const std::string path = kept_path_;
  replace_kept();
  writer_ = std::make_unique<MapWriter>(path);
}

void MapDatabase::restart(const MapOrigin& origin, const RunRecord& run) {
  const std::string path = writer_->database.path();
  writer_.reset();
  if (kept_path_.empty()) keep(path);
  writer_ = made(restarted_map_path(kept_path_), origin, run);
}

void MapDatabase::finish(const MapChanges& changes) {
  writer_->commit(changes, true);
  writer_->database.text("PRAGMA journal_mode = DELETE");  // everything into the one file
  writer_.reset();
  if (!kept_path_.empty()) replace_kept();
}

void MapDatabase::replace_kept() {
  replace(restarted_map_path(kept_path_), kept_path_);
  kept_path_.clear();
}

void MapDatabase::close() { writer_.reset(); }

std::string interrupted_map_path(const std::string& path) {
  const std::string target = target_of(path), restarted = restarted_map_path(target);
  return fs::exists(restarted) ? restarted : target;
}

void write_judgement(const std::string& path, const Judgement& judgement) {
  SqliteDatabase database(path, SqliteDatabase::Access::kWrite);
  check_map_schema(database);
  upgrade_map_schema(database);
  database.execute("BEGIN IMMEDIATE; DELETE FROM judgement; DELETE FROM finding");
  MapRow row;
  row.text(to_string(judgement.verdict)).integer(judgement.metric).text(judgement.why_metric);
  const bool drift = judgement.metric && judgement.expected_drift_m;
  drift ? row.real(*judgement.expected_drift_m) : row.null();
  MapTable(database, "judgement", "id", 5).write(1, row);
  SqliteStatement origin(database, "UPDATE origin SET metric = ?");
  origin << std::int64_t{judgement.metric};
  origin.run();
  update_checksums(database, "origin");
  MapTable findings(database, "finding", "number", 5);
  std::int64_t number = 0;
  for (const DataNote& finding : judgement.findings)
    findings.write(number++, MapRow().note(finding));
  database.execute("COMMIT");
}

void write_map(const std::string& path, const StoredMap& stored) {
  const Map& map = stored.map;
  MapChanges changes;
  changes.places = map.place_graph.places;
  for (const Place& place : map.place_graph.places)
    if (!place.appearance.words.empty())
      changes.appearances.emplace_back(place.id, place.appearance);
  std::int64_t number = 0;
  for (const RelativePoseConstraint& constraint : map.place_graph.constraints)
    changes.constraints.push_back({0, number++, constraint});
  changes.keyframes = map.keyframes;
  for (const Keyframe& keyframe : map.keyframes)
    if (!keyframe.observations.empty())
      changes.observations.emplace_back(keyframe.id, keyframe.observations);
  changes.frames = map.frames;
  changes.online = map.trajectory_online.poses;
  changes.landmarks = map.landmarks;
  changes.loops = map.loops;
  changes.history = stored.history;
  changes.metric = map.metric;
  changes.run = stored.run;
  const std::string target = target_of(path), fresh = target + ".part";
  try {
    // The file appears only when it is complete.
    MapDatabase database(MapDatabase::made(fresh, stored.origin, {}));
    if (stored.finished) {
      database.finish(changes);
      if (stored.judgement) write_judgement(fresh, *stored.judgement);
    } else {
      database.commit(changes);
      database.close();
    }
  } catch (...) {
    remove_with_journal(fresh);
    throw;
  }
  replace(fresh, target);
}

}  // namespace placegraph
