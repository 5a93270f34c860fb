#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/map_changes.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Version of the tables (`PRAGMA user_version`); newer versions are rejected.
constexpr int kMapSchema = 4;

/// Something that was found to move with the camera; a restarted run masks it.
struct MaskedOverlay {
  Image mask;     ///< CV_8UC1 of the (left) images as they are given; 0 where they are not used
  DataNote note;  ///< what was found
};

/// The recording, sensor and options from which a map was made.
struct MapOrigin {
  std::string sequence;           ///< path of the sequence by which open_dataset finds it again
  Sensor sensor = Sensor::kMono;  ///< sensor of the run
  std::optional<Calibration>
      calibration;           ///< calibration of the images; without it the map has no poses
  std::string options;       ///< RunOptions of the run, YAML
  std::string view_options;  ///< PlaceCueOptions of the keyframes' appearance, YAML; empty: none
  double lens_k1 = 0;        ///< radial distortion (k1) that was removed from the images
  int lens_pass = 0;         ///< number of restarts of the run to remove it
  std::vector<MaskedOverlay> overlays;  ///< what the run masks; a restart for each
};

/// All saved data of a map.
struct StoredMap {
  MapOrigin origin;      ///< recording and options that it was made from
  Map map;               ///< the map itself
  PlaceHistory history;  ///< input of Slam::resume; empty if no run can continue the map
  bool finished = true;  ///< false: the run that made it was interrupted
  /// Judgement of the run; nothing if it was not written (write_judgement).
  std::optional<Judgement> judgement = {};
  RunRecord run = {};  ///< what the run reports; notes and errors only of a finished one
};

}  // namespace placegraph
