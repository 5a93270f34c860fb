#pragma once
#include <placegraph/backend/elimination/front_forest.h>
#include <placegraph/backend/elimination/matrix_pool.h>

namespace placegraph {

/// Assembles a front's matrix from its part of H and the Schur complements of its children.
/// `pool` provides the memory. `damping`: share of the mean of a variable's own diagonal that is
/// added to it.
template <int D>
void assemble(FrontForest<D>& forest, typename FrontForest<D>::Front& front, double damping,
              MatrixPool& pool);

/// Updates a front's part of L y = -g; its matrix is factorized and its children are up to date.
template <int D>
void substitute_forward(FrontForest<D>& forest, typename FrontForest<D>::Front& front);

}  // namespace placegraph
