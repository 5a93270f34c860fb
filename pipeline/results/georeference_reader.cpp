#include <placegraph/io/files/json_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/results/georeference_reader.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

namespace placegraph {

using nlohmann::json;

std::optional<SE3> Georeference::at(std::int64_t stamp_ns) const {
  constexpr std::int64_t kSame_ns = 1000000;  // rounding of stamps written in decimal seconds
  const auto found = std::lower_bound(
      trajectory.poses.begin(), trajectory.poses.end(), stamp_ns - kSame_ns,
      [](const StampedPose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
  if (found == trajectory.poses.end() || !found->T_world_body ||
      found->stamp_ns > stamp_ns + kSame_ns)
    return std::nullopt;
  return SE3(*found->T_world_body);
}

Georeference read_georeference(const std::string& folder, const Map& map) {
  namespace fs = std::filesystem;
  const std::string path = (fs::path(folder) / "georeference.json").string();
  Georeference result;
  take_json(path, "map georeference", [&](const json& file) {
    const json& origin = file.at("origin");
    result.origin = {origin.at("latitude_deg").get<double>(),
                     origin.at("longitude_deg").get<double>(), origin.at("height_m").get<double>()};
    result.origin.check();
  });
  result.trajectory = read_trajectory((fs::path(folder) / "trajectory_enu.tum").string());
  std::map<KeyframeId, SE3> poses;
  for (const Keyframe& keyframe : map.keyframes)
    if (const std::optional<SE3> T = result.at(keyframe.stamp_ns)) poses.emplace(keyframe.id, *T);
  result.T_enu_keyframe = [poses = std::move(poses)](KeyframeId id) -> std::optional<SE3> {
    const auto found = poses.find(id);
    if (found == poses.end()) return std::nullopt;
    return found->second;
  };
  return result;
}

}  // namespace placegraph
