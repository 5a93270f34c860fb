#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/evaluated_files.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <filesystem>

namespace placegraph {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const std::string& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename().string().front() != '.')
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Empty: none.
fs::path estimate_of(const fs::path& truth, const std::vector<fs::path>& candidates) {
  std::vector<fs::path> same_stem;
  for (const fs::path& candidate : candidates) {
    if (candidate.filename() == truth.filename()) return candidate;
    if (candidate.stem() == truth.stem()) same_stem.push_back(candidate);
  }
  if (same_stem.empty()) return {};
  require(same_stem.size() == 1,
          truth.filename().string() + ": both " + same_stem[0].filename().string() + " and " +
              same_stem.back().filename().string() + " could be its estimate");
  return same_stem.front();
}

std::string name_of_file(const std::string& path) {
  const fs::path whole = path;
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

std::string name_of_folder(const std::string& path) {
  const fs::path whole = path;
  return (whole.has_filename() ? whole : whole.parent_path()).parent_path().filename().string();
}

/// The poses in the folder of a KITTI sequence; the path itself if there are none.
fs::path poses_of(const std::string& truth) {
  const fs::path poses = fs::path(truth) / "poses.txt";
  return fs::is_directory(truth) && fs::exists(poses) ? poses : fs::path(truth);
}

}  // namespace

PairedFiles pair_files(const std::string& truths, const std::string& estimates) {
  PairedFiles paired;
  const std::vector<fs::path> candidates = files_in(estimates);
  for (const fs::path& truth : files_in(truths)) {
    const fs::path estimate = estimate_of(truth, candidates);
    if (estimate.empty())
      paired.alone.push_back(truth.string());
    else
      paired.pairs.push_back({truth.string(), estimate.string(), truth.stem().string()});
  }
  require(!paired.pairs.empty(), estimates + ": no file has the name of one in " + truths);
  return paired;
}

std::vector<std::string> distinct_names(const std::vector<std::string>& paths) {
  const auto is_unique = [&](const std::string& path, std::string (*part)(const std::string&)) {
    const auto same = [&](const std::string& other) { return part(other) == part(path); };
    return !part(path).empty() && std::ranges::count_if(paths, same) == 1;
  };
  std::vector<std::string> names;
  for (const std::string& path : paths)
    names.push_back(is_unique(path, name_of_file)     ? name_of_file(path)
                    : is_unique(path, name_of_folder) ? name_of_folder(path)
                                                      : path);
  return names;
}

bool is_run_folder(const std::string& folder) {
  return fs::exists(fs::path(folder) / "trajectory_optimized.kitti");
}

bool truth_has_times(const std::string& truth) {
  const fs::path poses = poses_of(truth);
  return fs::is_directory(poses) || poses.extension() == ".tum" || poses.extension() == ".csv" ||
         fs::exists(poses.parent_path() / "times.txt");
}

std::string trajectory_of_run(const std::string& folder, bool timed) {
  return (fs::path(folder) / (timed ? "trajectory_optimized.tum" : "trajectory_optimized.kitti"))
      .string();
}

std::string times_beside(const std::string& truth) {
  const fs::path poses = poses_of(truth), times = poses.parent_path() / "times.txt";
  return poses.filename() == "poses.txt" && fs::exists(times) ? times.string() : "";
}

Trajectory read_evaluated(const std::string& path, const std::string& times) {
  Trajectory trajectory = read_trajectory(path, {}, Orientation::kOptional);
  if (!trajectory.has_times && !times.empty()) give_times(trajectory, path, times);
  return trajectory;
}

Trajectory read_truth(const std::string& path, const std::string& times) {
  const std::string file = poses_of(path).string();
  if (!fs::is_directory(file)) return read_evaluated(file, times);
  const auto dataset = open_dataset(path);
  if (!dataset->ground_truth()) throw FileError(path, "the sequence has no ground truth");
  return *dataset->ground_truth();
}

}  // namespace placegraph
