#pragma once
#include <placegraph/graph/place_history.h>
#include <placegraph/io/internal/map/map_table.h>

namespace placegraph {

/// The tables that a map is gone on with: what of them is written already, and what is to be.
class MapHistoryWriter {
 public:
  /// `database` outlives it.
  explicit MapHistoryWriter(SqliteDatabase& database);
  /// Writes the rows that have changed.
  void put(const PlaceHistory& history);

 private:
  void put_keyframes(const PlaceHistory& history);
  void put_segments(const PlaceHistory& history);
  void put_motions(const PlaceHistory& history);
  void put_mergers(const PlaceHistory& history);

  MapTable links_, segments_, motions_, revisits_, track_segments_, merged_, merged_segments_,
      separated_;
};

}  // namespace placegraph
