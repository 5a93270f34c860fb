#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/graph/text/id_format.h>
#include <placegraph/io/graphs/pose_graph_builder.h>
#include <placegraph/io/graphs/printed_rounding.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace placegraph {
namespace {

/// Limits that keep the products and squares in solvers finite.
constexpr double kMaxInformation = 1e100, kMaxDistance_m = 1e50;

RelativePoseConstraint& edge_of(Constraint& constraint) {
  return std::get<RelativePoseConstraint>(constraint);
}

Pose identity_of(PoseKind kind) {
  if (kind == PoseKind::kSE2) return SE2();
  if (kind == PoseKind::kSE3) return SE3();
  return Sim3();
}

}  // namespace

PoseGraphBuilder::PoseGraphBuilder(const TextFile& file) : file_(&file), landmarks_(file) {}

void PoseGraphBuilder::require_count(const Fields& fields, std::size_t count) const {
  if (fields.size() == count + 1) return;
  file_->fail(
      fmt::format("{}: expected {} numbers, found {}", fields[0], count, fields.size() - 1));
}

void PoseGraphBuilder::require_count_before_stamp(const Fields& fields, std::size_t count) {
  if (fields.size() != count + 2 || unstamped_ > 0) {
    if (stamped_ > 0) require_count(fields, count + 1);
    require_count(fields, count);
    ++unstamped_;
    return;
  }
  const std::optional<double> stamp = parse_double(fields.back());
  if (!stamp || !std::isfinite(*stamp) || (stamped_ > 0 && *stamp <= last_stamp_))
    file_->fail(
        fmt::format("{}: expected {} numbers, found {}, the last of which does not increase from "
                    "line to line as a "
                    "time stamp would",
                    fields[0], count, count + 1));
  if (stamped_++ == 0) first_stamp_line_ = file_->line();
  last_stamp_ = *stamp;
}

void PoseGraphBuilder::report_stamps(const PoseGraphReading& reading) const {
  constexpr int kFewest = 3;  // to recognize an increase
  if (stamped_ == 0) return;
  if (stamped_ < kFewest || !reading.remarks)
    throw FileError(file_->path(), first_stamp_line_, "a number too many for a vertex");
  reading.remarks->push_back(fmt::format(
      "{} vertices have one more number after the pose, which increases from line to line "
      "like a time stamp: it was skipped",
      stamped_));
}

SE2 PoseGraphBuilder::se2(const Fields& fields, std::size_t at) const {
  return {file_->number(fields[at], "x"), file_->number(fields[at + 1], "y"),
          file_->number(fields[at + 2], "theta")};
}

Information PoseGraphBuilder::upper_triangle(const Fields& fields, std::size_t at, int n) const {
  Information matrix = Information::Zero(n, n);
  for (int row = 0; row < n; ++row)
    for (int column = row; column < n; ++column)
      matrix(row, column) = file_->number(fields[at++], "information");
  return matrix;
}

Information PoseGraphBuilder::symmetric(const Fields& fields, std::size_t at, int n) const {
  information_fields_ = std::span(fields).subspan(at, static_cast<std::size_t>(n * (n + 1) / 2));
  Information matrix(n, n);
  for (int row = 0; row < n; ++row)
    for (int column = row; column < n; ++column)
      matrix(row, column) = matrix(column, row) = file_->number(fields[at++], "information");
  return matrix;
}

void PoseGraphBuilder::require_kind(PoseKind kind) {
  if (!kind_) kind_ = kind;
  if (*kind_ == kind) return;
  const char* const names[] = {"SE2", "SE3", "Sim3"};
  const int a = static_cast<int>(*kind_), b = static_cast<int>(kind);
  file_->fail(fmt::format("{} and {} are mixed in one graph", names[std::min(a, b)],
                          names[std::max(a, b)]));
}

void PoseGraphBuilder::require_near(const Eigen::Vector3d& position) const {
  if (!(position.cwiseAbs().maxCoeff() <= kMaxDistance_m))
    file_->fail(fmt::format("a position beyond {:g} m", kMaxDistance_m));
}

