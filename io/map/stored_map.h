#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/map_changes.h>

#include <optional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Version of the tables (`PRAGMA user_version`): one that is newer is refused.
constexpr int kMapSchema = 2;

/// What a map was made from, and how.
struct MapOrigin {
  std::string sequence;  ///< as it can be opened again
  Sensor sensor = Sensor::kMono;
  std::optional<Calibration> calibration;  ///< without one no pose of the map means anything
  std::string options;                     ///< of the run, YAML
  std::string view_options;                ///< of the keyframes' views, YAML
  double lens_k1 = 0;                      ///< radial distortion that was taken out of the images
  int lens_pass = 0;                       ///< how many times the run has begun anew to do so
};

/// Everything of a map that is saved.
struct StoredMap {
  MapOrigin origin;
  Map map;
  PlaceHistory history;  ///< empty for a map that no run can go on with
  bool finished = true;  ///< false: the run that made it was broken off
};

}  // namespace placegraph
