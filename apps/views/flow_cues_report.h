#pragma once
#include <placegraph/frontend/internal/flow/flow_cues.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace placegraph::apps {

/// What `placegraph image flow --flow-cues` knows beside the flow.
struct CueSetting {
  Camera camera;
  std::optional<KnownRotation> turn;                  ///< nothing: none is taken out
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< to the plane, first camera's axes
  std::optional<double> dt_s;                         ///< nothing: times are in image steps
};

/// All cues with their variances, or why there are none: affine flow, ventral flow, time to
/// contact, balance. Members as in docs/flow.md.
nlohmann::ordered_json describe_cues(const std::vector<FlowVector>& flow,
                                     const CueSetting& setting);

/// Whether any of them is there.
bool any_cue(const nlohmann::ordered_json& cues);

/// The same in lines for people.
std::string cue_lines(const nlohmann::ordered_json& cues);

}  // namespace placegraph::apps
