#include <placegraph/io/map/map_columns.h>

#include <algorithm>

namespace placegraph {

SE3 pose_column(const SqliteRows& rows, int column, const char* name) {
  return decoded(rows, rows.blob(column, kPoseBytes), name,
                 [](BlobReader& reader) { return reader.pose(); });
}

Sim3 similarity_column(const SqliteRows& rows, int column, const char* name) {
  return decoded(rows, rows.blob(column, kSimilarityBytes), name,
                 [](BlobReader& reader) { return reader.similarity(); });
}

Information symmetric_column(const SqliteRows& rows, int column, const char* name, int size) {
  const auto bytes = static_cast<std::size_t>(size * (size + 1) / 2) * sizeof(double);
  return decoded(rows, rows.blob(column, bytes), name,
                 [size](BlobReader& reader) { return reader.symmetric(size); });
}

Keyframe& keyframe_of(StoredMap& stored, const SqliteRows& rows, std::int64_t id,
                      const char* column) {
  auto& all = stored.map.keyframes;
  const auto found =
      std::lower_bound(all.begin(), all.end(), id,
                       [](const Keyframe& k, std::int64_t value) { return k.id.value() < value; });
  if (found == all.end() || found->id.value() != id)
    rows.refuse(std::string(column) + " " + std::to_string(id) + " is not a keyframe of the map");
  return *found;
}

Place& place_of(StoredMap& stored, const SqliteRows& rows, std::int64_t id, const char* column) {
  auto& all = stored.map.place_graph.places;
  const auto found =
      std::lower_bound(all.begin(), all.end(), id,
                       [](const Place& p, std::int64_t value) { return p.id.value() < value; });
  if (found == all.end() || found->id.value() != id)
    rows.refuse(std::string(column) + " " + std::to_string(id) + " is not a place of the map");
  return *found;
}

void require_next(const SqliteRows& rows, std::size_t expected) {
  if (rows.integer(0) != static_cast<std::int64_t>(expected))
    rows.refuse("row " + std::to_string(expected) + " is missing before it");
}

}  // namespace placegraph
