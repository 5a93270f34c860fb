#pragma once
#include <placegraph/frontend/lines/line_initializer.h>
#include <placegraph/graph/core/ids.h>

#include <map>
#include <vector>

namespace placegraph {

/// Estimates the rotation of a camera from directions shared by many edges of the scene.
///
/// The directions are vanishing points, stored in a fixed frame, at any angles to each other.
/// Tracks are assigned to them once, by the direction of their segments, and constrain the rotation
/// in every view in which they are observed, even if their position is unknown. The rotation does
/// not drift as long as one direction stays in view while the others change.
class VanishingDirectionTracker {
 public:
  explicit VanishingDirectionTracker(const VanishingPointOptions& options) : options_(options) {}

  /// Rotation of a view.
  struct RotationEstimate {
    Outcome outcome;
    SO3 R_ref_cam;
    /// Right tangent of R_ref_cam [1 / rad^2], of rank two if only one direction is observed.
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    int lines = 0;
  };
  /// Estimates the rotation of a view from a guess with standard deviation `sigma_rad`.
  ///
  /// Reweighted Gauss-Newton over the tracks that have a direction. The guess constrains the axes
  /// that the lines leave undetermined and is not part of the information. Outcomes: too few data
  /// (fewer than three of them).
  [[nodiscard]] RotationEstimate read(const Camera& camera, const LineView& view,
                                      const SO3& R_ref_cam_guess, double sigma_rad) const;
  /// Updates the directions by a view of known rotation.
  ///
  /// Tracks that point to one of the directions join it, those that no longer do leave it, and new
  /// directions are searched among the remaining tracks. Tracks that are not in the view are
  /// removed.
  void learn(const Camera& camera, const LineView& view, const SO3& R_ref_cam, Random& random);
  /// A direction and the tracks of the view learned last that point to it.
  struct DirectionCluster {
    Eigen::Vector3d d_ref;
    double sigma_rad;
    std::vector<LineId> tracks;  ///< ascending, three or more
  };
  std::vector<DirectionCluster> clusters() const;
  int directions() const { return static_cast<int>(directions_.size()); }

 private:
  struct Known {
    Eigen::Vector3d d_ref;
    Eigen::Matrix3d across = Eigen::Matrix3d::Zero();  ///< sum of weighted n n^T over its planes
  };
  struct Evidence;
  LineView assign(const Evidence& evidence, const LineView& view, const SO3& R_ref_cam);
  void find_new(const Camera& camera, const LineView& left, const SO3& R_ref_cam, Random& random);
  void refine(const Evidence& evidence, const SO3& R_ref_cam);

  VanishingPointOptions options_;
  std::vector<Known> directions_;
  std::map<LineId, int> direction_of_;  ///< -1: none
};

}  // namespace placegraph
