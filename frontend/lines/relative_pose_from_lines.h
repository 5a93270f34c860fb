#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/plane3.h>

#include <array>
#include <vector>

namespace placegraph {

/// A direction of the scene in two camera frames, up to its sign.
///
/// The direction of a 3-D line, or of a vanishing point.
struct DirectionPair {
  Eigen::Vector3d ref = Eigen::Vector3d::UnitZ(), cur = Eigen::Vector3d::UnitZ();
  double sigma_rad =
      0.01;  ///< standard deviation per axis of the angle between both after the rotation
};

/// Rotation between two cameras from directions.
struct RotationFromDirections {
  Outcome outcome;
  SO3 R_cur_ref;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< right tangent of R_cur_ref
};

/// Estimates the rotation between two cameras from directions.
///
/// min sum |cur - R ref|^2 / sigma^2 (Wahba; Kabsch 1976), with the signs nearest to
/// `R_cur_ref_guess`. One direction, or parallel ones, leave the rotation about it undetermined:
/// kDegenerate, with the information of the two determined axes. Too few data: no directions.
[[nodiscard]] RotationFromDirections rotation_from_directions(
    const std::vector<DirectionPair>& pairs, const SO3& R_cur_ref_guess = {});

/// A line in three views: unit normals of its planes through the centres, in each camera.
using LineNormals = std::array<Eigen::Vector3d, 3>;

/// Translations between three views from lines.
struct TranslationFromLines {
  Outcome outcome;
  Eigen::Vector3d t_21 = Eigen::Vector3d::Zero();  ///< X_2 = R_21 X_1 + t_21, with
  Eigen::Vector3d t_31 = Eigen::Vector3d::Zero();  ///< |t_21|^2 + |t_31|^2 = 1
  double condition = 0;   ///< fifth singular value over the sixth expected from noise
  double rms_sigmas = 0;  ///< rms of m_3 . t_31 - beta m_2 . t_21 over the lines
  /// Covariance of [t_21, t_31] at a standard deviation of `sigma_rad` of each normal; singular
  /// along [t_21, t_31].
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Estimates translations between three views of known rotation, up to a common scale.
///
/// Needs five lines or more: R_31^T m_3 = alpha m_1 + beta R_21^T m_2 determines beta, then
/// m_3^T t_31 = beta m_2^T t_21 is one linear equation per line, weighted by the effect of the
/// normals' errors. The caller must choose the sign for which the lines are in front of the
/// cameras. Outcomes: too few data (fewer than five lines whose planes rotated between the first
/// two views), degenerate (fifth and sixth singular value similar, as for lines of one direction).
/// Two views alone never determine a translation: any two planes meet in a line.
[[nodiscard]] TranslationFromLines translation_from_three_views(
    const std::vector<LineNormals>& lines, const SO3& R_21, const SO3& R_31,
    double sigma_rad = 1e-3);

/// Outcome of the motion from two views of lines, always kDegenerate.
///
/// No set of lines determines the translation, nor the rotation unless directions are known.
[[nodiscard]] Outcome translation_from_two_views(std::size_t lines);

/// Observations in two views of a line on a known plane n^T p = d of the first camera's frame.
struct PlaneLineObservation {
  Eigen::Vector3d normal_ref =
      Eigen::Vector3d::Zero();  ///< normal of its plane through each camera
  Eigen::Vector3d normal_cur = Eigen::Vector3d::Zero();
  double sigma_rad = 1e-3;  ///< standard deviation of either normal
};

/// Motion of a camera along a plane.
struct MotionOnPlane {
  Outcome outcome;
  Eigen::Vector3d displacement_ref =
      Eigen::Vector3d::Zero();  ///< camera's displacement along the plane
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< covariance of displacement_ref, rank two
  int lines = 0;
};

/// Estimates the displacement of a camera along a plane from lines on that plane (a floor).
///
/// The displacement is metric for a plane at known metric distance; the rotation is given. A line's
/// offset in the plane changes by -a^T c with a its normal in the plane, so two lines of different
/// direction determine c. `height_cur` is the plane's distance from the second view, which may
/// differ from that of the first. Outcomes: too few data, degenerate (all lines of one direction:
/// the displacement along them is undetermined; covariance has the information about the other).
[[nodiscard]] MotionOnPlane motion_from_floor_lines(const std::vector<PlaneLineObservation>& lines,
                                                    const Plane3& plane_ref, double height_cur,
                                                    const SO3& R_cur_ref);

}  // namespace placegraph
