#pragma once
#include <placegraph/frontend/flow/flow_cues.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace placegraph::apps {

/// What `placegraph image flow --flow-cues` knows beside the flow.
struct CueSetting {
  Camera camera;
  std::optional<KnownRotation> rotation;              ///< nothing: no rotation is subtracted
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< normal of the plane, first camera's axes
  std::optional<double> dt_s;  ///< nothing: the unit of time is the image step
};

/// All cues with their variances, or the reasons why there are none.
/// The cues are affine flow, ventral flow, time to contact and balance. Members as in docs/flow.md.
nlohmann::ordered_json describe_cues(const std::vector<FlowVector>& flow,
                                     const CueSetting& setting);

/// True if any cue was estimated.
bool any_cue(const nlohmann::ordered_json& cues);

/// Text of the cues for people.
std::string cue_lines(const nlohmann::ordered_json& cues);

}  // namespace placegraph::apps
