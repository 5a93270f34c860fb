#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/indoor_walk.h>
#include <placegraph/io/synthetic/worlds/small_room.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace placegraph::synthetic {
namespace {

constexpr double kInterval_s = 1.0 / 30;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kPeakSpeed_mps = 0.9;     ///< while walking
constexpr double kPeakOfMeanRate = 1.875;  ///< peak over mean rate with the least jerk

/// Where the hand is in the plan and how it is turned: yaw to the right, pitch up, roll clockwise
/// [rad].
struct Posture {
  Eigen::Vector2d position{0, 0};
  Eigen::Vector3d angles{0, 0, 0};
};

/// A motion with the least jerk to a posture, from the one before.
struct Move {
  Posture to;
  double duration_s = 0;
  bool walk = false;
};

/// Puts moves together that follow each other.
class Choreography {
 public:
  Choreography(const Eigen::Vector2d& begin, Random& random) : random_(random) {
    now_.position = begin;
    pause(0.5);
  }

  /// Turns at the place with a peak rate of 40 to 80 degrees a second.
  void rotate_to(const Eigen::Vector3d& angles) {
    const double largest = (angles - now_.angles).cwiseAbs().maxCoeff();
    now_.angles = angles;
    add(kPeakOfMeanRate * largest / (random_.uniform(40, 80) * kDegree), false);
    pause(random_.uniform(0.1, 0.35));
  }

  void walk_to(const Eigen::Vector2d& position, double yaw) {
    const double distance_m = (position - now_.position).norm(),
                 rotation_s = std::abs(yaw - now_.angles[0]) / (60 * kDegree);
    now_.position = position;
    now_.angles = {yaw, 0, 0};
    add(kPeakOfMeanRate * std::max(distance_m / kPeakSpeed_mps, rotation_s), true);
    pause(random_.uniform(0.1, 0.3));
  }

  const std::vector<Move>& moves() const { return moves_; }

 private:
  void pause(double duration_s) { add(duration_s, false); }
  void add(double duration_s, bool walk) { moves_.push_back({now_, duration_s, walk}); }

  Random& random_;
  Posture now_;
  std::vector<Move> moves_;
};

/// Turns to one side and back, then nods and tilts to both.
void rotate_on_the_spot(Choreography& moves, double yaw, Random& random) {
  const double side = random.uniform() < 0.5 ? -1 : 1, nod = random.uniform() < 0.5 ? -1 : 1;
  moves.rotate_to({yaw + side * random.uniform(60, 120) * kDegree, 0, 0});
  moves.rotate_to({yaw, 0, 0});
  const double pitch = nod * random.uniform(20, 30) * kDegree,
               roll = side * random.uniform(10, 20) * kDegree;
  moves.rotate_to({yaw, pitch, roll});
  moves.rotate_to({yaw, -pitch, -roll});
  moves.rotate_to({yaw, 0, 0});
}

/// Three or four places in the middle of the room, 0.5 to 1.5 m from one to the next.
std::vector<Eigen::Vector2d> find_stations(const SmallRoom& room, Random& random) {
  const double margin = SmallRoom::kFurnitureDepth_m + 0.4;
  const auto place = [&] {
    return Eigen::Vector2d{random.uniform(margin, room.size[0] - margin),
                           random.uniform(margin, room.size[1] - margin)};
  };
  std::vector<Eigen::Vector2d> stations{place()};
  const std::size_t count = 3 + static_cast<std::size_t>(random.index(2));
  while (stations.size() < count) {
    const Eigen::Vector2d next = place();
    const double distance_m = (next - stations.back()).norm();
    if (distance_m > 0.5 && distance_m < 1.5) stations.push_back(next);
  }
  return stations;
}

std::vector<Move> choreograph(const SmallRoom& room, Random& random) {
  const std::vector<Eigen::Vector2d> stations = find_stations(room, random);
  Choreography moves(stations.front(), random);
  double yaw = 0;  // the first pose has the scene's axes
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (i > 0) {
      yaw += random.uniform(-90, 90) * kDegree;
      moves.walk_to(stations[i], yaw);
    }
    rotate_on_the_spot(moves, yaw, random);
  }
  return moves.moves();
}

/// The hand that holds the camera: it trembles, and the camera stands off the axis of its turns.
class Hand {
 public:
  Hand(double height_m, std::uint32_t seed, Random& random)
      : height_m_(height_m),
        seed_(seed),
        off_axis_{random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02),
                  random.uniform(0.03, 0.08)} {}

  /// `stride` is 0 at rest and 1 in the middle of a walk.
  SE3 pose(const Posture& posture, double stride, double t) const {
    const double ramp = std::min(1.0, 2 * t);  // level and straight at the start
    const auto tremor = [&](std::uint32_t salt) {
      return ramp * (0.7 * value_noise(1.1 * t, 0.5, seed_ + salt) +
                     0.3 * value_noise(4.3 * t, 0.5, seed_ + salt + 1));
    };
    Eigen::Vector3d p(posture.position[0], -height_m_, posture.position[1]);
    p += 0.004 * Eigen::Vector3d(tremor(11), tremor(13), tremor(15));
    p[1] += 0.02 * stride * value_noise(3.6 * t, 0.5, seed_ + 17);  // steps
    const Eigen::Vector3d shake =
        0.4 * kDegree * Eigen::Vector3d(tremor(21), tremor(23), tremor(25));
    const SO3 R = SO3::exp({0, posture.angles[0], 0}) * SO3::exp({posture.angles[1], 0, 0}) *
                  SO3::exp({0, 0, posture.angles[2]}) * SO3::exp(shake);
    return SE3(R, p + R * off_axis_);
  }

 private:
  double height_m_;
  std::uint32_t seed_;
  Eigen::Vector3d off_axis_;
};

void perform(const std::vector<Move>& moves, const Hand& hand, Tour& tour) {
  Posture from = moves.front().to;
  double begin_s = 0;
  for (const Move& move : moves) {
    const double end_s = begin_s + move.duration_s;
    for (;;) {
      const double t = kInterval_s * static_cast<double>(tour.time_s.size());
      if (t >= end_s) break;
      const double x = (t - begin_s) / move.duration_s;
      const double share = x * x * x * (10 - 15 * x + 6 * x * x);
      const Posture now{from.position + share * (move.to.position - from.position),
                        from.angles + share * (move.to.angles - from.angles)};
      const double stride = move.walk ? 16 * x * x * (1 - x) * (1 - x) : 0;
      tour.time_s.push_back(t);
      tour.T_scene_cam.push_back(hand.pose(now, stride, t));
    }
    from = move.to;
    begin_s = end_s;
  }
}

}  // namespace

Tour make_turning_walk(const TourRequest& request) {
  Random random(request.seed, 51);
  Tour tour;
  tour.name = "turning-walk";
  tour.scene.outdoor = false;
  tour.scene.seed = mix_bits(static_cast<std::uint32_t>(request.seed) * 2654435761U + 277U);
  const SmallRoom room = build_small_room(tour.scene, random);
  const std::vector<Move> moves = choreograph(room, random);
  perform(moves, Hand(random.uniform(1.25, 1.5), tour.scene.seed, random), tour);
  tour.camera = indoor_camera();
  tour.baseline_m = kIndoorBaseline_m;
  const Eigen::Vector3d first = tour.T_scene_cam.front().translation();
  tour.floor_plan = to_json(room.plan, {first[0], first[2]}, -first[1]);
  return tour;
}

}  // namespace placegraph::synthetic
