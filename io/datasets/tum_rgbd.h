#pragma once
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// Whether a folder contains `rgb.txt`.
bool is_tum_rgbd(const std::string& folder);

/// A sequence of the TUM RGB-D benchmark (Sturm et al. 2012): `rgb.txt`, `depth.txt` (1/5000 m,
/// registered to the colour image) and `groundtruth.txt`, associated by time: colour images without
/// a depth image within 20 ms are left out, ground truth is interpolated. Intrinsics from
/// `calibration.yaml` in the folder, else the benchmark's own by `freiburg1|2|3` (or fr1, fr2, fr3)
/// in the folder's name. Images and depth are undistorted. Throws FileError.
std::unique_ptr<Dataset> open_tum_rgbd(const std::string& folder);

}  // namespace placegraph