Information PoseGraphBuilder::plausible(const Information& information) const {
  const std::optional<Information> found = definite(information);
  if (!found) file_->fail("the information is indefinite");
  return *found;
}

std::optional<Information> PoseGraphBuilder::definite(const Information& information) const {
  const auto fields = std::exchange(information_fields_, {});
  const char* fault = fault_of(information);
  if (!fault) {
    if (information.cwiseAbs().maxCoeff() > kMaxInformation)
      file_->fail(fmt::format("the information is above {:g}", kMaxInformation));
    return information;
  }
  double rounding = 0;
  for (const std::string_view field : fields)
    rounding = std::max(rounding, printed_rounding(field));
  const Information nearest = without_rounding(information, rounding);
  const char* remaining = fault_of(nearest);
  if (remaining && remaining == std::string_view("information is indefinite")) return std::nullopt;
  if (remaining) file_->fail(std::string("the ") + remaining);
  return nearest;
}

void PoseGraphBuilder::add_node(std::string_view id, const Pose& T_world_node) {
  require_kind(kind_of(T_world_node));
  require_near(position_of(T_world_node));
  graph_.nodes.push_back({NodeId(file_->integer(id, "id")), T_world_node, false});
  node_lines_.push_back(file_->line());
}

/// Makes room for the next edge, and for those that the file still has if they are as long as the
/// ones read: a graph that doubled its room would touch its memory two and three times.
void PoseGraphBuilder::make_room() {
  constexpr std::size_t kFewEdges = 1000;
  std::vector<Constraint>& edges = graph_.constraints;
  if (edges.empty()) edges_begin_ = file_->position();
  if (edges.size() < kFewEdges || edges.size() < edges.capacity()) return;
  const auto read = static_cast<double>(file_->position() - edges_begin_);
  const auto all = static_cast<double>(file_->size() - edges_begin_);
  const auto expected = static_cast<std::size_t>(all / read * static_cast<double>(edges.size()));
  edges.reserve(expected + kFewEdges);
}

void PoseGraphBuilder::add_edge(std::string_view from, std::string_view to, const Pose& T_from_to,
                                const Information& given, std::optional<ConstraintSource> source) {
  require_kind(kind_of(T_from_to));
  require_near(position_of(T_from_to));
  const std::optional<Information> information = definite(given);
  if (!information) indefinite_.push_back(graph_.constraints.size());
  make_room();
  RelativePoseConstraint& edge =
      graph_.constraints.emplace_back().emplace<RelativePoseConstraint>();
  edge.from = NodeId(file_->integer(from, "id"));
  edge.to = NodeId(file_->integer(to, "id"));
  if (edge.from == edge.to) file_->fail(fmt::format("an edge from {} to itself", edge.from));
  edge.T_from_to = T_from_to;
  edge.information = information.value_or(given);
  const bool consecutive = ++NodeId(std::min(edge.from, edge.to)) == std::max(edge.from, edge.to);
  edge.source =
      source.value_or(consecutive ? ConstraintSource::kOdometry : ConstraintSource::kLoop);
  source_is_given_.push_back(source.has_value());
  edge_lines_.push_back(file_->line());
}

void PoseGraphBuilder::add_position(std::string_view node, const Eigen::Vector2d& position_world,
                                    const Eigen::Matrix2d& information) {
  require_kind(PoseKind::kSE2);
  PositionConstraint position;
  position.node = NodeId(file_->integer(node, "id"));
  position.position_world.head<2>() = position_world;
  Information padded = Information::Zero(3, 3);
  padded.topLeftCorner<2, 2>() = information;
  position.information = plausible(padded);
  require_near(position.position_world);
  positions_.emplace_back(position, file_->line());
}

void PoseGraphBuilder::fix(std::string_view id) {
  fixed_.emplace_back(NodeId(file_->integer(id, "id")), file_->line());
}

int PoseGraphBuilder::find(const NodeIndex& index, NodeId id, int line) const {
  if (const std::optional<int> position = index.find(id)) return *position;
  throw FileError(file_->path(), line, fmt::format("there is no vertex {}", id));
}

