// A box put into the pictures of a rendered town against where it truly would be seen.
//   bench_overlay_study MODEL OUT_PREFIX [SEED=1] [FRAMES=40]
// MODEL: of surfaces (configs/models/surfaces.pgscene). Boxes of 0.6 x 0.6 x 1.8 m stand on a grid
// over road and pavement before the camera, wherever nothing solid stands. The picture gives
// horizon and surfaces; camera and its height are known. Writes OUT_PREFIX_targets.tsv (figure,
// tab, value) and OUT_PREFIX_K.png for the first six frames.
#include <fmt/format.h>
#include <placegraph/frontend/internal/labels/surface_classifier.h>
#include <placegraph/frontend/internal/scene/horizon.h>
#include <placegraph/frontend/internal/scene/popup.h>
#include <placegraph/frontend/internal/segments/segment_detector.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/core/angle.h>
#include <placegraph/graph/internal/core/median.h>
#include <placegraph/io/internal/synthetic/worlds/synthetic_world.h>
#include <placegraph/io/internal/synthetic/worlds/tours.h>
#include <placegraph/io/models/scene_model_file.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "tests/support/pictures.h"

namespace placegraph {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using synthetic::Face;
using synthetic::Scene;
using synthetic::SurfaceClass;

struct Street {
  double y;  ///< scene frame, down
  bool is_road;
};

/// The road or pavement at (x, z) of the scene.
std::optional<Street> street_at(const Scene& scene, const Vector2d& place) {
  for (const synthetic::Part& part : scene.parts)
    for (const Face& face : part.faces) {
      if (face.label != SurfaceClass::kRoad && face.label != SurfaceClass::kPavement) continue;
      bool left = true, right = true;
      for (int i = 0; i < face.count; ++i) {
        const Vector3d& a = face.corners[static_cast<std::size_t>(i)];
        const Vector3d side = face.corners[static_cast<std::size_t>((i + 1) % face.count)] - a;
        const double side_sign = side.x() * (place.y() - a.z()) - side.z() * (place.x() - a.x());
        left = left && side_sign >= 0;
        right = right && side_sign <= 0;
      }
      if (!left && !right) continue;
      const Vector3d& a = face.corners[0];
      return Street{
          a.y() - (face.normal.x() * (place.x() - a.x()) + face.normal.z() * (place.y() - a.z())) /
                      face.normal.y(),
          face.label == SurfaceClass::kRoad};
    }
  return std::nullopt;
}

/// A box as it truly stands: nearest depth [m] along the ray of a pixel, where it is hit.
struct TrueBox {
  Eigen::Matrix3d R_box_cam;  ///< right, down, forward over the ground
  Vector3d foot_cam;
  StandingBox size;

