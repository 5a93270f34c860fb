#pragma once
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// Whether a folder holds `mav0/cam0/data.csv`, or is such a `mav0` folder itself.
bool is_euroc(const std::string& folder);

/// A sequence in the EuRoC / ASL layout (Burri et al. 2016): `mav0/cam0`, optionally `cam1`
/// (pictures `data/*`, `data.csv`, `sensor.yaml` with T_BS = T_body_cam and the lens distortion,
/// radial-tangential or equidistant) and `state_groundtruth_estimate0/data.csv` (T_world_body).
/// Stereo is rectified from T_BS and the distortion; pairs are those of equal stamps, others left
/// out. Ground truth is converted to T_world_cam of the rectified left camera. Throws FileError.
std::unique_ptr<Dataset> open_euroc(const std::string& folder);

/// The same with what others who read such a folder need to know.
struct EurocBody {
  std::unique_ptr<Dataset> images;
  SE3 T_body_cam;          ///< mounting of the camera whose images `images` hands out
  std::string mav_folder;  ///< where cam0 lies; imu0 beside it, if there is one
};
EurocBody open_euroc_body(const std::string& folder);

}  // namespace placegraph
