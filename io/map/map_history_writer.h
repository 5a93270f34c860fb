#pragma once
#include <placegraph/graph/place_history.h>
#include <placegraph/io/map/map_table.h>

namespace placegraph {

/// Writes the tables that are needed to continue a map, and tracks the rows that are already
/// written.
class MapHistoryWriter {
 public:
  /// `database` must outlive the writer.
  explicit MapHistoryWriter(SqliteDatabase& database);
  /// Writes the rows that have changed.
  void put(const PlaceHistory& history);

 private:
  void put_keyframes(const PlaceHistory& history);
  void put_segments(const PlaceHistory& history);
  void put_motions(const PlaceHistory& history);
  void put_mergers(const PlaceHistory& history);

  MapTable links_, segments_, motions_, revisits_, track_segments_, merged_, merged_segments_,
      separated_, evidence_;
};

}  // namespace placegraph
