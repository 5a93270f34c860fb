#include <placegraph/eval/scene/floor_plan_check.h>
#include <placegraph/graph/core/angle.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace placegraph {
namespace {

using Eigen::Vector2d;

// Distance of the samples along walls. Chosen.
constexpr double kStep_m = 0.05;

struct Segment {
  Vector2d a, b;
};
struct Sample {
  Vector2d at, normal;
};

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

bool crosses(const Vector2d& p, const Vector2d& q, const Segment& s) {
  const double a = cross(q - p, s.a - p), b = cross(q - p, s.b - p);
  const double c = cross(s.b - s.a, p - s.a), d = cross(s.b - s.a, q - s.a);
  return (a > 0) != (b > 0) && (c > 0) != (d > 0);
}

/// The pieces of a wall between its doors; `closed_too`: closed doors are pieces as well.
std::vector<Segment> solid_pieces(const TrueFloorPlan& truth, std::size_t wall, bool closed_too) {
  const TrueFloorPlan::Wall& w = truth.walls[wall];
  const Vector2d axis = (w.b - w.a).normalized();
  std::vector<std::pair<double, double>> gaps;
  for (const TrueFloorPlan::Door& door : truth.doors) {
    if (door.wall != static_cast<int>(wall) || (closed_too && door.closed)) continue;
    const double s = axis.dot(door.a - w.a), t = axis.dot(door.b - w.a);
    gaps.emplace_back(std::min(s, t), std::max(s, t));
  }
  std::sort(gaps.begin(), gaps.end());
  std::vector<Segment> pieces;
  double from = 0;
  for (const auto& [begin, end] : gaps) {
    if (begin > from) pieces.push_back({w.a + from * axis, w.a + begin * axis});
    from = end;
  }
  const double length = (w.b - w.a).norm();
  if (length > from) pieces.push_back({w.a + from * axis, w.b});
  return pieces;
}

/// The surfaces that are visible from the poses, in the plane.
class Visibility {
 public:
  Visibility(const TrueFloorPlan& truth, const std::vector<SE3>& poses,
             const FloorPlanCheckOptions& options)
      : options_(options) {
    for (std::size_t i = 0; i < truth.walls.size(); ++i)
      for (const Segment& piece : solid_pieces(truth, i, true)) blocks_.push_back(piece);
    std::optional<View> last;
    for (const SE3& pose : poses) {
      const Eigen::Vector3d t = pose.translation(), z = pose.rotation().matrix().col(2);
      const View view{{t[0], t[2]}, Vector2d(z[0], z[2]).normalized()};
      if (last && (last->at - view.at).norm() < 0.4 && last->axis.dot(view.axis) > 0.995) continue;
      views_.push_back(view);
      last = view;
    }
  }

  bool sees(const Vector2d& at, const Vector2d& normal) const {
    const double least_view = std::cos(deg_to_rad(options_.half_view_deg));
    const double least_incidence = std::sin(deg_to_rad(options_.min_incidence_deg));
    return std::any_of(views_.begin(), views_.end(), [&](const View& view) {
      const Vector2d offset = at - view.at;
      const double range = offset.norm();
      if (range > options_.range_m || range < 0.1) return false;
      if (view.axis.dot(offset) < least_view * range ||
          -normal.dot(offset) < least_incidence * range)
        return false;
      const Vector2d near = at + 0.02 * normal;
      return std::none_of(blocks_.begin(), blocks_.end(),
                          [&](const Segment& block) { return crosses(view.at, near, block); });
    });
  }

 private:
  struct View {
    Vector2d at, axis;
  };
  const FloorPlanCheckOptions& options_;
  std::vector<Segment> blocks_;
  std::vector<View> views_;
};

std::vector<Sample> samples_of(const Segment& segment, const Vector2d& normal) {
  std::vector<Sample> samples;
  const double length = (segment.b - segment.a).norm();
  const int count = static_cast<int>(length / kStep_m);
  for (int i = 0; i < count; ++i)
    samples.push_back({segment.a + (segment.b - segment.a) * ((i + 0.5) / count), normal});
  return samples;
}

double distance_to(const Vector2d& p, const Segment& s) {
  const Vector2d offset = s.b - s.a;
  const double share = std::clamp(offset.dot(p - s.a) / offset.squaredNorm(), 0.0, 1.0);
  return (s.a + share * offset - p).norm();
}

struct Surface {
  Segment segment;
  Vector2d normal;
};

/// The distance to the nearest surface with the same orientation, at most one metre.
double nearest(const Sample& sample, const std::vector<Surface>& surfaces) {
  double best = 1;
  for (const Surface& surface : surfaces)
    if (surface.normal.dot(sample.normal) > 0.9)
      best = std::min(best, distance_to(sample.at, surface.segment));
  return best;
}

std::vector<Surface> true_surfaces(const TrueFloorPlan& truth) {
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < truth.walls.size(); ++i) {
    const TrueFloorPlan::Wall& wall = truth.walls[i];
    const Vector2d axis = (wall.b - wall.a).normalized(), across(-axis[1], axis[0]);
    for (const Segment& piece : solid_pieces(truth, i, false))
      for (const double side : {-1.0, 1.0}) {
        const Vector2d off = side * 0.5 * wall.thickness_m * across;
        surfaces.push_back({{piece.a + off, piece.b + off}, side * across});
      }
  }
  return surfaces;
}

