#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/io/calibration/calibration_file.h>
#include <placegraph/io/calibration/rectification.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// undistort_camera for the calibration that was read from `path`. Throws FileError if the lens
/// model is not monotonic within the image, so that some pixels have no ray, or if less than a
/// third of the image remains after undistortion.
UndistortedCamera undistort_plausibly(const std::string& path, const RawCamera& raw);

/// Throws FileError for a raw camera as above, and for normalized intrinsics.
void require_plausible_camera(const std::string& path, const RawCamera& raw);

/// Fits intrinsics to images of another size than they were calibrated for: sets a missing size,
/// scales the intrinsics if the aspect ratios agree to 1 %, and returns a note about it. Throws
/// FileError that names the image if they do not agree.
std::optional<DataNote> fit_to_image(const std::string& image_path, const Image& image,
                                     CalibrationYaml& yaml);

/// Notes about implausible values of a calibration, with advice: a principal point that fits larger
/// or smaller images or is outside of the image, a baseline, a camera height or a position of the
/// depth camera that cannot be a length in metres.
std::vector<DataNote> odd_calibration(const Calibration& calibration);

/// A note about an implausible camera height that was given on the command line.
std::optional<DataNote> odd_camera_height(double height_m);

}  // namespace placegraph
