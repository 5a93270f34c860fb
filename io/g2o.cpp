#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/atomic_file.h>
#include <placegraph/io/g2o.h>
#include <placegraph/io/text_file.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <iterator>
#include <unordered_map>

namespace placegraph {
namespace {

using Fields = std::vector<std::string_view>;

constexpr double kQuaternionTolerance = 1e-2;
constexpr double kIndefiniteTolerance = 1e-9;  ///< of the largest eigenvalue, as PoseGraph::check

void require_count(const TextFile& file, const Fields& fields, std::size_t numbers) {
  if (fields.size() == numbers + 1) return;
  file.fail(
      fmt::format("{}: expected {} numbers, found {}", fields[0], numbers, fields.size() - 1));
}

SE2 parse_se2(const TextFile& file, const Fields& fields, std::size_t at) {
  return {file.number(fields[at], "x"), file.number(fields[at + 1], "y"),
          file.number(fields[at + 2], "theta")};
}

SE3 parse_se3(const TextFile& file, const Fields& fields, std::size_t at) {
  double v[7];
  for (std::size_t i = 0; i < 7; ++i) v[i] = file.number(fields[at + i], "pose");
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(std::abs(q.norm() - 1) <= kQuaternionTolerance)) {
    file.fail(fmt::format("the quaternion has length {:.6g}, not 1", q.norm()));
  }
  return {SO3(q), Eigen::Vector3d(v[0], v[1], v[2])};
}

void require_semidefinite(const TextFile& file, const Information& information) {
  if (information.isZero(0)) file.fail("the information is all zero");
  const Eigen::LLT<Information> cholesky(information);
  if (cholesky.info() == Eigen::Success) return;
  const Eigen::SelfAdjointEigenSolver<Information> eigen(information, Eigen::EigenvaluesOnly);
  const double min = eigen.eigenvalues().minCoeff(), max = eigen.eigenvalues().maxCoeff();
  if (min < -kIndefiniteTolerance * max || max <= 0) {
    file.fail(
        fmt::format("the information is indefinite (eigenvalues {:.3g} to {:.3g})", min, max));
  }
}

Information parse_information(const TextFile& file, const Fields& fields, std::size_t at, int n) {
  Information information(n, n);
  for (int row = 0; row < n; ++row) {
    for (int column = row; column < n; ++column) {
      information(row, column) = information(column, row) =
          file.number(fields[at++], "information");
    }
  }
  require_semidefinite(file, information);
  return information;
}

/// Fills a graph line by line; edges may precede their vertices, so ids are checked at the end.
class Parser {
 public:
  explicit Parser(const std::string& path) : file_(path) {}

  PoseGraph parse() {
    std::string_view line;
    Fields fields;
    while (file_.next_data(line)) {
      split_blank(line, fields);
      parse_line(fields);
    }
    if (graph_.nodes.empty()) throw FileError(file_.path(), "holds no vertices");
    check_ids();
    return std::move(graph_);
  }

 private:
  void parse_line(const Fields& fields) {
    const std::string_view tag = fields[0];
    if (tag == "VERTEX_SE2") {
      require_count(file_, fields, 4);
      add_node(fields, parse_se2(file_, fields, 2));
    } else if (tag == "VERTEX_SE3:QUAT") {
      require_count(file_, fields, 8);
      add_node(fields, parse_se3(file_, fields, 2));
    } else if (tag == "EDGE_SE2") {
      require_count(file_, fields, 11);
      add_edge(fields, parse_se2(file_, fields, 3), parse_information(file_, fields, 6, 3));
    } else if (tag == "EDGE_SE3:QUAT") {
      require_count(file_, fields, 30);
      add_edge(fields, parse_se3(file_, fields, 3), parse_information(file_, fields, 10, 6));
    } else if (tag == "FIX") {
      if (fields.size() < 2) file_.fail("FIX: expected an id");
      for (std::size_t i = 1; i < fields.size(); ++i) {
        fixed_.emplace_back(file_.integer(fields[i], "id"), file_.line());
      }
    } else if (!tag.starts_with("PARAMS_")) {
      file_.fail(in_quotes(tag) +
                 ": unknown tag; known are VERTEX_SE2, EDGE_SE2, VERTEX_SE3:QUAT, EDGE_SE3:QUAT, "
                 "FIX, PARAMS_*");
    }
  }

  void require_kind(PoseKind kind) {
    if (!kind_) kind_ = kind;
    if (*kind_ != kind) file_.fail("SE2 and SE3 are mixed in one graph");
  }

