#include "apps/graph/optimize_warnings.h"

#include <fmt/format.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>

#include <algorithm>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

/// "3, 5, 7 and 12 more"
std::string some_ids(const std::vector<NodeId>& ids) {
  constexpr std::size_t kMost = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, ids.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", ids[i].value());
  if (ids.size() > kMost) text += fmt::format(" and {} more", ids.size() - kMost);
  return text;
}

}  // namespace

void warn_of_free_directions(const std::string& in, int count,
                             const std::vector<NodeId>& vertices) {
  if (count == 0) return;
  warn(
      fmt::format("{}: the minimum is not unique: the constraints leave {}{} directions free, at "
                  "{} vertices ({}); their information may have been written in another order, or "
                  "has zeros",
                  in, count >= FreeDirections::kMost ? "at least " : "", count, vertices.size(),
                  some_ids(vertices)));
}

void warn_of_parts(const std::string& in, const LandmarkSolution& solution) {
  const std::vector<NodeId>& held = solution.held_vertices;
  if (solution.components < 2 || held.empty()) return;
  warn(fmt::format(
      "{}: the graph falls into {} components, of which {} are constrained to the world by "
      "no prior and no FIX: each keeps a vertex where it is ({})",
      in, solution.components, held.size(), some_ids(held)));
}

}  // namespace placegraph::apps
