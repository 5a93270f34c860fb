#include <placegraph/graph/loop_model.h>

namespace placegraph {

const char* to_string(LoopModel model) {
  switch (model) {
    case LoopModel::kPoints3d2d:
      return "3d2d";
    case LoopModel::kEssential:
      return "essential";
    case LoopModel::kHomography:
      return "homography";
    case LoopModel::kNone:
      break;
  }
  return "none";
}

std::optional<LoopModel> loop_model(std::string_view name) {
  for (const auto model :
       {LoopModel::kNone, LoopModel::kPoints3d2d, LoopModel::kEssential, LoopModel::kHomography})
    if (name == to_string(model)) return model;
  return std::nullopt;
}

}  // namespace placegraph
