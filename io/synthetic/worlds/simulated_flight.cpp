#include <placegraph/graph/core/random.h>
#include <placegraph/io/synthetic/worlds/simulated_flight.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace placegraph::synthetic {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStep_s = 1e-3;
constexpr std::int64_t kBegin_ns =
    1'000'000'000'000;  ///< first stamp, such that all stamps have the same number of digits
constexpr double kField_m = 0.45;              ///< half the side of the square around the middle
constexpr double kLow_m = 1.2, kHigh_m = 1.8;  ///< range of flight heights
constexpr double kNear_m = 3.4, kFar_m = 4.2;  ///< range of distances of the far positions
constexpr double kCruise_mps = 0.8;            ///< mean speed from point to point
constexpr double kDrag = 0.3;                  ///< [1/s]
constexpr double kMotorLag_s = 0.03;
constexpr double kPositionGain = 3.2, kVelocityGain = 3.2;  ///< [1/s^2], [1/s]
constexpr double kAttitudeGain = 140, kRateGain = 17;       ///< [1/s^2], [1/s]
constexpr double kMaxTilt = 0.5;                            ///< largest commanded acceleration [g]

Vector3d normal3(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

/// A first-order Gauss-Markov process with this sigma and correlation time.
struct GaussMarkov {
  Vector3d sigma;
  double time_s;
  Vector3d value = Vector3d::Zero();
  void step(Random& random) {
    const double keep = std::exp(-kStep_s / time_s);
    value = keep * value + std::sqrt(1 - keep * keep) * sigma.cwiseProduct(normal3(random));
  }
};

/// The target of the body: rest-to-rest quintics between points, with pauses.
struct Leg {
  double begin_s, end_s;
  Vector3d from, to;
  double yaw_from, yaw_to;
};

struct Aim {
  Vector3d position, velocity, acceleration;
  double yaw, yaw_rate;
};

Aim aim_at(const std::vector<Leg>& legs, double t) {
  const auto after =
      std::find_if(legs.begin(), legs.end(), [t](const Leg& leg) { return t < leg.end_s; });
  const Leg& leg = after == legs.end() ? legs.back() : *after;
  const double T = leg.end_s - leg.begin_s, s = std::clamp((t - leg.begin_s) / T, 0.0, 1.0);
  const double progress = s * s * s * (10 + s * (-15 + 6 * s));
  const double speed = 30 * s * s * (1 - s) * (1 - s) / T;
  const double change = 60 * s * (1 - s) * (1 - 2 * s) / (T * T);
  const Vector3d d = leg.to - leg.from;
  const double yaw_change = leg.yaw_to - leg.yaw_from;
  return {leg.from + progress * d, speed * d, change * d, leg.yaw_from + progress * yaw_change,
          speed * yaw_change};
}

std::vector<Leg> plan(double duration_s, Random& random) {
  std::vector<Leg> legs;
  const auto over_field = [&] {
    const double x = random.uniform(-kField_m, kField_m), y = random.uniform(-kField_m, kField_m);
    return Vector3d(x, y, random.uniform(kLow_m, kHigh_m));
  };
  double t = 0, yaw = random.uniform(-std::numbers::pi, std::numbers::pi);
  Vector3d here = over_field();
  const auto stay = [&](double seconds) {
    legs.push_back({t, t + seconds, here, here, yaw, yaw});
    t += seconds;
  };
  const auto go = [&](const Vector3d& to) {
    const double seconds = std::max(1.5, (to - here).norm() / kCruise_mps);
    const double next_yaw = yaw + random.uniform(-1.2, 1.2);
    legs.push_back({t, t + seconds, here, to, yaw, next_yaw});
    here = to, yaw = next_yaw, t += seconds;
  };
  stay(3);
  while (t < duration_s) {
    go(over_field());
    stay(random.uniform(1, 3));
    const double direction = random.uniform(0, 2 * std::numbers::pi);
    const double off = random.uniform(kNear_m, kFar_m);
    go({off * std::cos(direction), off * std::sin(direction), random.uniform(kLow_m, kHigh_m)});
    stay(random.uniform(1.5, 3));
  }
  return legs;
}

/// The commanded acceleration of the thrust, and the angular acceleration towards its direction.
struct Command {
  double thrust = 0;  ///< per mass [m/s^2]
  Vector3d angular = Vector3d::Zero();
};

struct Vehicle {
  Vector3d p, v, w = Vector3d::Zero();  ///< w in body axes
  SO3 R;
  Command driven;  ///< present output of the motors
};

Command control(const Vehicle& body, const Aim& aim) {
  Vector3d push = kPositionGain * (aim.position - body.p) +
                  kVelocityGain * (aim.velocity - body.v) + aim.acceleration;
  const double limit = -kMaxTilt * gravity().z();
  if (push.norm() > limit) push *= limit / push.norm();
  const Vector3d force = push - gravity();
  const Matrix3d R = body.R.matrix();
  const Vector3d z = force.normalized();
  const Vector3d heading(std::cos(aim.yaw), std::sin(aim.yaw), 0);
  const Vector3d y = z.cross(heading).normalized();
  Matrix3d wanted;
  wanted << y.cross(z), y, z;
  const Vector3d error = (body.R.inverse() * SO3::from_matrix(wanted)).log();
  const Vector3d rate = body.R.inverse() * Vector3d(0, 0, aim.yaw_rate);
  return {force.dot(R.col(2)), kAttitudeGain * error + kRateGain * (rate - body.w)};
}

/// Disturbances of the air.
struct Air {
  GaussMarkov gust, breeze, torque;
  Air(double wind_mps, Random& random)
      : gust{{wind_mps, wind_mps, 0.5 * wind_mps}, 1.5},
        breeze{{wind_mps, wind_mps, 0}, 20},
        torque{Vector3d::Constant(wind_mps), 0.1} {
    breeze.value = breeze.sigma.cwiseProduct(normal3(random));
  }
  void step(Random& random) {
    gust.step(random);
    breeze.step(random);
    torque.step(random);
  }
};

/// Forces without gravity per mass, in world axes.
Vector3d push_on(const Vehicle& body, const Air& air) {
  return body.R * Vector3d(0, 0, body.driven.thrust) -
         kDrag * (body.v - air.gust.value - air.breeze.value);
}

void move(Vehicle& body, const Command& wanted, const Vector3d& push, const Vector3d& torque) {
  const double follow = kStep_s / kMotorLag_s;
  body.driven.thrust += follow * (wanted.thrust - body.driven.thrust);
  body.driven.angular += follow * (wanted.angular - body.driven.angular);
  const Vector3d acceleration = push + gravity(),
                 angular_acceleration = body.driven.angular + torque;
  body.p += kStep_s * body.v + 0.5 * kStep_s * kStep_s * acceleration;
  body.v += kStep_s * acceleration;
  body.R = body.R * SO3::exp(kStep_s * body.w + 0.5 * kStep_s * kStep_s * angular_acceleration);
  body.w += kStep_s * angular_acceleration;
}

/// Gyro and accelerometer with white noise and random walk of the biases.
class InertialSensor {
 public:
  explicit InertialSensor(const SimulatedFlightOptions& options)
      : noise_(options.noise),
        random_(options.seed, 63),
        gyro_bias_(options.gyro_bias_sigma * normal3(random_)),
        accel_bias_(options.accel_bias_sigma * normal3(random_)) {}

  void sample(const Vehicle& body, const Vector3d& push, std::int64_t stamp_ns,
              SimulatedFlight& flight) {
    BodyState state;
    state.stamp_ns = stamp_ns;
    state.T_world_body = SE3(body.R, body.p);
    state.velocity_world = body.v;
    state.gyro_bias = gyro_bias_;
    state.accel_bias = accel_bias_;
    flight.truth.push_back(state);
    flight.angular_velocity.push_back(body.w);
    const double root_rate = std::sqrt(SimulatedFlight::kImuHz);
    ImuSample felt;
    felt.stamp_ns = stamp_ns;
    felt.gyro_rad_s = body.w + gyro_bias_ + noise_.gyro * root_rate * normal3(random_);
    felt.accel_m_s2 =
        body.R.inverse() * push + accel_bias_ + noise_.accel * root_rate * normal3(random_);
    flight.imu.samples.push_back(felt);
    gyro_bias_ += noise_.gyro_bias_walk / root_rate * normal3(random_);
    accel_bias_ += noise_.accel_bias_walk / root_rate * normal3(random_);
  }

 private:
  ImuNoise noise_;
  Random random_;
  Vector3d gyro_bias_, accel_bias_;
};

}  // namespace

void SimulatedFlightOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SimulatedFlightOptions& o) {
  field("seed", o.seed, "seed of the path, the wind and the sensor noise");
  field("duration_s", o.duration_s, "duration of the flight [s]", {1, 3600});
  field("wind_mps", o.wind_mps, "standard deviation of gusts and of the mean wind [m/s]", {0, 5});
  field("gyro_noise", o.noise.gyro, "noise density of the gyro [rad/s/sqrt(Hz)]", {1e-9, 1});
  field("accel_noise", o.noise.accel, "noise density of the accelerometer [m/s^2/sqrt(Hz)]",
        {1e-9, 1});
  field("gyro_bias_walk", o.noise.gyro_bias_walk, "random walk of the gyro bias [rad/s^2/sqrt(Hz)]",
        {1e-9, 1});
  field("accel_bias_walk", o.noise.accel_bias_walk,
        "random walk of the accelerometer bias [m/s^3/sqrt(Hz)]", {1e-9, 1});
  field("gyro_bias_sigma", o.gyro_bias_sigma, "standard deviation of the initial gyro bias [rad/s]",
        {0, 1});
  field("accel_bias_sigma", o.accel_bias_sigma,
        "standard deviation of the initial accelerometer bias [m/s^2]", {0, 1});
}

SimulatedFlight simulate_flight(const SimulatedFlightOptions& options) {
  options.check();
  Random path_random(options.seed, 61), weather(options.seed, 62);
  const std::vector<Leg> legs = plan(options.duration_s, path_random);
  Vehicle body;
  body.p = legs.front().from;
  body.v = Vector3d::Zero();
  body.R = SO3::exp({0, 0, legs.front().yaw_from});
  body.driven.thrust = -gravity().z();
  Air air(options.wind_mps, weather);
  InertialSensor sensor(options);

  SimulatedFlight flight;
  flight.imu.rate_hz = SimulatedFlight::kImuHz;
  flight.imu.noise = options.noise;
  const auto steps_a_sample = std::llround(1 / (SimulatedFlight::kImuHz * kStep_s));
  const auto steps_an_image = std::llround(1 / (SimulatedFlight::kImageHz * kStep_s));
  const auto steps = std::llround(options.duration_s / kStep_s);
  for (long long k = 0; k <= steps; ++k) {
    const Vector3d push = push_on(body, air);
    if (k % steps_an_image == 0) flight.images.push_back(flight.truth.size());
    if (k % steps_a_sample == 0) sensor.sample(body, push, kBegin_ns + 1'000'000 * k, flight);
    const Aim aim = aim_at(legs, kStep_s * static_cast<double>(k));
    move(body, control(body, aim), push, air.torque.value);
    air.step(weather);
  }
  return flight;
}

}  // namespace placegraph::synthetic
