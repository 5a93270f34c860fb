#pragma once
#include <placegraph/graph/core/robust_kernel.h>

#include <string>
#include <vector>

namespace placegraph {

/// How alike two lists of grey values are.
enum class Similarity {
  kSsd,          ///< sum of squared differences, as they are
  kSsdGainBias,  ///< the same after the best gain (within a half and two) and bias
  kZncc,         ///< zero-mean normalized cross-correlation
  kMi,           ///< mutual information of a joint histogram with cubic B-spline windows
};
const std::vector<std::string>& similarity_names();

/// Greater is more alike: minus the mean squared difference (SSD), the correlation in [-1, 1]
/// (ZNCC), mutual information in nats (MI). `ref` and `cur` are of one size; worst possible
/// (-infinity) below two values, 0 (ZNCC, MI) where one list does not vary.
double similarity(Similarity kind, const std::vector<double>& ref, const std::vector<double>& cur);

/// What an optimizer that follows derivatives needs of the template's values and those seen now:
/// the current grey value that the template predicts at each sample, model = m(ref), its slope
/// dm/dref, and residuals whose sum of squares falls as the similarity rises. SSD, ZNCC: cur -
/// model with m linear. MI: the derivative of mutual information by each current value (Dowson &
/// Bowden 2008, eq. 13), scaled by the conditional variance to grey levels, which for a joint
/// normal distribution is ZNCC's residual; m is the conditional mean.
struct PhotometricFit {
  std::vector<double> model, slope, residual, weight;
  double gain = 1, bias = 0;  ///< of the linear models
  double sigma_grey = 0;      ///< of cur - model, from the median of magnitudes, at least 0.4
  double similarity = 0;
  double inlier_share = 0;  ///< share of |cur - model| below 2.5 sigma, sigma at most 12 levels
};

/// Fits the model to the values, with robust weights: `width` in standard deviations. For SSD with
/// gain and bias and for ZNCC the linear model is refitted under its own weights, starting from
/// those in `weight` where it holds as many as there are values (a fit of the step before).
/// Precondition: ref and cur of one size, not empty.
void fit_photometry(Similarity kind, const std::vector<double>& ref, const std::vector<double>& cur,
                    RobustKernel::Kind kernel, double width, PhotometricFit& fit);

/// How well two lists agree where they agree at all, for the choice between rival alignments: MI as
/// it is; else one less the mean of min(e^2 / t^2, 1), with e the residual of a robust fit in grey
/// levels of the template and t half its standard deviation. An occluded part counts as one error,
/// however it looks. Worst possible below two values.
double robust_similarity(Similarity kind, const std::vector<double>& ref,
                         const std::vector<double>& cur);

/// How much of the current values the template explains: the weighted correlation of cur and model.
double agreement(const PhotometricFit& fit, const std::vector<double>& cur);

}  // namespace placegraph
