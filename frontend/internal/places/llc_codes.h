#pragma once
#include <placegraph/frontend/internal/places/float_features.h>

#include <vector>

namespace placegraph {

struct LlcOptions {
  int most_words = 1000;  ///< the deepest level of the vocabulary that has no more is taken
  int neighbours = 5;     ///< words a descriptor is made of
  double ridge = 1e-4;    ///< of the trace of the local covariance
  int pyramid_rows = 2;   ///< cells of the finer level of the spatial pyramid, across and down
  void check() const;
};
void visit(OptionVisitor& field, LlcOptions& options);

/// A descriptor as few words that make it up: their shares sum to one, some may be negative.
struct LlcCode {
  std::vector<int> words;  ///< nearest first
  Eigen::VectorXf shares;
};

/// The weights c of the rows b_i of `words` that make up `descriptor`: least |x - sum c_i b_i|^2 +
/// ridge * tr(C) |c|^2 with sum c_i = 1, where C_ij = (b_i - x)(b_j - x)^T. By Lagrange's rule
/// (C + ridge tr(C) I) c is the same in all components (Wang et al. 2010, section 3).
Eigen::VectorXf local_shares(const Eigen::Ref<const FloatDescriptors>& words,
                             const Eigen::Ref<const Eigen::RowVectorXf>& descriptor, double ridge);

/// Locality-constrained linear codes (Wang et al. 2010): every descriptor by its nearest words.
/// `words`, `descriptors`: by rows, of equal length (ArgumentError otherwise).
std::vector<LlcCode> llc_codes(const FloatDescriptors& words, const FloatDescriptors& descriptors,
                               const LlcOptions& options);

/// The codes of an image, the largest share of every word (none below 0) in the whole image and in
/// the cells of the spatial pyramid, the words of a cell together, of unit length (zero where there
/// are no codes). `cell_of`: of each code, 0 .. cells-1.
Eigen::VectorXf max_pooled(const std::vector<LlcCode>& codes, int words);
Eigen::VectorXf max_pooled(const std::vector<LlcCode>& codes, int words,
                           const std::vector<int>& cell_of, int cells);

/// In which cell of rows x rows over the image each position lies.
std::vector<int> pyramid_cells(const FloatFeatures& features, int rows);

}  // namespace placegraph
