#pragma once
#include <placegraph/frontend/internal/align/planar_template.h>
#include <placegraph/frontend/internal/align/similarity.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

/// Which gradients stand in the Jacobian of the residuals.
enum class Gradients {
  kForward,  ///< of the current image, warped: forward compositional Gauss-Newton
  kEsm,      ///< the mean of both: efficient second-order minimization (Benhimane & Malis 2007)
  kInverse,  ///< of the template: inverse compositional (Baker & Matthews 2004)
};

struct GradientAlignmentOptions {
  Similarity similarity = Similarity::kZncc;
  RobustKernel::Kind kernel = RobustKernel::Kind::kTukey;
  double kernel_width = 4.685;     ///< [standard deviations of the residuals]
  int iterations = 20;             ///< at most, per level
  double converged_px = 0.002;     ///< a step that moves no corner by more ends a level
  double min_visible_share = 0.4;  ///< of the samples, in the current image
  void check() const;
};
void visit(OptionVisitor& field, GradientAlignmentOptions& options);

/// The samples of a template that a warp puts into the current image.
struct SeenSamples {
  std::vector<std::size_t> index;  ///< into the level's samples
  std::vector<double> ref, cur;    ///< grey values
  /// Of the current image by the template's coordinates [grey per unit]; empty if not asked for.
  std::vector<Eigen::Vector2d> gradient;
};

/// `image` is the level of the current pyramid that is 2^-level its size.
void see_samples(const TemplateLevel& samples, const PlanarTemplate& planar_template,
                 const Image& image, int level, const Eigen::Matrix3d& H_cur_ref,
                 bool with_gradients, SeenSamples& seen);

/// One row of the Jacobian by the nine numbers of a generator in the template's coordinates:
/// gradient . (the field of A at x) for A row after row.
Eigen::Matrix<double, 9, 1> generator_row(const Eigen::Vector2d& x,
                                          const Eigen::Vector2d& gradient);

/// The warp's generators in the template's coordinates.
PlanarWarp::Generators template_generators(const PlanarTemplate& planar_template,
                                           const PlanarWarp& warp);

struct GradientAlignmentResult {
  PlanarWarp warp;
  int iterations = 0;        ///< steps taken
  double last_step_px = 0;   ///< of the corner that moved most
  double visible_share = 0;  ///< where it ended
  enum class End { kConverged, kIterations, kOutOfView, kSingular } end = End::kIterations;
};

/// Follows the similarity from `start` on one level: H <- H exp(x), x = -(J^T W J)^-1 J^T W e with
/// e and W of fit_photometry and gain and bias projected out of J (ZNCC, MI: out of the current
/// values'). A step may move a corner by a quarter of the template's size; along MI it is halved
/// until MI rises.
[[nodiscard]] GradientAlignmentResult align_level(const PlanarTemplate& planar_template,
                                                  const Image& image, int level,
                                                  const PlanarWarp& start, Gradients gradients,
                                                  const GradientAlignmentOptions& options);

}  // namespace placegraph
