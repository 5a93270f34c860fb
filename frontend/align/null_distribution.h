#pragma once
#include <placegraph/frontend/align/aligner.h>

namespace placegraph {

/// Distribution of AlignResult::robust_similarity in images that do not show the template.
struct NullDistribution {
  double mean = 0, deviation = 0;  ///< over surrogate images with the template's spectrum
  double rival = 0;  ///< greatest value elsewhere in the template's own image; near 1 if it repeats
  int trials = 0;    ///< surrogate images on which most of the template stayed in view
  /// Mean plus `deviations` standard deviations.
  ///
  /// A surrogate image exceeds it about as often as a normal variable exceeds that many deviations.
  double bound(double deviations) const { return mean + deviations * deviation; }
};

/// Estimates the null distribution of a template's similarity.
///
/// Aligns the template with `trials` surrogate images that have its power spectrum and random
/// phases (surrogate data: Theiler et al. 1992), and with its own image from starts beside it. The
/// template is that of `polygon_px` in `image_ref`; the swarm's seed determines phases and starts.
/// Throws ArgumentError unless `trials` is at least 2.
NullDistribution null_distribution(const Image& image_ref,
                                   const std::vector<Eigen::Vector2d>& polygon_px,
                                   const PlanarTemplate& planar_template,
                                   const AlignOptions& options, int trials);

}  // namespace placegraph
