// Square markers against the truth: the simulated picture of tags among the research data, and a
// sweep of rendered views over tilts, distances, blur and noise.
//   bench_marker_study OUT_PREFIX [SEEDS=3] [APRILTAG_SIM_FOLDER]
// writes OUT_PREFIX.md (tables) and OUT_PREFIX_targets.tsv (figure, tab, value).
#include <fmt/format.h>
#include <placegraph/frontend/markers/marker_filter.h>
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "tests/support/scenes/apriltag_sim.h"
#include "tests/support/scenes/marker_scene.h"

namespace {

using namespace placegraph;
using namespace placegraph::test;

double angle_deg(const SE3& a, const SE3& b) {
  return (a.rotation().inverse() * b.rotation()).log().norm() / kRadPerDeg;
}
double cpu_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Report {
  std::string markdown, targets;
  void target(const std::string& figure, double value) {
    targets += fmt::format("{}\t{:.4g}\n", figure, value);
  }
};

void study_apriltag_sim(const std::string& folder, Report& report) {
  const SimulatedTags truth = read_apriltag_sim(folder);
  const auto found = MarkerDetector({}, "apriltag_36h11").detect(truth.image);
  double corner_px = 0, path_percent = 0, rotation_deg = 0;
  report.markdown +=
      "| tag | corners, worst [px] | position [% of range] | attitude [deg] "
      "| chi2 of the mirrored pose |\n|---|---|---|---|---|\n";
  for (const MarkerObservation& observation : found) {
    const SimulatedTag& tag = truth.tags.at(observation.id);
    const double px = worst_corner_px(observation.corners_px, tag.corners_px);
    const MarkerPoses poses = estimate_marker_poses(observation, tag.side_m, truth.camera);
    if (!poses.outcome) continue;
    const SE3& T = poses.poses[0].T_cam_marker;
    const double range = tag.T_cam_marker.translation().norm();
    const double path = 100 * (T.translation() - tag.T_cam_marker.translation()).norm() / range;
    const double angle_error_deg = angle_deg(T, tag.T_cam_marker);
    corner_px = std::max(corner_px, px);
    path_percent = std::max(path_percent, path);
    rotation_deg = std::max(rotation_deg, angle_error_deg);
    report.markdown += fmt::format("| {} | {:.3f} | {:.2f} | {:.2f} | {:.0f} |\n", observation.id,
                                   px, path, angle_error_deg, poses.margin());
  }
  report.target("apriltag_sim, corners [px]", corner_px);
  report.target("apriltag_sim, position [%]", path_percent);
  report.target("apriltag_sim, attitude [deg]", rotation_deg);
  const MarkerDetector detector({}, "apriltag_36h11");
  std::vector<ExpectedSquare> near;
  for (const MarkerObservation& observation : found) near.push_back({observation.corners_px});
  constexpr int kTimes = 50;
  double begin = cpu_ms();
  for (int i = 0; i < kTimes; ++i) (void)detector.detect(truth.image);
  const double whole = (cpu_ms() - begin) / kTimes;
  begin = cpu_ms();
  for (int i = 0; i < kTimes; ++i) (void)detector.detect_near(truth.image, near);
  report.target("whole image [ms CPU]", whole);
  report.target("five markers near where they were [ms CPU]", (cpu_ms() - begin) / kTimes);
  report.markdown += "\n";
}

/// What became of the views of one kind.
struct Tally {
  int views = 0, seen = 0, undecided = 0, wrong = 0, predictions = 0;
  double worst_px = 0, corner_nees = 0, pose_nees = 0;
  std::vector<double> corner_px;

