#pragma once
#include <placegraph/backend/georeference/georeference_report.h>

namespace placegraph {

/// The change of scale from `map` to `optimized`, graphs of the same nodes; nothing unless they are
/// over Sim(3).
/// Components have units of their own: the scale is that of the first one. The mean is that of at
/// most 64 of its nodes at equal distances in their order, and its variance that of the Gaussian at
/// `optimized`, with the correlations of the nodes. Sigma is infinite if the constraints of
/// `optimized` leave directions undetermined.
std::optional<MapScale> map_scale(const PoseGraph& map, const PoseGraph& optimized);

}  // namespace placegraph
