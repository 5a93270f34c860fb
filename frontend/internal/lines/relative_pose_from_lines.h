#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/plane3.h>

#include <array>
#include <vector>

namespace placegraph {

/// A direction of the scene in two camera frames, up to its sign: of a 3-D line, or a vanishing
/// direction.
struct DirectionPair {
  Eigen::Vector3d ref = Eigen::Vector3d::UnitZ(), cur = Eigen::Vector3d::UnitZ();
  double sigma_rad = 0.01;  ///< of the angle between both after the rotation, each way
};

struct RotationFromDirections {
  Outcome outcome;
  SO3 R_cur_ref;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< right tangent of R_cur_ref
};

/// Rotation that carries directions over: min sum |cur - R ref|^2 / sigma^2 (Wahba; Kabsch 1976),
/// signs taken nearest to `R_cur_ref_guess`. One direction, or parallel ones, leave the turn about
/// it open: kDegenerate, with the information of the two that are known. Too few data: none.
[[nodiscard]] RotationFromDirections rotation_from_directions(
    const std::vector<DirectionPair>& pairs, const SO3& R_cur_ref_guess = {});

/// A line seen in some views: unit normals of its planes through their centres, in each camera.
using LineNormals = std::array<Eigen::Vector3d, 3>;

struct TranslationFromLines {
  Outcome outcome;
  Eigen::Vector3d t_21 = Eigen::Vector3d::Zero();  ///< X_2 = R_21 X_1 + t_21, with
  Eigen::Vector3d t_31 = Eigen::Vector3d::Zero();  ///< |t_21|^2 + |t_31|^2 = 1
  double condition = 0;   ///< fifth singular value over what the noise makes of the sixth
  double rms_sigmas = 0;  ///< of m_3 . t_31 - beta m_2 . t_21 over the lines
  /// Of [t_21, t_31], at a deviation of `sigma_rad` of each normal; singular along itself.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Translations between three views of known rotation from five lines or more, up to one common
/// scale: R_31^T m_3 = alpha m_1 + beta R_21^T m_2 gives beta, then m_3^T t_31 = beta m_2^T t_21 is
/// one linear equation a line, weighted by what the errors of the normals make of it. Which of the
/// two signs it is must be told by where the lines lie: before the cameras. Outcomes: too few data
/// (fewer than five whose planes turned between the first two views), degenerate (fifth and sixth
/// singular value alike, as for lines of one direction).
/// Two views alone never tell a translation: any two planes meet in a line.
[[nodiscard]] TranslationFromLines translation_from_three_views(
    const std::vector<LineNormals>& lines, const SO3& R_21, const SO3& R_31,
    double sigma_rad = 1e-3);

/// What two views of lines say of the motion between them: nothing of the translation, whatever
/// the lines, and nothing of the rotation either unless directions are known. Always kDegenerate.
[[nodiscard]] Outcome translation_from_two_views(std::size_t lines);

/// A line on a known plane n^T p = d of the first camera's frame (a floor), as two views see it.
struct PlaneLineObservation {
  Eigen::Vector3d normal_ref = Eigen::Vector3d::Zero();  ///< of its plane through each camera
  Eigen::Vector3d normal_cur = Eigen::Vector3d::Zero();
  double sigma_rad = 1e-3;  ///< of either
};

struct MotionOnPlane {
  Outcome outcome;
  Eigen::Vector3d displacement_ref = Eigen::Vector3d::Zero();  ///< of the camera, along the plane
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();        ///< of rank two
  int lines = 0;
};

/// The metric displacement of a camera along a plane at known distance from lines on that plane,
/// the rotation given: a line's offset in the plane changes by -a^T c with a its normal in the
/// plane, so two lines of different direction give c. `height_cur` is the plane's distance from the
/// second view, where it is not that from the first. Outcomes: too few data, degenerate (all lines
/// of one direction: the way along them is open; the information about the other is in covariance).
[[nodiscard]] MotionOnPlane motion_from_floor_lines(const std::vector<PlaneLineObservation>& lines,
                                                    const Plane3& plane_ref, double height_cur,
                                                    const SO3& R_cur_ref);

}  // namespace placegraph
