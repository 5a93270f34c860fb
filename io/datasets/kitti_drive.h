#pragma once
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// Whether a folder contains `image_00/data` or `image_02/data`: a drive of KITTI raw.
bool is_kitti_drive(const std::string& folder);

/// A synced and rectified drive of KITTI raw (`2011_09_26_drive_0095_sync`): the grey cameras
/// `image_00` and `image_01`, or where these are absent the colour cameras `image_02` and
/// `image_03`; the times of `timestamps.txt` relative to the first image, by the images' numbers;
/// the calibration of `calib_cam_to_cam.txt` (or `calib.txt`) in the folder or the one above it;
/// ground truth `poses.txt` (T_world_cam0), if the file was added. Images without a partner from
/// the other camera are skipped and counted. Throws FileError.
std::unique_ptr<Dataset> open_kitti_drive(const std::string& folder);

}  // namespace placegraph
