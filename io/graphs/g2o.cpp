#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/text/id_format.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/parse_graph.h>
#include <placegraph/io/graphs/pose_graph_builder.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <thread>

namespace placegraph {
namespace {

using Fields = PoseGraphBuilder::Fields;

constexpr double kQuaternionTolerance = 1e-2;
constexpr double kMaxLogScale = 300;
/// Positions of g2o's [rotation, translation, log scale] in our tangent.
constexpr int kSim3Order[] = {3, 4, 5, 0, 1, 2, 6};

SE3 parse_se3(const TextFile& file, const Fields& fields, std::size_t at) {
  double v[7];
  for (std::size_t i = 0; i < 7; ++i) v[i] = file.number(fields[at + i], "pose");
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(std::abs(q.norm() - 1) <= kQuaternionTolerance)) {
    file.fail(fmt::format("the quaternion has length {:.6g}, not 1", q.norm()));
  }
  return {SO3(q), Eigen::Vector3d(v[0], v[1], v[2])};
}

/// Parses two or three numbers; z is 0 if there are two.
Eigen::Vector3d parse_point(const TextFile& file, const Fields& fields, std::size_t at, int dim) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int i = 0; i < dim; ++i)
    point[i] = file.number(fields[at + static_cast<std::size_t>(i)], "position");
  return point;
}

Sim3 parse_sim3(const TextFile& file, const Fields& fields, std::size_t at) {
  Vector7d xi;
  for (int i = 0; i < 7; ++i) xi[kSim3Order[i]] = file.number(fields[at + i], "pose");
  if (!(std::abs(xi[6]) < kMaxLogScale))
    file.fail(fmt::format("the logarithm of the scale is {:.6g}", xi[6]));
  return Sim3::exp(xi);
}

Information parse_sim3_information(const PoseGraphBuilder& builder, const Fields& fields,
                                   std::size_t at) {
  const Information of_file = builder.symmetric(fields, at, 7);
  Information information(7, 7);
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j) information(kSim3Order[i], kSim3Order[j]) = of_file(i, j);
  return information;
}

/// Parses priors, point landmarks and the mounting of sensors; false for any other tag.
bool parse_landmark_line(const TextFile& file, const Fields& fields, PoseGraphBuilder& builder) {
  const std::string_view tag = fields[0];
  LandmarkLines& lines = builder.landmarks();
  if (tag == "PARAMS_SE3OFFSET") {
    builder.require_count(fields, 8);
    lines.add_offset(fields[1], parse_se3(file, fields, 2));
  } else if (tag == "EDGE_SE3_PRIOR") {
    builder.require_count(fields, 30);
    const SE3 T = parse_se3(file, fields, 3);
    builder.require_near(T.translation());
    lines.add_prior(fields[1], T, builder.plausible(builder.symmetric(fields, 10, 6)), fields[2]);
  } else if (tag == "EDGE_PRIOR_SE2") {
    builder.require_count(fields, 10);
    const SE2 T = builder.se2(fields, 2);
    builder.require_near({T.translation().x(), T.translation().y(), 0});
    lines.add_prior(fields[1], T, builder.plausible(builder.symmetric(fields, 5, 3)));
  } else if (tag == "EDGE_PRIOR_SE2_XY") {
    builder.require_count(fields, 6);
    builder.add_position(fields[1], parse_point(file, fields, 2, 2).head<2>(),
                         builder.symmetric(fields, 4, 2));
  } else if (tag == "VERTEX_XY" || tag == "VERTEX_TRACKXYZ") {
    const int dim = tag == "VERTEX_XY" ? 2 : 3;
    builder.require_count(fields, 1 + static_cast<std::size_t>(dim));
    const Eigen::Vector3d position = parse_point(file, fields, 2, dim);
    builder.require_near(position);
    lines.add_point(fields[1], position, dim == 2);
  } else if (tag == "EDGE_SE2_XY") {
    builder.require_count(fields, 7);
    const Eigen::Vector3d position = parse_point(file, fields, 3, 2);
    builder.require_near(position);
    Information information = Information::Zero(3, 3);
    information.topLeftCorner<2, 2>() = builder.symmetric(fields, 5, 2);
    lines.add_observation(fields[1], fields[2], position, builder.plausible(information), true);
  } else if (tag == "EDGE_SE3_TRACKXYZ") {
    builder.require_count(fields, 12);
    const Eigen::Vector3d position = parse_point(file, fields, 4, 3);
    builder.require_near(position);
    lines.add_observation(fields[1], fields[2], position,
                          builder.plausible(builder.symmetric(fields, 7, 3)), false, fields[3]);
  } else {
    return false;
  }
  return true;
}

