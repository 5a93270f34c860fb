#include <placegraph/pipeline/report/frames_part.h>

#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/graph/core/angle.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/parts.h>
#include <placegraph/pipeline/report/tables/column.h>

namespace placegraph::report {
namespace {

using nlohmann::json;

/// The optimized pose of every posed frame, each in the frame of its component.
std::vector<std::optional<Eigen::Isometry3d>> poses_of(const Map& map) {
  std::vector<std::optional<Eigen::Isometry3d>> poses(map.frames.size());
  for (const MapComponent& component : map.components()) {
    const Trajectory trajectory = map.trajectory_optimized(component.number);
    for (std::size_t i = 0; i < trajectory.size(); ++i)
      if (trajectory.poses[i].T_world_body) poses[i] = trajectory.poses[i].T_world_body;
  }
  return poses;
}

/// Standard deviation of the position of every place relative to the first one of its component.
std::map<PlaceId, float> sigmas_of_places(const PlaceGraph& graph) {
  std::map<PlaceId, float> sigmas;
  if (graph.places.empty()) return sigmas;
  const PoseGraph poses = graph.pose_graph();
  const PoseMarginals marginals(poses);
  if (!marginals.outcome()) return sigmas;
  const std::vector<Information> covariances = marginals.covariances();
  for (std::size_t i = 0; i < poses.nodes.size(); ++i)
    sigmas[place_of_node(poses.nodes[i].id)] =
        static_cast<float>(std::sqrt(std::max(0.0, covariances[i].topLeftCorner<3, 3>().trace())));
  return sigmas;
}

/// A pose of the ground truth in the frame and the scale of the map.
Eigen::Isometry3d in_map(const Eigen::Isometry3d& T_truth_cam, const AlignmentResult& alignment) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const Eigen::Matrix3d R_estimate_truth = alignment.R_truth_estimate.transpose();
  T.linear() = R_estimate_truth * T_truth_cam.rotation();
  T.translation() =
      R_estimate_truth * (T_truth_cam.translation() - alignment.t_truth_estimate) / alignment.scale;
  return T;
}

void put_errors(const RunTruth& truth, int main,
                const std::vector<std::optional<Eigen::Isometry3d>>& poses,
                const std::vector<std::int32_t>& component, json& frames) {
  std::vector<std::optional<Eigen::Isometry3d>> true_poses;
  std::vector<float> error_m, error_deg;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::optional<Eigen::Isometry3d>& T_truth_cam = truth.of_frames.poses[i].T_world_body;
    true_poses.emplace_back();
    if (T_truth_cam) true_poses.back() = in_map(*T_truth_cam, truth.alignment);
    const bool known = T_truth_cam && poses[i] && component[i] == main;
    if (!known) {
      error_m.push_back(kUnknown);
      error_deg.push_back(kUnknown);
      continue;
    }
    const Eigen::Isometry3d T = truth.alignment.apply(*poses[i]);
    error_m.push_back(static_cast<float>((T.translation() - T_truth_cam->translation()).norm()));
    const Eigen::AngleAxisd off(T_truth_cam->rotation().transpose() * T.rotation());
    error_deg.push_back(static_cast<float>(rad_to_deg(std::abs(off.angle()))));
  }
  frames["truth"] = pose_column(true_poses);
  frames["error_m"] = column(error_m);
  frames["error_deg"] = column(error_deg);
}

/// The labels of the place of every posed frame.
json environments_of(const Map& map, const std::map<KeyframeId, const Place*>& place_of) {
  std::vector<std::string> labels;
  bool any = false;
  for (const FrameRecord& frame : map.frames) {
    std::string& text = labels.emplace_back();
    if (!frame.T_keyframe_frame) continue;
    for (const std::string& label : place_of.at(*frame.keyframe)->labels)
      text += (text.empty() ? "" : ", ") + label;
    any = any || !text.empty();
  }
  return any ? text_column(labels) : json();
}

}  // namespace

json describe_frames_for_report(const Map& map, const std::optional<RunTruth>& truth) {
  std::map<KeyframeId, const Place*> place_of;
  for (const Place& place : map.place_graph.places)
    for (const PlaceMember& member : place.members) place_of[member.keyframe] = &place;
  const std::vector<int> joined = map.place_graph.joined_components();
  std::map<PlaceId, int> component_of;
  for (std::size_t i = 0; i < joined.size(); ++i)
    component_of[map.place_graph.places[i].id] = joined[i];
  const std::map<PlaceId, float> sigma_of = sigmas_of_places(map.place_graph);
  const std::vector<std::optional<Eigen::Isometry3d>> poses = poses_of(map);

  std::vector<std::int32_t> id, component, keyframe, inliers;
  std::vector<double> stamp_s;
  std::vector<std::optional<Eigen::Isometry3d>> online;
  std::vector<float> sigma_m, confidence;
  std::vector<std::string> reason;
  for (std::size_t i = 0; i < map.frames.size(); ++i) {
    const FrameRecord& frame = map.frames[i];
    const Place* place = frame.T_keyframe_frame ? place_of.at(*frame.keyframe) : nullptr;
    id.push_back(static_cast<std::int32_t>(frame.frame.value()));
    stamp_s.push_back(1e-9 * static_cast<double>(frame.stamp_ns));
    component.push_back(place ? component_of.at(place->id) : -1);
    keyframe.push_back(place ? static_cast<std::int32_t>(frame.keyframe->value()) : -1);
    inliers.push_back(frame.inliers);
    online.push_back(map.trajectory_online.poses[i].T_world_body);
    sigma_m.push_back(place && sigma_of.contains(place->id) ? sigma_of.at(place->id) : kUnknown);
    confidence.push_back(frame.confidence ? static_cast<float>(*frame.confidence) : kUnknown);
    reason.push_back(frame.reason);
  }
  json frames = bare_frames(id, stamp_s);
  frames["component"] = column(component);
  frames["keyframe"] = column(keyframe);
  frames["pose"] = pose_column(poses);
  frames["online"] = pose_column(online);
  if (!sigma_of.empty()) frames["sigma_m"] = column(sigma_m);
  frames["confidence"] = column(confidence);
  frames["inliers"] = column(inliers);
  frames["reason"] = text_column(reason);
  frames["environment"] = environments_of(map, place_of);
  if (truth) put_errors(*truth, map.main_component(), poses, component, frames);
  return frames;
}

}  // namespace placegraph::report
