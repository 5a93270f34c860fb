#include <placegraph/frontend/planes/motion_from_planes.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Least share of a plane's matches in front of both cameras.
constexpr double kInFront = 0.9;
constexpr double kSameAngle_rad = 1e-3;  ///< readings closer than this count as one
// Ratio of eigenvalues: two orders above rounding. Chosen.
constexpr double kMinMotionCondition = 1e-14;
constexpr int kHalvings = 8;

/// Motion and planes during refinement; planes as normal over distance.
struct State {
  SO3 R_cur_ref;
  Vector3d t = Vector3d::UnitX();  // length one; zero without a translation
  std::vector<Vector3d> planes;    // empty without a translation

  Matrix3d euclidean(std::size_t plane) const {
    if (planes.empty()) return R_cur_ref.matrix();
    return R_cur_ref.matrix() + t * planes[plane].transpose();
  }
};

struct Views {
  Matrix3d K, K_inverse;
  const PointMatches& matches;
  std::vector<std::vector<int>> members;  // matches of each region
  TransferNoise noise;
};

Eigen::Matrix<double, 3, 2> across(const Vector3d& unit) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = unit.unitOrthogonal();
  basis.col(1) = unit.cross(basis.col(0));
  return basis;
}

Matrix3d skew(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

struct MotionEquations {
  MatrixXd information, expected;
  VectorXd gradient;
  double cost = 0;
};

/// Parameters: rotation (3), then, with a translation, its direction (2) and the planes (3 each).
MotionEquations normal_equations(const Views& views, const State& state) {
  const bool moves = !state.planes.empty();
  const auto size = static_cast<Eigen::Index>(3 + (moves ? 2 + 3 * state.planes.size() : 0));
  MotionEquations normal{MatrixXd::Zero(size, size), MatrixXd::Zero(size, size),
                         VectorXd::Zero(size), 0};
  const Eigen::Matrix<double, 3, 2> basis = across(moves ? state.t : Vector3d::UnitX());
  for (std::size_t k = 0; k < views.members.size(); ++k) {
    const Matrix3d M = state.euclidean(k);
    const Matrix3d H = views.K * M * views.K_inverse;
    for (const int index : views.members[k]) {
      const auto i = static_cast<std::size_t>(index);
      const TransferError error =
          transfer_error(H, views.matches.px_ref[i], views.matches.px_cur[i]);
      normal.cost += views.noise.cost(error);
      if (!std::isfinite(normal.cost)) return normal;
      const Vector3d x = views.K_inverse * views.matches.px_ref[i].homogeneous();
      const Vector3d y = M * x;
      Eigen::Matrix<double, 2, 3> J_px_y;
      J_px_y << 1, 0, -y[0] / y[2], 0, 1, -y[1] / y[2];
      J_px_y = views.K.topLeftCorner<2, 2>() * J_px_y / y[2];
      MatrixXd J = MatrixXd::Zero(2, size);
      J.leftCols<3>() = -J_px_y * state.R_cur_ref.matrix() * skew(x);
      if (moves) {
        J.middleCols<2>(3) = J_px_y * basis * state.planes[k].dot(x);
        J.middleCols<3>(static_cast<Eigen::Index>(5 + 3 * k)) = J_px_y * state.t * x.transpose();
      }
      const MatrixXd JW = J.transpose() * error.unit_covariance.inverse();
      const MatrixXd one = JW * J;
      const double weight = views.noise.weight(error);
      normal.expected += one;
      normal.information += weight * one;
      normal.gradient += weight * JW * error.residual;
    }
  }
  return normal;
}

State moved(const State& state, const VectorXd& step) {
  State next = state;
  next.R_cur_ref = state.R_cur_ref.plus(step.head<3>());
  if (state.planes.empty()) return next;
  next.t = (state.t + across(state.t) * step.segment<2>(3)).normalized();
  for (std::size_t k = 0; k < next.planes.size(); ++k)
    next.planes[k] += step.segment<3>(static_cast<Eigen::Index>(5 + 3 * k));
  return next;
}

/// Reweighted Gauss-Newton with halved steps.
MotionEquations refine(const Views& views, State& state, int max_iterations) {
  MotionEquations normal = normal_equations(views, state);
  for (int i = 0; i < max_iterations && std::isfinite(normal.cost); ++i) {
    VectorXd step = normal.information.ldlt().solve(normal.gradient);
    if (!step.allFinite()) break;
    bool lower = false;
    for (int half = 0; half < kHalvings && !lower; ++half, step /= 2) {
      const State next = moved(state, step);
      MotionEquations trial = normal_equations(views, next);
      if (!(trial.cost < normal.cost)) continue;
      lower = normal.cost - trial.cost > 1e-9;
      state = next;
      normal = std::move(trial);
      break;
    }
    if (!lower) break;
  }
  return normal;
}

/// Normal over distance of a plane from its matches under a motion: x_cur x (R x + t (v . x)) = 0.
Vector3d plane_under(const Views& views, const State& state, std::size_t plane) {
  Matrix3d A = Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
  for (const int index : views.members[plane]) {
    const auto i = static_cast<std::size_t>(index);
    const Vector3d x = views.K_inverse * views.matches.px_ref[i].homogeneous();
    const Vector3d x_cur = views.K_inverse * views.matches.px_cur[i].homogeneous();
    const Vector3d along = x_cur.cross(state.t);
    const Vector3d left = x_cur.cross(state.R_cur_ref * x);
    A += along.squaredNorm() * x * x.transpose();
    b -= along.dot(left) * x;
  }
  return A.ldlt().solve(b);
}

bool in_front(const Views& views, const State& state) {
  for (std::size_t k = 0; k < views.members.size(); ++k) {
    int front = 0;
    const Matrix3d M = state.euclidean(k);
    for (const int index : views.members[k]) {
      const Vector3d x =
          views.K_inverse * views.matches.px_ref[static_cast<std::size_t>(index)].homogeneous();
      front += state.planes[k].dot(x) > 0 && (M * x)[2] > 0;
    }
    if (front < kInFront * static_cast<double>(views.members[k].size())) return false;
  }
  return true;
}

PlanesReading reading_of(const State& state, const MotionEquations& normal,
                         const TransferNoise& noise) {
  PlanesReading reading;
  reading.T_cur_ref = SE3(state.R_cur_ref, state.t);
  reading.cost = normal.cost;
  const double variance = noise.sigma_px * noise.sigma_px / noise.information();
  const MatrixXd covariance = normal.expected.inverse() * variance;
  // t [+] rho = t + R rho.
  Eigen::Matrix<double, 6, 5> J = Eigen::Matrix<double, 6, 5>::Zero();
  J.topRightCorner<3, 2>() = state.R_cur_ref.matrix().transpose() * across(state.t);
  J.bottomLeftCorner<3, 3>().setIdentity();
  reading.covariance = J * covariance.topLeftCorner<5, 5>() * J.transpose();
  for (std::size_t k = 0; k < state.planes.size(); ++k) {
    const double inverse = state.planes[k].norm();
    reading.planes_ref.push_back({state.planes[k] / inverse, 1 / inverse});
    const auto at = static_cast<Eigen::Index>(5 + 3 * k);
    reading.inverse_covariances.push_back(covariance.block<3, 3>(at, at));
  }
  return reading;
}

bool same(const PlanesReading& a, const PlanesReading& b) {
  const double rotation = (a.T_cur_ref.rotation().inverse() * b.T_cur_ref.rotation()).log().norm();
  const double direction = (a.T_cur_ref.translation() - b.T_cur_ref.translation()).norm();
  return rotation < kSameAngle_rad && direction < kSameAngle_rad;
}

/// Rotation that explains all matches best, and its cost.
MotionEquations only_rotation(const Views& views, const PlanarRegionsResult& regions, State& best,
                              int max_iterations) {
  MotionEquations least;
  least.cost = std::numeric_limits<double>::infinity();
  for (const PlanarRegion& region : regions.regions) {
    const Eigen::JacobiSVD<Matrix3d> svd(views.K_inverse * region.H_cur_ref * views.K,
                                         Eigen::ComputeFullU | Eigen::ComputeFullV);
    State state;
    state.R_cur_ref = SO3::from_matrix(svd.matrixU() * svd.matrixV().transpose());
    MotionEquations normal = refine(views, state, max_iterations);
    if (!(normal.cost < least.cost)) continue;
    least = std::move(normal);
    best = state;
  }
  return least;
}

/// All motions that the regions' homographies allow, one by one, with their planes.
std::vector<State> starts(const Views& views, const PlanarRegionsResult& regions) {
  std::vector<State> states;
  for (std::size_t k = 0; k < regions.regions.size(); ++k) {
    std::vector<Eigen::Vector2d> px;
    for (const int i : views.members[k])
      px.push_back(views.matches.px_ref[static_cast<std::size_t>(i)]);
    for (const HomographyMotion& motion :
         decompose_homography(views.K, regions.regions[k].H_cur_ref, px)) {
      const double length = motion.T_cur_ref.translation().norm();
      if (!(length > 1e-9)) continue;
      State state;
      state.R_cur_ref = motion.T_cur_ref.rotation();
      state.t = motion.T_cur_ref.translation() / length;
      for (std::size_t j = 0; j < regions.regions.size(); ++j)
        state.planes.push_back(j == k ? Vector3d(motion.normal_ref * length)
                                      : plane_under(views, state, j));
      states.push_back(state);
    }
  }
  return states;
}

/// Motions that explain the matches, likeliest first, with the matches in front of both cameras.
struct Readings {
  std::vector<PlanesReading> readings;
  /// Whether the matches determine the motion, on whichever side of the cameras they are.
  bool fixed = false;
};

/// Refines every initial motion; of those that converge to the same motion the first is kept.
Readings readings_of(const Views& views, const PlanarRegionsResult& regions,
                     const MotionFromPlanesOptions& options) {
  Readings result;
  for (State& state : starts(views, regions)) {
    const MotionEquations normal = refine(views, state, options.max_iterations);
    if (!std::isfinite(normal.cost)) continue;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(normal.expected, Eigen::EigenvaluesOnly);
    if (!(eigen.eigenvalues()[0] > kMinMotionCondition * eigen.eigenvalues().tail<1>()[0]))
      continue;
    result.fixed = true;
    if (!in_front(views, state)) continue;
    PlanesReading reading = reading_of(state, normal, views.noise);
    if (std::none_of(result.readings.begin(), result.readings.end(),
                     [&](const PlanesReading& other) { return same(reading, other); }))
      result.readings.push_back(std::move(reading));
  }
  std::sort(result.readings.begin(), result.readings.end(),
            [](const PlanesReading& a, const PlanesReading& b) { return a.cost < b.cost; });
  while (!result.readings.empty() &&
         result.readings.back().cost > result.readings.front().cost + options.ambiguity_log_ratio)
    result.readings.pop_back();
  return result;
}

}  // namespace

