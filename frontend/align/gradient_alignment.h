#pragma once
#include <placegraph/frontend/align/align_options.h>
#include <placegraph/frontend/align/planar_template.h>
#include <placegraph/frontend/align/similarity.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

/// Gradients used in the Jacobian of the residuals.
enum class Gradients {
  kForward,  ///< those of the warped current image: forward compositional Gauss-Newton
  kEsm,      ///< the mean of both: efficient second-order minimization (Benhimane & Malis 2007)
  kInverse,  ///< those of the template: inverse compositional (Baker & Matthews 2004)
};

/// The samples of a template that a warp maps into the current image.
struct SeenSamples {
  std::vector<std::size_t> index;  ///< into the level's samples
  std::vector<double> ref, cur;    ///< grey values
  /// Gradient of the current image in the template's coordinates [grey per unit]; empty if not
  /// requested.
  std::vector<Eigen::Vector2d> gradient;
};

/// Samples the current image; `image` is level `level` of its pyramid, scaled by 2^-level.
void see_samples(const TemplateLevel& samples, const PlanarTemplate& planar_template,
                 const Image& image, int level, const Eigen::Matrix3d& H_cur_ref,
                 bool with_gradients, SeenSamples& seen);

/// One row of the Jacobian with respect to the nine numbers of a generator.
///
/// In the template's coordinates: gradient . (the field of A at x) for A row after row.
Eigen::Matrix<double, 9, 1> generator_row(const Eigen::Vector2d& x,
                                          const Eigen::Vector2d& gradient);

/// The warp's generators in the template's coordinates.
PlanarWarp::Generators template_generators(const PlanarTemplate& planar_template,
                                           const PlanarWarp& warp);

/// Result of align_level.
struct GradientAlignmentResult {
  PlanarWarp warp;
  int iterations = 0;        ///< steps taken
  double last_step_px = 0;   ///< displacement of the corner that moved most
  double visible_share = 0;  ///< share of the samples in view at the final warp
  enum class End { kConverged, kIterations, kOutOfView, kSingular } end = End::kIterations;
};

/// Maximizes the similarity from `start` on one level by Gauss-Newton steps.
///
/// H <- H exp(x), x = -(J^T W J)^-1 J^T W e with e and W of fit_photometry and gain and bias
/// projected out of J (ZNCC, MI: the gain acts on the current values). A step moves a corner by at
/// most a quarter of the template's size; with MI it is halved until MI rises.
[[nodiscard]] GradientAlignmentResult align_level(const PlanarTemplate& planar_template,
                                                  const Image& image, int level,
                                                  const PlanarWarp& start, Gradients gradients,
                                                  const GradientAlignmentOptions& options);

}  // namespace placegraph
