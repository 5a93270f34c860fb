#include <placegraph/frontend/floor_plan/skirting_line.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

/// Distance of neighbouring points in the image. Chosen.
constexpr int kFloorStep_px = 8;
/// Standard deviation of the row where floor and wall meet. Chosen; the cells
/// of the orientation map are 3 px wide.
constexpr double kBoundarySigma_px = 1.5;

/// End of the floor in an image's column, from below.
struct FloorEnd {
  double row = -1;    ///< row where it meets the wall
  int wall_row = -1;  ///< lowest pixel of the wall
  int axis = -1;      ///< axis of the wall's normal
};

class FloorViewer {
 public:
  FloorViewer(const OrientationMap& map, const std::vector<LineSegment>& segments,
              const std::vector<int>& axis, const Camera& camera, const SO3& R_cam_manhattan,
              double height_m, const SkirtingLineOptions& options)
      : map_(map),
        segments_(segments),
        axis_(axis),
        camera_(camera),
        R_(R_cam_manhattan.matrix()),
        height_m_(height_m),
        options_(options),
        down_(R_.col(map.vertical_axis)) {
    if (down_[1] < 0) down_ = -down_;
  }

  std::vector<SurfacePoint> find() {
    for (int u = kFloorStep_px / 2; u < camera_.width; u += kFloorStep_px) {
      add_floor(u);
      if (const FloorEnd end = floor_end(u); end.axis >= 0) add_wall(u, end);
    }
    return std::move(points_);
  }

 private:
  int label(int u, int v) const { return map_.labels.at<std::uint8_t>(v, u) - 1; }
  Eigen::Vector3d ray(double u, double v) const {
    return {(u - camera_.cx) / camera_.fx, (v - camera_.cy) / camera_.fy, 1};
  }
  /// First row below the horizon.
  int first_row(int u) const {
    const double x = (u - camera_.cx) / camera_.fx;
    const double horizon = camera_.cy - camera_.fy * (down_[0] * x + down_[2]) / down_[1];
    return static_cast<int>(std::clamp(horizon + 3, 0.0, static_cast<double>(camera_.height)));
  }
  /// Point of the floor at a pixel.
  Eigen::Vector3d on_floor(double u, double v) const {
    return height_m_ / down_.dot(ray(u, v)) * ray(u, v);
  }

  void add_floor(int u) {
    const auto sigma = static_cast<float>(0.02 * height_m_);
    for (int v = camera_.height - 1; v > first_row(u); v -= kFloorStep_px) {
      if (label(u, v) != map_.vertical_axis) continue;
      const Eigen::Vector3d point = on_floor(u, v);
      if (point.z() > options_.max_range_m) break;
      points_.push_back({point.cast<float>(), (-down_).cast<float>(), sigma});
    }
  }

  FloorEnd floor_end(int u) const {
    constexpr int kGap = 40;  // largest number of pixels without a label in between
    int floor_row = -1;
    for (int v = camera_.height - 1; v > first_row(u); --v) {
      const int axis = label(u, v);
      if (axis == map_.vertical_axis) floor_row = v;
      if (axis < 0 || axis == map_.vertical_axis) continue;
      if (floor_row < 0 || floor_row - v > kGap) return {};
      FloorEnd end{0.5 * (floor_row + v), v, axis};
      end.row = foot(u, end);
      return end;
    }
    return {};
  }

  /// Lowest edge along the wall that may be its foot; otherwise the end of the floor's label.
  double foot(int u, const FloorEnd& end) const {
    const int along = 3 - map_.vertical_axis - end.axis;
    const Eigen::Vector3d normal = R_.col(end.axis), top = ray(u, end.row);
    // Distance of an edge below and above the end of the floor. Chosen.
    constexpr double kReach_px = 8, kAbove_px = 4;
    double lowest = std::max(end.row - kAbove_px, first_row(u) + 1.0);
    bool found = false;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (axis_[i] != along) continue;
      const Eigen::Vector2d a = segments_[i].start, extent = segments_[i].end - a;
      if (std::abs(extent[0]) < 1) continue;
      const double share = (u - a[0]) / extent[0], slack = kReach_px / extent.norm();
      if (share < -slack || share > 1 + slack) continue;
      const double row = a[1] + share * extent[1];
      if (row < lowest || row > camera_.height - 1) continue;
      // Height of the label's end on the wall above that foot.
      const double depth = normal.dot(on_floor(u, row)) / normal.dot(top);
      if (!(height_m_ - depth * down_.dot(top) <= options_.skirting_m)) continue;
      lowest = row, found = true;
    }
    return found ? lowest : end.row;
  }

  void add_wall(int u, const FloorEnd& end) {
    const Eigen::Vector3d foot = on_floor(u, end.row);
    if (foot.z() > options_.max_range_m || foot.z() <= 0) return;
    Eigen::Vector3d normal = R_.col(end.axis);
    if (normal.dot(foot) > 0) normal = -normal;
    const double distance = normal.dot(foot);
    // Displacement of the wall for an error of one row at the foot.
    const double shift = std::abs(normal.dot(on_floor(u, end.row + 1)) - distance);
    const auto sigma = static_cast<float>(std::max(0.01, kBoundarySigma_px * shift));
    int labelled_row = end.wall_row;
    for (int v = end.wall_row; v >= 0; v -= kFloorStep_px) {
      const int axis = label(u, v);
      if (axis < 0 && 2 * (labelled_row - v) <= camera_.height) continue;
      if (axis != end.axis) break;
      labelled_row = v;
      const double cosine = normal.dot(ray(u, v));
      if (cosine > -0.05) break;
      const double depth = distance / cosine;
      if (depth <= 0 || depth > 2 * options_.max_range_m) break;
      points_.push_back({(depth * ray(u, v)).cast<float>(), normal.cast<float>(), sigma});
    }
  }

  const OrientationMap& map_;
  const std::vector<LineSegment>& segments_;
  const std::vector<int>& axis_;
  const Camera& camera_;
  Eigen::Matrix3d R_;
  double height_m_;
  const SkirtingLineOptions& options_;
  Eigen::Vector3d down_;
  std::vector<SurfacePoint> points_;
};

}  // namespace

std::vector<SurfacePoint> surface_points_on_floor(const OrientationMap& map,
                                                  const std::vector<LineSegment>& segments,
                                                  const std::vector<int>& axis,
                                                  const Camera& camera, const SO3& R_cam_manhattan,
                                                  double height_m,
                                                  const SkirtingLineOptions& options) {
  options.check();
  require(height_m > 0, "surface points: the camera's height must be positive");
  require(segments.size() == axis.size(), "surface points: needs an axis for every segment");
  if (!map.outcome) return {};
  return FloorViewer(map, segments, axis, camera, R_cam_manhattan, height_m, options).find();
}

}  // namespace placegraph
