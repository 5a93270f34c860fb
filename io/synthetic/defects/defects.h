#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>

#include <cstdint>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

namespace synthetic {

struct SensorModel;

/// Difficulty of the images.
///
/// The numbers of a level are frozen, because results are quoted by level.
enum class Difficulty {
  kClean,     ///< neither noise nor blur, and no traffic
  kStandard,  ///< those of an ordinary camera and drive
  kHard       ///< much noise, low contrast, long exposures and dense traffic
};
/// The level of a name: clean, standard or hard. Throws ArgumentError for others.
Difficulty difficulty_from(const std::string& name);
/// The name of a level.
const char* to_string(Difficulty difficulty);
/// The camera of a level.
SensorModel sensor_model(Difficulty difficulty);

}  // namespace synthetic

/// Ways in which real recordings differ from their files.
///
/// With every number 0 a world is exact.
struct SyntheticDefects {
  double calibration_error = 0;   ///< written minus true calibration, sigma as a share
  double time_jitter_s = 0;       ///< true minus written time of an image, sigma
  double rolling_shutter_s = 0;   ///< time from the first to the last row of an image
  double undulation_m = 0;        ///< height of the road's undulation, root mean square
  double shutter_s = 0;           ///< exposure time; 0 = that of the difficulty
  double depth_lag_s = 0;         ///< time by which depth is older than its image
  double depth_quantization = 0;  ///< step of inverse depth [1/m]
  double depth_noise = 0;         ///< sigma of inverse depth [1/m]
  double depth_holes = 0;         ///< share of the pixels without a measurement
  double flying_pixels = 0;       ///< share of the pixels beside depth edges that lie between
  double depth_scale_error = 0;   ///< measured over true depth minus 1, sigma
};
void visit(OptionVisitor& field, SyntheticDefects& defects);

/// Names of the sets of defects: "none", "hard-drive", "hard-rgbd".
const std::vector<std::string>& defect_sets();
/// One of them. Throws ArgumentError that lists them for another name.
SyntheticDefects defects_from(const std::string& name);

/// Whether any of the defects is one of depth images.
bool has_depth_defects(const SyntheticDefects& defects);
/// The defects that are not 0, a line "  key: value" each.
std::string defect_list(const SyntheticDefects& defects);

namespace synthetic {

/// What a calibration with relative errors of sigma `error` says.
///
/// The focal length, the baseline and the camera height are multiplied by 1 + N(0, error), each
/// coordinate of the principal point is shifted by N(0, error * fx). The depth camera has errors of
/// its own.
Calibration miscalibrated(Calibration calibration, double error, std::uint64_t seed);

}  // namespace synthetic
}  // namespace placegraph
