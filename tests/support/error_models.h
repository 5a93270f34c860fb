#pragma once
#include <placegraph/eval/uncertainty/error_series.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Core>
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace placegraph::test {

/// A pose of the plane: position [m] and heading [rad].
struct PlanarPose {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double heading_rad = 0;
};
using PlanarDrive = std::vector<PlanarPose>;

inline Eigen::Vector2d direction(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

inline Eigen::Vector2d rotated(const Eigen::Vector2d& v, double angle_rad) {
  const Eigen::Vector2d d = direction(angle_rad);
  return {d.x() * v.x() - d.y() * v.y(), d.y() * v.x() + d.x() * v.y()};
}

enum class Shape { kWinding, kBlocks, kRing };

inline const char* to_string(Shape shape) {
  return shape == Shape::kWinding ? "winding" : shape == Shape::kBlocks ? "blocks" : "ring";
}

/// A drive of `frames` steps of `step_m`. Blocks: straight streets of 150 to 300 frames between
/// right angles of twelve frames.
inline PlanarDrive planar_drive(Shape shape, int frames, double step_m = 1) {
  Random random(7);
  PlanarDrive drive(frames);
  int corner = 200, sign = 1;
  for (int i = 1; i < frames; ++i) {
    double heading_rad = drive[i - 1].heading_rad;
    if (shape == Shape::kRing) heading_rad = 2 * std::numbers::pi * i / frames;
    if (shape == Shape::kWinding)
      heading_rad = 0.6 * std::sin(i / 90.0) + 0.9 * std::sin(i / 271.0 + 1);
    if (shape == Shape::kBlocks && i >= corner) heading_rad += sign * std::numbers::pi / 24;
    if (i == corner + 11) {
      corner = i + 150 + random.index(150);
      sign = random.index(2) == 0 ? -1 : 1;
    }
    drive[i].heading_rad = heading_rad;
    drive[i].position_m = drive[i - 1].position_m + step_m * direction(heading_rad);
  }
  return drive;
}

enum class ErrorModel {
  kWhite,         ///< noise of each position
  kPositionWalk,  ///< noise of each step
  kHeadingWalk,   ///< noise of each rotation
  kScaleWander,   ///< a scale about its level, correlated over 10 s
  kLoopClosed,    ///< walks of heading and of position that end where they began
  kScaleWalk,     ///< a scale that walks away from its start
  kBursts,        ///< noise of rotations ten times as large in curves
  kCorrelated,    ///< noise of the steps' length, correlated over 30 s
  kHeavyTails,    ///< noise of each step of Student's distribution with three degrees of freedom
};

inline const char* to_string(ErrorModel model) {
  constexpr const char* kNames[] = {"white noise of positions", "walk of position",
                                    "walk of heading",          "scale about a level",
                                    "loops closed",             "walk of the scale",
                                    "bursts in curves",         "correlated over 30 s",
                                    "heavy tails"};
  return kNames[static_cast<int>(model)];
}

/// Errors of an estimate's steps: in heading before it, along and across it, and the log of its
/// length.
struct StepErrors {
  std::vector<double> heading_rad, log_scale;
  std::vector<Eigen::Vector2d> shift_m;

  StepErrors(const PlanarDrive& truth, ErrorModel model, Random& random)
      : heading_rad(truth.size()), log_scale(truth.size()), shift_m(truth.size()) {
    for (Eigen::Vector2d& shift : shift_m) shift.setZero();
    const auto normal2 = [&random](double sigma) {
      return Eigen::Vector2d(random.normal(0, sigma), random.normal(0, sigma));
    };
    const auto correlated = [&](double sigma, double frames) {
      const double kept = std::exp(-1 / frames);
      log_scale[0] = random.normal(0, sigma);
      for (std::size_t i = 1; i < truth.size(); ++i)
        log_scale[i] =
            kept * log_scale[i - 1] + random.normal(0, sigma * std::sqrt(1 - kept * kept));
    };
    if (model == ErrorModel::kScaleWander) correlated(0.02, 100);
    if (model == ErrorModel::kCorrelated) correlated(0.02, 300);
    for (std::size_t i = 1; i < truth.size(); ++i) {
      if (model == ErrorModel::kPositionWalk || model == ErrorModel::kLoopClosed)
        shift_m[i] = normal2(0.02);
      if (model == ErrorModel::kHeadingWalk || model == ErrorModel::kLoopClosed)
        heading_rad[i] = random.normal(0, 0.0005);
      if (model == ErrorModel::kScaleWalk)
        log_scale[i] = log_scale[i - 1] + random.normal(0, 0.002);
      if (model == ErrorModel::kBursts) {
        const bool curve = std::abs(truth[i].heading_rad - truth[i - 1].heading_rad) > 0.008;
        heading_rad[i] = random.normal(0, curve ? 0.002 : 0.0002);
      }
      if (model == ErrorModel::kHeavyTails) {
        const double scale = std::sqrt(3 / (std::pow(random.normal(), 2) +
                                            std::pow(random.normal(), 2) +
                                            std::pow(random.normal(), 2)));
        shift_m[i] = normal2(0.02 * scale);
      }
    }
    if (model == ErrorModel::kLoopClosed) close(truth);
  }

  /// Corrects all steps by least squares, weighed by their noise, so that the last pose is right to
  /// first order: what a pose graph does with a loop.
  void close(const PlanarDrive& truth) {
    const int count = static_cast<int>(truth.size());
    constexpr double kShift = 0.02, kHeading = 0.0005;
    // Rows: the last position and heading; columns: a step's shift and rotation over their noise.
    const auto effect = [&](int i) {
      const Eigen::Vector2d lever = truth.back().position_m - truth[i - 1].position_m;
      Eigen::Matrix3d A = Eigen::Vector3d(kShift, kShift, kHeading).asDiagonal();
      A.topRightCorner<2, 1>() = kHeading * Eigen::Vector2d(-lever.y(), lever.x());
      return A;
    };
    const auto noise = [&](int i) {
      return Eigen::Vector3d(shift_m[i].x() / kShift, shift_m[i].y() / kShift,
                             heading_rad[i] / kHeading);
    };
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    Eigen::Vector3d open = Eigen::Vector3d::Zero();
    for (int i = 1; i < count; ++i) {
      squares += effect(i) * effect(i).transpose();
      open += effect(i) * noise(i);
    }
    const Eigen::Vector3d weights = squares.ldlt().solve(open);
    for (int i = 1; i < count; ++i) {
      const Eigen::Vector3d correction = effect(i).transpose() * weights;
      shift_m[i] -= kShift * correction.head<2>();
      heading_rad[i] -= kHeading * correction[2];
    }
  }
};

/// One estimate of the drive whose errors are of the model.
inline PlanarDrive estimate_of(const PlanarDrive& truth, ErrorModel model, Random& random) {
  PlanarDrive estimate = truth;
  if (model == ErrorModel::kWhite) {
    for (PlanarPose& pose : estimate)
      pose.position_m += Eigen::Vector2d(random.normal(0, 0.1), random.normal(0, 0.1));
    return estimate;
  }
  const StepErrors errors(truth, model, random);
  double heading_error_rad = 0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Eigen::Vector2d step = truth[i].position_m - truth[i - 1].position_m;
    const double middle_rad = heading_error_rad + 0.5 * errors.heading_rad[i];
    heading_error_rad += errors.heading_rad[i];
    estimate[i].position_m = estimate[i - 1].position_m +
                             rotated(std::exp(errors.log_scale[i]) * step, middle_rad) +
                             errors.shift_m[i];
    estimate[i].heading_rad = truth[i].heading_rad + heading_error_rad;
  }
  return estimate;
}

/// |trans E| of the motion from frame i to j, as kitti_segments() and rpe() have it.
inline double motion_error_m(const PlanarDrive& truth, const PlanarDrive& estimate, int i, int j) {
  const Eigen::Vector2d true_m =
      rotated(truth[j].position_m - truth[i].position_m, -truth[i].heading_rad);
  const Eigen::Vector2d estimated_m =
      rotated(estimate[j].position_m - estimate[i].position_m, -estimate[i].heading_rad);
  return (estimated_m - true_m).norm();
}

/// t_rel's errors [%] of drives whose steps are `step_m` long, from every tenth frame.
inline std::vector<ErrorSeries> segment_series(const PlanarDrive& truth,
                                               const PlanarDrive& estimate,
                                               const std::vector<double>& lengths_m,
                                               double step_m = 1) {
  std::vector<ErrorSeries> all;
  for (const double length_m : lengths_m) {
    ErrorSeries series{std::to_string(static_cast<int>(length_m)) + " m", {}};
    const int frames = static_cast<int>(std::floor(length_m / step_m)) + 1;
    for (int i = 0; i + frames < static_cast<int>(truth.size()); i += 10)
      series.errors.push_back(
          {i, i + frames, motion_error_m(truth, estimate, i, i + frames) / length_m * 100});
    if (!series.errors.empty()) all.push_back(std::move(series));
  }
  return all;
}

/// Errors [m] of the motions over `frames` frames, from every `every`-th one.
inline std::vector<ErrorSeries> motion_series(const PlanarDrive& truth,
                                              const PlanarDrive& estimate, int frames, int every) {
  ErrorSeries series{std::to_string(frames) + " frames", {}};
  for (int i = 0; i + frames < static_cast<int>(truth.size()); i += every)
    series.errors.push_back({i, i + frames, motion_error_m(truth, estimate, i, i + frames)});
  return {series};
}

/// RMSE [m] of the positions after the best rotation and translation of the plane.
inline double planar_ate_m(const PlanarDrive& truth, const PlanarDrive& estimate) {
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    a += truth[i].position_m / static_cast<double>(truth.size());
    b += estimate[i].position_m / static_cast<double>(truth.size());
  }
  double cosine = 0, sine = 0, squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Vector2d p = truth[i].position_m - a, q = estimate[i].position_m - b;
    cosine += p.dot(q);
    sine += q.x() * p.y() - q.y() * p.x();
    squares += p.squaredNorm() + q.squaredNorm();
  }
  const double fitted = squares - 2 * std::hypot(cosine, sine);
  return std::sqrt(std::max(0.0, fitted) / static_cast<double>(truth.size()));
}

}  // namespace placegraph::test
