#include <placegraph/io/synthetic/worlds/cloud_scene.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace placegraph::synthetic {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Hit {
  double distance = kNever;
  int face = 0;  ///< 1, 2, ... a plane; 0 curved
};

/// Intersection of a ray o + t d with the unit cube, from outside or from within.
Hit meet_cube(const Eigen::Vector3d& o, const Eigen::Vector3d& d, bool within) {
  double in = -kNever, out = kNever;
  int in_face = 0, out_face = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) {
      if (std::abs(o[axis]) > 1) return {};
      continue;
    }
    double a = (-1 - o[axis]) / d[axis], b = (1 - o[axis]) / d[axis];
    int face_a = 2 * axis + 1, face_b = 2 * axis + 2;
    if (a > b) std::swap(a, b), std::swap(face_a, face_b);
    if (a > in) in = a, in_face = face_a;
    if (b < out) out = b, out_face = face_b;
  }
  if (in > out) return {};
  if (within) return out > 0 ? Hit{out, out_face} : Hit{};
  return in > 0 ? Hit{in, in_face} : Hit{};
}

/// The nearer root of a t^2 + 2 b t + c = 0.
double nearer_root(double a, double b, double c) {
  const double under = b * b - a * c;
  return under < 0 || a == 0 ? kNever : (-b - std::sqrt(under)) / a;
}

Hit meet_cylinder(const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
  Hit hit;
  const double side = nearer_root(d.head<2>().squaredNorm(), o.head<2>().dot(d.head<2>()),
                                  o.head<2>().squaredNorm() - 1);
  if (side > 0 && side < kNever && std::abs(o.z() + side * d.z()) <= 1) hit = {side, 0};
  for (int end = 0; end < 2; ++end) {
    if (d.z() == 0) continue;
    const double t = ((end == 0 ? -1 : 1) - o.z()) / d.z();
    if (t > 0 && t < hit.distance && (o + t * d).head<2>().squaredNorm() <= 1) hit = {t, end + 1};
  }
  return hit;
}

Hit meet(const Solid& solid, const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
  switch (solid.kind) {
    case SolidKind::kBox:
      return meet_cube(o, d, false);
    case SolidKind::kRoom:
      return meet_cube(o, d, true);
    case SolidKind::kCylinder:
      return meet_cylinder(o, d);
    case SolidKind::kBall:
      break;
  }
  const double t = nearer_root(d.squaredNorm(), o.dot(d), o.squaredNorm() - 1);
  return t > 0 && t < kNever ? Hit{t, 0} : Hit{};
}

SE3 pose_at(const Eigen::Vector3d& position, const Eigen::Vector3d& rotation_vector) {
  return SE3(SO3::exp(rotation_vector), position);
}

