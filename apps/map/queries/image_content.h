#pragma once
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/map/explanation.h>

#include <nlohmann/json_fwd.hpp>

namespace placegraph::apps {

/// What the image of a frame shows by the installed models, or {"unknown": reason}.
///
/// "surfaces" and "classes" are shares of the image, "street" is the probability of a street.
nlohmann::json image_content(const StoredMap& stored, const Explanation& explanation);

}  // namespace placegraph::apps
