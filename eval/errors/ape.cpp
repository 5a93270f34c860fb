#include <fmt/format.h>
#include <placegraph/eval/errors/ape.h>
#include <placegraph/eval/errors/relative_error.h>
#include <placegraph/eval/alignment/vertical.h>
#include <placegraph/graph/core/angle.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Directions of the true path, level, by chords of a length about each pair.
class PathDirections {
 public:
  PathDirections(const std::vector<FramePair>& pairs, const std::vector<double>& travelled_m,
                 const Eigen::Vector3d& up)
      : pairs_(pairs), travelled_m_(travelled_m), up_(up) {
    // Long enough that noise of the truth does not turn it; on a circle the chord about a frame is
    // parallel to its tangent. Chosen.
    chord_m_ = std::min(2.0, 0.01 * travelled_m.back());
  }

  /// The direction at pair i; nothing where the chord is level with nothing. `i` must not decrease.
  std::optional<Eigen::Vector3d> at(std::size_t i) {
    while (first_ < i && travelled_m_[i] - travelled_m_[first_] > 0.5 * chord_m_) ++first_;
    last_ = std::max(last_, i);
    while (last_ + 1 < pairs_.size() && travelled_m_[last_] - travelled_m_[i] < 0.5 * chord_m_)
      ++last_;
    const std::size_t before = first_ > 0 ? first_ - 1 : first_;
    const Eigen::Vector3d chord =
        pairs_[last_].T_world_truth.translation() - pairs_[before].T_world_truth.translation();
    const Eigen::Vector3d level = chord - up_ * up_.dot(chord);
    if (level.norm() > 1e-9 * (1 + travelled_m_.back())) known_ = level.normalized();
    return known_;
  }

 private:
  const std::vector<FramePair>& pairs_;
  const std::vector<double>& travelled_m_;
  const Eigen::Vector3d up_;
  double chord_m_ = 0;
  std::size_t first_ = 0, last_ = 0;
  std::optional<Eigen::Vector3d> known_;
};

Statistics component(const std::vector<Eigen::Vector3d>& errors_m, int row) {
  std::vector<double> values;
  values.reserve(errors_m.size());
  for (const Eigen::Vector3d& error : errors_m) values.push_back(error[row]);
  return signed_statistics_of(values);
}

}  // namespace

ErrorProjection projection_of(const std::vector<FramePair>& pairs, ErrorPart part) {
  ErrorProjection result;
  if (part == ErrorPart::kSpace) return result;
  if (part == ErrorPart::kX || part == ErrorPart::kY || part == ErrorPart::kZ) {
    const int axis = static_cast<int>(part) - static_cast<int>(ErrorPart::kX);
    result.projection = Eigen::Vector3d::Unit(axis) * Eigen::Vector3d::Unit(axis).transpose();
    result.text = std::string("along ") + "xyz"[axis];
    return result;
  }
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  result.text = "in the plane xy";
  if (part == ErrorPart::kXz) normal = Eigen::Vector3d::UnitY(), result.text = "in the plane xz";
  if (part == ErrorPart::kYz) normal = Eigen::Vector3d::UnitX(), result.text = "in the plane yz";
  if (part == ErrorPart::kFitted) {
    std::vector<Eigen::Vector3d> positions;
    for (const FramePair& pair : pairs) positions.push_back(pair.T_world_truth.translation());
    normal = spread_of(positions).axes.col(0);
    result.text = fmt::format("in the fitted plane with normal ({:.3f}, {:.3f}, {:.3f})", normal[0],
                              normal[1], normal[2]);
  }
  result.projection = Eigen::Matrix3d::Identity() - normal * normal.transpose();
  result.rotation_axis = normal;
  return result;
}

ApeResult ape(const std::vector<FramePair>& aligned_pairs, const ErrorProjection& part,
              const Outcome& rotation) {
  ApeResult result;
  result.rotation_outcome = rotation;
  const bool whole = part.text.empty();
  std::vector<double> full;
  result.frames.reserve(aligned_pairs.size());
  result.frame_errors_m.reserve(aligned_pairs.size());
  if (rotation) {
    result.frame_errors_deg.reserve(aligned_pairs.size());
    full.reserve(aligned_pairs.size());
  }
  for (const FramePair& pair : aligned_pairs) {
    if (!pair.T_world_estimate) continue;
    const Eigen::Vector3d error_m =
        pair.T_world_estimate->translation() - pair.T_world_truth.translation();
    result.frames.push_back(pair.frame);
    result.frame_errors_m.push_back(whole ? error_m.norm() : (part.projection * error_m).norm());
    if (!rotation) continue;
    const Eigen::Matrix4d error = relative_pose(pair.T_world_truth, *pair.T_world_estimate);
    const double angle =
        part.rotation_axis
            ? twist_angle(pair.T_world_estimate->linear() * pair.T_world_truth.linear().inverse(),
                          *part.rotation_axis)
            : rotation_angle(error.topLeftCorner<3, 3>());
    result.frame_errors_deg.push_back(rad_to_deg(angle));
    full.push_back((error - Eigen::Matrix4d::Identity()).norm());
  }
  if (result.frames.empty()) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no frame has an estimate");
    result.rotation_outcome = result.outcome;
    return result;
  }
  result.error_m = statistics_of(result.frame_errors_m);
  if (rotation) {
    result.rotation_deg = statistics_of(result.frame_errors_deg);
    result.full = statistics_of(full);
  }
  result.outcome = Outcome::ok();
  return result;
}

ErrorComponents error_components(const std::vector<FramePair>& aligned_pairs,
                                 const std::vector<double>& travelled_m, bool has_orientation,
                                 Vertical vertical) {
  ErrorComponents result;
  const VerticalResult up = vertical_of(aligned_pairs, has_orientation, vertical);
  result.outcome = up.outcome;
  result.vertical = up.text;
  if (!result.outcome) return result;
  PathDirections directions(aligned_pairs, travelled_m, up.axis);
  // Frames before the first motion take its direction.
  std::optional<Eigen::Vector3d> along;
  for (std::size_t i = 0; i < aligned_pairs.size() && !along; ++i) along = directions.at(i);
  if (!along) {
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate,
                                      "the ground truth does not move across the vertical");
    return result;
  }
  PathDirections again(aligned_pairs, travelled_m, up.axis);
  for (std::size_t i = 0; i < aligned_pairs.size(); ++i) {
    along = again.at(i).value_or(*along);
    if (!aligned_pairs[i].T_world_estimate) continue;
    const Eigen::Vector3d error_m = aligned_pairs[i].T_world_estimate->translation() -
                                    aligned_pairs[i].T_world_truth.translation();
    result.errors_m.push_back(
        {along->dot(error_m), up.axis.cross(*along).dot(error_m), up.axis.dot(error_m)});
  }
  if (result.errors_m.empty()) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no frame has an estimate");
    return result;
  }
  result.along_m = component(result.errors_m, 0);
  result.across_m = component(result.errors_m, 1);
  result.up_m = component(result.errors_m, 2);
  return result;
}

}  // namespace placegraph
