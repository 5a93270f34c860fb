#pragma once
#include <placegraph/graph/pose_graph/constraint.h>

#include <optional>
#include <string_view>

namespace [[gnu::visibility("default")]] placegraph {

/// "odometry", "loop", "other": the names of sources in every file.
const char* to_string(ConstraintSource source);
/// The source of a name; nothing for any other.
std::optional<ConstraintSource> constraint_source(std::string_view name);

}  // namespace placegraph
