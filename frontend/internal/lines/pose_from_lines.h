#pragma once
#include <placegraph/frontend/internal/lines/line_triangulation.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/internal/core/ransac.h>

#include <array>
#include <optional>
#include <vector>

namespace placegraph {

/// A line of known place and where it is seen.
struct SeenLine {
  Line3 line_ref;
  ImageLine::Carriers seen;
};

/// What is known of a pose beforehand: error log(T_ref_cam_known^-1 T_ref_cam).
struct PoseGuess {
  SE3 T_ref_cam;
  Matrix6d information = Matrix6d::Zero();  ///< of any rank
};

struct PoseFromLines {
  Outcome outcome;
  SE3 T_ref_cam;                            ///< meaningful only if outcome
  std::vector<int> inliers;                 ///< ascending
  double rms_sigmas = 0;                    ///< of the inliers, per residual
  Matrix6d information = Matrix6d::Zero();  ///< right tangent of T_ref_cam, the guess' included
};

/// Pose from lines of known place: three-line minimal solutions in RANSAC, then Gauss-Newton on the
/// distances of the carriers from the projected lines, Huber weights, and the guess as a
/// measurement. The guess is refined first, and the RANSAC left out where it explains enough lines.
/// Lines of one direction alone leave a translation open, lines through one point a rotation.
/// Outcomes: too few data, no consensus, degenerate (a direction that neither lines nor guess fix).
[[nodiscard]] PoseFromLines estimate_pose_from_lines(const Camera& camera,
                                                     const std::vector<SeenLine>& lines,
                                                     const PoseFromLinesOptions& options,
                                                     Random& random,
                                                     const PoseGuess* guess = nullptr);

/// All poses (T_cam_ref) that see three lines at planes of the given unit normals, up to eight:
/// m_i^T R v_i = 0 with R v_1 turned about m_1 and R about v_1 leaves one trigonometric polynomial
/// of degree four in the second turn (Dhome et al. 1989, Chen 1991); then m_i^T (R p_i + t) = 0 is
/// linear in t. Nothing for three lines of which two are parallel or whose normals lie in a plane.
std::vector<SE3> solve_three_lines(const std::array<Line3, 3>& lines_ref,
                                   const std::array<Eigen::Vector3d, 3>& normals_cam);

}  // namespace placegraph
