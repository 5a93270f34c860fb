#pragma once
#include <placegraph/backend/georeference/georeference.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// Reads the graph, the visits and the motion of a map.
/// `path` is the output folder of `placegraph run` (graph.g2o, places.json,
/// trajectory_optimized.tum, result.json), its map.db (any file NAME.db), or a pose graph in any
/// form of read_pose_graph. In a folder or a map, every member of a place is a visit, and a map
/// without metric scale becomes a Sim(3) graph. With a pose graph, line i of `times_path`, from 0,
/// is the time of the node with id i. Throws FileError, and ArgumentError if `times_path` is
/// missing or superfluous.
GeoreferenceInput read_georeference_input(const std::string& path, const std::string& times_path);

/// Converts a graph for .g2o.
/// Sim(3) nodes lose their scale, which their edges take over; position constraints are left out.
PoseGraph metric_graph(const PoseGraph& graph);

/// Result of every fix as CSV: stamp_ns, node, residual_{east,north,up}_m,
/// sigma_{horizontal,vertical}_m, weight, rejected.
std::string fixes_csv(const GeoreferenceResult& result, const std::vector<GpsFix>& fixes);

/// Content of georeference.json.
nlohmann::ordered_json describe_georeference(const GeoreferenceResult& result);

}  // namespace placegraph::apps
