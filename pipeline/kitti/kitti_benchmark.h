#pragma once
#include <placegraph/eval/kitti/kitti_result.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Judges submissions to KITTI's odometry benchmark as its devkit does (evaluate_odometry).
///
/// `truths` and each of `estimates` is a folder with `00.txt` ... or `00/poses.txt` ...: poses
/// T_world_cam of every frame, twelve numbers a line. Every sequence of `truths` is judged, or
/// those of `sequences` if there are any. An estimate without truth is checked in its form alone,
/// and a folder that has one of the sequences 11 to 21 must have all of them. An estimate with a
/// fault has no figures, and its system no mean. Systems have the names of their folders. Throws
/// ArgumentError for folders without poses and sequences without truth, FileError for a truth that
/// cannot be read.
[[nodiscard]] KittiBenchmark evaluate_kitti(const std::string& truths,
                                            const std::vector<std::string>& estimates,
                                            const std::vector<std::string>& sequences = {});

}  // namespace placegraph