  void add_node(const Fields& fields, const Pose& T_world_node) {
    require_kind(kind_of(T_world_node));
    const std::int64_t id = file_.integer(fields[1], "id");
    if (!index_.emplace(id, graph_.nodes.size()).second) {
      file_.fail(fmt::format("vertex {} is there twice", id));
    }
    graph_.nodes.push_back({id, T_world_node, false});
  }

  void add_edge(const Fields& fields, const Pose& T_from_to, const Information& information) {
    require_kind(kind_of(T_from_to));
    RelativePoseConstraint edge;
    edge.from = file_.integer(fields[1], "id");
    edge.to = file_.integer(fields[2], "id");
    if (edge.from == edge.to) file_.fail(fmt::format("an edge from {} to itself", edge.from));
    edge.T_from_to = T_from_to;
    edge.information = information;
    const std::int64_t low = std::min(edge.from, edge.to), high = std::max(edge.from, edge.to);
    edge.source = low + 1 == high ? ConstraintSource::kOdometry : ConstraintSource::kLoop;
    graph_.constraints.emplace_back(std::move(edge));
    edge_lines_.push_back(file_.line());
  }

  std::size_t find(std::int64_t id, int line) const {
    const auto found = index_.find(id);
    if (found != index_.end()) return found->second;
    throw FileError(file_.path(), line, fmt::format("there is no vertex {}", id));
  }

  void check_ids() {
    for (std::size_t i = 0; i < graph_.constraints.size(); ++i) {
      const auto& edge = std::get<RelativePoseConstraint>(graph_.constraints[i]);
      find(edge.from, edge_lines_[i]);
      find(edge.to, edge_lines_[i]);
    }
    for (const auto& [id, line] : fixed_) graph_.nodes[find(id, line)].fixed = true;
  }

  TextFile file_;
  PoseGraph graph_;
  std::optional<PoseKind> kind_;
  std::unordered_map<std::int64_t, std::size_t> index_;
  std::vector<int> edge_lines_;
  std::vector<std::pair<std::int64_t, int>> fixed_;
};

using Buffer = std::back_insert_iterator<fmt::memory_buffer>;

void format_number(Buffer out, double value) { fmt::format_to(out, " {:.17g}", value); }

void format_pose(Buffer out, const Pose& pose) {
  if (const SE2* T = std::get_if<SE2>(&pose)) {
    for (const double v : {T->translation().x(), T->translation().y(), T->rotation().angle()}) {
      format_number(out, v);
    }
    return;
  }
  const SE3& T = std::get<SE3>(pose);
  for (const double v : T.translation()) format_number(out, v);
  for (const double v : T.rotation().quaternion().coeffs()) format_number(out, v);  // x y z w
}

void format_edge(Buffer out, const RelativePoseConstraint& edge) {
  const bool planar = kind_of(edge.T_from_to) == PoseKind::kSE2;
  fmt::format_to(out, "{} {} {}", planar ? "EDGE_SE2" : "EDGE_SE3:QUAT", edge.from, edge.to);
  format_pose(out, edge.T_from_to);
  for (int row = 0; row < edge.information.rows(); ++row) {
    for (int column = row; column < edge.information.cols(); ++column) {
      format_number(out, edge.information(row, column));
    }
  }
  fmt::format_to(out, "\n");
}

}  // namespace

PoseGraph read_g2o(const std::string& path) { return Parser(path).parse(); }

void write_g2o(const std::string& path, const PoseGraph& graph) {
  graph.check();
  require(graph.kind() != PoseKind::kSim3, "g2o: there is no text form for Sim3 nodes");
  fmt::memory_buffer text;
  const Buffer out = std::back_inserter(text);
  const char* tag = graph.kind() == PoseKind::kSE2 ? "VERTEX_SE2" : "VERTEX_SE3:QUAT";
  for (const PoseNode& node : graph.nodes) {
    fmt::format_to(out, "{} {}", tag, node.id);
    format_pose(out, node.T_world_node);
    fmt::format_to(out, "\n");
  }
  for (const PoseNode& node : graph.nodes) {
    if (node.fixed) fmt::format_to(out, "FIX {}\n", node.id);
  }
  for (const Constraint& constraint : graph.constraints) {
    const auto* edge = std::get_if<RelativePoseConstraint>(&constraint);
    require(edge != nullptr, "g2o: there is no text form for position constraints");
    format_edge(out, *edge);
  }
  AtomicFile file(path);
  file.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  file.commit();
}

}  // namespace placegraph
