#include "apps/graph/covariance_table.h"

#include <fmt/format.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/graph/internal/core/id_format.h>
#include <placegraph/io/internal/files/atomic_file.h>

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

std::string header_of(PoseKind kind) {
  const std::vector<std::string> names = names_of_coordinates(kind);
  std::string line = "node";
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = i; j < names.size(); ++j)
      line += fmt::format(",{}:{}", names[i], names[j]);
  return line + "\n";
}

}  // namespace

void write_covariances(const std::string& path, const std::string& in, const PoseGraph& graph,
                       RotationError rotation_error) {
  const PoseMarginals marginals(graph, rotation_error);
  if (!marginals.outcome()) throw NoResult(in + ": no covariances: " + marginals.outcome().reason);
  const std::vector<Information> covariances = marginals.covariances();
  std::string text = header_of(graph.kind());
  for (std::size_t k = 0; k < covariances.size(); ++k) {
    text += fmt::format("{}", graph.nodes[k].id);
    for (Eigen::Index i = 0; i < covariances[k].rows(); ++i)
      for (Eigen::Index j = i; j < covariances[k].cols(); ++j)
        text += fmt::format(",{:.12g}", covariances[k](i, j));
    text += "\n";
  }
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

}  // namespace placegraph::apps
