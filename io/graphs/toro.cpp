#include <placegraph/io/graphs/euler_angles.h>
#include <placegraph/io/graphs/parse_graph.h>
#include <placegraph/io/graphs/pose_graph_builder.h>
#include <placegraph/io/graphs/toro.h>

namespace placegraph {
namespace {

using Fields = PoseGraphBuilder::Fields;

/// I_ff I_fs I_ss I_rr I_fr I_sr -> over [x y theta].
Information planar_information(const TextFile& file, const Fields& fields, std::size_t at) {
  double v[6];
  for (std::size_t i = 0; i < 6; ++i) v[i] = file.number(fields[at + i], "information");
  Eigen::Matrix3d information;
  information << v[0], v[1], v[4],  //
      v[1], v[2], v[5],             //
      v[4], v[5], v[3];
  return Information(information);
}

void parse_toro_line(const TextFile& file, const Fields& fields, PoseGraphBuilder& builder) {
  const std::string_view tag = fields[0];
  if (tag == "VERTEX2") {
    builder.require_count(fields, 4);
    builder.add_node(fields[1], builder.se2(fields, 2));
  } else if (tag == "EDGE2") {
    builder.require_count(fields, 11);
    builder.add_edge(fields[1], fields[2], builder.se2(fields, 3),
                     planar_information(file, fields, 6));
  } else if (tag == "VERTEX3") {
    builder.require_count(fields, 7);
    builder.add_node(fields[1], parse_euler_pose(file, fields, 2));
  } else if (tag == "EDGE3") {
    builder.require_count(fields, 29);
    builder.add_edge(fields[1], fields[2], parse_euler_pose(file, fields, 3),
                     builder.symmetric(fields, 9, 6));
  } else {
    file.fail(in_quotes(tag) +
              ": unknown tag; known in TORO's form are VERTEX2, EDGE2, VERTEX3, "
              "EDGE3");
  }
}

}  // namespace

PoseGraph parse_toro(TextFile& file, const PoseGraphReading& reading) {
  return parse_lines(file, parse_toro_line).finish(reading);
}

PoseGraph read_toro(const std::string& path, const PoseGraphReading& reading) {
  TextFile file(path);
  return parse_toro(file, reading);
}

}  // namespace placegraph
