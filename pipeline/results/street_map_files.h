#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/scene/scene_model.h>
#include <placegraph/pipeline/scene/street_mapper.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

class Dataset;

/// The models for street labelling.
struct StreetMapModels {
  SceneModel urban;     ///< of the classes of street scenes
  SceneModel surfaces;  ///< of the directions of surfaces
};

/// A mapper with the keyframes of a map made from `dataset`.
/// `lens_k1` is the distortion that was removed from its images. `progress` takes the numbers of
/// keyframes that are labelled and of all. Throws FileError if an image cannot be read.
StreetMapper make_street_mapper(const Map& map, const Calibration& calibration,
                                const Dataset& dataset, Sensor sensor, double lens_k1,
                                const StreetMapperOptions& options, StreetMapModels models,
                                const std::function<void(std::size_t, std::size_t)>& progress = {});

/// Writes semantic_map.ply, .json and .png into a folder.
/// If the map is in the east-north-up frame of an `origin`, semantic_map.geojson is written too.
/// `T_frame_keyframe` are the poses used for its fusion; `log` takes a warning where no PNG can be
/// made. Throws FileError.
void write_street_map(const std::string& folder, const StreetMap& semantic,
                      const StreetMapper& mapper, const Map& map,
                      const KeyframePoses& T_frame_keyframe, const std::string& title,
                      const std::optional<GeodeticPosition>& origin = std::nullopt,
                      const LogSink& log = {});

/// Members of result.json for a street map, JSON.
/// These are counts and, if the sequence's folder has the true scene (scene.ply) and true poses,
/// the number of correct cells, without any fit: by the poses of the map ("optimized") and by those
/// before corrections ("online").
std::string street_map_json(const StreetMap& semantic, const StreetMapper& mapper, const Map& map,
                            const Dataset& dataset, const std::string& sequence);

}  // namespace placegraph
