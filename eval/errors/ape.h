#pragma once
#include <placegraph/eval/alignment/alignment_options.h>
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/eval/errors/statistics.h>
#include <placegraph/graph/core/outcome.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Which part of the position errors is judged.
enum class ErrorPart {
  kSpace,   ///< the whole error
  kXy,      ///< its part in the plane of the world's x and y
  kXz,      ///< its part in the plane of x and z
  kYz,      ///< its part in the plane of y and z
  kFitted,  ///< its part in the plane that fits the true positions best
  kX,       ///< its part along x
  kY,       ///< its part along y
  kZ,       ///< its part along z
};

/// The part of position errors that is judged: a plane or an axis of the truth's world.
struct ErrorProjection {
  Eigen::Matrix3d projection = Eigen::Matrix3d::Identity();  ///< applied to position errors
  /// Axis about which rotation errors are judged, in the truth's world; nothing: about any.
  std::optional<Eigen::Vector3d> rotation_axis;
  std::string text;  ///< "in the plane xy", "along z"; empty for the whole error
};
/// The projection that `part` names; a fitted plane is that of the true positions.
ErrorProjection projection_of(const std::vector<FramePair>& pairs, ErrorPart part);

/// Absolute trajectory error: differences of true and estimated poses of the posed frames.
struct ApeResult {
  Outcome outcome;                     ///< kTooFewData if no frame is posed
  Statistics error_m;                  ///< meaningful only if outcome; the RMSE is the ATE
  std::vector<int> frames;             ///< the posed frames, as FramePair::frame
  std::vector<double> frame_errors_m;  ///< error of each of them [m]
  Outcome rotation_outcome;            ///< no success without orientations, or if one is arbitrary
  Statistics rotation_deg;             ///< angles of T_truth^-1 T_estimate
  std::vector<double> frame_errors_deg;  ///< error of each posed frame [deg]
  Statistics full;  ///< Frobenius norms of T_truth^-1 T_estimate - I, of whole poses
};

/// Computes the absolute errors of pairs whose estimate is aligned already.
///
/// Sturm et al. 2012, section V.B. Lost frames are left out. The rotation is judged where
/// `rotation` succeeds.
[[nodiscard]] ApeResult ape(const std::vector<FramePair>& aligned_pairs,
                            const ErrorProjection& part = {},
                            const Outcome& rotation = Outcome::ok());

/// Position errors along, across and up the true path, with signs, of the posed frames.
struct ErrorComponents {
  Outcome outcome;  ///< kDegenerate if no vertical is evident or the truth never moves
  std::string vertical;                      ///< the vertical, in words
  Statistics along_m, across_m, up_m;        ///< signed_statistics_of: the mean is a bias
  std::vector<Eigen::Vector3d> errors_m;     ///< along, across, up of each posed frame
};

/// Splits the position errors of aligned pairs by the direction of the true path.
///
/// Along is the direction of the chord of the true path about the frame, level; up is the vertical;
/// across is up x along, to the left of a path whose vertical points up.
[[nodiscard]] ErrorComponents error_components(const std::vector<FramePair>& aligned_pairs,
                                               const std::vector<double>& travelled_m,
                                               bool has_orientation, Vertical vertical);

}  // namespace placegraph