void parse_g2o_line(const TextFile& file, const Fields& fields, PoseGraphBuilder& builder) {
  const std::string_view tag = fields[0];
  if (tag == "VERTEX_SE2") {
    builder.require_count_before_stamp(fields, 4);
    builder.add_node(fields[1], builder.se2(fields, 2));
  } else if (tag == "EDGE_SE2") {
    builder.require_count(fields, 11);
    builder.add_edge(fields[1], fields[2], builder.se2(fields, 3), builder.symmetric(fields, 6, 3));
  } else if (tag == "VERTEX_SE3:QUAT") {
    builder.require_count_before_stamp(fields, 8);
    builder.add_node(fields[1], parse_se3(file, fields, 2));
  } else if (tag == "EDGE_SE3:QUAT") {
    builder.require_count(fields, 30);
    builder.add_edge(fields[1], fields[2], parse_se3(file, fields, 3),
                     builder.symmetric(fields, 10, 6));
  } else if (tag == "VERTEX_SIM3:EXPMAP") {
    // g2o writes four camera parameters after the pose.
    builder.require_count(fields, fields.size() == 13 ? 12 : 8);
    builder.add_node(fields[1], parse_sim3(file, fields, 2));
  } else if (tag == "EDGE_SIM3:EXPMAP") {
    builder.require_count(fields, 37);
    builder.add_edge(fields[1], fields[2], parse_sim3(file, fields, 3),
                     parse_sim3_information(builder, fields, 10));
  } else if (tag == "FIX") {
    if (fields.size() < 2) file.fail("FIX: expected an id");
    for (std::size_t i = 1; i < fields.size(); ++i) builder.fix(fields[i]);
  } else if (!parse_landmark_line(file, fields, builder) && !tag.starts_with("PARAMS_")) {
    file.fail(in_quotes(tag) +
              ": unknown tag; known are VERTEX_ and EDGE_ of SE2, SE3:QUAT and SIM3:EXPMAP, "
              "EDGE_PRIOR_SE2, EDGE_PRIOR_SE2_XY, EDGE_SE3_PRIOR, VERTEX_XY, EDGE_SE2_XY, "
              "VERTEX_TRACKXYZ, EDGE_SE3_TRACKXYZ, FIX, PARAMS_*");
  }
}

constexpr const char* kNoCamera =
    " 1 1 0 0";  ///< focal lengths and principal point, as g2o has them by default

using Text = fmt::memory_buffer&;

template <class... Values>
void print(Text out, fmt::format_string<Values...> text, Values&&... values) {
  fmt::vformat_to(std::back_inserter(out), text, fmt::make_format_args(values...));
}

/// The 17 digits that give the same number again; most entries of information are short integers.
void format_number(Text out, double value) {
  constexpr double kShort = 1e6;
  std::array<char, 32> text;
  text[0] = ' ';
  char* const begin = text.data() + 1;
  char* const end = text.data() + text.size();
  const auto whole = static_cast<int>(std::abs(value) < kShort ? value : 0);
  const bool is_whole = whole == value && !(whole == 0 && std::signbit(value));
  const std::to_chars_result done =
      is_whole ? std::to_chars(begin, end, whole)
               : std::to_chars(begin, end, value, std::chars_format::general, 17);
  out.append(text.data(), done.ptr);
}

const char* suffix_of(PoseKind kind) {
  if (kind == PoseKind::kSE2) return "SE2";
  return kind == PoseKind::kSE3 ? "SE3:QUAT" : "SIM3:EXPMAP";
}

void format_pose(Text out, const Pose& pose) {
  if (const SE2* planar = std::get_if<SE2>(&pose)) {
    for (const double v :
         {planar->translation().x(), planar->translation().y(), planar->rotation().angle()}) {
      format_number(out, v);
    }
  } else if (const SE3* T = std::get_if<SE3>(&pose)) {
    for (const double v : T->translation()) format_number(out, v);
    for (const double v : T->rotation().quaternion().coeffs()) format_number(out, v);  // x y z w
  } else {
    const Vector7d xi = std::get<Sim3>(pose).log();
    for (const int i : kSim3Order) format_number(out, xi[i]);
  }
}

void format_edge(Text out, const RelativePoseConstraint& edge) {
  const PoseKind kind = kind_of(edge.T_from_to);
  print(out, "EDGE_{} {} {}", suffix_of(kind), edge.from, edge.to);
  format_pose(out, edge.T_from_to);
  const auto place = [&](int i) { return kind == PoseKind::kSim3 ? kSim3Order[i] : i; };
  for (int row = 0; row < edge.information.rows(); ++row) {
    for (int column = row; column < edge.information.cols(); ++column) {
      format_number(out, edge.information(place(row), place(column)));
    }
  }
  out.push_back('\n');
}

/// The upper triangle of the first `size` rows and columns, and the end of the line.
template <class Matrix>
void format_information(Text out, const Matrix& information, int size) {
  for (int row = 0; row < size; ++row)
    for (int column = row; column < size; ++column) format_number(out, information(row, column));
  out.push_back('\n');
}

void format_point(Text out, const Eigen::Vector3d& point, bool planar) {
  for (int i = 0; i < (planar ? 2 : 3); ++i) format_number(out, point[i]);
}

