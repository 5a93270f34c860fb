#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_columns.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/map/map_history_reader.h>
#include <placegraph/io/map/map_reader.h>

#include <algorithm>
#include <filesystem>

namespace placegraph {

void MapReader::read_origin() {
  SqliteRows rows(database_, "origin",
                  "id, sequence, sensor, options, view_options, lens_k1, lens_pass, baseline_m, "
                  "camera_height_m, T_cam_depth, depth_sigma_at_1m, metric, median_depth_m, "
                  "finished, founded, judged_loops");
  if (!rows.next()) throw FileError(database_.path(), "table origin: its row is missing");
  MapOrigin& origin = stored_.origin;
  origin.sequence = rows.text(1);
  origin.sensor = static_cast<Sensor>(rows.integer(2, 0, 2));
  origin.options = rows.text(3);
  origin.view_options = rows.text(4);
  origin.lens_k1 = rows.real(5);
  origin.lens_pass = static_cast<int>(rows.integer(6, 0, kMost));
  stored_.map.metric = rows.integer(11, 0, 1) == 1;
  stored_.history.median_depth_m = rows.positive(12);
  stored_.finished = rows.integer(13, 0, 1) == 1;
  stored_.history.founded = rows.integer(14, 0);
  stored_.history.judged_loops = static_cast<std::size_t>(rows.integer(15, 0));
  if (rows.is_null(7)) return;
  Calibration& calibration = origin.calibration.emplace();
  calibration.baseline_m = rows.real(7);
  if (!rows.is_null(8)) calibration.camera_height_m = rows.positive(8);
  read_camera(1, calibration.camera);
  if (!rows.is_null(9)) {
    calibration.depth.emplace();
    calibration.depth->T_cam_depth = pose_column(rows, 9, "T_cam_depth");
    calibration.depth->sigma_at_1m = rows.positive(10);
    read_camera(2, calibration.depth->camera);
  }
  try {
    calibration.check();
  } catch (const ArgumentError& error) {
    throw FileError(database_.path(), std::string("table camera: ") + error.what());
  }
}

void MapReader::read_camera(std::int64_t id, Camera& camera) {
  SqliteRows rows(database_, "camera",
                  "id, width, height, fx, fy, cx, cy, distortion, d1, d2, d3, d4, d5",
                  "WHERE id = " + std::to_string(id));
  if (!rows.next())
    throw FileError(database_.path(), "table camera, row " + std::to_string(id) + ": is missing");
  camera.width = static_cast<int>(rows.integer(1, 1, kMost));
  camera.height = static_cast<int>(rows.integer(2, 1, kMost));
  camera.fx = rows.positive(3);
  camera.fy = rows.positive(4);
  camera.cx = rows.real(5);
  camera.cy = rows.real(6);
  camera.distortion = static_cast<Distortion>(rows.integer(7, 0, 2));
  for (int i = 0; i < 5; ++i) camera.coefficients[static_cast<std::size_t>(i)] = rows.real(8 + i);
}

void MapReader::read_keyframes() {
  SqliteRows rows(database_, "keyframe", "id, frame, stamp_ns, place, T_place_keyframe, scale");
  while (rows.next()) {
    Keyframe& keyframe = stored_.map.keyframes.emplace_back();
    keyframe.id = KeyframeId(rows.integer(0, 0));
    keyframe.frame = FrameId(rows.integer(1, 0));
    keyframe.stamp_ns = rows.integer(2);
    keyframe.place = PlaceId(rows.integer(3, 0));
    keyframe.T_place_keyframe = pose_column(rows, 4, "T_place_keyframe");
    keyframe.scale = rows.positive(5);
  }
  read_features();
}

void MapReader::read_features() {
  SqliteRows rows(database_, "features", "keyframe, count, data");
  std::size_t described = 0;
  while (rows.next()) {
    Keyframe& keyframe = keyframe_of(stored_, rows, rows.integer(0), "keyframe");
    const auto count = static_cast<std::size_t>(rows.integer(1, 0, kMost));
    keyframe.features = decoded(rows, rows.blob(2, count * kFeatureBytes), "data",
                                [&](BlobReader& reader) { return reader.features(count); });
    ++described;
  }
  if (described != stored_.map.keyframes.size())
    throw FileError(database_.path(),
                    "table features: " + std::to_string(described) + " rows for " +
                        std::to_string(stored_.map.keyframes.size()) + " keyframes");
}

void MapReader::read_places() {
  auto& places = stored_.map.place_graph.places;
  SqliteRows rows(database_, "place",
                  "id, anchor_keyframe, component, T_map_place, scale, reach, last_keyframe");
  while (rows.next()) {
    Place& place = places.emplace_back();
    place.id = PlaceId(rows.integer(0, 0));
    place.anchor_keyframe = keyframe_of(stored_, rows, rows.integer(1), "anchor_keyframe").id;
    place.component = static_cast<int>(rows.integer(2, 0, kMost));
    place.T_map_place = pose_column(rows, 3, "T_map_place");
    place.scale = rows.positive(4);
    if (rows.is_null(5)) continue;
    stored_.history.places.push_back({place.id, rows.real(5), KeyframeId(rows.integer(6))});
    (void)keyframe_of(stored_, rows, rows.integer(6), "last_keyframe");
  }
  if (!stored_.history.places.empty() && stored_.history.places.size() != places.size())
    throw FileError(database_.path(), "table place: only some rows have a reach");
  SqliteRows labels(database_, "label", "place, position, label", "ORDER BY place, position");
  while (labels.next()) {
    Place& place = place_of(stored_, labels, labels.integer(0), "place");
    if (labels.integer(1) != static_cast<std::int64_t>(place.labels.size()))
      labels.refuse("a label is missing before position " + std::to_string(labels.integer(1)));
    place.labels.emplace_back(labels.text(2));
  }
}

void MapReader::read_members() {
  // The anchor first, then in the order in which they came.
  SqliteRows rows(database_, "keyframe", "id, place");
  for (Place& place : stored_.map.place_graph.places) place.members.emplace_back();
  while (rows.next()) {
    Place& place = place_of(stored_, rows, rows.integer(1), "place");
    const Keyframe& keyframe = keyframe_of(stored_, rows, rows.integer(0), "id");
    const PlaceMember member{keyframe.id, keyframe.T_place_keyframe, keyframe.scale};
    if (keyframe.id == place.anchor_keyframe)
      place.members.front() = member;
    else
      place.members.push_back(member);
  }
  SqliteRows places(database_, "place", "id");
  while (places.next()) {
    const Place& place = place_of(stored_, places, places.integer(0), "id");
    const Keyframe& anchor =
        keyframe_of(stored_, places, place.anchor_keyframe.value(), "anchor_keyframe");
    if (anchor.place != place.id)
      places.refuse("anchor_keyframe " + to_string(anchor.id) + " belongs to place " +
                    to_string(anchor.place));
  }
}

void MapReader::read_appearances() {
  SqliteRows rows(database_, "appearance", "place, words, data");
  while (rows.next()) {
    const auto count = static_cast<std::size_t>(rows.integer(1, 0, kMost));
    place_of(stored_, rows, rows.integer(0), "place").appearance =
        decoded(rows, rows.blob(2, count * kWordBytes), "data",
                [&](BlobReader& reader) { return reader.words(count); });
  }
}

void MapReader::read_views() {
  SqliteRows rows(database_, "view", "keyframe, data");
  const PlaceView* first = nullptr;
  while (rows.next()) {
    PlaceView& view = keyframe_of(stored_, rows, rows.integer(0), "keyframe").view;
    view = decoded(rows, rows.blob(1), "data", [](BlobReader& reader) { return reader.view(); });
    if (view.empty() || view.coarse.empty()) rows.refuse("data: a view without cues");
    if (!first) first = &view;
    const bool similar = view.thumbnail.size() == first->thumbnail.size() &&
                         view.tiny.size() == first->tiny.size() &&
                         view.gradients.size() == first->gradients.size() &&
                         view.colour.channels == first->colour.channels &&
                         view.coarse.channels == first->coarse.channels;
    if (!similar) rows.refuse("data: a view with other cues than the first");
  }
}

void MapReader::read_thumbnails() {
  SqliteRows rows(database_, "thumbnail", "keyframe, data");
  while (rows.next())
    keyframe_of(stored_, rows, rows.integer(0), "keyframe").thumbnail = rows.blob(1);
}

void MapReader::read_observations() {
  SqliteRows rows(database_, "observations", "keyframe, count, data");
  while (rows.next()) {
    const auto count = static_cast<std::size_t>(rows.integer(1, 0, kMost));
    keyframe_of(stored_, rows, rows.integer(0), "keyframe").observations =
        decoded(rows, rows.blob(2, count * kObservationBytes), "data",
                [&](BlobReader& reader) { return reader.observations(count); });
  }
}

void MapReader::read_edges() {
  SqliteRows rows(database_, "edge",
                  "kind || ':' || number, from_place, to_place, source, kernel, kernel_width, "
                  "motion, information",
                  "ORDER BY kind, number");
  const auto kernels = static_cast<std::int64_t>(robust_kernel_names().size());
  std::optional<std::size_t> motion_bytes;
  while (rows.next()) {
    RelativePoseConstraint edge;
    edge.from = node_of_place(place_of(stored_, rows, rows.integer(1), "from_place").id);
    edge.to = node_of_place(place_of(stored_, rows, rows.integer(2), "to_place").id);
    edge.source = static_cast<ConstraintSource>(rows.integer(3, 0, 2));
    edge.kernel.kind = static_cast<RobustKernel::Kind>(rows.integer(4, 0, kernels - 1));
    edge.kernel.width = rows.positive(5);
    const std::size_t bytes = rows.blob(6).size();
    if (motion_bytes.value_or(bytes) != bytes)
      rows.refuse("motion: differs in kind from the first");
    motion_bytes = bytes;
    const bool scaled = bytes == kSimilarityBytes;
    if (scaled)
      edge.T_from_to = similarity_column(rows, 6, "motion");
    else
      edge.T_from_to = pose_column(rows, 6, "motion");
    edge.information = symmetric_column(rows, 7, "information", scaled ? 7 : 6);
    if (const char* fault = fault_of(edge.information)) rows.refuse(fault);
    stored_.map.place_graph.constraints.push_back(edge);
  }
}

void MapReader::read_frames() {
  Map& map = stored_.map;
  SqliteRows rows(database_, "frame",
                  "number, frame, stamp_ns, keyframe, T_keyframe_frame, inliers, confidence, "
                  "reason");
  while (rows.next()) {
    require_next(rows, map.frames.size());
    FrameRecord record;
    record.frame = FrameId(rows.integer(1, 0));
    record.stamp_ns = rows.integer(2);
    if (const std::int64_t keyframe = rows.integer(3, -1); keyframe >= 0)
      record.keyframe = KeyframeId(keyframe);
    record.inliers = static_cast<int>(rows.integer(5, 0, kMost));
    if (!rows.is_null(6)) record.confidence = rows.real(6);
    record.reason = rows.text(7);
    if (!rows.is_null(4)) {
      record.T_keyframe_frame = pose_column(rows, 4, "T_keyframe_frame");
      (void)keyframe_of(stored_, rows, rows.integer(3), "keyframe");
    }
    if (!map.frames.empty() &&
        (record.frame <= map.frames.back().frame || record.stamp_ns <= map.frames.back().stamp_ns))
      rows.refuse("frame and stamp_ns do not increase");
    map.frames.push_back(record);
  }
  SqliteRows online(database_, "online", "number, stamp_ns, T_map_cam");
  while (online.next()) {
    require_next(online, map.trajectory_online.size());
    StampedPose& at = map.trajectory_online.poses.emplace_back();
    at.stamp_ns = online.integer(1);
    if (!online.is_null(2))
      at.T_world_body = decoded(online, online.blob(2, kMatrixBytes), "T_map_cam",
                                [](BlobReader& reader) { return reader.matrix12(); });
  }
  if (map.trajectory_online.size() != map.frames.size())
    throw FileError(database_.path(),
                    "table online: " + std::to_string(map.trajectory_online.size()) + " rows for " +
                        std::to_string(map.frames.size()) + " frames");
}

void MapReader::read_loops() {
  SqliteRows rows(
      database_, "loop",
      "number, query_frame, match_frame, inliers, accepted, stage, T_match_query, model, lines, "
      "similarity, probability");
  while (rows.next()) {
    require_next(rows, stored_.map.loops.size());
    LoopRecord& loop = stored_.map.loops.emplace_back();
    loop.query_frame = FrameId(rows.integer(1, 0));
    loop.match_frame = FrameId(rows.integer(2, 0));
    loop.inliers = static_cast<int>(rows.integer(3, 0, kMost));
    loop.T_match_query = pose_column(rows, 6, "T_match_query");
    const auto model = loop_model(rows.text(7));
    if (!model) rows.refuse("model: not a model of loop closures");
    loop.model = *model;
    const auto stage = loop_stage(rows.text(5), loop.model);
    if (!stage) rows.refuse("stage: not a loop stage: " + std::string(rows.text(5)));
    loop.stage = *stage;
    if ((rows.integer(4, 0, 1) == 1) != loop.accepted())
      rows.refuse("accepted: contradicts stage " + std::string(rows.text(5)));
    loop.lines = static_cast<int>(rows.integer(8, 0, kMost));
    loop.similarity = rows.real(9);
    loop.probability = rows.real(10);
    if (loop.similarity < 0 || loop.probability < 0 || loop.probability > 1)
      rows.refuse("similarity or probability: out of range");
  }
}

void MapReader::read_landmarks() {
  auto& landmarks = stored_.map.landmarks;
  SqliteRows rows(database_, "landmarks", "number, count, data, colours, covariances");
  std::size_t number = 0;
  while (rows.next()) {
    require_next(rows, number++);
    const auto count = static_cast<std::size_t>(rows.integer(1, 0, kMost));
    auto more = decoded(rows, rows.blob(2, count * kLandmarkBytes), "data",
                        [&](BlobReader& reader) { return reader.landmarks(count); });
    if (!rows.is_null(3))
      decoded(rows, rows.blob(3, count * kColourBytes), "colours", [&](BlobReader& reader) {
        reader.colours(more);
        return true;
      });
    if (!rows.is_null(4))
      decoded(rows, rows.blob(4, count * kCovarianceBytes), "covariances", [&](BlobReader& reader) {
        reader.covariances(more);
        return true;
      });
    for (const PointLandmark& landmark : more)
      (void)keyframe_of(stored_, rows, landmark.keyframe.value(), "keyframe");
    landmarks.insert(landmarks.end(), more.begin(), more.end());
  }
}

StoredMap read_map(const std::string& path) { return MapReader(path).read(); }
MapOrigin read_map_origin(const std::string& path) { return MapReader(path).origin(); }

std::string check_map_file(const std::string& path) {
  SqliteDatabase database(path, SqliteDatabase::Access::kRead);
  check_map_schema(database);
  // Each finding is a line; the first says enough, and its list of findings can be long.
  std::string found = database.text("PRAGMA integrity_check(1)");
  std::ranges::replace(found, '\n', ' ');
  constexpr std::size_t kMost = 200;  // characters
  if (found.size() > kMost) found = found.substr(0, kMost) + " ...";
  return found;
}

void check_map_checksums(const std::string& path) {
  SqliteDatabase database(path, SqliteDatabase::Access::kRead);
  check_map_schema(database);
  if (database.integer("PRAGMA user_version") >= 3) check_checksums(database);
}

bool is_unfinished_map(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) return false;
  SqliteDatabase database(path, SqliteDatabase::Access::kRead);
  check_map_schema(database);
  return database.integer("SELECT finished FROM origin") == 0;
}

MapSizes map_sizes(const std::string& path) {
  SqliteDatabase database(path, SqliteDatabase::Access::kRead);
  check_map_schema(database);
  const auto bytes_of = [&](const char* table) {
    return database.integer(std::string("SELECT coalesce(sum(length(data)), 0) FROM ") + table);
  };
  return {database.integer("PRAGMA user_version"),
          static_cast<std::int64_t>(std::filesystem::file_size(path)), bytes_of("features"),
          bytes_of("view"), bytes_of("landmarks")};
}

}  // namespace placegraph
