#include <placegraph/graph/pose_graph/constraint_source.h>

namespace placegraph {

const char* to_string(ConstraintSource source) {
  switch (source) {
    case ConstraintSource::kOdometry:
      return "odometry";
    case ConstraintSource::kLoop:
      return "loop";
    case ConstraintSource::kOther:
      break;
  }
  return "other";
}

std::optional<ConstraintSource> constraint_source(std::string_view name) {
  for (const auto source :
       {ConstraintSource::kOdometry, ConstraintSource::kLoop, ConstraintSource::kOther})
    if (name == to_string(source)) return source;
  return std::nullopt;
}

}  // namespace placegraph
