#pragma once
#include <placegraph/graph/scene/environment.h>
#include <placegraph/pipeline/internal/cues/surface_labels.h>

#include <cstdint>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Views of a rendered world with what kind of surroundings they show: `frames` along its way, and
/// indoors twice as many from anywhere in its rooms, as somebody holds a camera.
std::vector<EnvironmentSample> samples_of_world(const std::string& name, std::uint64_t seed,
                                                int frames, const SurfaceLabeller& eye);

/// Pictures of a labelled set (read_labelled_set): a street where a tenth is buildings, a road
/// where hardly any is; what lies between is neither. Depth is not known of them. Throws FileError,
/// and ArgumentError where the set has no class Building.
std::vector<EnvironmentSample> samples_of_pictures(const std::string& data,
                                                   const SurfaceLabeller& eye);

}  // namespace placegraph::apps
