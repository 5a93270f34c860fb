#include "apps/image/scene/scene_popup.h"

#include <fmt/format.h>
#include <placegraph/frontend/labels/scene_labels.h>
#include <placegraph/frontend/scene/popup.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/picture_file.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/image/scene/scene_images.h"
#include "apps/shipped/scene_models.h"
#include "apps/support/output.h"
#include "apps/support/read_calib.h"

namespace placegraph::apps {
namespace {

/// Without a calibration: a lens of about 58 degrees with a centred principal point.
Camera popup_camera(const ScenePopupArguments& a, const Image& image) {
  if (!a.calib.empty()) {
    const Camera camera = read_calib_without_distortion(a.calib, "image popup needs");
    require_size(a.image, image, camera.width, camera.height);
    return camera;
  }
  const double f = 0.9 * image.cols;
  return {image.cols,        image.rows, f, f, (image.cols - 1) / 2.0, (image.rows - 1) / 2.0,
          Distortion::kNone, {}};
}

template <class T>
void put_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// A mesh of the pixels with a position: squares whose corners have similar distances.
std::string mesh_of(const PopUp& popup, const GroundView& view, const Image& bgr) {
  constexpr float kStep = 1.25f;  // ratio of distances within a square
  std::string vertices, faces;
  Image number(bgr.size(), CV_32SC1, cv::Scalar(-1));
  int count = 0, squares = 0;
  for (int v = 0; v < bgr.rows; ++v)
    for (int u = 0; u < bgr.cols; ++u) {
      const auto point = popped_point(popup, view, u, v);
      if (!point) continue;
      number.at<int>(v, u) = count++;
      for (int i = 0; i < 3; ++i) put_bytes(vertices, static_cast<float>((*point)[i]));
      for (int c = 2; c >= 0; --c) put_bytes(vertices, bgr.at<cv::Vec3b>(v, u)[c]);
    }
  for (int v = 0; v + 1 < bgr.rows; ++v)
    for (int u = 0; u + 1 < bgr.cols; ++u) {
      const std::array<cv::Point, 4> corners = {
          cv::Point(u, v), {u, v + 1}, {u + 1, v + 1}, {u + 1, v}};
      float least = 1e9f, most = 0;
      bool all = true;
      for (const cv::Point& p : corners) {
        all = all && number.at<int>(p) >= 0;
        least = std::min(least, popup.distance.at<float>(p));
        most = std::max(most, popup.distance.at<float>(p));
      }
      if (!all || most > kStep * least) continue;
      ++squares;
      put_bytes(faces, std::uint8_t{4});
      for (const cv::Point& p : corners) put_bytes(faces, number.at<int>(p));
    }
  return fmt::format(
             "ply\nformat binary_little_endian 1.0\ncomment camera frame, metres: x right, y down, "
             "z forward\n"
             "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty "
             "uchar red\nproperty uchar green\n"
             "property uchar blue\nelement face {}\nproperty list uchar int "
             "vertex_indices\nend_header\n",
             count, squares) +
         vertices + faces;
}

Image surfaces_for(const ScenePopupArguments& a, const Image& image) {
  if (a.surfaces.empty())
    return label_scene(load_scene_model(SceneModel::Kind::kSurfaces, a.model), image).labels;
  const Image surfaces = read_image_as_stored(a.surfaces);
  if (surfaces.type() != CV_8UC1)
    throw FileError(a.surfaces, "no label image: one channel of 8 bits is needed");
  require_size(a.surfaces, surfaces, image.cols, image.rows);
  return surfaces;
}

/// Draws the box into the image and writes the image and the mask.
PlacedBox place_box(const ScenePopupArguments& a, const Image& bgr, const PopUp& popup,
                    const GroundView& view) {
  const StandingBox box{a.box[0], a.box[1], a.box[2], a.box[3], a.box[4]};
  Image mask;
  write_png(a.draw, overlay_box(bgr, popup, view, box, &mask));
  if (!a.mask.empty()) write_png(a.mask, mask);
  const Eigen::Vector3d foot = ground_place(view, box.right_m, box.forward_m);
  return {{view.camera.fx * foot.x() / foot.z() + view.camera.cx,
           view.camera.fy * foot.y() / foot.z() + view.camera.cy},
          cv::countNonZero(mask == 255),
          cv::countNonZero(mask == 128)};
}

}  // namespace

ScenePopupResult scene_popup(const ScenePopupArguments& a) {
  for (const std::string* path : {&a.out, &a.draw, &a.mask})
    if (!path->empty()) require_free(*path, a.force);
  require(a.draw.empty() == a.box.empty(), "--box: needs --draw, and --draw needs --box");
  require(a.box.empty() || a.box.size() == 5, "--box: five numbers are needed");
  cv::setNumThreads(1);
  const GreyAndColour read = read_image(a.image);
  Image bgr = read.colour;
  if (bgr.empty()) cv::cvtColor(read.grey, bgr, cv::COLOR_GRAY2BGR);
  GroundView view{popup_camera(a, bgr), Eigen::Vector3d::UnitY(), a.height_m};
  Random random(a.seed);
  Horizon horizon;
  if (!a.level)
    horizon = estimate_horizon(segments_of(detect_segments(read.grey, {})), view.camera, a.horizon,
                               random);
  view.down = horizon.down;
  const PopUp popup = pop_up(surfaces_for(a, bgr), view, a.farthest_m);
  write_file(a.out, mesh_of(popup, view, bgr));
  ScenePopupResult result{a.image, a.out, view.down, static_cast<bool>(horizon.outcome)};
  const double pitch = std::atan2(view.down.z(), view.down.y());
  result.horizon_row = view.camera.cy - view.camera.fy * std::tan(pitch);
  if (!a.box.empty()) result.box = place_box(a, bgr, popup, view);
  return result;
}

std::string to_json(const ScenePopupResult& result) {
  nlohmann::json report = {{"out", result.out},
                           {"down", {result.down.x(), result.down.y(), result.down.z()}},
                           {"horizon_from_lines", result.horizon_from_lines},
                           {"horizon_row", result.horizon_row}};
  if (result.box) {
    report["foot_px"] = {result.box->foot_px.x(), result.box->foot_px.y()};
    report["seen_px"] = result.box->seen_px;
    report["hidden_px"] = result.box->hidden_px;
  }
  return json_text(report, 2);
}

std::string to_text(const ScenePopupResult& result) {
  return fmt::format("{}: horizon at row {:.1f} of the middle column{}, written to {}\n",
                     result.image, result.horizon_row,
                     result.horizon_from_lines ? "" : " (level camera assumed)", result.out);
}

}  // namespace placegraph::apps
