#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/io/datasets/kitti_calibration.h>
#include <placegraph/io/synthetic/defects/vehicle.h>
#include <placegraph/io/synthetic/worlds/tours.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>
#include <placegraph/io/synthetic/worlds/traffic.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace placegraph::synthetic {
namespace {

namespace fs = std::filesystem;

constexpr double kRoadHalfWidth_m = 4;
constexpr double kRoadShift_m = 1.1;   ///< distance of the road's middle to the left of the track
constexpr double kSameStreet_m = 5.5;  ///< passes closer than this share one street
constexpr double kPathStep_m = 1.5;
constexpr double kSurfaceStiffness = 3000;  ///< spreads contradictions over about 20 m
constexpr std::size_t kMinPoses = 2;

struct RawDrive {
  std::vector<double> time_s;
  std::vector<Eigen::Matrix3d> R_scene_cam;
  std::vector<Eigen::Vector3d> position;
};

RawDrive read_drive(const std::string& path) {
  if (fs::is_directory(path)) throw FileError(path, "is a folder, not a pose file");
  const std::string times = (fs::path(path).parent_path() / "times.txt").string();
  Trajectory trajectory = read_frame_poses(path);
  const bool timed = fs::exists(times);
  if (timed) give_times(trajectory, path, times);
  if (trajectory.size() < kMinPoses) throw FileError(path, "holds fewer than 2 poses");
  RawDrive raw;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const StampedPose& pose = trajectory.poses[i];
    const int line = static_cast<int>(i) + 1;
    if (!pose.T_world_body) throw FileError(path, line, "the pose is nan");
    const Eigen::Vector3d p = pose.T_world_body->translation();
    if (i > 0 && (p - raw.position.back()).norm() > 20)
      throw FileError(path, line, "the pose lies more than 20 m from the one before");
    try {
      raw.R_scene_cam.push_back(SO3::from_matrix(pose.T_world_body->linear()).matrix());
    } catch (const ArgumentError&) {
      throw FileError(path, line, "the pose holds no rotation");
    }
    if (raw.R_scene_cam.back()(1, 1) < 0.7)
      throw FileError(path, line, "the camera is not upright (y must point down)");
    raw.position.push_back(p);
    raw.time_s.push_back(timed ? 1e-9 * static_cast<double>(pose.stamp_ns)
                               : 0.1 * static_cast<double>(i));
  }
  return raw;
}

Eigen::Vector2d flat(const Eigen::Vector3d& v) { return {v[0], v[2]}; }

GroundMesh fit_ground(const RawDrive& raw, const Undulation& undulation) {
  // Five samples across each pose keep the road level sideways where only one pass defines it.
  std::vector<Eigen::Vector3d> samples;
  Eigen::Vector2d low(1e30, 1e30), high(-1e30, -1e30), last(1e30, 1e30);
  for (std::size_t i = 0; i < raw.position.size(); ++i) {
    const Eigen::Vector3d& p = raw.position[i];
    low = low.cwiseMin(flat(p));
    high = high.cwiseMax(flat(p));
    if ((flat(p) - last).norm() < 0.5) continue;
    last = flat(p);
    const Eigen::Vector2d right = flat(raw.R_scene_cam[i].col(0)).normalized();
    for (const double side : {-7.0, -3.5, 0.0, 3.5, 7.0})
      samples.emplace_back(p[0] + side * right[0], p[1] + kDriveHeight_m, p[2] + side * right[1]);
  }
  const Eigen::Vector2d extent = (high - low).array() + 120;
  if (!(extent.maxCoeff() < 20000))
    throw ArgumentError("pose file: the path spans more than 20 km");
  const double spacing_m = std::max(4.0, std::sqrt(extent[0] * extent[1] / 40000));
  return GroundMesh(HeightSurface::fit(samples, spacing_m, kSurfaceStiffness, 60), undulation);
}

std::vector<double> smoothed(std::vector<double> values, int half) {
  const int n = static_cast<int>(values.size());
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<double> sum(n + 1, 0.0);
    for (int i = 0; i < n; ++i) sum[i + 1] = sum[i] + values[i];
    for (int i = 0; i < n; ++i) {
      const int a = std::max(0, i - half), b = std::min(n, i + half + 1);
      values[i] = (sum[b] - sum[a]) / (b - a);
    }
  }
  return values;
}

