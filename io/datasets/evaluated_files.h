#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Files of a true and of an estimated trajectory that belong together.
struct EvaluatedFiles {
  std::string truth;     ///< path of the true trajectory
  std::string estimate;  ///< path of the estimate
  std::string name;      ///< name of the sequence: that of the files, without their extensions
};

/// Result of pair_files.
struct PairedFiles {
  std::vector<EvaluatedFiles> pairs;  ///< in the order of their names
  std::vector<std::string> alone;     ///< paths of true trajectories without an estimate
};

/// Pairs the files of two folders by their names.
///
/// The estimate of a file is the one of the same name, or else the only one that differs in its
/// extension. Files whose names begin with a dot are ignored. Throws ArgumentError if there is no
/// pair, or if several files could be the estimate of one.
PairedFiles pair_files(const std::string& truths, const std::string& estimates);

/// Different names of estimates: file name, folder name or path, the first that is unique.
std::vector<std::string> distinct_names(const std::vector<std::string>& paths);

/// Whether a folder is the output folder of a run.
bool is_run_folder(const std::string& folder);

/// Whether the ground truth in a file, or of the sequence in a folder, has times.
bool truth_has_times(const std::string& truth);

/// Path of the optimized trajectory of a run: of the file with times if `timed`.
std::string trajectory_of_run(const std::string& folder, bool timed);

/// Path of the file of times beside the poses of a KITTI sequence.
///
/// `truth` as for truth_has_times. Empty if there is no such file.
std::string times_beside(const std::string& truth);

/// Reads a trajectory to evaluate, whose poses need no orientations.
///
/// `times` is the file of times for a trajectory without; empty: none. Throws FileError if a file
/// cannot be read.
Trajectory read_evaluated(const std::string& path, const std::string& times = "");

/// Reads the ground truth: a file as read_evaluated, or that of the sequence in a folder.
///
/// Throws FileError if the sequence has no ground truth or a file cannot be read.
Trajectory read_truth(const std::string& path, const std::string& times = "");

}  // namespace placegraph
