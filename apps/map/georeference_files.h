#pragma once
#include <placegraph/backend/georeference/georeference.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// Graph, visits and motion from
///  - the output folder of `placegraph run` (graph.g2o, places.json, trajectory_optimized.tum,
///    result.json): every member of a place is a visit; a map without metric scale becomes a Sim(3)
///    graph,
///  - a pose graph in any form read_pose_graph knows; `times_path`: line i, from 0, is the time of
///    the node with id i.
/// Throws FileError, and ArgumentError if `times_path` is missing or superfluous.
GeoreferenceInput read_georeference_input(const std::string& path, const std::string& times_path);

/// A graph that .g2o can hold: Sim(3) nodes lose their scale, which their edges take over;
/// positions are left out.
PoseGraph metric_graph(const PoseGraph& graph);

/// What became of every fix: stamp_ns, node, residual_{east,north,up}_m,
/// sigma_{horizontal,vertical}_m, weight, rejected.
std::string fixes_csv(const GeoreferenceResult& result, const std::vector<GpsFix>& fixes);

/// georeference.json.
nlohmann::ordered_json describe_georeference(const GeoreferenceResult& result);

}  // namespace placegraph::apps