/// A random rotation vector: upright things are rotated about y, others about any axis.
Eigen::Vector3d random_rotation(Random& random, bool upright) {
  if (upright) return {0, random.uniform(-std::numbers::pi, std::numbers::pi), 0};
  return {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
}

class SceneMaker {
 public:
  SceneMaker(double size_m, Random& random) : size_(size_m), random_(random) {}

  std::vector<Solid> make() {
    const double tilt = random_.uniform(-0.4, 0.4);
    const bool room = random_.uniform() < 0.75;
    const Eigen::Vector3d half =
        size_ * Eigen::Vector3d(random_.uniform(0.5, 1.2), random_.uniform(0.25, 0.6),
                                random_.uniform(0.6, 1.2));
    const SE3 T_sensor_room = pose_at(
        Eigen::Vector3d::Zero(), {tilt, random_.uniform(-std::numbers::pi, std::numbers::pi), 0});
    const Eigen::Vector3d off(random_.uniform(-0.4, 0.4) * half.x(),
                              random_.uniform(-0.2, 0.2) * half.y(),
                              random_.uniform(-0.4, 0.4) * half.z());
    if (room)
      add(SolidKind::kRoom, T_sensor_room * pose_at(off, Eigen::Vector3d::Zero()), half, 6);
    else  // a floor
      add(SolidKind::kBox, T_sensor_room * pose_at({0, half.y() * 1.2, 0}, Eigen::Vector3d::Zero()),
          {3 * size_, 0.2 * half.y(), 3 * size_}, 6);
    // Ramps: tilted a little out of the floor or a wall.
    for (int i = random_.index(3); i > 0; --i) {
      const double angle = random_.uniform(0.15, 0.7);
      const Eigen::Vector3d rotation_vector = random_.uniform() < 0.5
                                                  ? Eigen::Vector3d(angle, 0, 0)
                                                  : Eigen::Vector3d(0, angle, angle / 2);
      const Eigen::Vector3d at =
          off + Eigen::Vector3d(random_.uniform(-0.8, 0.8) * half.x(),
                                random_.uniform() < 0.5 ? half.y() : 0.3 * half.y(),
                                random_.uniform(0.3, 1.0) * half.z());
      add(SolidKind::kBox, T_sensor_room * pose_at(at, rotation_vector), sides(0.1, 0.35), 6);
    }
    const int things = 3 + random_.index(10);
    for (int i = 0; i < things; ++i) add_thing();
    return std::move(solids_);
  }

 private:
  void add(SolidKind kind, const SE3& T, const Eigen::Vector3d& half, int planes) {
    solids_.push_back({kind, T, half, next_label_});
    next_label_ += planes;
  }
  Eigen::Vector3d position() {
    const double z = size_ * random_.uniform(0.35, 1.0);
    return {z * random_.uniform(-0.6, 0.6), z * random_.uniform(-0.5, 0.5), z};
  }
  Eigen::Vector3d sides(double least, double most) {
    return size_ * Eigen::Vector3d(random_.uniform(least, most), random_.uniform(least, most),
                                   random_.uniform(least, most));
  }
  void add_thing() {
    const SE3 T = pose_at(position(), random_rotation(random_, random_.uniform() < 0.7));
    const double kind = random_.uniform();
    if (kind < 0.4) {
      add(SolidKind::kBox, T, sides(0.03, 0.25), 6);
    } else if (kind < 0.65) {
      const double radius = random_.uniform(0.03, 0.25);
      add(SolidKind::kCylinder, T,
          size_ * Eigen::Vector3d(radius, radius, random_.uniform(0.05, 0.4)), 2);
    } else if (kind < 0.85) {
      add(SolidKind::kBall, T, sides(0.05, 0.3), 0);
    } else {  // a heap
      for (int i = 0; i < 25; ++i) {
        const Eigen::Vector3d near = sides(-0.1, 0.1);
        add(SolidKind::kBall, pose_at(T.translation() + near, random_rotation(random_, false)),
            sides(0.01, 0.04), 0);
      }
    }
  }

  double size_;
  Random& random_;
  std::vector<Solid> solids_;
  int next_label_ = 1;
};

/// Scales the depths in a part of the view by random factors, as if seen through leaves.
void add_foliage(LabelledCloud& taken, int width, int height, Random& random) {
  const int x0 = random.index(width), y0 = random.index(height);
  const int x1 = x0 + width / 8 + random.index(width / 2),
            y1 = y0 + height / 8 + random.index(height / 2);
  const double depth = random.uniform(0.05, 0.4);
  for (std::size_t i = 0; i < taken.labels.size(); ++i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    if (x < x0 || x >= x1 || y < y0 || y >= y1) continue;
    taken.cloud.points[i] *= std::max(0.1, 1 + random.normal(0, depth));
    taken.labels[i] = 0;
  }
}

/// The cloud without its viewpoint: no pixels, another origin, and points that fill a volume.
LabelledCloud moved(const LabelledCloud& taken, double size_m, Random& random) {
  LabelledCloud result;
  const Eigen::Vector3d shift =
      size_m *
      Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1.5, 0));
  for (std::size_t i = 0; i < taken.labels.size(); ++i) {
    if (!taken.cloud.points[i].allFinite()) continue;
    result.cloud.points.push_back(taken.cloud.points[i] + shift);
    result.labels.push_back(taken.labels[i]);
  }
  const Eigen::Vector3d centre = shift + Eigen::Vector3d(0, 0, size_m * random.uniform(0.3, 0.8));
  const double spread = size_m * random.uniform(0.05, 0.3);
  for (int i = random.index(3000); i > 0; --i) {
    result.cloud.points.push_back(
        centre + spread * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
    result.labels.push_back(0);
  }
  return result;
}

}  // namespace

