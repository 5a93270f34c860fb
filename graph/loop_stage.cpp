#include <placegraph/graph/loop_stage.h>

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

const char* to_string(LoopStage stage) {
  switch (stage) {
    case LoopStage::kRetrieval:
      return "retrieval";
    case LoopStage::kGeometry:
      return "geometry";
    case LoopStage::kCovariance:
      return "covariance";
    case LoopStage::kSupport:
      return "support";
    case LoopStage::kAccepted:
      return "accepted";
    case LoopStage::kManual:
      return "manual";
    case LoopStage::kReach:
    case LoopStage::kDrift:
      break;
  }
  return "drift";
}

std::optional<LoopStage> loop_stage(std::string_view name, LoopModel model) {
  const LoopStage drift = model == LoopModel::kNone ? LoopStage::kReach : LoopStage::kDrift;
  for (const auto stage :
       {LoopStage::kRetrieval, LoopStage::kGeometry, drift, LoopStage::kCovariance,
        LoopStage::kSupport, LoopStage::kAccepted, LoopStage::kManual})
    if (name == to_string(stage)) return stage;
  return std::nullopt;
}

}  // namespace placegraph