  /// The distance that this share of the corners stays below.
  double corner_at(double share) {
    if (corner_px.empty()) return 0;
    std::sort(corner_px.begin(), corner_px.end());
    return corner_px[static_cast<std::size_t>(share * static_cast<double>(corner_px.size() - 1))];
  }
};

/// The pose that exact corners could be taken for beside the true one, if there is one.
std::optional<SE3> rival(const MarkerScene& scene, const SE3& T_world_cam) {
  const PlacedMarker& placed = scene.layout.markers[0];
  MarkerObservation exact;
  exact.covariance *= 0.01;
  for (int k = 0; k < 4; ++k)
    exact.corners_px[k] = *scene.camera.project(T_world_cam.inverse() * placed.T_world_marker *
                                                placed.corners_marker()[k]);
  const MarkerPoses poses = estimate_marker_poses(exact, placed.side_m, scene.camera);
  if (poses.poses.size() < 2) return std::nullopt;
  return placed.T_world_marker * poses.poses[1].T_cam_marker.inverse();
}

void judge(const MarkerScene& scene, const SE3& T_world_cam, const Image& image,
           const MarkerDetector& detector, const std::optional<SO3>& body_rotation,
           std::int64_t stamp_ns, MarkerFilter& filter, Tally& tally) {
  ++tally.views;
  MarkerView view;
  view.stamp_ns = stamp_ns;
  view.markers = detector.detect(image);
  view.rotation_body = body_rotation;
  if (view.markers.size() != 1) return;
  ++tally.seen;
  const PlacedMarker& placed = scene.layout.markers[0];
  const auto& observation = view.markers[0];
  Eigen::Matrix<double, 8, 1> error;
  for (int k = 0; k < 4; ++k)
    error.segment<2>(2 * k) = observation.corners_px[k] -
                              *scene.camera.project(T_world_cam.inverse() * placed.T_world_marker *
                                                    placed.corners_marker()[k]);
  for (int k = 0; k < 4; ++k) {
    const double px = error.segment<2>(2 * k).norm();
    tally.worst_px = std::max(tally.worst_px, px);
    tally.corner_px.push_back(px);
  }
  tally.corner_nees += error.dot(observation.covariance.ldlt().solve(error)) / 8;
  const MarkerPoseEstimate estimate = filter.observe(view);
  if (!estimate.outcome) {
    ++tally.undecided;
    return;
  }
  ++tally.predictions;
  const Vector6d d = (estimate.observation.T_world_body.inverse() * T_world_cam).log();
  tally.pose_nees += d.dot(estimate.observation.covariance.ldlt().solve(d)) / 6;
  const auto other = rival(scene, T_world_cam);
  if (other && angle_deg(estimate.observation.T_world_body, *other) <
                   angle_deg(estimate.observation.T_world_body, T_world_cam)) {
    ++tally.wrong;
  }
}

std::string row(const std::string& name, Tally& tally) {
  return fmt::format("| {} | {} | {} | {} | {} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {:.2f} |\n",
                     name, tally.views, tally.seen, tally.undecided, tally.wrong,
                     tally.corner_at(0.5), tally.corner_at(0.99), tally.worst_px,
                     tally.corner_nees / std::max(1, tally.seen),
                     tally.pose_nees / std::max(1, tally.predictions));
}
const char* const kHead =
    "| {} | views | seen | undecided | wrong pose | median [px] | 99 % [px] | worst [px] | NEES/8 "
    "| NEES/6 |\n|---|---|---|---|---|---|---|---|---|---|\n";

/// Single views, nothing known before; and views of a camera that sways, its turns known by a gyro.
void study_tilts(int seeds, Report& report) {
  MarkerScene scene;
  scene.camera = MarkerScene::usual_camera();
  scene.layout.markers = {{3, 0.2, SE3()}};
  scene.samples = 4;
  const MarkerDetector detector({}, scene.layout.dictionary);
  std::map<int, Tally> by_tilt, by_range, swaying;
  Tally all, all_swaying;
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed), 3);
    for (const double range : {0.6, 1.2, 2.0, 3.0, 4.0})
      for (const double blur : {0.5, 1.0, 1.5})
        for (const double noise : {2.0, 8.0})
          for (int tilt = 0; tilt <= 75; tilt += 5) {
            scene.blur_px = blur;
            scene.noise = noise;
            const SE3 T =
                looking_at_origin(range, tilt * kRadPerDeg, random.uniform(0, 2 * std::numbers::pi),
                                  random.uniform(0, 2 * std::numbers::pi)) *
                SE3(SO3::exp({random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0}),
                    Eigen::Vector3d::Zero());
            const Image image = scene.render(T, random);
            for (Tally* tally : {&by_tilt[tilt], &by_range[static_cast<int>(10 * range)], &all}) {
              MarkerFilter filter({}, scene.layout, scene.camera, SE3());
              judge(scene, T, image, detector, std::nullopt, 1, filter, *tally);
            }
          }
    // From straight above to the side and back, in steps of 2.5 degrees.
    for (const double range : {1.2, 2.5, 4.0})
      for (const double blur : {0.5, 1.2}) {
        scene.blur_px = blur;
        scene.noise = 4;
        MarkerFilter filter({}, scene.layout, scene.camera, SE3());
        const double azimuth = random.uniform(0, 2 * std::numbers::pi),
                     roll = random.uniform(0, 2 * std::numbers::pi);
        SE3 before;
        for (int step = 0; step < 60; ++step) {
          const double tilt = (step < 30 ? step : 60 - step) * 2.5;
          const SE3 T = looking_at_origin(range, tilt * kRadPerDeg, azimuth + 0.01 * step, roll);
          std::optional<SO3> body_rotation;
          if (step > 0) {
            const double s = 0.002;
            body_rotation =
                before.rotation().inverse() * T.rotation() *
                SO3::exp({random.normal(0, s), random.normal(0, s), random.normal(0, s)});
          }
          before = T;
          const Image image = scene.render(T, random);
          judge(scene, T, image, detector, body_rotation, 50'000'000LL * (step + 1), filter,
                all_swaying);
        }
      }
  }
  report.markdown += fmt::format(fmt::runtime(kHead), "tilt [deg]");
  for (auto& [tilt, tally] : by_tilt) report.markdown += row(std::to_string(tilt), tally);
  report.markdown += "\n";
  report.markdown += fmt::format(fmt::runtime(kHead), "range [m]");
  for (auto& [range, tally] : by_range)
    report.markdown += row(fmt::format("{:.1f}", range / 10.0), tally);
  report.markdown += row("all", all);
  report.markdown += row("swaying camera with a gyro", all_swaying);
  report.markdown += "\n";
  report.target("sweep, wrong poses", all.wrong);
  report.target("sweep, views seen", all.seen);
  report.target("sweep, undecided", all.undecided);
  report.target("swaying, wrong poses", all_swaying.wrong);
  report.target("swaying, views seen", all_swaying.seen);
  report.target("swaying, undecided", all_swaying.undecided);
  for (const double percent : {95.0, 99.0})
    report.target(fmt::format("sweep, corners, {:.0f} % [px]", percent),
                  all.corner_at(percent / 100));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "bench_marker_study OUT_PREFIX [SEEDS=3] [APRILTAG_SIM_FOLDER]\n");
    return 2;
  }
  try {
    Report report;
    if (argc > 3) study_apriltag_sim(argv[3], report);
    study_tilts(argc > 2 ? std::atoi(argv[2]) : 3, report);
    const std::string prefix = argv[1];
    std::ofstream(prefix + ".md") << report.markdown;
    std::ofstream(prefix + "_targets.tsv") << report.targets;
    std::fputs(report.targets.c_str(), stdout);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_marker_study: %s\n", error.what());
    return 2;
  }
}
