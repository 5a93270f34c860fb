#include <fmt/format.h>
#include <placegraph/pipeline/exports/ply_export.h>
#include <placegraph/pipeline/map/map_geometry.h>

#include <limits>

namespace placegraph {

std::string landmarks_ply(const StoredMap& stored, int component, NumberForm form) {
  std::vector<ColouredPoint> points;
  for (const PlacedLandmark& landmark : geometry_of(stored.map, component).landmarks)
    points.push_back({landmark.p_map, landmark.rgb.value_or(kUnknownColour),
                      landmark.sigma.value_or(std::numeric_limits<double>::quiet_NaN())});
  return to_ply(points, form,
                {fmt::format("landmarks of component {} of a map by placegraph", component),
                 stored.map.metric ? "lengths in metres" : "lengths at an arbitrary scale"});
}

}  // namespace placegraph
