#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/io/internal/calibration/calibration_file.h>
#include <placegraph/io/internal/calibration/rectification.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// undistort_camera for the calibration that was read from `path`. Throws FileError where the lens
/// model turns back within the image, so that it gives no ray for some pixels, and where less than
/// a third of the image is left without distortion.
UndistortedCamera undistort_plausibly(const std::string& path, const RawCamera& raw);

/// Throws FileError for a raw camera as above, and for normalized intrinsics.
void require_plausible_camera(const std::string& path, const RawCamera& raw);

/// Makes intrinsics fit images of another size than they were given for: takes the size where there
/// is none, scales the intrinsics where the aspect agrees to 1 %, and says so. Throws FileError
/// that names the image if it does not.
std::optional<DataNote> fit_to_image(const std::string& image_path, const Image& image,
                                     CalibrationYaml& yaml);

/// What is odd about a calibration, with what to try: a principal point as of larger or smaller
/// images or outside of them, a baseline, a
/// camera height or a place of the depth camera that is no length in metres.
std::vector<DataNote> odd_calibration(const Calibration& calibration);

/// Of a camera height that was given with the command.
std::optional<DataNote> odd_camera_height(double height_m);

}  // namespace placegraph
