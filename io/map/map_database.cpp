#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_writer.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace placegraph {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLandmarksARow = 1000;

void remove_with_journal(const std::string& path) {
  for (const char* ending : {"", "-wal", "-shm", "-journal"}) fs::remove(path + ending);
}

/// Where a map of that name is written: what a link names, never what is no plain file.
std::string target_of(const std::string& path) {
  std::error_code ignored;
  const std::string target =
      fs::is_symlink(path, ignored) ? fs::weakly_canonical(path).string() : path;
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored))
    throw FileError(path, "cannot be written: is no plain file");
  return target;
}

/// Puts `fresh` in the place of `path`, at no time without either; the log of the old one goes.
void replace(const std::string& fresh, const std::string& path) {
  for (const char* ending : {"-wal", "-shm", "-journal"}) fs::remove(path + ending);
  std::error_code code;
  fs::rename(fresh, path, code);
  if (code) throw FileError(path, "cannot be written: " + code.message());
}

void insert_camera(SqliteDatabase& database, std::int64_t id, const Camera& camera) {
  SqliteStatement put(database,
                      "INSERT INTO camera VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  put << id << std::int64_t{camera.width} << std::int64_t{camera.height} << camera.fx << camera.fy
      << camera.cx << camera.cy << static_cast<std::int64_t>(camera.distortion);
  for (const double coefficient : camera.coefficients) put << coefficient;
  put.run();
}

/// Origin and cameras, in place of those that are there.
void write_origin(SqliteDatabase& database, const MapOrigin& origin) {
  database.execute("DELETE FROM origin");
  database.execute("DELETE FROM camera");
  SqliteStatement put(
      database, "INSERT INTO origin VALUES (1, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, 0, 10, 0, 0, 0)");
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
  if (!calibration) return;
  insert_camera(database, 1, calibration->camera);
  if (calibration->depth) insert_camera(database, 2, calibration->depth->camera);
}

}  // namespace

void MapDatabase::Impl::put_places(const MapChanges& changes) {
  std::map<std::int64_t, const PlaceHistory::Place*> grown;
  for (const PlaceHistory::Place& place : changes.history.places) grown[place.id] = &place;
  std::set<std::int64_t> ids;
  for (const Place& place : changes.places) {
    ids.insert(place.id);
    MapRow row;
    row.integer(place.anchor_keyframe).integer(place.component).pose(place.T_map_place);
    row.real(place.scale);
    if (const auto found = grown.find(place.id); found != grown.end())
      row.real(found->second->reach).integer(found->second->last_keyframe);
    else
      row.null().null();
    places.put(place.id, row);
    if (place.labels == written_labels[place.id]) continue;
    labels.erase(place.id);
    for (std::size_t i = 0; i < place.labels.size(); ++i)
      labels.write(place.id, MapRow().integer(static_cast<std::int64_t>(i)).text(place.labels[i]));
    written_labels[place.id] = place.labels;
  }
  for (const std::int64_t id : places.keep(ids)) {
    labels.erase(id);
    appearances.erase(id);
    written_labels.erase(id);
  }
  for (const auto& [place, appearance] : changes.appearances) {
    if (!ids.count(place)) continue;
    std::string bytes;
    BlobWriter(bytes).words(appearance);
    appearances.write(
        place, MapRow().integer(static_cast<std::int64_t>(appearance.words.size())).blob(bytes));
  }
}

void MapDatabase::Impl::put_keyframes(const MapChanges& changes) {
  for (const Keyframe& keyframe : changes.keyframes) {
    keyframe_times[keyframe.id] = {keyframe.frame, keyframe.stamp_ns};
    std::string bytes;
    BlobWriter(bytes).features(keyframe.features);
    features.write(
        keyframe.id,
        MapRow().integer(static_cast<std::int64_t>(keyframe.features.size())).blob(bytes));
    if (keyframe.view.empty()) continue;
    bytes.clear();
    BlobWriter(bytes).view(keyframe.view);
    views.write(keyframe.id, MapRow().blob(bytes));
  }
  for (const Place& place : changes.places)
    for (const PlaceMember& member : place.members) {
      const auto times = keyframe_times.find(member.keyframe);
      require(times != keyframe_times.end(),
              "map: place " + std::to_string(place.id) + " has keyframe " +
                  std::to_string(member.keyframe) + ", which is not there");
      keyframes.put(member.keyframe, MapRow()
                                         .integer(times->second.first)
                                         .integer(times->second.second)
                                         .integer(place.id)
                                         .pose(member.T_place_keyframe)
                                         .real(member.scale));
    }
}

void MapDatabase::Impl::put_frames(const MapChanges& changes) {
  auto number = static_cast<std::int64_t>(changes.first_frame);
  for (const FrameRecord& record : changes.frames) {
    MapRow row;
    row.integer(record.frame).integer(record.stamp_ns).integer(record.keyframe);
    record.T_keyframe_frame ? row.pose(*record.T_keyframe_frame) : row.null();
    row.integer(record.inliers);
    frames.write(number++, row);
  }
  number = static_cast<std::int64_t>(changes.first_frame);
  for (const StampedPose& pose : changes.online) {
    MapRow row;
    row.integer(pose.stamp_ns);
    std::string bytes;
    if (pose.T_world_body) BlobWriter(bytes).matrix12(*pose.T_world_body);
    pose.T_world_body ? row.blob(bytes) : row.null();
    online.write(number++, row);
  }
  number = 0;
  for (const LoopRecord& loop : changes.loops)
    loops.put(number++, MapRow()
                            .integer(loop.query_frame)
                            .integer(loop.match_frame)
                            .integer(loop.inliers)
                            .integer(loop.accepted)
                            .text(loop.stage)
                            .pose(loop.T_match_query)
                            .text(to_string(loop.model))
                            .integer(loop.lines)
                            .real(loop.likeness)
                            .real(loop.probability));
}

