#include "apps/graph/covariance_table.h"

#include <fmt/format.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/graph/text/csv_text.h>

#include <vector>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

/// Names of the coordinates of the tangent: translation, rotation, log scale.
std::vector<std::string> names_of_coordinates(PoseKind kind) {
  if (kind == PoseKind::kSE2) return {"x", "y", "angle"};
  std::vector<std::string> names = {"x", "y", "z", "rx", "ry", "rz"};
  if (kind == PoseKind::kSim3) names.emplace_back("log_scale");
  return names;
}

void add_header(PoseKind kind, CsvText& csv) {
  const std::vector<std::string> names = names_of_coordinates(kind);
  csv.add("node");
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = i; j < names.size(); ++j) csv.add(names[i] + ":" + names[j]);
  csv.end_row();
}

/// The upper triangle of a matrix in the columns of one with `width` rows; the others stay empty.
void add_row(NodeId id, const Information& covariance, Eigen::Index width, CsvText& csv) {
  csv.add(id);
  for (Eigen::Index i = 0; i < width; ++i)
    for (Eigen::Index j = i; j < width; ++j)
      csv.add(j < covariance.cols() ? fmt::format("{:.12g}", covariance(i, j)) : "");
  csv.end_row();
}

void write_table(const std::string& path, const std::string& in, const PoseGraph& graph,
                 const std::vector<GraphPoint>& points, const PoseMarginals& marginals) {
  if (!marginals.outcome()) throw NoResult(in + ": no covariances: " + marginals.outcome().reason);
  const Eigen::Index width = degrees_of_freedom(graph.kind());
  CsvText csv;
  add_header(graph.kind(), csv);
  const std::vector<Information> of_nodes = marginals.covariances();
  for (std::size_t k = 0; k < of_nodes.size(); ++k)
    add_row(graph.nodes[k].id, of_nodes[k], width, csv);
  if (!points.empty()) {
    const std::vector<Information> of_points = marginals.point_covariances();
    for (std::size_t k = 0; k < of_points.size(); ++k)
      add_row(points[k].id, of_points[k], width, csv);
  }
  write_file(path, csv.text());
}

}  // namespace

void write_covariances(const std::string& path, const std::string& in, const PoseGraph& graph,
                       RotationError rotation_error) {
  write_table(path, in, graph, {}, PoseMarginals(graph, rotation_error));
}

void write_covariances(const std::string& path, const std::string& in, const LandmarkGraph& graph,
                       RotationError rotation_error) {
  write_table(path, in, graph.poses, graph.points, PoseMarginals(graph, rotation_error));
}

}  // namespace placegraph::apps
