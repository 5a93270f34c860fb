#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// The names of KITTI's sequences without public ground truth, "11" to "21".
const std::vector<std::string>& kitti_test_sequences();

/// The number of frames of a sequence of KITTI's odometry benchmark, "00" to "21"; nothing for any
/// other name. They are those of the images and times that the benchmark publishes.
std::optional<int> kitti_frames(const std::string& sequence);

/// A line if a submission has not one pose per frame; empty if it has.
/// `from_truth` says whether the number of frames is that of the true poses.
std::string kitti_count_fault(std::size_t poses, int frames, bool from_truth);

/// Lines on poses T_world_cam of a vehicle's camera that are well formed but seem to be wrong.
///  - the first pose is not the identity: no figure depends on it, but the drawn path does;
///  - the camera does not move along its z axis, which points forward: these are poses of another
///    sensor, or inverse ones.
std::vector<std::string> kitti_pose_warnings(const Trajectory& poses);

/// The same for the first pose alone, where a truth shows the axes.
std::vector<std::string> kitti_start_warnings(const Trajectory& poses);

}  // namespace placegraph
