#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/distinct_paths.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/image_list.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;

namespace {

/// The path without links and dots; of a link into nothing, where it leads.
fs::path resolved(fs::path path) {
  constexpr int kMostLinks = 40;  // as the kernel follows
  std::error_code ignored;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, ignored) && !fs::exists(path, ignored);
       ++i)
    path = path.parent_path() / fs::read_symlink(path, ignored);
  fs::path whole = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  if (ignored) whole = fs::absolute(path).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

struct ResolvedPath {
  NamedPath given;
  fs::path path;
};

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return a == b || fs::equivalent(a, b, ignored);
}

/// Whether the path lies in the folder, at any depth.
bool lies_in(const fs::path& path, const fs::path& folder) {
  const auto parts = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return parts.first == folder.end() && parts.second != path.end();
}

bool is_device(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) &&
         !fs::is_directory(path, ignored);
}

std::vector<ResolvedPath> resolved_outputs(const std::vector<NamedPath>& outputs) {
  std::vector<ResolvedPath> paths;
  for (const NamedPath& output : outputs)
    if (!output.path.empty() && !is_device(output.path))
      paths.push_back({output, resolved(output.path)});
  return paths;
}

/// The inputs that exist.
std::vector<ResolvedPath> resolved_inputs(const std::vector<NamedPath>& inputs) {
  std::vector<ResolvedPath> paths;
  std::error_code ignored;
  for (const NamedPath& input : inputs)
    if (fs::exists(input.path, ignored)) paths.push_back({input, resolved(input.path)});
  return paths;
}

/// Whether the folder is that of a run.
bool is_run_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / "map.db", ignored) ||
         fs::is_regular_file(folder / "result.json", ignored);
}

/// Whether it is the name of a file that a run writes and commands read (docs/output.md).
bool is_file_of_run(const std::string& name) {
  constexpr std::array kBegins{"map.db",          "result.json", "trajectory_",
                               "graph",           "places.",     "loops.csv",
                               "environment.csv", "floor_plan.", "semantic_map."};
  return std::ranges::any_of(kBegins, [&](const char* begin) { return name.starts_with(begin); });
}

/// Whether it is the name of an image of a sequence: with a number, unlike plot.png.
bool is_numbered_image(const fs::path& path) {
  const std::string name = path.filename().string();
  return has_image_extension(name) &&
         std::ranges::any_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

constexpr int kDeepest = 3;  // folders of a recording: mav0/cam0/data

/// Whether a file or folder is, by its name or its images, one that recordings consist of. Links
/// in a folder are not followed.
bool is_part_of_recording(const fs::path& path, int depth = kDeepest) {
  constexpr std::array kBegins{"calib",     "times",    "poses.",  "rgb.txt",      "depth.txt",
                               "ground",    "associat", "sensor.", "data.csv",     "world.yaml",
                               "odometry.", "imu",      "gps",     "accelerometer"};
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    return depth > 0 && !is_run_folder(path) &&
           std::ranges::any_of(fs::directory_iterator(path, ignored), [&](const auto& entry) {
             return !fs::is_symlink(entry.path(), ignored) &&
                    is_part_of_recording(entry.path(), depth - 1);
           });
  const std::string name = path.filename().string();
  return is_numbered_image(path) ||
         std::ranges::any_of(kBegins, [&](const char* begin) { return name.starts_with(begin); });
}

/// The innermost recording around the path; empty if there is none, or a run between them.
fs::path recording_around(const fs::path& path) {
  fs::path folder = path.parent_path();
  for (int depth = 0; depth < kDeepest && !is_run_folder(folder); ++depth) {
    if (is_sequence(folder.string())) return folder;
    folder = folder.parent_path();
  }
  return {};
}

void require_apart(const ResolvedPath& output, const ResolvedPath& other) {
  const std::string text = output.given.option + ": " + output.given.path;
  require(!same_file(output.path, other.path),
          text + " is where another output is to be written, that of " + other.given.option);
  require(!lies_in(output.path, other.path),
          text + " is in the folder of another output, that of " + other.given.option);
}

void require_no_input(const ResolvedPath& output, const ResolvedPath& input) {
  const std::string text = output.given.option + ": " + output.given.path;
  std::error_code ignored;
  const std::string name = output.path.filename().string();
  // SQLite reads what bears the name of its log.
  const bool of_run = output.path.parent_path() == input.path && is_run_folder(input.path) &&
                      is_file_of_run(name) &&
                      (fs::exists(output.path, ignored) || name.starts_with("map.db"));
  require(!same_file(output.path, input.path) && !of_run,
          text + " is an input, that of " + input.given.option);
  require(!same_file(output.path, input.path.parent_path()) ||
              !fs::is_regular_file(input.path, ignored),
          text + " is the folder of an input, that of " + input.given.option);
}

/// What a recording consists of stays as it is; other files in its folder may be written again.
void require_no_recording(const ResolvedPath& output) {
  std::error_code ignored;
  if (!fs::exists(output.path, ignored)) return;
  const fs::path recording = recording_around(output.path);
  require(recording.empty() || !is_part_of_recording(output.path),
          output.given.option + ": " + output.given.path + " is a part of the recording " +
              recording.string() + ": name another place");
}

}  // namespace

void require_distinct_paths(const std::vector<NamedPath>& outputs,
                            const std::vector<NamedPath>& inputs) {
  const std::vector<ResolvedPath> written = resolved_outputs(outputs);
  const std::vector<ResolvedPath> read = resolved_inputs(inputs);
  for (std::size_t i = 0; i < written.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      require_apart(written[i], written[k]);
      require_apart(written[k], written[i]);
    }
    for (const ResolvedPath& input : read) require_no_input(written[i], input);
    require_no_recording(written[i]);
  }
}

}  // namespace placegraph
