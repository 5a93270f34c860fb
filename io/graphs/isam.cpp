#include <placegraph/io/graphs/euler_angles.h>
#include <placegraph/io/graphs/isam.h>
#include <placegraph/io/graphs/parse_graph.h>
#include <placegraph/io/graphs/pose_graph_builder.h>

namespace placegraph {
namespace {

using Fields = PoseGraphBuilder::Fields;

/// Omega = R^T R.
Information information_of_root(const TextFile& file, const PoseGraphBuilder& builder,
                                const Fields& fields, std::size_t at, int n) {
  const Information R = builder.upper_triangle(fields, at, n);
  if ((R.diagonal().array() == 0).any())
    file.fail("the root of the information has a zero on its diagonal: a direction has no weight");
  return R.transpose() * R;
}

void parse_isam_line(const TextFile& file, const Fields& fields, PoseGraphBuilder& builder) {
  const std::string_view tag = fields[0];
  if (tag == "ODOMETRY" || tag == "EDGE2") {
    builder.require_count(fields, 11);
    std::optional<ConstraintSource> source;
    if (tag == "ODOMETRY") source = ConstraintSource::kOdometry;
    builder.add_edge(fields[1], fields[2], builder.se2(fields, 3),
                     information_of_root(file, builder, fields, 6, 3), source);
  } else if (tag == "EDGE3") {
    builder.require_count(fields, 29);
    builder.add_edge(fields[1], fields[2], parse_euler_pose(file, fields, 3),
                     information_of_root(file, builder, fields, 9, 6));
  } else if (tag == "LANDMARK" || tag == "POINT3") {
    file.fail(std::string(tag) + ": a pose graph has no landmarks");
  } else {
    file.fail(in_quotes(tag) + ": unknown tag; known in iSAM's form are ODOMETRY, EDGE2 and EDGE3");
  }
}

}  // namespace

PoseGraph parse_isam(TextFile& file, const PoseGraphReading& reading) {
  return parse_lines(file, parse_isam_line).finish(reading);
}

PoseGraph read_isam(const std::string& path, const PoseGraphReading& reading) {
  TextFile file(path);
  return parse_isam(file, reading);
}

}  // namespace placegraph
