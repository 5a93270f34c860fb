#pragma once
#include <placegraph/io/datasets/dataset.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Whether a folder contains `mav0/cam0/data.csv`, or is such a `mav0` folder itself.
bool is_euroc(const std::string& folder);

/// A sequence in the EuRoC / ASL layout (Burri et al.
/// 2016): `mav0/cam0`, optionally `cam1` (images `data/*`, `data.csv`, `sensor.yaml` with T_BS =
/// T_body_cam and the lens distortion, radial-tangential or equidistant) and
/// `state_groundtruth_estimate0/data.csv` (T_world_body). Stereo is rectified from T_BS and the
/// distortion; images are paired by their nearest stamps within a tenth of the frame interval, the
/// others are skipped. Ground truth is converted to T_world_cam of the rectified left camera.
/// Throws FileError.
std::unique_ptr<Dataset> open_euroc(const std::string& folder);

/// A EuRoC sequence with the data that readers of its other sensors need.
struct EurocBody {
  std::unique_ptr<Dataset> images;
  SE3 T_body_cam;          ///< mounting of the camera of `images`
  std::string mav_folder;  ///< folder of cam0, and of imu0 if there is one
};
/// Opens a sequence as open_euroc() does.
EurocBody open_euroc_body(const std::string& folder);

}  // namespace placegraph
