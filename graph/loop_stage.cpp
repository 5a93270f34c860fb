#include <placegraph/graph/loop_stage.h>

namespace placegraph {

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
    case LoopStage::kReach:
    case LoopStage::kDrift:
      break;
  }
  return "drift";
}

std::optional<LoopStage> loop_stage(std::string_view name, LoopModel model) {
  const LoopStage drift = model == LoopModel::kNone ? LoopStage::kReach : LoopStage::kDrift;
  for (const auto stage : {LoopStage::kRetrieval, LoopStage::kGeometry, drift,
                           LoopStage::kCovariance, LoopStage::kSupport, LoopStage::kAccepted})
    if (name == to_string(stage)) return stage;
  return std::nullopt;
}

}  // namespace placegraph
