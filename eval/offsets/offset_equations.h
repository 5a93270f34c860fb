#pragma once
#include <placegraph/eval/offsets/posed_path.h>

#include <array>
#include <utility>

namespace placegraph {

/// The parameters of the fit: lever arm, rotation, time and scale.
inline constexpr int kOffsetParameters = 8;
using OffsetVector = Eigen::Matrix<double, kOffsetParameters, 1>;
using OffsetMatrix = Eigen::Matrix<double, kOffsetParameters, kOffsetParameters>;
/// The derivative of a motion by the parameters: rows [translation, rotation].
using OffsetJacobian = Eigen::Matrix<double, 6, kOffsetParameters>;
/// Places of the parameters in their vector.
inline constexpr int kLeverAt = 0, kRotationAt = 3, kTimeAt = 6, kScaleAt = 7;

/// Which parameters are fitted.
using OffsetMask = std::array<bool, kOffsetParameters>;

/// What is fitted.
struct OffsetState {
  /// T_estimate_truth, the truth's body in the estimate's [m of the truth]. Of positions alone only
  /// the translation is meant.
  SE3 T_estimate_truth;
  SO3 R_world_estimate;  ///< of positions alone: the estimate's world in the truth's
  double time_s = 0;     ///< added to the estimate's times
  double scale = 1;      ///< metres of the truth per unit of the estimate

  /// The state after a small change.
  OffsetState plus(const OffsetVector& change, bool positions_alone) const;
};

/// A motion of both bodies between two times.
struct OffsetRow {
  double time = 0;  ///< its begin
  /// The true motion after the inverse of the predicted one: translation and rotation vector.
  Vector6d error;
  OffsetJacobian derivative;  ///< of the prediction, by the estimate's motion
  OffsetJacobian instrument;  ///< the same by the truth's motion: free of the estimate's noise
};

/// The equations T_truth(i, j) = X^-1 T_estimate(i, j) X of motions from time i to time j.
///
/// X is T_estimate_truth: a motion in the body's own frame does not depend on the frame of the
/// world, so that no alignment enters, and drift enters as far as it grows during the motion.
/// Positions alone: p_truth(j) - p_truth(i) = R_world (s p_estimate + R_estimate X)(j) - the same
/// at i, with one rotation between the worlds. Times are those of the sparser trajectory.
class OffsetEquations {
 public:
  OffsetEquations(const PosedPath& truth, const PosedPath& estimate, bool positions_alone,
                  bool with_time);

  bool positions_alone() const { return positions_alone_; }
  /// Duration of the time that both cover, and the time between neighbours of the sparser.
  double span() const { return span_; }
  double spacing() const { return nodes_->spacing(); }
  /// Half the time over which the truth's velocity is taken, for motions of a duration.
  double half_of(double duration) const;

  /// Equations of motions of about `duration`, at most `most` of them.
  std::vector<OffsetRow> rows(const OffsetState& state, double duration, int most) const;

  /// The rotation, and with `with_scale` the scale, by which the motions fit at the state's time
  /// and without a lever arm (Wahba 1965); where they leave the rotation free, that nearest to
  /// none.
  OffsetState aligned(const OffsetState& state, double duration, int most, bool with_scale) const;

 private:
  /// Both poses at a node, and their velocities if time is fitted.
  struct Node {
    double time = 0;
    SE3 T_world_truth, T_world_estimate;
    Vector6d truth_twist = Vector6d::Zero(), estimate_twist = Vector6d::Zero();
  };

  using Motion = std::pair<Node, Node>;
  std::vector<Motion> motions(const OffsetState& state, double duration, int most) const;
  std::optional<Node> node(std::size_t i, const OffsetState& state, double duration) const;
  OffsetRow pose_row(const Node& i, const Node& j, const OffsetState& state) const;
  OffsetRow position_row(const Node& i, const Node& j, const OffsetState& state) const;

  const PosedPath& truth_;
  const PosedPath& estimate_;
  const PosedPath* nodes_;  ///< the sparser of the two
  bool positions_alone_, with_time_;
  double span_;
};

}  // namespace placegraph
