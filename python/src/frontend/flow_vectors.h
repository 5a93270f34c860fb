#pragma once
#include <placegraph/frontend/flow/flow_vector.h>

#include "python/src/frontend/functions.h"

namespace placegraph::python {

/// Displacements of points as Python sees them: columns that are views.
struct FlowVectors {
  std::vector<FlowVector> vectors;
};

/// A view of a member of each item, N x 2 (a vector) or N x 2 x 2 (a symmetric matrix); it keeps
/// the owner of the items alive.
template <class Item, class Member, class Owner>
ReadOnlyArray<double> column_of(const std::vector<Item>& items, Member Item::*member,
                                const Owner& owner) {
  static_assert(sizeof(Item) % sizeof(double) == 0);
  constexpr std::size_t kDimensions = Member::ColsAtCompileTime == 1 ? 2 : 3;
  const std::size_t shape[3] = {items.size(), 2, 2};
  constexpr std::int64_t kStep = sizeof(Item) / sizeof(double);
  const std::int64_t strides[3] = {kStep, 1, 2};
  const double* first = items.empty() ? nullptr : (items.front().*member).data();
  return {first, kDimensions, shape, nb::find(owner), strides};
}

}  // namespace placegraph::python
