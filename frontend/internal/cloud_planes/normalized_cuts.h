#pragma once
#include <optional>
#include <vector>

namespace placegraph {

/// How alike two nodes of a graph are.
struct Affinity {
  int a = 0, b = 0;   ///< a != b
  double weight = 0;  ///< > 0
};

/// A graph in two.
struct NormalizedCut {
  std::vector<bool> second;  ///< side of each node
  double value = 0;          ///< cut / assoc(A, V) + cut / assoc(B, V), 0 to 2
};

/// The best normalized cut (Shi & Malik 2000) of a connected graph of `nodes` >= 2: the eigenvector
/// of the second smallest eigenvalue of (D - W) y = lambda D y, by Lanczos iterations on the
/// symmetric form (Spectra), cut at the best of all its levels. Nothing where the iterations give
/// no vector. Throws ArgumentError for nodes that are not there.
std::optional<NormalizedCut> normalized_cut(int nodes, const std::vector<Affinity>& affinities);

}  // namespace placegraph