/// Places the camera on the surface: exact height; slow pitch and roll are those of the surface
/// plus the recording's median mounting angle, fast ones (nodding, vibration) are as recorded.
std::vector<SE3> settle(const RawDrive& raw, const GroundMesh& ground) {
  const std::size_t n = raw.position.size();
  std::vector<double> pitch(n), roll(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Matrix3d& R = raw.R_scene_cam[i];
    const Eigen::Vector3d up = ground.surface.normal(raw.position[i][0], raw.position[i][2]);
    // Slopes of the camera's axes against the surface, along their own directions.
    pitch[i] = R.col(2).dot(up) / flat(R.col(2)).norm();
    roll[i] = R.col(0).dot(up) / flat(R.col(0)).norm();
  }
  constexpr int kHalfWindow =
      12;  // [frames] with two passes, motion slower than about 2 s is that of the road
  const std::vector<double> slow_pitch = smoothed(pitch, kHalfWindow),
                            slow_roll = smoothed(roll, kHalfWindow);
  const double mount_pitch = median_of(pitch), mount_roll = median_of(roll);
  std::vector<SE3> poses;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Matrix3d& R = raw.R_scene_cam[i];
    const double x = raw.position[i][0], z = raw.position[i][2];
    const Eigen::Vector3d up = ground.surface.normal(x, z);
    const Eigen::Vector3d forward =
        (R.col(2) + (mount_pitch - slow_pitch[i]) * flat(R.col(2)).norm() * up).normalized();
    Eigen::Vector3d right = R.col(0) + (mount_roll - slow_roll[i]) * flat(R.col(0)).norm() * up;
    right = (right - forward * forward.dot(right)).normalized();
    Eigen::Matrix3d settled;
    settled << right, forward.cross(right), forward;
    const double level = ground.height(x, z) - ground.undulation_at(x, z);
    poses.push_back(
        on_undulation(ground, SE3(settled, Eigen::Vector3d(x, level - kDriveHeight_m, z))));
  }
  return poses;
}

/// The street network under the track: one marked road for each stretch driven for the first time,
/// and a plain strip under every pass.
std::vector<Roadway> find_roads(const std::vector<Eigen::Vector2d>& track) {
  std::vector<Roadway> roads;
  roads.push_back({track, 2.4, false, false});
  Roadway current;
  current.half_width_m = kRoadHalfWidth_m;
  const auto finish = [&] {
    if (length(current) > 8) roads.push_back(current);
    current.centre.clear();
  };
  for (std::size_t i = 0; i + 1 < track.size(); ++i) {
    const Eigen::Vector2d d =
        (track[std::min(track.size() - 1, i + 2)] - track[i >= 2 ? i - 2 : 0]).normalized();
    bool again = false;
    for (std::size_t j = 0; j + 30 < i && !again; ++j) {
      if ((track[j] - track[i]).squaredNorm() > kSameStreet_m * kSameStreet_m) continue;
      const Eigen::Vector2d e = (track[j + 1] - track[j]).normalized();
      again = std::abs(d.dot(e)) > 0.85;
    }
    if (again) {
      finish();
      continue;
    }
    current.centre.push_back(track[i] + kRoadShift_m * Eigen::Vector2d(-d[1], d[0]));
  }
  finish();
  return roads;
}

void use_calibration(const std::string& poses_path, Tour& tour) {
  tour.camera = kitti_camera();
  tour.baseline_m = kKittiBaseline_m;
  const fs::path calibration = fs::path(poses_path).parent_path() / "calib.txt";
  if (!fs::exists(calibration)) return;
  const KittiCalibration read = read_kitti_calibration(calibration.string());
  tour.camera.fx = read.camera.fx;
  tour.camera.fy = read.camera.fy;
  tour.camera.cx = read.camera.cx;
  tour.camera.cy = read.camera.cy;
  if (read.baseline_m > 0) tour.baseline_m = read.baseline_m;
}

}  // namespace

Tour make_drive(const std::string& poses_path, const TourRequest& request) {
  const RawDrive raw = read_drive(poses_path);
  std::vector<Eigen::Vector2d> driven, moved;
  for (const Eigen::Vector3d& p : raw.position) {
    driven.push_back(flat(p));
    if (moved.empty() || (flat(p) - moved.back()).norm() > 0.3) moved.push_back(flat(p));
  }
  // A standing camera needs a road, too.
  const Eigen::Vector2d ahead = flat(raw.R_scene_cam.back().col(2)).normalized();
  moved.push_back(moved.back() + 60 * ahead);
  moved.insert(moved.begin(),
               moved.front() - 10 * flat(raw.R_scene_cam.front().col(2)).normalized());
  const std::vector<Eigen::Vector2d> track = smooth_path(moved, kPathStep_m, 4.5);

  const Undulation undulation(request.undulation_m, request.seed);
  TownPlan plan{find_roads(track), fit_ground(raw, undulation), driven, request.seed};
  Tour tour;
  tour.name = fs::path(poses_path).stem().string();
  tour.scene = build_town(plan);
  use_calibration(poses_path, tour);
  tour.camera_height_m = kDriveHeight_m;
  tour.time_s = raw.time_s;
  tour.T_scene_cam = settle(raw, plan.ground);
  add_traffic(tour.scene, plan.ground, tour.time_s, tour.T_scene_cam, request.sensor.traffic,
              request.seed);
  return tour;
}

}  // namespace placegraph::synthetic
