#pragma once
#include <placegraph/frontend/labels/superpixel_features.h>
#include <placegraph/graph/scene/scene_model.h>

#include <vector>

namespace placegraph {

/// Conditional random field over adjacent superpixels.
///
/// The cost of label l for item i is -log p_i(l), and with each neighbour j, by the share w_ij of
/// their border in the whole border of i,
/// -w_ij (smoothness s_ij [l_i = l_j] + relation_weight T(l_i, l_j)),
/// with s_ij = exp(-|c_i - c_j|^2 / (2 m)), m the mean of the squares, and T the table of relations
/// above, below and beside.
struct LabelField {
  int classes = 0;
  double smoothness = 0, relation_weight = 0;
  RelationTable relations;
};

/// Computes marginals of the field by mean field (ten rounds, all items at once), count x classes.
///
/// `shares`: p_i(l), each > 0 after a floor of 1e-3; `colours`: features with the brightness and
/// colour channels of c_i. Throws ArgumentError if the sizes do not agree.
std::vector<float> field_marginals(const LabelField& field, const std::vector<float>& shares,
                                   const Superpixels& superpixels, const ByteFeatures& colours);

/// Counts of the contacts of classes by pixels of borders, for `relations_of`.
struct RelationCounts {
  explicit RelationCounts(int classes);
  /// Adds an image. `labels`: one class per superpixel, or -1.
  void add(const Superpixels& superpixels, const std::vector<int>& labels);
  RelationTable table() const;

 private:
  int classes_;
  std::vector<double> above_, beside_;
};

}  // namespace placegraph
