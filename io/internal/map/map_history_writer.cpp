#include <placegraph/io/internal/map/map_history_writer.h>

#include <set>

namespace placegraph {

MapHistoryWriter::MapHistoryWriter(SqliteDatabase& database)
    : links_(database, "link", "keyframe", 9),
      parts_(database, "part", "anchor", 5),
      motions_(database, "motion", "number", 5),
      revisits_(database, "revisit", "number", 5),
      runs_(database, "run", "number", 2),
      merged_(database, "merged", "number", 2),
      merged_parts_(database, "merged_part", "number", 4),
      parted_(database, "parted", "number", 3) {
  merged_.take_keys(database, "number merged");
  merged_parts_.take_keys(database, "number merged_part");
}

void MapHistoryWriter::put(const PlaceHistory& history) {
  put_keyframes(history);
  put_parts(history);
  put_motions(history);
  put_mergers(history);
}

void MapHistoryWriter::put_keyframes(const PlaceHistory& history) {
  for (const PlaceHistory::Keyframe& keyframe : history.keyframes) {
    MapRow row;
    row.id(keyframe.part).integer(keyframe.run);
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

void MapHistoryWriter::put_parts(const PlaceHistory& history) {
  for (const PlaceHistory::Part& part : history.parts) {
    std::string S_place_part;
    BlobWriter(S_place_part).similarity(part.S_place_part);
    MapRow row;
    row.id(part.place).blob(S_place_part).symmetric(part.covariance);
    part.motion_covariance ? row.symmetric(*part.motion_covariance) : row.null();
    parts_.put(part.anchor.value(), row);
  }
}

void MapHistoryWriter::put_mergers(const PlaceHistory& history) {
  std::int64_t number = 0, part_number = 0;
  std::set<std::int64_t> kept, parts_kept;
  for (const PlaceHistory::Merged& merger : history.merged) {
    for (const auto& [part, covariance] : merger.covariance_of_part) {
      parts_kept.insert(part_number);
      merged_parts_.put(part_number++, MapRow().integer(number).id(part).symmetric(covariance));
    }
    kept.insert(number);
    merged_.put(number++, MapRow().id(merger.anchor));
  }
  merged_.keep(kept);
  merged_parts_.keep(parts_kept);
  number = 0;
  for (const auto& [one, other] : history.parted) parted_.put(number++, MapRow().id(one).id(other));
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
  for (const bool measured : history.unit_measured) runs_.put(number++, MapRow().integer(measured));
}

}  // namespace placegraph
