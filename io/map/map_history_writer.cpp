#include <placegraph/io/map/map_writer.h>

#include <set>

namespace placegraph {

void MapWriter::put_history(const PlaceHistory& history) {
  for (const PlaceHistory::Keyframe& keyframe : history.keyframes) {
    MapRow row;
    row.integer(keyframe.part).integer(keyframe.run);
    if (const auto& link = keyframe.link)
      row.integer(link->from)
          .pose(link->T_from_this)
          .symmetric(link->information)
          .integer(static_cast<std::int64_t>(link->source))
          .real(link->sigma_log_scale)
          .real(link->scale);
    else
      row.null().null().null().null().null().null();
    links.put(keyframe.id, row);
  }
  for (const PlaceHistory::Part& part : history.parts) {
    std::string S_place_part;
    BlobWriter(S_place_part).similarity(part.S_place_part);
    MapRow row;
    row.integer(part.place).blob(S_place_part).symmetric(part.covariance);
    part.motion_covariance ? row.symmetric(*part.motion_covariance) : row.null();
    parts.put(part.anchor, row);
  }
  put_runs(history);
  put_mergers(history);
}

void MapWriter::put_mergers(const PlaceHistory& history) {
  std::int64_t number = 0, part_number = 0;
  std::set<std::int64_t> kept, parts_kept;
  for (const PlaceHistory::Merged& merger : history.merged) {
    for (const auto& [part, covariance] : merger.covariance_of_part) {
      parts_kept.insert(part_number);
      merged_parts.put(part_number++, MapRow().integer(number).integer(part).symmetric(covariance));
    }
    kept.insert(number);
    merged.put(number++, MapRow().integer(merger.anchor));
  }
  merged.keep(kept);
  merged_parts.keep(parts_kept);
  number = 0;
  for (const auto& [one, other] : history.parted)
    parted.put(number++, MapRow().integer(one).integer(other));
}

void MapWriter::put_runs(const PlaceHistory& history) {
  std::int64_t number = 0;
  for (const PlaceHistory::Motion& motion : history.motions)
    motions.put(number++, MapRow()
                              .integer(motion.from)
                              .integer(motion.to)
                              .pose(motion.T_from_to)
                              .symmetric(motion.covariance));
  number = 0;
  for (const Loop& loop : history.loops) {
    std::string S_match_query;
    BlobWriter(S_match_query).similarity(loop.S_match_query());
    revisits.put(number++, MapRow()
                               .integer(loop.query)
                               .integer(loop.match)
                               .blob(S_match_query)
                               .symmetric(loop.information));
  }
  number = 0;
  for (const bool measured : history.unit_measured) runs.put(number++, MapRow().integer(measured));
}

}  // namespace placegraph
