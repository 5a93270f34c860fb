#pragma once
#include <placegraph/frontend/internal/cloud_planes/planarity.h>

#include <string>

namespace placegraph::apps {

/// A model that `placegraph train planarity` wrote. Throws FileError.
PlanarityModel read_planarity(const std::string& path);

}  // namespace placegraph::apps