double median(std::vector<double> values) {
  if (values.empty()) return 1;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

double share_below(const std::vector<double>& values, double limit) {
  if (values.empty()) return 0;
  return static_cast<double>(
             std::count_if(values.begin(), values.end(), [&](double v) { return v < limit; })) /
         static_cast<double>(values.size());
}

/// Rooms on a raster of the truth's plan.
class RoomRaster {
 public:
  explicit RoomRaster(const TrueFloorPlan& truth) {
    low_ = Vector2d::Constant(1e9);
    Vector2d high = -low_;
    for (const TrueFloorPlan::Room& room : truth.rooms)
      low_ = low_.cwiseMin(room.low), high = high.cwiseMax(room.high);
    low_ -= Vector2d::Constant(1);
    size_ = {static_cast<int>((high[0] + 1 - low_[0]) / kStep_m),
             static_cast<int>((high[1] + 1 - low_[1]) / kStep_m)};
    cv::Mat1b space(size_, static_cast<uchar>(0));
    for (const TrueFloorPlan::Room& room : truth.rooms) fill_box(space, room.low, room.high, 255);
    for (const TrueFloorPlan::Wall& wall : truth.walls) {
      const Vector2d half = Vector2d::Constant(0.5 * wall.thickness_m);
      fill_box(space, wall.a.cwiseMin(wall.b) - half, wall.a.cwiseMax(wall.b) + half, 0);
    }
    count_ = cv::connectedComponents(space, spaces_, 4, CV_32S);
  }

  int space_at(const Vector2d& p) const {
    const cv::Point q = cell(p);
    return q.x >= 0 && q.y >= 0 && q.x < size_.width && q.y < size_.height ? spaces_(q) : 0;
  }
  int count() const { return count_; }
  cv::Mat1b space(int k) const { return spaces_ == k; }

  cv::Mat1b room(const std::vector<Vector2d>& outline,
                 const std::vector<std::vector<Vector2d>>& holes) const {
    cv::Mat1b mask(size_, static_cast<uchar>(0));
    std::vector<std::vector<cv::Point>> rings{ring(outline)};
    for (const auto& hole : holes) rings.push_back(ring(hole));
    cv::fillPoly(mask, rings, 255);  // even-odd: holes stay empty
    return mask;
  }

 private:
  cv::Point cell(const Vector2d& p) const {
    return {static_cast<int>(std::floor((p[0] - low_[0]) / kStep_m)),
            static_cast<int>(std::floor((p[1] - low_[1]) / kStep_m))};
  }
  std::vector<cv::Point> ring(const std::vector<Vector2d>& points) const {
    std::vector<cv::Point> cells;
    for (const Vector2d& p : points) cells.push_back(cell(p));
    return cells;
  }
  void fill_box(cv::Mat1b& image, const Vector2d& low, const Vector2d& high, uchar value) const {
    const Vector2d half = Vector2d::Constant(0.5 * kStep_m);
    const cv::Point a = cell(low + half), b = cell(high - half);
    cv::rectangle(image, a, b, value, cv::FILLED);
  }

  Vector2d low_;
  cv::Size size_;
  cv::Mat1i spaces_;
  int count_ = 0;
};

class Checker {
 public:
  Checker(const FloorPlan& plan, const TrueFloorPlan& truth, const SE3& T_truth_plan,
          const std::vector<SE3>& poses, const FloorPlanCheckOptions& options)
      : plan_(plan),
        truth_(truth),
        T_(T_truth_plan),
        poses_(poses),
        options_(options),
        observation_(truth, poses, options) {}

  FloorPlanCheck check() {
    walls();
    rooms();
    doors();
    return result_;
  }

 private:
  Vector2d into_truth(const Vector2d& p) const {
    const Eigen::Vector3d q = T_ * Eigen::Vector3d(p[0], plan_.floor_y, p[1]);
    return {q[0], q[2]};
  }

  void walls() {
    const std::vector<Surface> surfaces = true_surfaces(truth_);
    std::vector<Surface> estimated;
    for (const PlanWall& wall : plan_.walls)
      estimated.push_back({{into_truth(wall.a), into_truth(wall.b)},
                           (into_truth(wall.a + wall.normal) - into_truth(wall.a)).normalized()});
    std::vector<double> from_truth, from_plan;
    for (const Surface& surface : surfaces)
      for (const Sample& sample : samples_of(surface.segment, surface.normal))
        if (observation_.sees(sample.at, sample.normal))
          from_truth.push_back(nearest(sample, estimated));
    for (const Surface& surface : estimated)
      for (const Sample& sample : samples_of(surface.segment, surface.normal))
        from_plan.push_back(nearest(sample, surfaces));
    result_.truth_to_plan_median_m = median(from_truth);
    result_.truth_found_share = share_below(from_truth, options_.found_m);
    result_.seen_length_m = kStep_m * static_cast<double>(from_truth.size());
    result_.plan_to_truth_median_m = median(from_plan);
    result_.plan_right_share = share_below(from_plan, options_.found_m);
    result_.plan_length_m = kStep_m * static_cast<double>(from_plan.size());
  }

  void rooms() {
    const RoomRaster raster(truth_);
    std::map<int, std::string> entered;
    for (const SE3& pose : poses_) {
      const Vector2d p(pose.translation()[0], pose.translation()[2]);
      const int space = raster.space_at(p);
      if (space == 0 || entered.count(space)) continue;
      for (const TrueFloorPlan::Room& room : truth_.rooms)
        if ((p - room.low).minCoeff() >= 0 && (room.high - p).minCoeff() >= 0) {
          entered[space] = room.name;
          break;
        }
    }
    std::vector<cv::Mat1b> masks;
    for (const PlanRoom& room : plan_.rooms) {
      std::vector<Vector2d> outline;
      std::vector<std::vector<Vector2d>> holes(room.holes.size());
      for (const Vector2d& p : room.outline) outline.push_back(into_truth(p));
      for (std::size_t i = 0; i < holes.size(); ++i)
        for (const Vector2d& p : room.holes[i]) holes[i].push_back(into_truth(p));
      masks.push_back(raster.room(outline, holes));
    }
    for (const auto& [space, name] : entered) {
      FloorPlanCheck::RoomCheck check{name, 0, -1};
      const cv::Mat1b mask = raster.space(space);
      for (std::size_t i = 0; i < masks.size(); ++i) {
        const double both = cv::countNonZero(mask & masks[i]);
        const double iou = both / std::max(1, cv::countNonZero(mask | masks[i]));
        if (iou > check.iou) check.iou = iou, check.room = static_cast<int>(i);
      }
      result_.rooms.push_back(check);
    }
  }

  void doors() {
    std::vector<char> used(plan_.doors.size(), 0);
    for (const TrueFloorPlan::Door& door : truth_.doors) {
      const TrueFloorPlan::Wall& wall = truth_.walls[door.wall];
      const Vector2d axis = (wall.b - wall.a).normalized(), across(-axis[1], axis[0]);
      const Vector2d middle = 0.5 * (door.a + door.b);
      // A closed door is in the middle line itself, so that a point a little before it is tested.
      const bool seen = observation_.sees(middle + 0.03 * across, across) ||
                        observation_.sees(middle - 0.03 * across, -across);
      int match = -1;
      for (std::size_t i = 0; i < plan_.doors.size(); ++i) {
        const Vector2d there = 0.5 * (into_truth(plan_.doors[i].a) + into_truth(plan_.doors[i].b));
        if ((there - middle).norm() < options_.door_m) match = static_cast<int>(i), used[i] = 1;
      }
      result_.doors_seen += seen;
      result_.doors_found += seen && match >= 0;
      result_.doors_state_right += seen && match >= 0 && plan_.doors[match].closed == door.closed;
    }
    result_.doors_false = static_cast<int>(std::count(used.begin(), used.end(), 0));
  }

  const FloorPlan& plan_;
  const TrueFloorPlan& truth_;
  const SE3& T_;
  const std::vector<SE3>& poses_;
  const FloorPlanCheckOptions& options_;
  Visibility observation_;
  FloorPlanCheck result_;
};

}  // namespace

FloorPlanCheck check_floor_plan(const FloorPlan& plan, const TrueFloorPlan& truth,
                                const SE3& T_truth_plan, const std::vector<SE3>& poses,
                                const FloorPlanCheckOptions& options) {
  return Checker(plan, truth, T_truth_plan, poses, options).check();
}

}  // namespace placegraph
