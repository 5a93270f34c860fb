#pragma once
#include <placegraph/frontend/flow/flow_options.h>
#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/frontend/flow/padded_pyramid.h>
#include <placegraph/graph/core/options.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace placegraph {

/// Motion of a patch between two images.
///
/// Its points x move to centre + shift + R(rotation) (x - centre); R rotates u towards v.
struct PatchMotion {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();       ///< [px]
  double rotation = 0;                                   ///< [rad]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< covariance of (shift, rotation)
  double gain = 1;      ///< gain of contrast from the first image to the second
  double residual = 0;  ///< RMS of the residual [grey levels]
};

/// Optical flow by image interpolation.
///
/// After Srinivasan, "An image-interpolation technique for the computation of optic flow and
/// egomotion", Biological Cybernetics 71, 1994: the second image of a patch is interpolated
/// linearly between six copies of the first, shifted by both signs along u and v and rotated by
/// both signs, by least squares with Gaussian weights. Here the estimate is refined from coarse to
/// fine, with the second image moved back by the current estimate and interpolated again, and with
/// free gain and offset of the grey values. Exact for planes that face the camera.
class InterpolationFlow {
 public:
  /// Throws ArgumentError for options out of range.
  explicit InterpolationFlow(const InterpolationFlowOptions& options);

  /// The pyramid of an image (CV_8UC1) for `measure`.
  PaddedPyramid pyramid(const Image& grey) const;
  /// Motion of the patch around the pixel nearest to `px`.
  ///
  /// Nothing if its texture leaves a direction undetermined, the patch leaves the image, or the
  /// residual is too large.
  std::optional<PatchMotion> measure(const PaddedPyramid& from, const PaddedPyramid& to,
                                     const Eigen::Vector2d& px) const;

 private:
  struct Patch;
  struct Pixel {  // pixel of a rotated patch with bilinear weights
    int row, column;
    float w00, w01, w10, w11;
  };
  void reference(const Image& image, int u, int v, bool rotates, Patch& patch) const;
  bool sample(const Image& image, const Eigen::Vector2d& centre, double rotation,
              Eigen::VectorXf& values) const;
  bool follow(const Patch& patch, const Image& image, const Eigen::Vector2d& centre, bool rotates,
              double epsilon_px, PatchMotion& motion) const;

  InterpolationFlowOptions options_;
  Eigen::VectorXf weights_;                // Psi, sum 1
  std::vector<Pixel> rotated_, returned_;  // by +rotation_rad and by -rotation_rad
};

}  // namespace placegraph
