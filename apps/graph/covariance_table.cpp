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

}  // namespace

void write_covariances(const std::string& path, const std::string& in, const PoseGraph& graph,
                       RotationError rotation_error) {
  const PoseMarginals marginals(graph, rotation_error);
  if (!marginals.outcome()) throw NoResult(in + ": no covariances: " + marginals.outcome().reason);
  const std::vector<Information> covariances = marginals.covariances();
  CsvText csv;
  add_header(graph.kind(), csv);
  for (std::size_t k = 0; k < covariances.size(); ++k) {
    csv.add(graph.nodes[k].id);
    for (Eigen::Index i = 0; i < covariances[k].rows(); ++i)
      for (Eigen::Index j = i; j < covariances[k].cols(); ++j)
        csv.add(fmt::format("{:.12g}", covariances[k](i, j)));
    csv.end_row();
  }
  write_file(path, csv.text());
}

}  // namespace placegraph::apps
