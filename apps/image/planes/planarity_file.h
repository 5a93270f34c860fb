#pragma once
#include <placegraph/frontend/cloud_planes/planarity_model.h>

#include <string>

namespace placegraph::apps {

/// Reads a model written by `placegraph train planarity`. Throws FileError.
PlanarityModel read_planarity(const std::string& path);

}  // namespace placegraph::apps
