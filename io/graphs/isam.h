#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>
#include <placegraph/io/graphs/pose_graph_file.h>

#include <string>

namespace placegraph {

/// Reads a pose graph in the text format of iSAM (Kaess et al., its example data): edges alone,
///
///   ODOMETRY from to x y theta r_11 r_12 r_13 r_22 r_23 r_33
///   EDGE2    the same, for loops
///   EDGE3 from to x y z roll pitch yaw r_11 r_12 .. r_16 r_22 .. r_66
///
/// with T_from_to and the upper-triangular square root R of the information, Omega = R^T R, over
/// the six or three values in their order in the line. Lengths [m], angles [rad]; R = R_z(yaw)
/// R_y(pitch) R_x(roll). As in the TORO format, the information of EDGE3 is used unchanged for our
/// tangent and belongs to RotationError::kLog. The vertices are those that the edges name, by
/// ascending id, their poses chained along odometry (then loops) from the origin. ODOMETRY lines
/// and edges between consecutive ids count as odometry, the others as loops. LANDMARK and POINT3
/// lines are an error, because a pose graph has no landmarks; so is every other tag. Errors as
/// read_g2o.
PoseGraph read_isam(const std::string& path, const PoseGraphReading& reading = {});

}  // namespace placegraph
