// Georeferences a map by GPS fixes and writes it for a map viewer: georeference_map OUT.kml
// The map is odometry around a block with a drift of the heading; the GPS fixes are simulated.
#include <placegraph/backend/georeference/georeference.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/geo_export.h>

#include <cmath>
#include <cstdio>

using namespace placegraph;

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s OUT.kml\n", argv[0]);
    return 2;
  }
  const EnuFrame enu({.latitude_deg = 49.0, .longitude_deg = 8.4, .height_m = 115});
  const SE2 step(2, 0, 0), drifting(2, 0, 0.002), corner(0, 0, M_PI / 2);
  GeoreferenceInput input;
  SE2 T_enu_robot, T_map_robot;
  for (int i = 0; i < 200; ++i) {
    const std::int64_t stamp_ns = i * 1'000'000'000ll;
    const Eigen::Vector2d p = T_enu_robot.translation();
    input.graph.nodes.push_back({NodeId(i), T_map_robot, false});
    input.visits.push_back({stamp_ns, NodeId(i)});
    GpsFix fix;
    fix.stamp_ns = stamp_ns;
    fix.position = enu.to_geodetic({p.x(), p.y(), 0});
    fix.accuracy_m = 0.5;
    input.fixes.push_back(fix);
    const SE2 step_rotation = i % 50 == 49 ? corner : SE2();
    if (i + 1 < 200) {
      RelativePoseConstraint edge;
      edge.from = NodeId(i), edge.to = NodeId(i + 1);
      edge.T_from_to = drifting * step_rotation;
      edge.information = Eigen::Vector3d(400, 400, 1e5).asDiagonal();  // 5 cm and 0.2 degrees
      input.graph.constraints.push_back(edge);
    }
    T_enu_robot = T_enu_robot * step * step_rotation;
    T_map_robot = T_map_robot * drifting * step_rotation;
  }
  const GeoreferenceResult result = georeference(input, {});
  if (!result.outcome) {
    std::fprintf(stderr, "no position: %s\n", result.outcome.reason.c_str());
    return 1;
  }
  write_kml(argv[1], {"block", result.origin, result.trajectory, result.graph, {}});
  std::printf("origin %.4f N %.4f E, fixes off by %.3f m\n", result.origin.latitude_deg,
              result.origin.longitude_deg, result.residual_rms_m);
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
