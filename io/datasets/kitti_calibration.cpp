#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/kitti_calibration.h>
#include <placegraph/io/files/text_file.h>

namespace placegraph {
namespace {

/// The position of the camera of P = K [I | t] in the frame of camera 0: -t.
Eigen::Vector3d kitti_position(const KittiLine& P) {
  const std::vector<double>& p = P.numbers;
  const double z = p[11];
  return -Eigen::Vector3d((p[3] - p[2] * z) / p[0], (p[7] - p[6] * z) / p[5], z);
}

}  // namespace

KittiLines read_kitti_lines(const std::string& path,
                            const std::vector<std::pair<std::string, std::size_t>>& wanted) {
  TextFile file(path);
  KittiLines lines;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    std::string key(fields[0]);
    if (key.ends_with(':')) key.pop_back();
    if (key.starts_with("P_rect_0")) key.replace(0, 8, "P");
    for (const auto& [name, count] : wanted) {
      if (key != name) continue;
      if (fields.size() != count + 1) {
        file.fail(fmt::format("{}: expected {} numbers, found {}", key, count, fields.size() - 1));
      }
      KittiLine& entry = lines[key];
      if (entry.line > 0) file.fail(fmt::format("{}: is there twice", key));
      entry.line = file.line();
      for (std::size_t i = 1; i <= count; ++i) {
        entry.numbers.push_back(file.number(fields[i], name.c_str()));
      }
    }
  }
  return lines;
}

Camera kitti_camera(const std::string& path, const std::string& key, const KittiLine& P) {
  const std::vector<double>& p = P.numbers;
  const bool pinhole =
      p[0] > 0 && p[5] > 0 && p[1] == 0 && p[4] == 0 && p[8] == 0 && p[9] == 0 && p[10] == 1;
  if (!pinhole) {
    throw FileError(path, P.line, key + ": is not a projection matrix fx 0 cx . 0 fy cy . 0 0 1 .");
  }
  Camera camera;
  camera.fx = p[0], camera.cx = p[2], camera.fy = p[5], camera.cy = p[6];
  return camera;
}

void set_size(const std::string& first_image, const Image& image, Camera& camera) {
  camera.width = image.cols;
  camera.height = image.rows;
  try {
    camera.check();
  } catch (const ArgumentError& error) {
    throw FileError(first_image, error.what());
  }
}

KittiCameras read_kitti_cameras(const std::string& path, int left, bool with_right) {
  const auto lines = read_kitti_lines(path, {{"P0", 12}, {"P1", 12}, {"P2", 12}, {"P3", 12}});
  const std::string left_key = fmt::format("P{}", left), right_key = fmt::format("P{}", left + 1);
  const auto P_left = lines.find(left_key), P_right = lines.find(right_key);
  if (P_left == lines.end()) throw FileError(path, "has no line " + left_key + ":");
  KittiCameras cameras;
  cameras.camera = kitti_camera(path, left_key, P_left->second);
  cameras.position_in_cam0 = kitti_position(P_left->second);
  cameras.paired = P_right != lines.end();
  if (!with_right || P_right == lines.end()) return cameras;
  const Camera right = kitti_camera(path, right_key, P_right->second);
  if (right.fx != cameras.camera.fx || right.fy != cameras.camera.fy ||
      right.cx != cameras.camera.cx || right.cy != cameras.camera.cy)
    throw FileError(path, P_right->second.line,
                    right_key + ": has other intrinsics than " + left_key + ": not rectified");
  cameras.baseline_m = (P_left->second.numbers[3] - P_right->second.numbers[3]) / cameras.camera.fx;
  if (!(cameras.baseline_m > 0))
    throw FileError(
        path, P_right->second.line,
        fmt::format("{}: baseline is {} m, not positive", right_key, cameras.baseline_m));
  return cameras;
}

KittiCalibration read_kitti_calibration(const std::string& path) {
  const auto lines = read_kitti_lines(path, {{"P0", 12}, {"P1", 12}});
  const auto P0 = lines.find("P0"), P1 = lines.find("P1");
  if (P0 == lines.end()) throw FileError(path, "has no line P0:");
  KittiCalibration out;
  out.camera = kitti_camera(path, "P0", P0->second);
  if (P1 != lines.end()) {
    kitti_camera(path, "P1", P1->second);
    out.baseline_m = (P0->second.numbers[3] - P1->second.numbers[3]) / out.camera.fx;
  }
  return out;
}

}  // namespace placegraph
