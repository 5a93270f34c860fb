#pragma once
#include <placegraph/frontend/internal/lines/line_initializer.h>
#include <placegraph/graph/core/ids.h>

#include <map>
#include <vector>

namespace placegraph {

/// The rotation of a camera by directions of a scene that many of its edges share: vanishing points
/// remembered in a fixed frame, whatever the angles between them. Tracks are assigned to them once,
/// by where they point, and go on to show the rotation in every view that they are seen in, whether
/// their place is known or not. It does not drift as long as one direction stays in view while the
/// others change.
class VanishingDirectionTracker {
 public:
  explicit VanishingDirectionTracker(const VanishingPointOptions& options) : options_(options) {}

  struct RotationEstimate {
    Outcome outcome;
    SO3 R_ref_cam;
    /// Right tangent of R_ref_cam [1 / rad^2], of rank two where one direction alone is seen.
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    int lines = 0;
  };
  /// Near a rotation known to `sigma_rad`, which holds what the lines leave open and does not enter
  /// the information. Reweighted Gauss-Newton over the tracks that have a direction. Outcomes: too
  /// few data (under three of them).
  [[nodiscard]] RotationEstimate read(const Camera& camera, const LineView& view,
                                      const SO3& R_ref_cam_guess, double sigma_rad) const;
  /// Where a view was taken: tracks that point to one of the directions join it, those that do not
  /// any more leave it, and what is left over may show new directions. Tracks that the view does
  /// not hold are forgotten.
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
    Eigen::Matrix3d across = Eigen::Matrix3d::Zero();  ///< sum of weighted n n^T of its planes
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
