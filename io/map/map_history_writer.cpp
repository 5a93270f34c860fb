#include <placegraph/io/map/map_history_writer.h>

#include <set>

namespace placegraph {

MapHistoryWriter::MapHistoryWriter(SqliteDatabase& database)
    : links_(database, "link", "keyframe", 9),
      segments_(database, "segment", "anchor", 5),
      motions_(database, "motion", "number", 5),
      revisits_(database, "loop_constraint", "number", 5),
      track_segments_(database, "track_segment", "number", 2),
      merged_(database, "merged", "number", 2),
      merged_segments_(database, "merged_segment", "number", 4),
      separated_(database, "separated", "number", 3),
      evidence_(database, "evidence", "id", 2) {
  merged_.take_keys(database, "number merged");
  merged_segments_.take_keys(database, "number merged_segment");
}

void MapHistoryWriter::put(const PlaceHistory& history) {
  put_keyframes(history);
  put_segments(history);
  put_motions(history);
  put_mergers(history);
  evidence_.put(1, MapRow().blob(history.evidence));
}

void MapHistoryWriter::put_keyframes(const PlaceHistory& history) {
  for (const PlaceHistory::Keyframe& keyframe : history.keyframes) {
    MapRow row;
    row.id(keyframe.segment).integer(keyframe.track_segment);
    if (const auto& link = keyframe.link)
      row.id(link->from)
          .pose(link->T_from_this)
          .symmetric(link->information)
          .integer(static_cast<std::int64_t>(link->source))
          .real(link->sigma_log_scale)
          .real(link->scale);
    else
      row.null().null().null().null().null().null();
    links_.put(keyframe.id.value(), row);
  }
}

void MapHistoryWriter::put_segments(const PlaceHistory& history) {
  for (const PlaceHistory::Segment& segment : history.segments) {
    std::string S_place_segment;
    BlobWriter(S_place_segment).similarity(segment.S_place_segment);
    MapRow row;
    row.id(segment.place).blob(S_place_segment).symmetric(segment.covariance);
    segment.motion_covariance ? row.symmetric(*segment.motion_covariance) : row.null();
    segments_.put(segment.anchor.value(), row);
  }
}

void MapHistoryWriter::put_mergers(const PlaceHistory& history) {
  std::int64_t number = 0, segment_number = 0;
  std::set<std::int64_t> kept, segments_kept;
  for (const PlaceHistory::Merged& merger : history.merged) {
    for (const auto& [segment, covariance] : merger.covariance_of_segment) {
      segments_kept.insert(segment_number);
      merged_segments_.put(segment_number++,
                           MapRow().integer(number).id(segment).symmetric(covariance));
    }
    kept.insert(number);
    merged_.put(number++, MapRow().id(merger.anchor));
  }
  merged_.keep(kept);
  merged_segments_.keep(segments_kept);
  number = 0;
  for (const auto& [one, other] : history.separated)
    separated_.put(number++, MapRow().id(one).id(other));
}

void MapHistoryWriter::put_motions(const PlaceHistory& history) {
  std::int64_t number = 0;
  for (const PlaceHistory::Motion& motion : history.motions)
    motions_.put(
        number++,
        MapRow().id(motion.from).id(motion.to).pose(motion.T_from_to).symmetric(motion.covariance));
  number = 0;
  for (const Loop& loop : history.loops) {
    std::string S_match_query;
    BlobWriter(S_match_query).similarity(loop.S_match_query());
    revisits_.put(
        number++,
        MapRow().id(loop.query).id(loop.match).blob(S_match_query).symmetric(loop.information));
  }
  number = 0;
  for (const bool measured : history.scale_measured)
    track_segments_.put(number++, MapRow().integer(measured));
}

}  // namespace placegraph