  std::optional<double> depth(const Vector3d& ray) const {
    const Vector3d d = R_box_cam * ray, o = R_box_cam * -foot_cam;
    const Vector3d low(-size.width_m / 2, -size.tall_m, -size.depth_m / 2),
        high(size.width_m / 2, 0, size.depth_m / 2);
    double enter = 0, leave = 1e9;
    for (int i = 0; i < 3; ++i) {
      const double a = (low[i] - o[i]) / d[i], b = (high[i] - o[i]) / d[i];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (!(enter < leave) || enter <= 0) return std::nullopt;
    return enter;  // rays have z = 1
  }
};

struct Score {
  std::vector<double> horizon_deg;                     ///< by frame
  std::vector<double> plane_px, road_px, pavement_px;  ///< off the true foot, by box
  std::vector<double> best_road_px;                    ///< the true horizon's
  std::int64_t right = 0, pixels = 0, hidden_right = 0, hidden = 0;
};

Vector2d seen_at(const Camera& camera, const Vector3d& p) {
  return {camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy};
}

/// Pixels of the true box whose fate, seen (255) or hidden (128), is drawn as it should be.
void judge_pixels(const TrueBox& box, const Camera& camera, const Image& depth, const Image& drawn,
                  Score& score) {
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
      const std::optional<double> there = box.depth(ray);
      if (!there) continue;
      const float scene = depth.at<float>(v, u);
      const bool hidden = scene > 0 && scene < *there;
      const bool right = drawn.at<std::uint8_t>(v, u) == (hidden ? 128 : 255);
      ++score.pixels;
      score.right += right;
      score.hidden += hidden;
      score.hidden_right += hidden && right;
    }
}

void judge_frame(const SyntheticWorld& world, std::size_t k, const SceneModel& model,
                 const std::string& draw, Score& score) {
  const synthetic::Tour& tour = world.tour();
  SyntheticContents contents;
  contents.depth = true;
  const Frame frame = world.render(k, contents).frame;
  Image bgr;
  cv::cvtColor(frame.image, bgr, cv::COLOR_GRAY2BGR);
  const Calibration calibration = world.calibration();
  const SE3& T_scene_cam = tour.T_scene_cam[k];
  const GroundView truth{calibration.camera, T_scene_cam.rotation().inverse() * Vector3d::UnitY(),
                         tour.camera_height_m};
  Random random(1);
  GroundView view = truth;
  view.down =
      estimate_horizon(segments_of(detect_segments(frame.image, {})), view.camera, {}, random).down;
  score.horizon_deg.push_back(rad_to_deg(std::acos(std::min(1.0, view.down.dot(truth.down)))));
  const PopUp popup = pop_up(classify_surfaces(model, view_scene(bgr)).surfaces.labels, view);

  TrueBox box;
  const Vector3d z = Vector3d::UnitZ();
  const Vector3d forward = (z - z.dot(truth.down) * truth.down).normalized();
  box.R_box_cam.row(0) = truth.down.cross(forward).transpose();
  box.R_box_cam.row(1) = truth.down.transpose();
  box.R_box_cam.row(2) = forward.transpose();
  Image picture = bgr;
  for (const double ahead : {7.0, 10.0, 14.0, 19.0})
    for (const double right : {-6.0, -3.5, -1.0, 1.0, 3.5, 6.0}) {
      Vector3d p = T_scene_cam * Vector3d(ground_place(truth, right, ahead));
      const std::optional<Street> street = street_at(tour.scene, {p.x(), p.z()});
      if (!street) continue;
      p.y() = street->y;
      const bool taken = std::any_of(tour.scene.solids.begin(), tour.scene.solids.end(),
                                     [&](const synthetic::Footprint& solid) {
                                       return solid.distance({p.x(), p.z()}) < 0.5;
                                     });
      box.foot_cam = T_scene_cam.inverse() * p;
      const Vector2d foot = seen_at(truth.camera, box.foot_cam);
      if (taken || foot.x() < 20 || foot.x() > bgr.cols - 20 || foot.y() > bgr.rows - 10) continue;
      box.size = {right, ahead, 0.6, 0.6, 1.8};
      const Vector2d predicted = seen_at(view.camera, ground_place(view, right, ahead));
      const Vector2d level = seen_at(truth.camera, ground_place(truth, right, ahead));
      score.plane_px.push_back((predicted - level).norm());
      if (street->is_road) score.best_road_px.push_back((level - foot).norm());
      (street->is_road ? score.road_px : score.pavement_px).push_back((predicted - foot).norm());
      Image mask;
      picture = overlay_box(draw.empty() ? bgr : picture, popup, view, box.size, &mask);
      judge_pixels(box, truth.camera, frame.depth, mask, score);
    }
  if (!draw.empty()) test::write_picture(draw, picture);
}

void run(int count, char** arguments) {
  require(count >= 3, "MODEL OUT_PREFIX [SEED] [FRAMES] needed");
  const SceneModel model = read_scene_model(arguments[1]);
  const std::string prefix = arguments[2];
  SyntheticOptions options;
  options.seed = count > 3 ? std::strtoull(arguments[3], nullptr, 10) : 1;
  const int asked = count > 4 ? std::atoi(arguments[4]) : 40;
  require(asked > 0, "FRAMES: must be positive");
  const auto frames = static_cast<std::size_t>(asked);
  const SyntheticWorld world(options);
  Score score;
  for (std::size_t i = 0; i < frames; ++i)
    judge_frame(world, i * (world.size() - 1) / frames, model,
                i < 6 ? fmt::format("{}_{}.png", prefix, i) : "", score);
  std::ofstream targets(prefix + "_targets.tsv");
  const auto tell = [&](const char* figure, double value) {
    targets << fmt::format("{}\t{:.4g}\n", figure, value);
    fmt::print("{}: {:.4g}\n", figure, value);
  };
  tell("frames", static_cast<double>(frames));
  tell("boxes", static_cast<double>(score.plane_px.size()));
  tell("horizon, median error [deg]", median_of(score.horizon_deg));
  tell("boxes on the road", static_cast<double>(score.road_px.size()));
  tell("foot on a level plane, median error [px]", median_of(score.plane_px));
  tell("foot on the road, median error [px]", median_of(score.road_px));
  tell("foot on the road by the true horizon, median error [px]", median_of(score.best_road_px));
  tell("foot on the pavement, median error [px]", median_of(score.pavement_px));
  tell("pixels of boxes", static_cast<double>(score.pixels));
  tell("pixels right", static_cast<double>(score.right) / static_cast<double>(score.pixels));
  tell("hidden pixels", static_cast<double>(score.hidden));
  tell("hidden pixels right",
       static_cast<double>(score.hidden_right) / static_cast<double>(score.hidden));
}

}  // namespace
}  // namespace placegraph

int main(int count, char** arguments) {
  try {
    placegraph::run(count, arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_overlay_study: {}\n", error.what());
    return 2;
  }
  return 0;
}
