#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// The SVG files in the folder of a run, by name; those of more than 4 MB are left out.
nlohmann::json describe_pictures(const std::string& folder);

}  // namespace placegraph::apps
