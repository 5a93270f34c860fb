#pragma once
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/scene/urban_mapper.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace placegraph {
class Dataset;
}

namespace placegraph::apps {

/// Paths of the models for street labelling; empty: the installed ones.
struct UrbanModelPaths {
  std::string urban, surfaces;
};

/// Checks models and options before any work.
/// Throws FileError if a model is missing or invalid, with the command that makes it, and
/// ArgumentError.
void check_urban_models(const UrbanMapperOptions& options, const UrbanModelPaths& models);

/// A mapper with the keyframes of a map made from `dataset`.
/// `lens_k1` is the distortion that was removed from its images. Throws FileError if a model is
/// missing.
UrbanMapper urban_mapper_of(const Map& map, const Calibration& calibration, const Dataset& dataset,
                            Sensor sensor, double lens_k1, const UrbanMapperOptions& options,
                            const UrbanModelPaths& models);

/// Writes semantic_map.ply, .json and .png into a folder.
/// If the map is in the east-north-up frame of an `origin`, semantic_map.geojson is written too.
/// `T_frame_keyframe` are the poses used for its fusion.
void write_semantic_map(const std::string& folder, const SemanticMap& semantic,
                        const UrbanMapper& mapper, const Map& map,
                        const KeyframePoses& T_frame_keyframe, const std::string& title,
                        const std::optional<GeodeticPosition>& origin = std::nullopt);

/// Members of result.json for a semantic map.
/// These are counts and, if the sequence's folder has the true scene (scene.ply) and true poses,
/// the number of correct cells, without any fit: by the poses of the map ("optimized") and by those
/// before corrections ("online").
nlohmann::json describe_semantic_map(const SemanticMap& semantic, const UrbanMapper& mapper,
                                     const Map& map, const Dataset& dataset,
                                     const std::string& sequence);

}  // namespace placegraph::apps
