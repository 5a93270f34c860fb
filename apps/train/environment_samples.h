#pragma once
#include <placegraph/graph/scene/environment.h>
#include <placegraph/pipeline/cues/surface_labels.h>

#include <cstdint>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Views of a rendered world with the kind of their environment.
/// `frames` views are on its path, and indoors twice as many are from random positions in its
/// rooms, as from a handheld camera.
std::vector<EnvironmentSample> samples_of_world(const std::string& name, std::uint64_t seed,
                                                int frames, const SurfaceLabeller& labeller);

/// Images of a labelled set (read_labelled_set) with the kind of their environment.
/// Images with more than a tenth of buildings are streets, those with hardly any are roads, and
/// those between are left out. Their depth is unknown. Throws FileError, and ArgumentError if the
/// set has no class Building.
std::vector<EnvironmentSample> samples_of_images(const std::string& data,
                                                 const SurfaceLabeller& labeller);

}  // namespace placegraph::apps
