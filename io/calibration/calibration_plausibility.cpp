#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/io/files/image_file.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace {

/// Least focal length as a share of the image size; normalized ones are a hundredth of this.
constexpr double kLeastFocalShare = 0.05;
constexpr double kLeastImageShare = 1.0 / 3;
/// Stereo cameras of lorries have a baseline of 1.2 m.
constexpr double kGreatestBaseline_m = 3, kLeastBaseline_m = 5e-3;
constexpr double kGreatestHeight_m = 10, kLeastHeight_m = 0.02;
constexpr double kGreatestDepthCamera_m = 1;
/// Largest distance of the principal point outside a cropped image, as a share of its side.
constexpr double kBeside = 0.02;
/// Tolerance of the aspect ratio: sides of resized images are rounded to whole numbers.
constexpr double kSameAspect = 0.01;

/// Distance from the principal point towards a corner up to which the lens model has rays [px].
double reach_px(const Camera& camera, const Eigen::Vector2d& corner) {
  const Eigen::Vector2d middle(camera.cx, camera.cy);
  double inside = 0, outside = 1;
  for (int i = 0; i < 20; ++i) {
    const double share = 0.5 * (inside + outside);
    (camera.unproject(middle + share * (corner - middle)) ? inside : outside) = share;
  }
  return inside * (corner - middle).norm();
}

/// Share of the pixels, on a grid with the border, that have a ray.
double share_with_ray(const Camera& camera) {
  constexpr int kSteps = 24;
  int good = 0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      good +=
          camera.unproject({(camera.width - 1.0) * i / kSteps, (camera.height - 1.0) * j / kSteps})
              .has_value();
  return static_cast<double>(good) / ((kSteps + 1) * (kSteps + 1));
}

/// Distance of the farthest corner from the principal point, in focal lengths.
double farthest_corner(const Camera& camera) {
  return std::hypot(std::max(camera.cx, camera.width - 1 - camera.cx) / camera.fx,
                    std::max(camera.cy, camera.height - 1 - camera.cy) / camera.fy);
}

/// Scales intrinsics to images of another size; (-0.5, -0.5) is the image's corner.
void scale(double x, double y, double& fx, double& fy, double& cx, double& cy) {
  fx *= x, cx = (cx + 0.5) * x - 0.5;
  fy *= y, cy = (cy + 0.5) * y - 0.5;
}

/// Scales the right camera like the left one if both were calibrated at the same image size.
void fit_right(int given_width, int given_height, const Image& image, Camera& right) {
  const bool follows = right.width == given_width && right.height == given_height;
  if (follows && given_width > 0)
    scale(static_cast<double>(image.cols) / given_width,
          static_cast<double>(image.rows) / given_height, right.fx, right.fy, right.cx, right.cy);
  if (follows || right.width == 0) right.width = image.cols, right.height = image.rows;
}

/// Share of the raw image that is visible in the remapped one.
double share_shown(const Remap& remap, const Camera& raw) {
  if (remap.is_identity()) return 1;
  double low_x, high_x, low_y, high_y;
  cv::minMaxLoc(remap.map_x, &low_x, &high_x);
  cv::minMaxLoc(remap.map_y, &low_y, &high_y);
  const auto share = [](double low, double high, double size) {
    return std::clamp((std::min(high, size) - std::max(low, 0.0)) / size, 0.0, 1.0);
  };
  return share(low_x, high_x, raw.width - 1) * share(low_y, high_y, raw.height - 1);
}

DataNote of_scale(NoteCause cause, std::string text) { return {std::move(text), true, cause, ""}; }

void add_principal_point(const Camera& camera, std::vector<DataNote>& notes) {
  const double x = camera.cx / (camera.width - 1), y = camera.cy / (camera.height - 1);
  const bool similar = std::abs(std::log(x / y)) < std::log(1.25);
  const std::string where = fmt::format(
      "the principal point ({:.5g}, {:.5g}) is at {:.0f} % of the width and {:.0f} % of "
      "the height of {}x{} images",
      camera.cx, camera.cy, 100 * x, 100 * y, camera.width, camera.height);
  if (x > 0 && y > 0 && similar && (std::min(x, y) > 0.75 || std::max(x, y) < 0.3)) {
    notes.push_back(
        of_scale(NoteCause::kCalibration,
                 fmt::format("{}: the calibration seems to be for images of about {:.0f}x{:.0f}; "
                             "scale fx, fy, cx and "
                             "cy by {:.3g}, or use images of that size",
                             where, 2 * camera.cx, 2 * camera.cy, 0.5 * camera.width / camera.cx)));
  } else if (!(std::min(x, y) >= -kBeside && std::max(x, y) <= 1 + kBeside)) {
    notes.push_back(
        of_scale(NoteCause::kCalibration, where + ": is the calibration for other images?"));
  }
}

}  // namespace

