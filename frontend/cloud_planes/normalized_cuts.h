#pragma once
#include <optional>
#include <vector>

namespace placegraph {

/// Similarity of two nodes of a graph.
struct Affinity {
  int a = 0, b = 0;   ///< a != b
  double weight = 0;  ///< > 0
};

/// Division of a graph into two parts.
struct NormalizedCut {
  std::vector<bool> second;  ///< side of each node
  double value = 0;          ///< cut / assoc(A, V) + cut / assoc(B, V), 0 to 2
};

/// The best normalized cut (Shi & Malik 2000) of a connected graph of `nodes` >= 2.
///
/// It uses the eigenvector of the second smallest eigenvalue of (D - W) y = lambda D y, by Lanczos
/// iterations on the symmetric form (Spectra), cut at the best of all its levels. No result if the
/// iterations do not converge. Throws ArgumentError for nodes that do not exist.
std::optional<NormalizedCut> normalized_cut(int nodes, const std::vector<Affinity>& affinities);

}  // namespace placegraph