void PoseGraphBuilder::require_connected(const PoseGraph& graph) const {
  const std::vector<int> component = graph.components();
  const int count = 1 + *std::max_element(component.begin(), component.end());
  std::vector<char> is_fixed(static_cast<std::size_t>(count), 0);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    if (graph.nodes[i].fixed) is_fixed[static_cast<std::size_t>(component[i])] = 1;
  const NodeIndex index = graph.index_by_id();
  for (const auto& [position, line] : positions_)
    is_fixed[static_cast<std::size_t>(component[index.at(position.node)])] = 1;
  if (count == 1 || std::find(is_fixed.begin(), is_fixed.end(), 0) == is_fixed.end()) return;
  const auto apart = static_cast<std::size_t>(std::find(component.begin(), component.end(), 1) -
                                              component.begin());
  throw FileError(
      file_->path(), node_lines_[apart],
      fmt::format("vertex {} is not connected with vertex {}: the graph falls into {} components; "
                  "--components optimizes each separately, FIX fixes a vertex of each",
                  graph.nodes[apart].id, graph.nodes[0].id, count));
}

void PoseGraphBuilder::find_odometry_by_order() {
  // At most one in so many steps to the next id leads to id + 1.
  constexpr std::size_t kHardly = 10;
  std::vector<NodeId> ids;
  for (const PoseNode& node : graph_.nodes) ids.push_back(node.id);
  std::sort(ids.begin(), ids.end());
  // The positions in `ids` from which an edge leads to the next id.
  std::vector<int> steps;
  std::vector<std::size_t> edges;
  for (std::size_t i = 0; i < graph_.constraints.size(); ++i) {
    if (source_is_given_[i]) continue;
    const RelativePoseConstraint& edge = edge_of(graph_.constraints[i]);
    const auto low = std::lower_bound(ids.begin(), ids.end(), std::min(edge.from, edge.to));
    if (low + 1 == ids.end() || low[1] != std::max(edge.from, edge.to)) continue;
    steps.push_back(static_cast<int>(low - ids.begin()));
    edges.push_back(i);
  }
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  const auto consecutive = std::count_if(steps.begin(), steps.end(),
                                         [&](int k) { return ++NodeId(ids[k]) == ids[k + 1]; });
  // The steps must form a path through at least half of the nodes; too few steps are not evidence.
  if (kHardly * static_cast<std::size_t>(consecutive) > steps.size() ||
      2 * steps.size() + 1 < ids.size() || steps.size() < kHardly)
    return;
  for (const std::size_t i : edges)
    edge_of(graph_.constraints[i]).source = ConstraintSource::kOdometry;
}

PoseGraph PoseGraphBuilder::finish(const PoseGraphReading& reading) {
  if (!landmarks_.empty())
    throw FileError(
        file_->path(), landmarks_.first_line(),
        "the graph has priors or point landmarks, which only optimize and convert accept");
  report_stamps(reading);
  replace_indefinite(reading);
  PoseGraph graph = finish_poses();
  if (reading.connected) require_connected(graph);
  return graph;
}

LandmarkGraph PoseGraphBuilder::finish_landmarks(const PoseGraphReading& reading) {
  if (landmarks_.empty()) return {finish(reading), {}, {}, {}};
  report_stamps(reading);
  replace_indefinite(reading);
  LandmarkGraph graph;
  graph.poses = finish_poses();
  landmarks_.add_to(graph);
  return graph;
}

namespace {

/// The weight of an isotropic block: the harmonic mean of its eigenvalues where all are positive,
/// as in SE-Sync, else the mean of those that are not negative.
double isotropic_weight(const Information& block) {
  const Eigen::SelfAdjointEigenSolver<Information> eigen(block, Eigen::EigenvaluesOnly);
  const auto& values = eigen.eigenvalues();
  const auto count = static_cast<double>(values.size());
  return values.minCoeff() > 0 ? count / values.cwiseInverse().sum()
                               : values.cwiseMax(0).sum() / count;
}

Information isotropic(const Information& information) {
  const Eigen::Index size = information.rows(), dim = size == 3 ? 2 : 3;
  Eigen::VectorXd weights(size);
  weights.head(dim).setConstant(isotropic_weight(information.topLeftCorner(dim, dim)));
  const Eigen::Index rotation = size == 3 ? 1 : 3;
  weights.segment(dim, rotation)
      .setConstant(isotropic_weight(information.block(dim, dim, rotation, rotation)));
  if (size == 7) weights[6] = std::max(0.0, information(6, 6));
  return Information(weights.asDiagonal());
}

}  // namespace

