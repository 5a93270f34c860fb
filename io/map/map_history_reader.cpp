#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_columns.h>
#include <placegraph/io/map/map_history_reader.h>

#include <set>

namespace placegraph {
namespace {

void read_links(SqliteDatabase& database, StoredMap& stored) {
  {
    auto& measured = stored.history.scale_measured;
    SqliteRows track_segments(database, "track_segment", "number, scale_measured");
    while (track_segments.next()) {
      require_next(track_segments, measured.size());
      measured.push_back(track_segments.integer(1, 0, 1) == 1);
    }
  }
  const auto track_segments = static_cast<std::int64_t>(stored.history.scale_measured.size());
  SqliteRows rows(
      database, "link",
      "keyframe, segment, track_segment, from_keyframe, T_from_this, information, source, "
      "sigma_log_scale, scale");
  while (rows.next()) {
    PlaceHistory::Keyframe keyframe;
    keyframe.id = keyframe_of(stored, rows, rows.integer(0), "keyframe").id;
    keyframe.segment = keyframe_of(stored, rows, rows.integer(1), "segment").id;
    keyframe.track_segment = static_cast<int>(rows.integer(2, 0, track_segments - 1));
    if (!rows.is_null(3)) {
      KeyframeLink& link = keyframe.link.emplace();
      link.from = keyframe_of(stored, rows, rows.integer(3), "from_keyframe").id;
      if (link.from >= keyframe.id) rows.refuse("from_keyframe is not older");
      link.T_from_this = pose_column(rows, 4, "T_from_this");
      link.information = symmetric_column(rows, 5, "information", 6);
      link.source = static_cast<ConstraintSource>(rows.integer(6, 0, 2));
      link.sigma_log_scale = rows.real(7);
      link.scale = rows.positive(8);
    }
    stored.history.keyframes.push_back(keyframe);
  }
}

std::set<KeyframeId> read_segments(SqliteDatabase& database, StoredMap& stored) {
  std::set<KeyframeId> segments;
  PlaceHistory& history = stored.history;
  SqliteRows rows(database, "segment",
                  "anchor, place, S_place_segment, covariance, motion_covariance");
  while (rows.next()) {
    PlaceHistory::Segment& segment = history.segments.emplace_back();
    segment.anchor = keyframe_of(stored, rows, rows.integer(0), "anchor").id;
    segment.place = place_of(stored, rows, rows.integer(1), "place").id;
    segment.S_place_segment = similarity_column(rows, 2, "S_place_segment");
    segment.covariance = symmetric_column(rows, 3, "covariance", 7);
    if (!rows.is_null(4))
      segment.motion_covariance = symmetric_column(rows, 4, "motion_covariance", 6);
    segments.insert(segment.anchor);
  }
  const std::size_t keyframes = stored.map.keyframes.size();
  if (!history.keyframes.empty() && history.keyframes.size() != keyframes)
    throw FileError(database.path(), "table link: " + std::to_string(history.keyframes.size()) +
                                         " rows for " + std::to_string(keyframes) + " keyframes");
  SqliteRows links(database, "link", "keyframe, segment");
  while (links.next())
    if (!segments.count(KeyframeId(links.integer(1))))
      links.refuse("segment " + std::to_string(links.integer(1)) + " is not a segment of the map");
  return segments;
}

void read_motions(SqliteDatabase& database, StoredMap& stored,
                  const std::set<KeyframeId>& segments) {
  PlaceHistory& history = stored.history;
  SqliteRows motions(database, "motion", "number, from_segment, to_segment, T_from_to, covariance");
  while (motions.next()) {
    require_next(motions, history.motions.size());
    PlaceHistory::Motion& motion = history.motions.emplace_back();
    motion.from = KeyframeId(motions.integer(1));
    motion.to = KeyframeId(motions.integer(2));
    if (!segments.count(motion.from) || !segments.count(motion.to))
      motions.refuse("its ends are not segments of the map");
    motion.T_from_to = pose_column(motions, 3, "T_from_to");
    motion.covariance = symmetric_column(motions, 4, "covariance", 6);
  }
  SqliteRows rows(database, "loop_constraint", "number, query, match, S_match_query, information");
  while (rows.next()) {
    require_next(rows, history.loops.size());
    Loop& loop = history.loops.emplace_back();
    loop.query = keyframe_of(stored, rows, rows.integer(1), "query").id;
    loop.match = keyframe_of(stored, rows, rows.integer(2), "match").id;
    const Sim3 S_match_query = similarity_column(rows, 3, "S_match_query");
    loop.T_match_query = SE3(S_match_query.rotation(), S_match_query.translation());
    loop.scale_match_query = S_match_query.scale();
    loop.information = symmetric_column(rows, 4, "information", 7);
  }
}

void read_mergers(SqliteDatabase& database, StoredMap& stored,
                  const std::set<KeyframeId>& segments) {
  PlaceHistory& history = stored.history;
  {
    SqliteRows rows(database, "merged", "number, anchor");
    while (rows.next()) {
      require_next(rows, history.merged.size());
      const KeyframeId anchor(rows.integer(1));
      history.merged.push_back({anchor, {}});
      if (!segments.count(anchor)) rows.refuse("anchor is not a segment of the map");
    }
  }
  const auto mergers = static_cast<std::int64_t>(history.merged.size());
  SqliteRows rows(database, "merged_segment", "number, merged, segment, covariance");
  while (rows.next()) {
    const KeyframeId segment(rows.integer(2));
    if (!segments.count(segment))
      rows.refuse("segment " + to_string(segment) + " is not a segment of the map");
    history.merged[static_cast<std::size_t>(rows.integer(1, 0, mergers - 1))]
        .covariance_of_segment[segment] = symmetric_column(rows, 3, "covariance", 7);
  }
  SqliteRows separated(database, "separated", "number, one, other");
  while (separated.next())
    history.separated.emplace(keyframe_of(stored, separated, separated.integer(1), "one").id,
                              keyframe_of(stored, separated, separated.integer(2), "other").id);
}

void read_evidence(SqliteDatabase& database, StoredMap& stored) {
  SqliteRows rows(database, "evidence", "id, data, checksum IS row_checksum(id, data)");
  if (!rows.next()) return;
  stored.history.evidence = rows.blob(1);
  if (rows.integer(2) != 1) rows.refuse("data: its bytes have changed since it was written");
}

}  // namespace

void read_history(SqliteDatabase& database, StoredMap& stored) {
  read_links(database, stored);
  const std::set<KeyframeId> segments = read_segments(database, stored);
  read_motions(database, stored, segments);
  read_mergers(database, stored, segments);
  read_evidence(database, stored);
}

}  // namespace placegraph
