#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/io/synthetic/render/height_surface.h>
#include <placegraph/io/synthetic/render/sensor_model.h>
#include <placegraph/io/synthetic/render/world.h>

#include <memory>
#include <string>
#include <vector>

namespace placegraph::synthetic {

struct FlightSetting;

/// A scene and a camera's path through it: the result of a world file.
struct Tour {
  std::string name;
  Scene scene;
  std::vector<double> time_s;
  std::vector<SE3> T_scene_cam;
  Camera camera;
  double baseline_m = 0;
  double camera_height_m = 0;  ///< camera height above the ground at every pose; 0: it changes
  bool has_depth = false;      ///< depth is written by default (indoor worlds)
  std::string floor_plan;      ///< JSON; empty outdoors
  /// Velocity of the camera in its own axes, [translation, rotation], if it is known better than
  /// from the poses; else empty.
  std::vector<Vector6d> velocity_cam;
  std::shared_ptr<const FlightSetting> flight_setting;  ///< null except in the flight world
};

struct TourRequest {
  std::uint64_t seed = 1;
  SensorModel sensor;
  double duration_s = 0;    ///< duration of worlds without a fixed one; 0 = default
  double undulation_m = 0;  ///< root mean square of the height of the road's undulation
};

/// A drive at 10 Hz through a small grid of streets, about 650 m, parts of it twice.
Tour make_town_loop(const TourRequest& request);
/// A street of seven blocks that are identical to the last brick, driven once: every loop is false.
Tour make_repeated_blocks(const TourRequest& request);
/// Two rounds through the corridor of an office floor, past open and closed rooms, about 95 m.
Tour make_corridor_loop(const TourRequest& request);
/// A walk between the racks of a hall and through the offices beside it, partly twice.
Tour make_warehouse(const TourRequest& request);
/// A camera in the hand that turns about itself at three or four places of a small room, 30 Hz.
Tour make_turning_walk(const TourRequest& request);
/// A town around any KITTI pose file. Times and calibration are taken from `times.txt` and
/// `calib.txt` beside it if they exist. The poses keep x, z and the rotation's vibration; height,
/// mean pitch and roll follow one surface fitted to all passes; the camera is 1.65 m above the
/// rendered ground, measured vertically. Throws FileError for a bad file.
Tour make_drive(const std::string& poses_path, const TourRequest& request);

/// KITTI's camera 0 of drives 04-12 (f = 707.1, 1241 x 376) and its stereo baseline.
Camera kitti_camera();
constexpr double kKittiBaseline_m = 0.5372;
constexpr double kDriveHeight_m = 1.65;

/// A polyline resampled to steps of `step_m`, its corners rounded by averaging over `window_m`
/// three times.
std::vector<Eigen::Vector2d> smooth_path(const std::vector<Eigen::Vector2d>& corners, double step_m,
                                         double window_m);

struct SpeedLimits {
  double cruise_mps = 10, lateral_mps2 = 3.5, forward_mps2 = 2.0;
};
/// Positions along `path` of a vehicle at every `interval_s`: as fast as allowed, slow in bends.
std::vector<double> drive_positions(const std::vector<Eigen::Vector2d>& path, double step_m,
                                    const SpeedLimits& limits, double interval_s);

/// Point and unit direction at an arc length of a path with even steps; clamped to its ends.
struct PathPoint {
  Eigen::Vector2d position, direction;
};
PathPoint path_point(const std::vector<Eigen::Vector2d>& path, double step_m, double s);

/// Camera axes (x right, y down, z forward) from a forward direction and an up-pointing normal,
/// rotated by the small angles `pitch`, `yaw`, `roll` [rad].
Eigen::Matrix3d camera_axes(const Eigen::Vector3d& forward, const Eigen::Vector3d& up, double pitch,
                            double yaw, double roll);

}  // namespace placegraph::synthetic