LabelledCloud take_cloud(const std::vector<Solid>& solids, const CloudSensor& sensor,
                         Random& random) {
  LabelledCloud result;
  if (!sensor.scans) result.cloud.width = sensor.width, result.cloud.height = sensor.height;
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<std::pair<Eigen::Matrix3d, Eigen::Vector3d>> to_unit;  // linear part, origin
  for (const Solid& solid : solids) {
    const SE3 T = solid.T_sensor_solid.inverse();
    const Eigen::Matrix3d scale = solid.half.cwiseInverse().asDiagonal();
    to_unit.emplace_back(scale * T.rotation().matrix(), scale * T.translation());
  }
  for (int y = 0; y < sensor.height; ++y)
    for (int x = 0; x < sensor.width; ++x) {
      const double u = x - 0.5 * (sensor.width - 1), v = y - 0.5 * (sensor.height - 1);
      Eigen::Vector3d ray(u / sensor.focal_px, v / sensor.focal_px, 1);
      if (sensor.scans) {
        const double azimuth = u * sensor.step_rad, elevation = v * sensor.step_rad;
        ray = {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
               std::cos(azimuth) * std::cos(elevation)};
      }
      Hit best;
      int label = 0;
      for (std::size_t k = 0; k < solids.size(); ++k) {
        const Hit hit = meet(solids[k], to_unit[k].second, to_unit[k].first * ray);
        if (hit.distance >= best.distance) continue;
        best = hit;
        label = hit.face > 0 ? solids[k].first_label + hit.face - 1 : 0;
      }
      if (best.distance == kNever) {
        if (sensor.scans) continue;
        result.cloud.points.push_back(none);
        result.labels.push_back(0);
        continue;
      }
      const double scale = sensor.depth_scale_m;
      const double sigma =
          sensor.noise_share * scale * std::pow(best.distance / scale, sensor.noise_power);
      const double depth = best.distance + random.normal(0, sigma);
      result.cloud.points.push_back(ray * std::max(depth, 0.01 * best.distance));
      result.labels.push_back(label);
    }
  return result;
}

LabelledCloud random_cloud(Random& random) {
  const double size_m = 0.3 * std::pow(200, random.uniform());
  const std::vector<Solid> solids = SceneMaker(size_m, random).make();
  CloudSensor sensor;
  sensor.scans = random.uniform() < 0.35;
  sensor.width = sensor.scans ? 100 : 160 + 80 * random.index(4);
  sensor.height = sensor.scans ? 100 : sensor.width * 3 / 4;
  sensor.focal_px = sensor.width * random.uniform(0.8, 1.2);
  sensor.step_rad = random.uniform(0.003, 0.012);
  sensor.noise_share = random.uniform() < 0.25 ? 0 : 2e-4 * std::pow(60, random.uniform());
  sensor.noise_power = random.index(3);
  sensor.depth_scale_m = size_m;
  LabelledCloud taken = take_cloud(solids, sensor, random);
  if (!sensor.scans && random.uniform() < 0.3)
    add_foliage(taken, sensor.width, sensor.height, random);
  if (sensor.width <= 160 && random.uniform() < 0.4) return moved(taken, size_m, random);
  return taken;
}

}  // namespace placegraph::synthetic
