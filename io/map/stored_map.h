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
  std::string sequence;           ///< path of the sequence by which open_dataset finds it again
  Sensor sensor = Sensor::kMono;  ///< what it was run as
  std::optional<Calibration> calibration;  ///< of the images; without it the map has no poses
  std::string options;                     ///< RunOptions of the run, YAML
  std::string view_options;  ///< PlaceCueOptions of the keyframes' appearance, YAML; empty: none
  double lens_k1 = 0;        ///< radial distortion (k1) that was removed from the images
  int lens_pass = 0;         ///< how many times the run has begun again to do so
};

/// Everything of a map that is saved.
struct StoredMap {
  MapOrigin origin;      ///< what it was made from
  Map map;               ///< the map itself
  PlaceHistory history;  ///< what Slam::resume needs; empty for a map that no run can go on with
  bool finished = true;  ///< false: the run that made it was broken off
};

}  // namespace placegraph
