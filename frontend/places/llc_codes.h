#pragma once
#include <placegraph/frontend/places/float_features.h>

#include <vector>

namespace placegraph {

struct LlcOptions;

/// Code of a descriptor: a few words with shares that sum to one; shares may be negative.
struct LlcCode {
  std::vector<int> words;  ///< nearest first
  Eigen::VectorXf shares;
};

/// Weights c of the rows b_i of `words` that reconstruct `descriptor`.
///
/// They minimize |x - sum c_i b_i|^2 + ridge * tr(C) |c|^2 with sum c_i = 1, where C_ij = (b_i -
/// x)(b_j - x)^T. By Lagrange's rule (C + ridge tr(C) I) c is the same in all components (Wang et
/// al. 2010, section 3).
Eigen::VectorXf local_shares(const Eigen::Ref<const FloatDescriptors>& words,
                             const Eigen::Ref<const Eigen::RowVectorXf>& descriptor, double ridge);

/// Locality-constrained linear codes (Wang et al. 2010): each descriptor by its nearest words.
///
/// `words`, `descriptors`: rows of equal length (ArgumentError otherwise).
std::vector<LlcCode> llc_codes(const FloatDescriptors& words, const FloatDescriptors& descriptors,
                               const LlcOptions& options);

/// Pools the codes of an image by the maximum.
///
/// The largest share of every word (none below 0) in the whole image and in the cells of the
/// spatial pyramid, the words of a cell together, of unit length (zero without codes). `cell_of`:
/// cell of each code, 0 .. cells-1.
Eigen::VectorXf max_pooled(const std::vector<LlcCode>& codes, int words);
Eigen::VectorXf max_pooled(const std::vector<LlcCode>& codes, int words,
                           const std::vector<int>& cell_of, int cells);

/// Cell of each position in a grid of rows x rows over the image.
std::vector<int> pyramid_cells(const FloatFeatures& features, int rows);

}  // namespace placegraph
