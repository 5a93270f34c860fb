#include <fmt/format.h>
#include <placegraph/eval/trajectory/plausibility.h>
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/graph/core/angle.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace placegraph {
namespace {

// Frames by which trajectories may be shifted, and the share of the misfit with which another
// reading is better. Chosen.
constexpr int kMaxShift = 5;
constexpr double kClearlyBetter = 0.5;
/// More motions than this, evenly spread, would show nothing else. Chosen.
constexpr int kMostMotions = 10'000;
/// Misfits below this (1 % of the motion) need no explanation.
constexpr double kGoodMisfit = 1e-4;
/// Orientations that differ by less are the same.
constexpr double kSameOrientation_rad = 1e-6;
/// Rotated axes below this are a mounting error, not those of another sensor.
constexpr double kRotatedAxes_deg = 5;

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd angle_axis(R);
  return angle_axis.angle() * angle_axis.axis();
}

struct Motion {
  Eigen::Vector3d translation;
  Eigen::Vector3d rotation;
};

/// An interpretation of a file's poses.
using Reading = std::function<Eigen::Isometry3d(const Eigen::Isometry3d&)>;

Eigen::Isometry3d as_it_stands(const Eigen::Isometry3d& T) { return T; }
Eigen::Isometry3d inverse(const Eigen::Isometry3d& T) { return T.inverse(Eigen::Affine); }

/// The pose if the four numbers that were read as x, y, z, w of its quaternion are w, x, y, z.
Eigen::Isometry3d scalar_first(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  Eigen::Isometry3d other = T;
  other.linear() = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).toRotationMatrix();
  return other;
}

/// The pose if the four numbers that were read as w, x, y, z of its quaternion are x, y, z, w.
Eigen::Isometry3d scalar_last(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  Eigen::Isometry3d other = T;
  other.linear() = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
  return other;
}

Motion motion_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Matrix4d T_a_b = relative_pose(a, b);
  return {T_a_b.topRightCorner<3, 1>(), rotation_vector(T_a_b.topLeftCorner<3, 3>())};
}

/// The motions of both from pair i to pair i + stride.
struct Motions {
  std::vector<Motion> truth, estimate;
  double scale = std::numeric_limits<double>::quiet_NaN();  ///< scale of the estimate

  Motions(const std::vector<FramePair>& pairs, int stride, int shift, const Reading& of_truth,
          const Reading& of_estimate) {
    const int n = static_cast<int>(pairs.size());
    double truth_length = 0, estimate_length = 0;
    truth.reserve(pairs.size());
    estimate.reserve(pairs.size());
    // The same window of ground truth for every shift, so that misfits can be compared.
    for (int i = kMaxShift; i + stride + kMaxShift < n; i += std::max(1, n / kMostMotions)) {
      const auto& a = pairs[static_cast<std::size_t>(i + shift)].T_world_estimate;
      const auto& b = pairs[static_cast<std::size_t>(i + shift + stride)].T_world_estimate;
      if (!a || !b) continue;
      truth.push_back(
          motion_between(of_truth(pairs[static_cast<std::size_t>(i)].T_world_truth),
                         of_truth(pairs[static_cast<std::size_t>(i + stride)].T_world_truth)));
      estimate.push_back(motion_between(of_estimate(*a), of_estimate(*b)));
      truth_length += truth.back().translation.norm();
      estimate_length += estimate.back().translation.norm();
    }
    if (truth_length > 0 && estimate_length > 0) scale = truth_length / estimate_length;
  }

  /// Misfit with the estimate's axes rotated by R; NaN if no motion can be compared.
  double misfit(const Eigen::Matrix3d& R_truth_estimate) const {
    if (std::isnan(scale)) return scale;
    double translation = 0, rotation = 0, translation_all = 0, rotation_all = 0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      translation += (truth[k].translation - scale * (R_truth_estimate * estimate[k].translation))
                         .squaredNorm();
      rotation += (truth[k].rotation - R_truth_estimate * estimate[k].rotation).squaredNorm();
      translation_all += truth[k].translation.squaredNorm();
      rotation_all += truth[k].rotation.squaredNorm();
    }
    // A truth with hardly any rotation (below 1 mrad a stride) allows no relative comparison.
    const double rotation_floor = 1e-6 * static_cast<double>(truth.size());
    return translation / translation_all + rotation / std::max(rotation_all, rotation_floor);
  }

  /// The rotation between the axes of the two that takes the motions of one to those of the other;
  /// nothing if their directions do not determine it.
  std::optional<Eigen::Matrix3d> axes() const {
    Eigen::Matrix3d translations = Eigen::Matrix3d::Zero(), rotations = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < truth.size(); ++k) {
      translations += truth[k].translation * estimate[k].translation.transpose();
      rotations += truth[k].rotation * estimate[k].rotation.transpose();
    }
    const auto normalized = [](const Eigen::Matrix3d& m) -> Eigen::Matrix3d {
      return m.norm() > 0 ? Eigen::Matrix3d(m / m.norm()) : m;
    };
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(normalized(translations) + normalized(rotations),
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    if (svd.singularValues()[1] < 0.05 * svd.singularValues()[0]) return std::nullopt;
    Eigen::Vector3d sign(1, 1, svd.matrixU().determinant() * svd.matrixV().determinant());
    return Eigen::Matrix3d(svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose());
  }
};

double misfit(const std::vector<FramePair>& pairs, int stride, const Reading& of_truth,
              const Reading& of_estimate) {
  return Motions(pairs, stride, 0, of_truth, of_estimate).misfit(Eigen::Matrix3d::Identity());
}

