#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/results/component_files.h>
#include <placegraph/pipeline/results/run_results.h>

#include <filesystem>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kPrefix = "trajectory_optimized.component";

std::string stem_of(const MapComponent& component) {
  return component.main ? "trajectory_optimized" : kPrefix + std::to_string(component.number);
}

void remove_earlier(const std::string& folder) {
  std::vector<fs::path> earlier;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(kPrefix)) earlier.push_back(entry.path());
  for (const fs::path& path : earlier) fs::remove(path);
}

}  // namespace

void write_other_components(const std::string& folder, const Map& map) {
  remove_earlier(folder);
  for (const MapComponent& component : map.components()) {
    if (component.main) continue;
    const Trajectory trajectory = map.trajectory_optimized(component.number);
    const std::string stem = (fs::path(folder) / stem_of(component)).string();
    write_trajectory(stem + ".tum", trajectory, TrajectoryFormat::kTum);
    write_trajectory(stem + ".kitti", trajectory, TrajectoryFormat::kKitti);
  }
}

json describe_components(const Map& map) {
  json list = json::array();
  for (const MapComponent& component : map.components())
    list.push_back({{"component", component.number},
                    {"main", component.main},
                    {"posed", component.posed},
                    {"first_frame", map.frames[component.first].frame},
                    {"last_frame", map.frames[component.last].frame},
                    {"trajectory", stem_of(component) + ".tum"}});
  return list;
}

}  // namespace placegraph
