#include <fmt/format.h>
#include <placegraph/eval/plots/floor_plan_plot.h>
#include <placegraph/eval/scene/floor_plan_check.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/scene/floor_plan_file.h>
#include <placegraph/pipeline/results/floor_plan_files.h>
#include <placegraph/pipeline/results/plot_beside.h>
#include <placegraph/pipeline/results/run_judgement.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<Eigen::Vector2d> path_of(const FloorPlan& plan, const Trajectory& trajectory) {
  std::vector<Eigen::Vector2d> path;
  for (const StampedPose& pose : trajectory.poses)
    if (pose.T_world_body) {
      const Eigen::Vector3d p = plan.R_plan_map.matrix() * pose.T_world_body->translation();
      path.emplace_back(p[0], p[2]);
    }
  return path;
}

json check_json(const FloorPlanCheck& check) {
  json rooms = json::array();
  double least = 1;
  for (const auto& room : check.rooms) {
    rooms.push_back({{"name", room.name}, {"iou", room.iou}, {"room", room.room}});
    least = std::min(least, room.iou);
  }
  return {{"wall_error_median_m", check.truth_to_plan_median_m},
          {"walls_found_share", check.truth_found_share},
          {"walls_seen_m", check.seen_length_m},
          {"plan_error_median_m", check.plan_to_truth_median_m},
          {"plan_right_share", check.plan_right_share},
          {"plan_walls_m", check.plan_length_m},
          {"rooms", rooms},
          {"room_iou_least", check.rooms.empty() ? 0 : least},
          {"doors_seen", check.doors_seen},
          {"doors_found", check.doors_found},
          {"doors_false", check.doors_false},
          {"doors_state_right", check.doors_state_right}};
}

}  // namespace

void save_labels(const std::string& map_file, const PlaceGraph& places) {
  StoredMap stored = read_map(map_file);
  for (Place& place : stored.map.place_graph.places)
    if (const Place* labelled = places.find(place.id)) place.labels = labelled->labels;
  write_map(map_file, stored);
}

void write_floor_plan(const std::string& folder, const FloorPlan& plan, const Map& map,
                      const std::string& title, const LogSink& log) {
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  FloorPlanPicture picture;
  picture.title = title;
  picture.path = path_of(plan, map.trajectory_optimized());
  write_file(path("floor_plan.json"), to_json(plan));
  const std::string svg = floor_plan_svg(plan, picture);
  write_file(path("floor_plan.svg"), svg);
  write_plot_beside(path("floor_plan.png"), svg, log);
}

double walled_share(const FloorPlan& plan) {
  const auto length_of = [](const std::vector<Eigen::Vector2d>& polygon) {
    double length = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
      length += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
    return length;
  };
  double walls = 0, outlines = 0;
  for (const PlanWall& wall : plan.walls) walls += wall.length();
  for (const PlanRoom& room : plan.rooms) {
    outlines += length_of(room.outline);
    for (const auto& hole : room.holes) outlines += length_of(hole);
  }
  return outlines > 0 ? std::min(1.0, walls / outlines) : 0;
}

std::optional<std::string> doubt_of(const FloorPlan& plan) {
  constexpr double kLeast = 0.5;
  const double share = walled_share(plan);
  if (share >= kLeast) return std::nullopt;
  return fmt::format(
      "the floor plan is uncertain: walls were observed along {:.0f} % of the outlines of its "
      "rooms",
      100 * share);
}

namespace {

json describe_floor_plan(const FloorPlan& plan, const Map& map, const Dataset& dataset,
                         const std::string& sequence) {
  json summary = {{"outcome", to_string(plan.outcome.code)}};
  if (!plan.outcome) {
    summary["reason"] = plan.outcome.reason;
    return summary;
  }
  double length = 0;
  for (const PlanWall& wall : plan.walls) length += wall.length();
  summary["walls"] = plan.walls.size();
  summary["walls_m"] = length;
  summary["doors"] = plan.doors.size();
  summary["rooms"] = plan.rooms.size();
  summary["walled_share"] = walled_share(plan);
  const fs::path truth_path = fs::path(sequence) / "floorplan.json";
  const auto& truth = dataset.ground_truth();
  if (!fs::exists(truth_path) || !truth || truth->size() != dataset.size()) return summary;
  const TrueFloorPlan building = read_true_floor_plan(truth_path.string());
  std::vector<SE3> poses;
  for (const FrameRecord& record : map.frames)
    if (const auto frame = static_cast<std::size_t>(record.frame.value());
        frame < truth->size() && truth->poses[frame].T_world_body)
      poses.emplace_back(*truth->poses[frame].T_world_body);
  const SE3 T_map_plan(plan.R_plan_map.inverse(), Eigen::Vector3d::Zero());
  const Trajectory estimate = map.trajectory_optimized();
  summary["check"]["origin"] = check_json(check_floor_plan(
      plan, building, fit_by_first_pose(*truth, map, estimate) * T_map_plan, poses));
  summary["check"]["se3"] = check_json(check_floor_plan(
      plan, building, fit_by_positions(*truth, map, estimate) * T_map_plan, poses));
  return summary;
}

}  // namespace

std::string floor_plan_json(const FloorPlan& plan, const Map& map, const Dataset& dataset,
                            const std::string& sequence) {
  return describe_floor_plan(plan, map, dataset, sequence)
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace placegraph
