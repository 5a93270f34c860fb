#pragma once
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/graph/core/ransac.h>

#include <array>
#include <optional>
#include <vector>

namespace placegraph {

/// A mapped line and its observation.
struct SeenLine {
  Line3 line_ref;
  ImageLine::Carriers seen;
};

/// Prior of a pose, with the error log(T_ref_cam_known^-1 T_ref_cam).
struct PoseGuess {
  SE3 T_ref_cam;
  Matrix6d information = Matrix6d::Zero();  ///< may have any rank
};

/// Pose of a camera from lines.
struct PoseFromLines {
  Outcome outcome;
  SE3 T_ref_cam;                            ///< meaningful only if outcome
  std::vector<int> inliers;                 ///< ascending
  double rms_sigmas = 0;                    ///< root mean square of the inliers' residuals
  Matrix6d information = Matrix6d::Zero();  ///< right tangent of T_ref_cam, prior included
};

/// Estimates a camera's pose from mapped lines.
///
/// Three-line minimal solutions in RANSAC, then Gauss-Newton on the distances of the carriers from
/// the projected lines, with Huber weights and the guess as a measurement. The guess is refined
/// first; RANSAC is skipped if enough lines are its inliers. Lines of one direction leave a
/// translation undetermined, lines through one point a rotation. Outcomes: too few data, no
/// consensus, degenerate (a direction that neither lines nor guess determine).
[[nodiscard]] PoseFromLines estimate_pose_from_lines(const Camera& camera,
                                                     const std::vector<SeenLine>& lines,
                                                     const PoseFromLinesOptions& options,
                                                     Random& random,
                                                     const PoseGuess* guess = nullptr);

/// All poses (T_cam_ref), up to eight, at which three lines have planes of the given unit normals.
///
/// m_i^T R v_i = 0 with R v_1 rotated about m_1 and R about v_1 leaves one trigonometric polynomial
/// of degree four in the second rotation (Dhome et al. 1989, Chen 1991); then m_i^T (R p_i + t) = 0
/// is linear in t. Nothing if two of the lines are parallel or the normals are coplanar.
std::vector<SE3> solve_three_lines(const std::array<Line3, 3>& lines_ref,
                                   const std::array<Eigen::Vector3d, 3>& normals_cam);

}  // namespace placegraph
