#include "apps/scene/cmd_scene_popup.h"

#include <fmt/format.h>
#include <placegraph/frontend/labels/surface_classifier.h>
#include <placegraph/frontend/scene/horizon.h>
#include <placegraph/frontend/scene/popup.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/scene/scene_pictures.h"
#include "apps/support/calib_option.h"
#include "apps/support/read_calib.h"
#include "apps/support/output.h"
#include "apps/support/scene_models.h"

namespace placegraph::apps {
namespace {

struct ScenePopupArguments {
  std::string image, out, calib, model, surfaces, draw, mask;
  double height_m = 1.5, farthest_m = 100;
  std::vector<double> box;
  std::uint64_t seed = 1;
  bool level = false, force = false, json = false;
  HorizonOptions horizon;
};

/// Without calibration: a lens of about 58 degrees across that looks through the middle.
Camera camera_for(const ScenePopupArguments& a, const Image& image) {
  if (!a.calib.empty()) {
    const Camera camera = read_calib_without_distortion(a.calib, "scene popup");
    require_size(a.image, image, camera.width, camera.height);
    return camera;
  }
  const double f = 0.9 * image.cols;
  return {image.cols,        image.rows, f, f, (image.cols - 1) / 2.0, (image.rows - 1) / 2.0,
          Distortion::kNone, {}};
}

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// A mesh of the pixels that have a place: squares whose corners are about as far.
std::string ply_of(const PopUp& popup, const GroundView& view, const Image& bgr) {
  constexpr float kStep = 1.25f;  // ratio of distances within a square
  std::string vertices, faces;
  Image number(bgr.size(), CV_32SC1, cv::Scalar(-1));
  int count = 0, squares = 0;
  for (int v = 0; v < bgr.rows; ++v)
    for (int u = 0; u < bgr.cols; ++u) {
      const auto point = popped_point(popup, view, u, v);
      if (!point) continue;
      number.at<int>(v, u) = count++;
      for (int i = 0; i < 3; ++i) put(vertices, static_cast<float>((*point)[i]));
      for (int c = 2; c >= 0; --c) put(vertices, bgr.at<cv::Vec3b>(v, u)[c]);
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
      put(faces, std::uint8_t{4});
      for (const cv::Point& p : corners) put(faces, number.at<int>(p));
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

Image surfaces_for(const ScenePopupArguments& a, const Image& picture) {
  if (a.surfaces.empty())
    return classify_surfaces(load_scene_model(SceneModel::Kind::kSurfaces, a.model),
                             view_scene(picture))
        .surfaces.labels;
  const Image surfaces = read_image_as_stored(a.surfaces);
  if (surfaces.type() != CV_8UC1)
    throw FileError(a.surfaces, "no label image: one channel of 8 bits is needed");
  require_size(a.surfaces, surfaces, picture.cols, picture.rows);
  return surfaces;
}

void pop_up_image(const ScenePopupArguments& a) {
  for (const std::string* path : {&a.out, &a.draw, &a.mask})
    if (!path->empty()) require_free(*path, a.force);
  require(a.draw.empty() == a.box.empty(),
          "--box: says what --draw puts into the picture; give both or neither");
  cv::setNumThreads(1);
  const GreyAndColour read = read_image(a.image);
  Image bgr = read.colour;
  if (bgr.empty()) cv::cvtColor(read.grey, bgr, cv::COLOR_GRAY2BGR);
  GroundView view{camera_for(a, bgr), Eigen::Vector3d::UnitY(), a.height_m};
  Random random(a.seed);
  Horizon horizon;
  if (!a.level)
    horizon = estimate_horizon(segments_of(detect_segments(read.grey, {})), view.camera, a.horizon,
                               random);
  view.down = horizon.down;
  const PopUp popup = pop_up(surfaces_for(a, bgr), view, a.farthest_m);
  write_file(a.out, ply_of(popup, view, bgr));
  nlohmann::json report = {{"out", a.out},
                           {"down", {view.down.x(), view.down.y(), view.down.z()}},
                           {"horizon_from_lines", static_cast<bool>(horizon.outcome)}};
  // Where the horizon crosses the middle column.
  const double pitch = std::atan2(view.down.z(), view.down.y());
  report["horizon_row"] = view.camera.cy - view.camera.fy * std::tan(pitch);
  if (!a.box.empty()) {
    const StandingBox box{a.box[0], a.box[1], a.box[2], a.box[3], a.box[4]};
    Image mask;
    write_png(a.draw, overlay_box(bgr, popup, view, box, &mask));
    if (!a.mask.empty()) write_png(a.mask, mask);
    const Eigen::Vector3d foot = ground_place(view, box.right_m, box.forward_m);
    report["foot_px"] = {view.camera.fx * foot.x() / foot.z() + view.camera.cx,
                         view.camera.fy * foot.y() / foot.z() + view.camera.cy};
    report["seen_px"] = cv::countNonZero(mask == 255);
    report["hidden_px"] = cv::countNonZero(mask == 128);
  }
  if (a.json)
    fmt::print("{}\n", report.dump(2));
  else
    fmt::print("{}: horizon at row {:.1f} of the middle column{}, written to {}\n", a.image,
               report["horizon_row"].get<double>(),
               horizon.outcome ? "" : " (level: no edges say more)", a.out);
}

}  // namespace

void add_scene_popup_command(CLI::App& scene) {
  CLI::App* command =
      scene.add_subcommand("popup", "Fold a picture up into space, and put a box into it");
  command->footer(
      "placegraph scene popup street.png --calib K.txt --camera-height 1.65 --out street.ply --box "
      "1,12,0.6,0.6,1.8 --draw overlay.png");
  auto arguments = std::make_shared<ScenePopupArguments>();
  ScenePopupArguments& a = *arguments;
  command->add_option("IMAGE", a.image, "image, without distortion")->required();
  command->add_option("--out", a.out, "write the mesh, PLY, in metres of the camera's frame")
      ->required();
  add_calib_option(*command, a.calib,
                   std::string("the camera: ") + kCalibFile + "; else a usual one is supposed");
  command->add_option("--camera-height", a.height_m, "above the ground [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--farthest", a.farthest_m, "nothing but the sky is farther [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--model", a.model,
                      "of surfaces, in place of the one that came with the program");
  command->add_option("--surfaces", a.surfaces,
                      "label image of `scene surfaces` to take instead of the model's");
  command->add_flag("--level", a.level, "the camera is level: do not ask the edges");
  command->add_option("--box", a.box, "right,forward,width,depth,height [m] of a box on the ground")
      ->delimiter(',')
      ->expected(5);
  command->add_option("--draw", a.draw,
                      "write the picture with the box in it, behind what is nearer");
  command->add_option("--mask", a.mask, "write where the box is seen (255) and hidden (128)");
  command->add_option("--seed", a.seed, "of the search for vanishing points")
      ->capture_default_str();
  command->add_flag("--json", a.json, "a report for machines");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { pop_up_image(*arguments); });
}

}  // namespace placegraph::apps
