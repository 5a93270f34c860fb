#pragma once
#include <placegraph/graph/pose_graph/constraint.h>

#include <optional>
#include <string_view>

namespace [[gnu::visibility("default")]] placegraph {

/// The name of a source in files: "odometry", "loop" or "other".
const char* to_string(ConstraintSource source);
/// The source with the given name; nothing for any other text.
std::optional<ConstraintSource> constraint_source(std::string_view name);

}  // namespace placegraph
