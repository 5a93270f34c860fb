#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>

namespace placegraph {

/// Fails if the observations of a pose leave its rotation open: `information` is that of its right
/// tangent, and its standard deviation must be below `most_sigma_deg`.
///
/// Few points in a small part of the image agree with a rotation that is wrong by several degrees,
/// and new points would get their depths by it.
[[nodiscard]] Outcome determines_rotation(const Matrix6d& information, double most_sigma_deg);

}  // namespace placegraph
