#pragma once
#include <placegraph/frontend/align/align_options.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <string>
#include <vector>

namespace placegraph {

/// Similarity of two lists of grey values; a greater value is more similar.
///
/// Minus the mean squared difference (SSD), the correlation in [-1, 1] (ZNCC), mutual information
/// in nats (MI). `ref` and `cur` are of one size; -infinity with less than two values, 0 (ZNCC, MI)
/// if one list is constant.
double similarity(Similarity kind, const std::vector<double>& ref, const std::vector<double>& cur);

/// Photometric model of the current grey values given the template's, for gradient methods.
///
/// It has the predicted current grey value at each sample, model = m(ref), its slope dm/dref, and
/// residuals whose sum of squares falls as the similarity rises. SSD, ZNCC: cur - model with m
/// linear. MI: the derivative of mutual information by each current value (Dowson & Bowden 2008,
/// eq. 13), scaled by the conditional variance to grey levels, which for a joint normal
/// distribution is ZNCC's residual; m is the conditional mean.
struct PhotometricFit {
  std::vector<double> model, slope, residual, weight;
  double gain = 1, bias = 0;  ///< parameters of the linear models
  double sigma_grey = 0;      ///< deviation of cur - model, from the median magnitude, at least 0.4
  double similarity = 0;
  double inlier_share = 0;  ///< share of |cur - model| below 2.5 sigma, sigma at most 12 levels
};

/// Fits the model to the values, with robust weights of `width` standard deviations.
///
/// For SSD with gain and bias and for ZNCC the linear model is refitted under its own weights,
/// starting from those in `fit.weight` if there are as many as values (a fit of the previous step).
/// Precondition: ref and cur of one size, not empty.
void fit_photometry(Similarity kind, const std::vector<double>& ref, const std::vector<double>& cur,
                    RobustKernel::Kind kernel, double width, PhotometricFit& fit);

/// Similarity that is robust to occlusion, for the choice between rival alignments.
///
/// MI unchanged; else one minus the mean of min(e^2 / t^2, 1), with e the residual of a robust fit
/// in grey levels of the template and t half its standard deviation. The error of an occluded part
/// is bounded for any appearance. Worst possible value with less than two values.
double robust_similarity(Similarity kind, const std::vector<double>& ref,
                         const std::vector<double>& cur);

/// Weighted correlation of the current values and the model.
double agreement(const PhotometricFit& fit, const std::vector<double>& cur);

}  // namespace placegraph