void MapDatabase::Impl::put_constraints(const MapChanges& changes) {
  for (const auto& [kind, number, constraint] : changes.constraints) {
    if (!constraint) {
      erase_edge << std::int64_t{kind} << number;
      erase_edge.run();
      continue;
    }
    std::string motion, information;
    require(kind_of(constraint->T_from_to) != PoseKind::kSE2, "map: a constraint in the plane");
    if (const auto* S_from_to = std::get_if<Sim3>(&constraint->T_from_to))
      BlobWriter(motion).similarity(*S_from_to);
    else
      BlobWriter(motion).pose(std::get<SE3>(constraint->T_from_to));
    BlobWriter(information).symmetric(constraint->information);
    put_edge << std::int64_t{kind} << number << constraint->from << constraint->to
             << static_cast<std::int64_t>(constraint->source)
             << static_cast<std::int64_t>(constraint->kernel.kind) << constraint->kernel.width;
    put_edge.blob(motion).blob(information).run();
  }
}

/// In rows of a thousand: single ones would cost more to find than to write.
void MapDatabase::Impl::put_landmarks(const MapChanges& changes) {
  const std::size_t first = changes.first_landmark;
  require(first % kLandmarksARow == 0, "map: landmarks begin within a row");
  for (std::size_t i = 0; i < changes.landmarks.size(); i += kLandmarksARow) {
    const std::size_t count = std::min(kLandmarksARow, changes.landmarks.size() - i);
    std::string bytes;
    BlobWriter(bytes).landmarks(changes.landmarks.data() + i, count);
    landmarks.write(static_cast<std::int64_t>((first + i) / kLandmarksARow),
                    MapRow().integer(static_cast<std::int64_t>(count)).blob(bytes));
  }
  const std::size_t end = first + changes.landmarks.size();
  const auto rows = static_cast<std::int64_t>((end + kLandmarksARow - 1) / kLandmarksARow);
  database.execute("DELETE FROM landmarks WHERE number >= " + std::to_string(rows));
}

void MapDatabase::Impl::commit(const MapChanges& changes, bool finished) {
  database.execute("BEGIN IMMEDIATE");
  try {
    put_keyframes(changes);
    put_places(changes);
    put_frames(changes);
    put_constraints(changes);
    put_landmarks(changes);
    put_history(changes.history);
    SqliteStatement origin(database,
                           "UPDATE origin SET metric = ?, median_depth_m = ?, founded = ?, "
                           "judged_loops = ?, finished = ?");
    origin << std::int64_t{changes.metric} << changes.history.median_depth_m
           << changes.history.founded << static_cast<std::int64_t>(changes.history.judged_loops)
           << std::int64_t{finished};
    origin.run();
    database.execute("COMMIT");
  } catch (...) {
    try {
      database.execute("ROLLBACK");
    } catch (const Error&) {  // the first fault is the one to tell
    }
    throw;
  }
}

MapDatabase::MapDatabase(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MapDatabase::MapDatabase(MapDatabase&&) noexcept = default;
MapDatabase& MapDatabase::operator=(MapDatabase&&) noexcept = default;
MapDatabase::~MapDatabase() = default;

std::unique_ptr<MapDatabase::Impl> MapDatabase::made(const std::string& path,
                                                     const MapOrigin& origin, bool synchronized) {
  // A file of that name has its tables and its origin, or there is none.
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
  replace(fresh, path);
  return std::make_unique<Impl>(path, synchronized);
}

MapDatabase MapDatabase::create(const std::string& path, const MapOrigin& origin) {
  return MapDatabase(made(target_of(path), origin, true));
}

MapDatabase MapDatabase::open(const std::string& path) {
  return MapDatabase(std::make_unique<Impl>(path, true));
}

void MapDatabase::commit(const MapChanges& changes) { impl_->commit(changes, false); }

void MapDatabase::clear(const MapOrigin& origin) {
  SqliteDatabase& database = impl_->database;
  database.execute("BEGIN IMMEDIATE");
  for (const char* table : kMapTables) database.execute(std::string("DELETE FROM ") + table);
  write_origin(database, origin);
  database.execute("COMMIT");
  const std::string path = database.path();
  impl_.reset();
  impl_ = std::make_unique<Impl>(path, true);
}

void MapDatabase::finish(const MapChanges& changes) {
  impl_->commit(changes, true);
  impl_->database.text("PRAGMA journal_mode = DELETE");  // everything into the one file
  impl_.reset();
}

void MapDatabase::close() { impl_.reset(); }

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
  changes.frames = map.frames;
  changes.online = map.trajectory_online.poses;
  changes.landmarks = map.landmarks;
  changes.loops = map.loops;
  changes.history = stored.history;
  changes.metric = map.metric;
  const std::string target = target_of(path), fresh = target + ".part";
  try {
    // Nobody sees it before it is whole.
    MapDatabase database(MapDatabase::made(fresh, stored.origin, true));
    if (stored.finished) {
      database.finish(changes);
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