void require_plausible_camera(const std::string& path, const RawCamera& camera) {
  const Camera& raw = camera.camera;
  if (raw.fx < kLeastFocalShare * raw.width || raw.fy < kLeastFocalShare * raw.height)
    throw FileError(path,
                    fmt::format("fx, fy: {:.4g}, {:.4g} are no focal lengths [px] of a {}x{} "
                                "image: are they normalized? Multiply them by the image's size",
                                raw.fx, raw.fy, raw.width, raw.height));
  double reach = std::hypot(raw.width, raw.height);
  if (camera.is_rational()) {
    const double share = camera.rational_reach();
    if (share > farthest_corner(raw)) return;
    reach = share * std::max(raw.fx, raw.fy);
  } else {
    if (raw.distortion == Distortion::kNone || share_with_ray(raw) == 1) return;
    for (const double x : {0.0, raw.width - 1.0})
      for (const double y : {0.0, raw.height - 1.0}) reach = std::min(reach, reach_px(raw, {x, y}));
  }
  throw FileError(
      path,
      fmt::format("distortion: the lens model is not monotonic beyond {:.0f} px from the principal "
                  "point, within the {}x{} image: the coefficients cannot be right",
                  reach, raw.width, raw.height));
}

UndistortedCamera undistort_plausibly(const std::string& path, const RawCamera& raw) {
  require_plausible_camera(path, raw);
  UndistortedCamera result = undistort_camera(raw);
  const double share = share_shown(result.remap, raw.camera);
  if (share < kLeastImageShare)
    throw FileError(
        path, fmt::format("distortion: only {:.2g} % of the image remain after undistortion: the "
                          "coefficients cannot be right",
                          100 * share));
  return result;
}

std::optional<DataNote> fit_to_image(const std::string& image_path, const Image& image,
                                     CalibrationYaml& yaml) {
  if (yaml.right) fit_right(yaml.width, yaml.height, image, yaml.right->raw.camera);
  if (yaml.width == 0 || yaml.height == 0) {
    yaml.width = image.cols;
    yaml.height = image.rows;
    return std::nullopt;
  }
  if (image.cols == yaml.width && image.rows == yaml.height) return std::nullopt;
  const double scale_x = static_cast<double>(image.cols) / yaml.width;
  const double scale_y = static_cast<double>(image.rows) / yaml.height;
  if (std::abs(scale_x / scale_y - 1) > kSameAspect)
    require_size(image_path, image, yaml.width, yaml.height);
  DataNote note{
      fmt::format("the calibration is for {}x{} images, these are {}x{}: intrinsics are "
                  "scaled by {:.4g}",
                  yaml.width, yaml.height, image.cols, image.rows, scale_x)};
  scale(scale_x, scale_y, yaml.fx, yaml.fy, yaml.cx, yaml.cy);
  yaml.width = image.cols, yaml.height = image.rows;
  return note;
}

std::optional<DataNote> odd_camera_height(double height_m) {
  if (height_m <= kGreatestHeight_m && height_m >= kLeastHeight_m) return std::nullopt;
  return of_scale(
      NoteCause::kCameraHeight,
      fmt::format("a camera height of {:g} m above the ground is implausible: is it in metres?",
                  height_m));
}

std::vector<DataNote> odd_calibration(const Calibration& calibration) {
  std::vector<DataNote> notes;
  const Camera& camera = calibration.camera;
  add_principal_point(camera, notes);
  const double baseline_m = calibration.baseline_m;
  if (baseline_m > kGreatestBaseline_m || (baseline_m > 0 && baseline_m < kLeastBaseline_m))
    notes.push_back(of_scale(
        NoteCause::kBaseline,
        fmt::format("a baseline of {:g} m is implausible for the two cameras of a vehicle or "
                    "a handheld device: it must be in metres, "
                    "not in millimetres and not times fx",
                    baseline_m)));
  if (calibration.camera_height_m)
    if (const auto note = odd_camera_height(*calibration.camera_height_m)) notes.push_back(*note);
  if (calibration.depth) {
    const double distance_m = calibration.depth->T_cam_depth.translation().norm();
    if (distance_m > kGreatestDepthCamera_m)
      notes.push_back(
          of_scale(NoteCause::kCalibration,
                   fmt::format("the depth camera is {:g} m from the camera (T_cam_depth): is this "
                               "in metres?",
                               distance_m)));
  }
  return notes;
}

}  // namespace placegraph
