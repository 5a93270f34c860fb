#pragma once
#include <placegraph/frontend/internal/align/aligner.h>

namespace placegraph {

/// The likeness (AlignResult::likeness) at which alignments end where the template is not.
struct NullDistribution {
  double mean = 0, deviation = 0;  ///< on pictures that only look alike
  double rival =
      0;           ///< the greatest elsewhere in the template's own image: near 1 where it repeats
  int trials = 0;  ///< pictures on which most of the template stayed in view
  /// What a picture that only looks alike exceeds about as often as a normal distribution lies
  /// beyond so many standard deviations.
  double bound(double deviations) const { return mean + deviations * deviation; }
};

/// Aligns the template with `trials` pictures of its own power spectrum but of random phases
/// (surrogate data: Theiler et al. 1992), and with its own image from starts beside it. The
/// template is that of `polygon_px` in `image_ref`; the swarm's seed chooses phases and starts.
/// Throws ArgumentError unless `trials` is at least 2.
NullDistribution null_distribution(const Image& image_ref,
                                   const std::vector<Eigen::Vector2d>& polygon_px,
                                   const PlanarTemplate& planar_template,
                                   const AlignOptions& options, int trials);

}  // namespace placegraph