void format_position(Text out, const PositionConstraint& position, PoseKind kind) {
  require(kind == PoseKind::kSE2 && position.lever_arm.isZero(0),
          "g2o: the format cannot express positions in space or beside a node");
  print(out, "EDGE_PRIOR_SE2_XY {}", position.node);
  format_point(out, position.position_world, true);
  format_information(out, position.information, 2);
}

/// Writes a prior of the node itself: parameters 0 are the identity.
void format_prior(Text out, const PosePriorConstraint& prior) {
  const bool planar = kind_of(prior.T_world_node) == PoseKind::kSE2;
  print(out, "{} {}{}", planar ? "EDGE_PRIOR_SE2" : "EDGE_SE3_PRIOR", prior.node,
        planar ? "" : " 0");
  format_pose(out, prior.T_world_node);
  format_information(out, prior.information, planar ? 3 : 6);
}

void format_observation(Text out, const PointObservation& observation, bool planar) {
  print(out, "{} {} {}{}", planar ? "EDGE_SE2_XY" : "EDGE_SE3_TRACKXYZ", observation.node,
        observation.point, planar ? "" : " 0");
  format_point(out, observation.position_node, planar);
  format_information(out, observation.information, planar ? 2 : 3);
}

/// Appends what `format` writes of every item, in the order of the items but from all threads.
template <class Item, class Format>
void format_all(Text out, const std::vector<Item>& items, const Format& format) {
  constexpr std::size_t kBlock = 4096;
  std::vector<fmt::memory_buffer> blocks((items.size() + kBlock - 1) / kBlock);
  const unsigned threads =
      blocks.size() < 2 ? 1 : std::max(1U, std::thread::hardware_concurrency());
  parallel_for(static_cast<int>(blocks.size()), static_cast<int>(threads), [&](int number) {
    const auto block = static_cast<std::size_t>(number);
    const std::size_t end = std::min(items.size(), (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) format(blocks[block], items[i]);
  });
  for (const fmt::memory_buffer& block : blocks) out.append(block);
}

void format_poses(Text out, const PoseGraph& graph) {
  const PoseKind kind = graph.kind();
  format_all(out, graph.nodes, [kind](Text block, const PoseNode& node) {
    print(block, "VERTEX_{} {}", suffix_of(kind), node.id);
    format_pose(block, node.T_world_node);
    if (kind == PoseKind::kSim3) print(block, kNoCamera);
    block.push_back('\n');
  });
  format_all(out, graph.constraints, [kind](Text block, const Constraint& constraint) {
    if (const auto* edge = std::get_if<RelativePoseConstraint>(&constraint))
      format_edge(block, *edge);
    else
      format_position(block, std::get<PositionConstraint>(constraint), kind);
  });
}

void format_beside_poses(Text out, const LandmarkGraph& graph) {
  const bool planar = graph.poses.kind() == PoseKind::kSE2;
  for (const GraphPoint& point : graph.points) {
    print(out, "{} {}", planar ? "VERTEX_XY" : "VERTEX_TRACKXYZ", point.id);
    format_point(out, point.position_world, planar);
    out.push_back('\n');
  }
  for (const PosePriorConstraint& prior : graph.priors) format_prior(out, prior);
  for (const PointObservation& observation : graph.observations)
    format_observation(out, observation, planar);
}

/// Behind the edges: readers of other programs end at the first line with fewer than two numbers.
template <class Vertices>
void format_fixed(Text out, const Vertices& vertices) {
  for (const auto& vertex : vertices)
    if (vertex.fixed) print(out, "FIX {}\n", vertex.id);
}

void write_text(const std::string& path, const fmt::memory_buffer& text) {
  AtomicFile file(path);
  file.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  file.commit();
}

}  // namespace

PoseGraph parse_g2o(TextFile& file, const PoseGraphReading& reading) {
  return parse_lines(file, parse_g2o_line).finish(reading);
}

PoseGraph read_g2o(const std::string& path, const PoseGraphReading& reading) {
  TextFile file(path);
  return parse_g2o(file, reading);
}

LandmarkGraph parse_g2o_landmarks(TextFile& file, const PoseGraphReading& reading) {
  return parse_lines(file, parse_g2o_line).finish_landmarks(reading);
}

void write_g2o(const std::string& path, const PoseGraph& graph) {
  graph.check();
  fmt::memory_buffer out;
  format_poses(out, graph);
  format_fixed(out, graph.nodes);
  write_text(path, out);
}

void write_g2o(const std::string& path, const LandmarkGraph& graph) {
  graph.check();
  fmt::memory_buffer out;
  if (!graph.has_poses_alone() && graph.poses.kind() == PoseKind::kSE3)
    print(out, "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n");
  format_poses(out, graph.poses);
  format_beside_poses(out, graph);
  format_fixed(out, graph.poses.nodes);
  format_fixed(out, graph.points);
  write_text(path, out);
}

}  // namespace placegraph