/// The greatest angle [rad] between an orientation and the first.
template <class Poses>
double greatest_rotation(const std::vector<FramePair>& pairs, Poses pose_of) {
  double greatest = 0;
  const Eigen::Isometry3d* first = nullptr;
  for (const FramePair& pair : pairs) {
    const Eigen::Isometry3d* pose = pose_of(pair);
    if (!pose) continue;
    if (!first) first = pose;
    greatest = std::max(
        greatest, rotation_angle(first->linear().transpose() * Eigen::Matrix3d(pose->linear())));
  }
  return greatest;
}

std::string never_rotates(const std::vector<FramePair>& pairs) {
  const auto truth = [](const FramePair& pair) { return &pair.T_world_truth; };
  const auto estimate = [](const FramePair& pair) {
    return pair.T_world_estimate ? &*pair.T_world_estimate : nullptr;
  };
  const double truth_rotations = greatest_rotation(pairs, truth);
  const double estimate_rotations = greatest_rotation(pairs, estimate);
  const auto text = [](const char* one, const char* other, double angle) {
    return fmt::format(
        "{} never turns, but {} does, by up to {:.1f} deg: if it has positions alone, RPE, t_rel "
        "and r_rel mean nothing",
        one, other, rad_to_deg(angle));
  };
  // A rotation, three degrees, that is not noise. Chosen.
  constexpr double kRotated_rad = 0.05;
  if (truth_rotations < kSameOrientation_rad && estimate_rotations > kRotated_rad)
    return text("the ground truth", "the estimate", estimate_rotations);
  if (estimate_rotations < kSameOrientation_rad && truth_rotations > kRotated_rad)
    return text("the estimate", "the ground truth", truth_rotations);
  return {};
}

/// The first other reading of either file that fits clearly better than `as_given`.
std::string other_convention(const std::vector<FramePair>& pairs, int stride, double as_given) {
  struct Candidate {
    Reading of_truth, of_estimate;
    const char* text;
  };
  const Candidate candidates[] = {
      {as_it_stands, inverse,
       "the estimate looks inverted: its inverse poses fit clearly better (T_cam_world given, "
       "T_world_cam expected?)"},
      {as_it_stands, scalar_first,
       "the estimate's quaternions seem to have w first, not last: in that order they fit clearly "
       "better"},
      {as_it_stands, scalar_last,
       "the estimate's quaternions seem to have w last, not first: in that order they fit clearly "
       "better"},
      {scalar_first, as_it_stands,
       "the ground truth's quaternions seem to have w first, not last: in that order they fit "
       "clearly better"},
      {scalar_last, as_it_stands,
       "the ground truth's quaternions seem to have w last, not first: in that order they fit "
       "clearly better"},
  };
  const Candidate* best = nullptr;
  double least = kClearlyBetter * as_given;
  for (const Candidate& candidate : candidates) {
    const double found = misfit(pairs, stride, candidate.of_truth, candidate.of_estimate);
    if (!(found < least)) continue;
    least = found;
    best = &candidate;
  }
  const Motions motions(pairs, stride, 0, as_it_stands, as_it_stands);
  const std::optional<Eigen::Matrix3d> R = motions.axes();
  const double angle_deg = R ? rad_to_deg(rotation_angle(*R)) : 0;
  if (angle_deg < kRotatedAxes_deg || !(motions.misfit(*R) < least)) return best ? best->text : "";
  return fmt::format(
      "the estimate's axes are rotated by {:.0f} deg against the ground truth's: are these poses "
      "of "
      "another sensor (camera against body)?",
      angle_deg);
}

std::string time_shift(const std::vector<FramePair>& pairs) {
  const int stride = pairs.size() > 100 ? 5 : 1;
  const double unshifted = motion_misfit(pairs, stride, 0, false);
  int best_shift = 0;
  double best = unshifted;
  for (int shift = -kMaxShift; shift <= kMaxShift; ++shift) {
    const double misfit = motion_misfit(pairs, stride, shift, false);
    if (!(misfit < best)) continue;
    best = misfit;
    best_shift = shift;
  }
  if (!(unshifted > kGoodMisfit && best < kClearlyBetter * unshifted)) return {};
  return fmt::format("the estimate looks shifted in time: it fits clearly better {} {} {}",
                     std::abs(best_shift), std::abs(best_shift) == 1 ? "frame" : "frames",
                     best_shift > 0 ? "earlier" : "later");
}

}  // namespace

double motion_misfit(const std::vector<FramePair>& pairs, int stride, int shift, bool inverted) {
  return Motions(pairs, stride, shift, as_it_stands, inverted ? inverse : as_it_stands)
      .misfit(Eigen::Matrix3d::Identity());
}

std::vector<std::string> convention_warnings(const std::vector<FramePair>& pairs) {
  const std::string stands = never_rotates(pairs);
  if (!stands.empty()) return {stands};
  const int n = static_cast<int>(pairs.size());
  if (n < 4 * kMaxShift) return {};
  const int stride = std::max(1, n / 50);
  const double as_given = misfit(pairs, stride, as_it_stands, as_it_stands);
  if (as_given > kGoodMisfit) {
    const std::string convention = other_convention(pairs, stride, as_given);
    if (!convention.empty()) return {convention};
  }
  const std::string shift = time_shift(pairs);
  return shift.empty() ? std::vector<std::string>{} : std::vector<std::string>{shift};
}

}  // namespace placegraph
