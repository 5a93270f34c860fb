#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_writer.h>

#include <algorithm>
#include <set>

namespace placegraph {
namespace {

constexpr std::size_t kLandmarksARow = 1000;

}  // namespace

void MapWriter::put_places(const MapChanges& changes) {
  std::map<PlaceId, const PlaceHistory::Place*> grown;
  for (const PlaceHistory::Place& place : changes.history.places) grown[place.id] = &place;
  std::set<std::int64_t> ids;
  for (const Place& place : changes.places) {
    ids.insert(place.id.value());
    MapRow row;
    row.id(place.anchor_keyframe).integer(place.component).pose(place.T_map_place);
    row.real(place.scale);
    if (const auto found = grown.find(place.id); found != grown.end())
      row.real(found->second->reach).id(found->second->last_keyframe);
    else
      row.null().null();
    places.put(place.id.value(), row);
    if (place.labels == written_labels[place.id]) continue;
    labels.erase(place.id.value());
    for (std::size_t i = 0; i < place.labels.size(); ++i)
      labels.write(place.id.value(),
                   MapRow().integer(static_cast<std::int64_t>(i)).text(place.labels[i]));
    written_labels[place.id] = place.labels;
  }
  for (const std::int64_t id : places.keep(ids)) {
    labels.erase(id);
    appearances.erase(id);
    written_labels.erase(PlaceId(id));
  }
  for (const auto& [place, appearance] : changes.appearances) {
    if (!ids.count(place.value())) continue;
    std::string bytes;
    BlobWriter(bytes).words(appearance);
    appearances.write(
        place.value(),
        MapRow().integer(static_cast<std::int64_t>(appearance.words.size())).blob(bytes));
  }
}

void MapWriter::put_keyframes(const MapChanges& changes) {
  for (const Keyframe& keyframe : changes.keyframes) {
    keyframe_times[keyframe.id] = {keyframe.frame, keyframe.stamp_ns};
    std::string bytes;
    BlobWriter(bytes).features(keyframe.features);
    features.write(
        keyframe.id.value(),
        MapRow().integer(static_cast<std::int64_t>(keyframe.features.size())).blob(bytes));
    if (!keyframe.thumbnail.empty())
      thumbnails.write(keyframe.id.value(), MapRow().blob(keyframe.thumbnail));
    if (keyframe.view.empty()) continue;
    bytes.clear();
    BlobWriter(bytes).view(keyframe.view);
    views.write(keyframe.id.value(), MapRow().blob(bytes));
  }
  for (const Place& place : changes.places)
    for (const PlaceMember& member : place.members) {
      const auto times = keyframe_times.find(member.keyframe);
      require(times != keyframe_times.end(), "map: place " + to_string(place.id) +
                                                 " has keyframe " + to_string(member.keyframe) +
                                                 ", which is not there");
      keyframes.put(member.keyframe.value(), MapRow()
                                                 .id(times->second.first)
                                                 .integer(times->second.second)
                                                 .id(place.id)
                                                 .pose(member.T_place_keyframe)
                                                 .real(member.scale));
    }
}

void MapWriter::put_observations(const MapChanges& changes) {
  for (const auto& [keyframe, seen] : changes.observations) {
    std::string bytes;
    BlobWriter(bytes).observations(seen);
    observations.write(keyframe.value(),
                       MapRow().integer(static_cast<std::int64_t>(seen.size())).blob(bytes));
  }
}

void MapWriter::put_frames(const MapChanges& changes) {
  auto number = static_cast<std::int64_t>(changes.first_frame);
  for (const FrameRecord& record : changes.frames) {
    MapRow row;
    row.id(record.frame).integer(record.stamp_ns);
    row.integer(record.keyframe ? record.keyframe->value() : -1);
    record.T_keyframe_frame ? row.pose(*record.T_keyframe_frame) : row.null();
    row.integer(record.inliers);
    record.confidence ? row.real(*record.confidence) : row.null();
    row.text(record.reason);
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
                            .id(loop.query_frame)
                            .id(loop.match_frame)
                            .integer(loop.inliers)
                            .integer(loop.accepted())
                            .text(to_string(loop.stage))
                            .pose(loop.T_match_query)
                            .text(to_string(loop.model))
                            .integer(loop.lines)
                            .real(loop.similarity)
                            .real(loop.probability));
}

void MapWriter::put_constraints(const MapChanges& changes) {
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
    put_edge << std::int64_t{kind} << number << constraint->from.value() << constraint->to.value()
             << static_cast<std::int64_t>(constraint->source)
             << static_cast<std::int64_t>(constraint->kernel.kind) << constraint->kernel.width;
    put_edge.blob(motion).blob(information).run();
  }
}

/// Writes rows of a thousand landmarks, because finding single ones would cost more than writing
/// them.
void MapWriter::put_landmarks(const MapChanges& changes) {
  const std::size_t first = changes.first_landmark;
  require(first % kLandmarksARow == 0, "map: landmarks begin within a row");
  for (std::size_t i = 0; i < changes.landmarks.size(); i += kLandmarksARow) {
    const std::size_t count = std::min(kLandmarksARow, changes.landmarks.size() - i);
    const PointLandmark* begin = changes.landmarks.data() + i;
    std::string positions, colours, covariances;
    BlobWriter(positions).landmarks(begin, count);
    BlobWriter(colours).colours(begin, count);
    BlobWriter(covariances).covariances(begin, count);
    landmarks.write(static_cast<std::int64_t>((first + i) / kLandmarksARow),
                    MapRow()
                        .integer(static_cast<std::int64_t>(count))
                        .blob(positions)
                        .blob(colours)
                        .blob(covariances));
  }
  const std::size_t end = first + changes.landmarks.size();
  const auto rows = static_cast<std::int64_t>((end + kLandmarksARow - 1) / kLandmarksARow);
  database.execute("DELETE FROM landmarks WHERE number >= " + std::to_string(rows));
}

void MapWriter::put_run(const RunRecord& run) {
  std::set<std::int64_t> kept;
  for (const DataNote& note : run.notes) {
    const auto number = static_cast<std::int64_t>(kept.size());
    notes.put(number, MapRow().note(note));
    kept.insert(number);
  }
  notes.keep(kept);
  if (const auto& error = run.odometry_error)
    odometry_error.put(1, MapRow().symmetric(error->independent).symmetric(error->shared));
  else
    odometry_error.keep({});
  std::int64_t number = 0;
  for (const StageTimes::Stage& stage : run.stages)
    stages.put(number++, MapRow().text(stage.name).real(stage.cpu_s).integer(stage.calls));
}

void MapWriter::commit(const MapChanges& changes, bool finished) {
  database.execute("BEGIN IMMEDIATE");
  try {
    database.execute("DELETE FROM judgement; DELETE FROM finding");  // of the map before
    put_keyframes(changes);
    put_observations(changes);
    put_places(changes);
    put_frames(changes);
    put_constraints(changes);
    put_landmarks(changes);
    history.put(changes.history);
    put_run(changes.run);
    SqliteStatement origin(database,
                           "UPDATE origin SET metric = ?, median_depth_m = ?, founded = ?, "
                           "judged_loops = ?, finished = ?");
    origin << std::int64_t{changes.metric} << changes.history.median_depth_m
           << changes.history.founded << static_cast<std::int64_t>(changes.history.judged_loops)
           << std::int64_t{finished};
    origin.run();
    update_checksums(database, "origin");
    database.execute("COMMIT");
  } catch (...) {
    try {
      database.execute("ROLLBACK");
    } catch (const Error&) {  // the first fault is the one to report
    }
    throw;
  }
}

}  // namespace placegraph
