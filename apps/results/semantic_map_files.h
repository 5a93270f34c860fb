#pragma once
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/internal/scene/urban_mapper.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace placegraph {
class Dataset;
}

namespace placegraph::apps {

/// Which models label the streets; empty: those that came with the program.
struct UrbanModelPaths {
  std::string urban, surfaces;
};

/// Where a map lies on the earth: what `placegraph georeference` wrote.
struct Georeference {
  GeodeticPosition origin;
  KeyframePoses T_enu_keyframe;
};

/// Reads georeference.json and trajectory_enu.tum of a folder. Throws FileError.
Georeference read_georeference(const std::string& folder, const Map& map);

/// Says what is wrong with models or options before any work. Throws FileError where a model is
/// absent or broken, naming the command that makes it, and ArgumentError.
void check_urban_models(const UrbanMapperOptions& options, const UrbanModelPaths& models);

/// A mapper that has taken the keyframes of a map whose images are those of `dataset`; `lens_k1` is
/// the distortion that was taken out of them. Throws FileError where a model is absent.
UrbanMapper urban_mapper_of(const Map& map, const Calibration& calibration, const Dataset& dataset,
                            Sensor sensor, double lens_k1, const UrbanMapperOptions& options,
                            const UrbanModelPaths& models);

/// Writes semantic_map.ply, .json and .png into a folder; with an `origin`, in whose east-north-up
/// frame the semantic map is, semantic_map.geojson too. `T_frame_keyframe` are the poses it was
/// fused by.
void write_semantic_map(const std::string& folder, const SemanticMap& semantic,
                        const UrbanMapper& mapper, const Map& map,
                        const KeyframePoses& T_frame_keyframe, const std::string& title,
                        const std::optional<GeodeticPosition>& origin = std::nullopt);

/// What result.json says of a semantic map: counts, and, where the sequence's folder holds the true
/// scene (scene.ply) and true poses, how many cells are right: by the poses of the map
/// ("optimized") and by those before corrections ("online"), nothing fitted.
nlohmann::json describe_semantic_map(const SemanticMap& semantic, const UrbanMapper& mapper,
                                     const Map& map, const Dataset& dataset,
                                     const std::string& sequence);

}  // namespace placegraph::apps