MotionFromPlanesResult motion_from_planes(const Camera& camera, const PointMatches& matches,
                                          const PlanarRegionsResult& regions,
                                          const MotionFromPlanesOptions& options) {
  options.check();
  camera.check();
  require(camera.distortion == Distortion::kNone,
          "motion_from_planes: needs a camera without distortion");
  require(regions.labels.size() == matches.px_ref.size(),
          "motion_from_planes: needs one label per match");
  MotionFromPlanesResult result;
  if (regions.regions.empty()) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no planar region");
    return result;
  }
  Views views{camera.K(), camera.K().inverse(), matches, {}, regions.noise};
  views.members.resize(regions.regions.size());
  int count = 0;
  for (int i = 0; i < matches.size(); ++i)
    if (const int label = regions.labels[static_cast<std::size_t>(i)]; label > 0) {
      views.members[static_cast<std::size_t>(label - 1)].push_back(i);
      ++count;
    }
  for (const PlanarRegion& region : regions.regions) result.homographies_cost += region.cost;

  // The cost of independent homographies is below that of any motion: if the three parameters of a
  // rotation are nearly as good as eight for each homography, a translation is not observable.
  State rotated;
  result.rotation_cost = only_rotation(views, regions, rotated, options.max_iterations).cost;
  const double per_parameter = 0.5 * std::log(static_cast<double>(count));
  const double parameters = 8.0 * static_cast<double>(regions.regions.size()) - 3;
  if (result.rotation_cost < result.homographies_cost + parameters * per_parameter) {
    result.R_cur_ref = rotated.R_cur_ref;
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate, "the motion is a pure rotation");
    return result;
  }

  Readings found = readings_of(views, regions, options);
  result.readings = std::move(found.readings);
  // One motion has five parameters and three per plane; independent planes have eight each.
  const double constraints = 5.0 * (static_cast<double>(regions.regions.size()) - 1);
  if (!result.readings.empty() && result.readings.front().cost > result.homographies_cost +
                                                                     constraints * per_parameter +
                                                                     1e-6 * count)
    result.outcome = Outcome::failure(Outcome::Code::kInconsistent,
                                      "the planes do not share one motion and this camera");
  else if (!result.readings.empty())
    result.outcome = Outcome::ok();
  else if (found.fixed)
    result.outcome = Outcome::failure(Outcome::Code::kInconsistent,
                                      "no motion has the matches in front of both cameras");
  else
    result.outcome =
        Outcome::failure(Outcome::Code::kDegenerate, "the matches do not determine the motion");
  return result;
}

}  // namespace placegraph
