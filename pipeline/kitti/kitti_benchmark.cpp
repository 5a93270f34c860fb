#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/kitti/kitti_check.h>
#include <placegraph/eval/kitti/kitti_figures.h>
#include <placegraph/eval/trajectory/plausibility.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/evaluated_files.h>
#include <placegraph/io/trajectories/submitted_poses.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/kitti/kitti_benchmark.h>
#include <placegraph/pipeline/kitti/kitti_folders.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace placegraph {
namespace {

/// True poses of every frame, by the names of the sequences.
using TruePoses = std::map<std::string, Trajectory>;

Trajectory read_every_frame(const std::string& path) {
  Trajectory truth = read_frame_poses(path);
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (!truth.poses[i].T_world_body)
      throw FileError(path, static_cast<int>(i) + 1, "the true pose of the frame is missing");
  return truth;
}

TruePoses read_truths(const std::string& folder, const std::vector<std::string>& sequences) {
  const PoseFolder found = pose_folder(folder);
  TruePoses truths;
  for (const std::string& name : sequences)
    require(found.files.contains(name),
            fmt::format("{}: holds no true poses of the sequence '{}'", folder, name));
  for (const auto& [name, path] : found.files)
    if (sequences.empty() || std::ranges::count(sequences, name) > 0)
      truths.emplace(name, read_every_frame(path));
  return truths;
}

/// Judges one folder of estimates.
class SubmissionJudge {
 public:
  SubmissionJudge(const TruePoses& truths, const std::string& folder, bool chosen)
      : truths_(truths), folder_(folder), found_(pose_folder(folder)), chosen_(chosen) {}

  KittiSystem judge(const std::string& name) {
    system_.name = name;
    for (const std::string& sequence : expected()) add(sequence);
    if (!chosen_) warn_of_others();
    add_mean();
    return std::move(system_);
  }

 private:
  /// The sequences that the folder must have, and those it has besides that KITTI has, too.
  std::set<std::string> expected() const {
    std::set<std::string> names;
    for (const auto& [name, truth] : truths_) names.insert(name);
    if (chosen_) return names;
    for (const auto& [name, path] : found_.files)
      if (kitti_frames(name)) names.insert(name);
    const std::vector<std::string>& test = kitti_test_sequences();
    if (std::ranges::any_of(test, [&](const auto& name) { return found_.files.contains(name); }))
      names.insert(test.begin(), test.end());
    return names;
  }

  void warn_of_others() {
    for (const auto& [name, path] : found_.files)
      if (!truths_.contains(name) && !kitti_frames(name))
        system_.warnings.push_back(
            {path, 0, "neither the ground truth nor KITTI has a sequence of this name"});
    for (const std::string& path : found_.others)
      system_.warnings.push_back({path, 0, "has no place in a submission and is not read"});
  }

  void add(const std::string& name) {
    KittiSequence& sequence = system_.sequences.emplace_back();
    const auto truth = truths_.find(name);
    const auto file = found_.files.find(name);
    sequence.name = name;
    sequence.has_truth = truth != truths_.end();
    sequence.frames = sequence.has_truth ? static_cast<int>(truth->second.size())
                                         : kitti_frames(name).value_or(0);
    const std::size_t faults = system_.faults.size();
    if (file == found_.files.end()) {
      const std::string path = (std::filesystem::path(folder_) / (name + ".txt")).string();
      system_.faults.push_back({path, 0,
                                sequence.has_truth
                                    ? "is missing: the ground truth has this sequence"
                                    : "is missing: the server wants all of 11 to 21"});
    } else {
      sequence.file = file->second;
      const Trajectory poses = read(sequence);
      sequence.faulty = system_.faults.size() > faults;
      if (!sequence.faulty && sequence.has_truth)
        compare(truth->second, poses, sequence);
      else if (!sequence.faulty)
        warn(sequence.file, kitti_pose_warnings(poses));
    }
    sequence.faulty = system_.faults.size() > faults;
  }

  /// The estimate, with the faults of its form.
  Trajectory read(const KittiSequence& sequence) {
    SubmittedPoses submitted;
    try {
      submitted = read_submitted_poses(sequence.file);
    } catch (const FileError& error) {
      const std::string before = sequence.file + ": ", text = error.what();
      system_.faults.push_back(
          {sequence.file, 0, text.starts_with(before) ? text.substr(before.size()) : text});
      return {};
    }
    for (const PoseFileFault& fault : submitted.faults)
      system_.faults.push_back({sequence.file, fault.line, fault.text});
    const std::string count =
        kitti_count_fault(submitted.poses.size(), sequence.frames, sequence.has_truth);
    if (!count.empty() && !submitted.poses.poses.empty())
      system_.faults.push_back({sequence.file, 0, count});
    return std::move(submitted.poses);
  }

  void compare(const Trajectory& truth, const Trajectory& poses, KittiSequence& sequence) {
    sequence.pairs.reserve(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      sequence.pairs.push_back({static_cast<int>(i), static_cast<std::int64_t>(i),
                                *truth.poses[i].T_world_body, poses.poses[i].T_world_body});
    sequence.path_m = travelled_m(sequence.pairs).back();
    sequence.segments = kitti_segments(sequence.pairs, false, SegmentOptions()).segments;
    sequence.figures = kitti_figures(sequence.segments);
    warn(sequence.file, kitti_start_warnings(poses));
    warn(sequence.file, convention_warnings(sequence.pairs));
  }

  void warn(const std::string& file, const std::vector<std::string>& texts) {
    for (const std::string& text : texts) system_.warnings.push_back({file, 0, text});
  }

  void add_mean() {
    std::vector<SegmentError> all;
    std::vector<std::string> unjudged;
    for (const KittiSequence& sequence : system_.sequences) {
      if (!sequence.has_truth) continue;
      all.insert(all.end(), sequence.segments.begin(), sequence.segments.end());
      if (sequence.faulty) unjudged.push_back(sequence.name);
    }
    if (unjudged.empty())
      system_.mean = kitti_figures(all);
    else
      system_.mean.outcome = Outcome::failure(
          Outcome::Code::kInconsistent,
          fmt::format("faults leave no figures of {}, and a mean does not leave them out",
                      fmt::join(unjudged, ", ")));
  }

  const TruePoses& truths_;
  std::string folder_;
  PoseFolder found_;
  bool chosen_;  ///< the sequences to judge are named: others are no matter
  KittiSystem system_;
};

}  // namespace

KittiBenchmark evaluate_kitti(const std::string& truths, const std::vector<std::string>& estimates,
                              const std::vector<std::string>& sequences) {
  require(!estimates.empty(), "estimates: there is none");
  const TruePoses poses = read_truths(truths, sequences);
  const std::vector<std::string> names = distinct_names(estimates);
  for (const std::string& name : names)
    require(std::ranges::count(names, name) == 1,
            "estimates: two have the same name '" + name + "'");
  KittiBenchmark benchmark;
  for (std::size_t i = 0; i < estimates.size(); ++i)
    benchmark.systems.push_back(
        SubmissionJudge(poses, estimates[i], !sequences.empty()).judge(names[i]));
  return benchmark;
}

}  // namespace placegraph
