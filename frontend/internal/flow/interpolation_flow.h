#pragma once
#include <placegraph/frontend/internal/flow/flow_vector.h>
#include <placegraph/frontend/internal/flow/padded_pyramid.h>
#include <placegraph/graph/core/options.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace placegraph {

struct InterpolationFlowOptions {
  int radius_px = 7;             ///< the patch is a square of 2 radius + 1
  double fwhm_px = 10;           ///< full width of its Gaussian weight at half of the maximum
  int levels = 3;                ///< references are shifted by as much on each
  int shift_px = 1;              ///< of the references, on each level
  double rotation_rad = 0.1;     ///< of the references, about the patch's centre
  bool rotates = true;           ///< rotation is looked for; on the finest level only
  int iterations = 4;            ///< on each level at most
  double epsilon_px = 0.01;      ///< a step shorter than this ends them
  double min_eigenvalue = 3e-5;  ///< of the gradient matrix per pixel, grey levels / 255
  double max_residual = 0.08;    ///< RMS of what the answer leaves, grey levels / 255
  void check() const;
};
void visit(OptionVisitor& field, InterpolationFlowOptions& options);

/// Motion of a patch between two images: its points x move to centre + shift + R(rotation) (x -
/// centre), R turning u towards v.
struct PatchMotion {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();       ///< [px]
  double rotation = 0;                                   ///< [rad]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (shift, rotation)
  double gain = 1;      ///< of contrast, from the first image to the second
  double residual = 0;  ///< RMS of what it leaves [grey levels]
};

/// Optical flow by image interpolation (Srinivasan, "An image-interpolation technique for the
/// computation of optic flow and egomotion", Biological Cybernetics 71, 1994): the second image of
/// a patch is interpolated linearly between six copies of the first, shifted both ways along u and
/// along v and rotated both ways, by least squares with Gaussian weights; here from coarse to fine,
/// with the second image moved back by what is known and interpolated again, and free gain and
/// offset of the grey values. Exact for planes that face the camera.
class InterpolationFlow {
 public:
  /// Throws ArgumentError.
  explicit InterpolationFlow(const InterpolationFlowOptions& options);

  /// The form in which `measure` wants images (CV_8UC1).
  PaddedPyramid pyramid(const Image& grey) const;
  /// Of the patch around the pixel nearest to `px`; nothing where its texture leaves a direction
  /// open, the patch leaves the image, or the answer does not explain it.
  std::optional<PatchMotion> measure(const PaddedPyramid& from, const PaddedPyramid& to,
                                     const Eigen::Vector2d& px) const;

 private:
  struct Patch;
  struct Pixel {  // of a turned patch: where it lies, and bilinear weights
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

/// One answer for each of `points`, at the pixel nearest to it. Throws ArgumentError.
std::vector<FlowVector> interpolation_flow(const Image& from, const Image& to,
                                           const std::vector<Eigen::Vector2d>& points,
                                           const InterpolationFlowOptions& options);

}  // namespace placegraph
