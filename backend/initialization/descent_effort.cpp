#include <placegraph/backend/initialization/descent_effort.h>

namespace placegraph {
namespace {

/// Operations per edge (except those that grow with the rank) and per node.
constexpr double kLinearization = 500, kProduct = 200, kNode = 100;

}  // namespace

DescentEffort::DescentEffort(int dim, int nodes, std::size_t edges, const BlockOrdering& ordering)
    : dim_(dim),
      nodes_(nodes),
      edges_(static_cast<double>(edges)),
      factor_operations_(ordering.operations),
      factor_fill_(ordering.fill) {}

double DescentEffort::step(int rank, int products) const {
  return (step_operations(rank) + products * product_operations(rank)) / iteration_operations();
}

double DescentEffort::certificate(int factorizations, int solutions) const {
  return (factorizations * factorization_operations(dim_ + 1) +
          solutions * solution_operations(dim_ + 1)) /
         iteration_operations();
}

double DescentEffort::factorization_operations(int block) const {
  return factor_operations_ * block * block * block;
}

double DescentEffort::solution_operations(int block) const {
  return 2 * factor_fill_ * block * block;
}

/// Operations of one Gauss-Newton iteration on the pose graph.
double DescentEffort::iteration_operations() const {
  const int dof = dim_ * (dim_ + 1) / 2;
  return factorization_operations(dof) + solution_operations(dof) + edges_ * dof * kLinearization;
}

/// Number of coordinates of a node: its rotation on the Stiefel manifold and its translation.
int DescentEffort::lifted_block(int rank) const {
  return dim_ * rank - dim_ * (dim_ + 1) / 2 + rank;
}

/// Operations of a product with the Hessian and one with the preconditioner.
double DescentEffort::product_operations(int rank) const {
  return solution_operations(lifted_block(rank)) + edges_ * (kProduct + 8.0 * rank * dim_) +
         nodes_ * (kNode + 8.0 * rank * rank * dim_);
}

/// Operations of an outer step, without the products.
double DescentEffort::step_operations(int rank) const {
  const int block = lifted_block(rank);
  return factorization_operations(block) + edges_ * (kProduct + 4.0 * rank * block * block) +
         2 * product_operations(rank);
}

}  // namespace placegraph