void PoseGraphBuilder::replace_indefinite(const PoseGraphReading& reading) {
  if (indefinite_.empty()) return;
  const std::size_t count = indefinite_.size(), all = graph_.constraints.size();
  const int first = edge_lines_[indefinite_.front()];
  if (reading.indefinite == IndefiniteInformation::kRefuse)
    throw FileError(file_->path(), first,
                    fmt::format("the information is indefinite, as that of {} of {} edges; "
                                "--indefinite nearest, or isotropic, replaces it",
                                count, all));
  const bool nearest = reading.indefinite == IndefiniteInformation::kNearest;
  for (const std::size_t i : indefinite_) {
    Information& information = std::get<RelativePoseConstraint>(graph_.constraints[i]).information;
    information = nearest ? nearest_semidefinite(information) : isotropic(information);
    if (const char* fault = fault_of(information))
      throw FileError(file_->path(), edge_lines_[i], fmt::format("replaced, the {}", fault));
  }
  if (reading.replaced) *reading.replaced = static_cast<int>(count);
  if (reading.remarks)
    reading.remarks->push_back(
        fmt::format("the information of {} of {} edges is indefinite, the first in line {}, and "
                    "replaced by {}",
                    count, all, first,
                    nearest ? "the nearest semi-definite matrix"
                            : "one weight for translation and one for rotation"));
}

PoseGraph PoseGraphBuilder::finish_poses() {
  const bool edges_alone = graph_.nodes.empty();
  if (edges_alone && graph_.constraints.empty())
    throw FileError(file_->path(), "holds no vertices");
  if (edges_alone) add_nodes_of_edges();
  const NodeIndex index = graph_.index_by_id();
  for (std::size_t i = 0; i < graph_.nodes.size(); ++i)
    if (index.find(graph_.nodes[i].id) != static_cast<int>(i))
      throw FileError(file_->path(), node_lines_[i],
                      fmt::format("vertex {} is there twice", graph_.nodes[i].id));
  for (std::size_t i = 0; i < graph_.constraints.size(); ++i) {
    const RelativePoseConstraint& edge = edge_of(graph_.constraints[i]);
    find(index, edge.from, edge_lines_[i]);
    find(index, edge.to, edge_lines_[i]);
  }
  find_odometry_by_order();
  for (const auto& [id, line] : fixed_)
    if (!landmarks_.fix(id)) graph_.nodes[find(index, id, line)].fixed = true;
  for (const auto& [position, line] : positions_) find(index, position.node, line);
  if (edges_alone) integrate_odometry(graph_);
  for (const auto& [position, line] : positions_) graph_.constraints.emplace_back(position);
  return std::move(graph_);
}

void PoseGraphBuilder::add_nodes_of_edges() {
  std::vector<std::pair<NodeId, int>> ids;  // with the line that first names them
  for (std::size_t i = 0; i < graph_.constraints.size(); ++i) {
    const RelativePoseConstraint& edge = edge_of(graph_.constraints[i]);
    ids.emplace_back(edge.from, edge_lines_[i]);
    ids.emplace_back(edge.to, edge_lines_[i]);
  }
  std::sort(ids.begin(), ids.end());
  for (const auto& [id, line] : ids) {
    if (!graph_.nodes.empty() && graph_.nodes.back().id == id) continue;
    graph_.nodes.push_back({id, identity_of(*kind_), false});
    node_lines_.push_back(line);
  }
}

PoseGraphBuilder parse_lines(TextFile& file,
                             void (*parse_line)(const TextFile&, const PoseGraphBuilder::Fields&,
                                                PoseGraphBuilder&)) {
  PoseGraphBuilder builder(file);
  std::string_view line;
  PoseGraphBuilder::Fields fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    parse_line(file, fields, builder);
  }
  return builder;
}

}  // namespace placegraph
