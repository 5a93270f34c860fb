#include <placegraph/eval/plots/pose_graph_plot.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/report/graph_page.h>

#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>

#include <limits>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/page.h>
#include <placegraph/pipeline/report/parts.h>
#include <placegraph/pipeline/report/tables/column.h>
#include <placegraph/pipeline/report/tables/page_thinning.h>

namespace placegraph {
namespace {

using namespace report;
using nlohmann::json;

json positions(const PoseGraph& graph) {
  std::vector<float> column_of_positions;
  for (const PoseNode& node : graph.nodes) {
    const Eigen::Vector3d p = position_of(node.T_world_node);
    for (int i = 0; i < 3; ++i) column_of_positions.push_back(static_cast<float>(p[i]));
  }
  return column(column_of_positions, 3);
}

json describe_graph(const GraphPage& page) {
  const NodeIndex index = page.after.index_by_id();
  std::vector<std::int32_t> ends;
  std::vector<std::string> kind;
  std::vector<float> chi2, weight;
  std::vector<char> rejected(page.after.constraints.size());
  for (const int i : page.rejected) rejected[static_cast<std::size_t>(i)] = 1;
  for (std::size_t i = 0; i < page.after.constraints.size(); ++i) {
    const auto* edge = std::get_if<RelativePoseConstraint>(&page.after.constraints[i]);
    if (!edge) continue;  // one on the position of a single node
    ends.push_back(static_cast<std::int32_t>(index.at(edge->from)));
    ends.push_back(static_cast<std::int32_t>(index.at(edge->to)));
    kind.emplace_back(rejected[i] ? "rejected" : to_string(edge->source));
    chi2.push_back(i < page.chi2.size() ? static_cast<float>(page.chi2[i])
                                        : std::numeric_limits<float>::quiet_NaN());
    weight.push_back(rejected[i] ? 0.0f : 1.0f);
  }
  json figures = json::array();
  for (const auto& [name, value] : page.figures)
    figures.push_back({{"name", name}, {"value", value}, {"unit", ""}, {"protocol", ""}});
  return {{"name", page.name},
          {"before", positions(page.before)},
          {"after", positions(page.after)},
          {"edges", column(ends, 2)},
          {"edge_kind", text_column(kind)},
          {"chi2", column(chi2)},
          {"weight", column(weight)},
          {"figures", figures}};
}

}  // namespace

std::string graph_picture(const PoseGraph& before, const PoseGraph& after,
                          const std::vector<int>& rejected, const std::string& title,
                          const std::vector<std::string>& notes) {
  Plot plot = plot_of(before, after, rejected);
  plot.title = title;
  plot.notes = notes;
  return to_svg(plot);
}

std::string graph_picture(const PoseGraph& graph, const std::vector<int>& rejected,
                          const std::string& title) {
  Plot plot = plot_of(graph, graph, rejected);
  plot.curves.erase(plot.curves.begin());
  plot.curves.front().name = "poses";
  plot.title = title;
  return to_svg(plot);
}

std::string graph_page(const GraphPage& graph, const std::string& program) {
  nlohmann::json report = bare_report(program, graph.name);
  report["graphs"].push_back(describe_graph(graph));
  thin_report(report);
  return page_with(report);
}

void write_graph_page(const std::string& file, const GraphPage& graph, const std::string& program) {
  write_file(file, graph_page(graph, program));
}

}  // namespace placegraph
