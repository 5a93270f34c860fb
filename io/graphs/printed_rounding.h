#pragma once
#include <placegraph/graph/pose_graph/constraint.h>

#include <string_view>
#include <vector>

namespace placegraph {

/// Half a unit of the last printed digit of a number: 0.05 for "100.1", 5 for "1.25e3"; 0 for
/// numbers without a point, which are considered exact.
double printed_rounding(std::string_view number);

/// The nearest positive semi-definite matrix in Frobenius' norm: negative eigenvalues become zero.
Information nearest_semidefinite(const Information& information);

/// The nearest positive semi-definite matrix, if rounding every entry by `rounding` can have made
/// it indefinite and is small against its largest eigenvalue; else the unchanged matrix.
Information without_rounding(const Information& information, double rounding);

}  // namespace placegraph
