#pragma once
#include <placegraph/frontend/scene/environment.h>
#include <placegraph/graph/scene/scene_model.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace placegraph::apps {

/// A model of surfaces, which all samples share.
using SurfaceModel = std::shared_ptr<const SceneModel>;

/// Views of a rendered world with the kind of their environment.
/// `frames` views are on its path, and indoors twice as many are from random positions in its
/// rooms, as from a handheld camera.
std::vector<EnvironmentSample> samples_of_world(const std::string& name, std::uint64_t seed,
                                                int frames, const SurfaceModel& surfaces);

/// Images of a labelled set (read_labelled_set) with the kind of their environment.
/// Images with more than a tenth of buildings are streets, those with hardly any are roads, and
/// those between are left out. Their depth is unknown. Throws FileError, and ArgumentError if the
/// set has no class Building.
std::vector<EnvironmentSample> samples_of_images(const std::string& data,
                                                 const SurfaceModel& surfaces);

}  // namespace placegraph::apps
