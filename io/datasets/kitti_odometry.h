#pragma once
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// Whether a folder contains `image_0` or `image_2`, and `calib.txt`.
bool is_kitti_odometry(const std::string& folder);

/// One sequence of the KITTI odometry benchmark, or any folder in its layout: left camera `image_0`
/// (grey) or, where that is absent, `image_2` (colour); right camera `image_1` / `image_3`; 16-bit
/// depth in `depth_0` with `calib_depth.txt`; `times.txt`; ground truth `poses.txt`, or
/// `../../poses/NN.txt` for a folder `sequences/NN`. Details in docs/datasets.md. KITTI's poses are
/// T_world_cam0; those of the colour camera are converted to T_world_cam2. Throws FileError.
std::unique_ptr<Dataset> open_kitti_odometry(const std::string& folder);

}  // namespace placegraph
