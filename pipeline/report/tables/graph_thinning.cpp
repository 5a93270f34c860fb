#include <placegraph/pipeline/report/tables/graph_thinning.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <unordered_map>
#include <vector>

#include <placegraph/pipeline/report/tables/column.h>
#include <placegraph/pipeline/report/tables/row_thinning.h>

namespace placegraph::report {
namespace {

using nlohmann::json;
using EdgeRows = std::vector<std::size_t>;

/// An edge between rows of nodes.
struct GraphEdge {
  std::size_t from = 0, to = 0;
  int kind = 0;
  float chi2 = 0;
};

/// Which nodes and edges are kept.
struct KeptGraph {
  EdgeRows nodes, edges;
  std::vector<std::size_t> position;  ///< of each node, that of the kept one that stands for it
};

KeptGraph kept_graph(std::size_t nodes, const std::vector<RowSeries>& series,
                     const std::vector<GraphEdge>& edges, std::size_t most) {
  KeptGraph kept;
  std::vector<char> wanted(nodes);
  for (const GraphEdge& edge : edges)
    if (edge.to != edge.from + 1) wanted[edge.from] = wanted[edge.to] = 1;
  EdgeRows ends;
  for (std::size_t i = 0; i < nodes; ++i)
    if (wanted[i]) ends.push_back(i);
  kept.nodes = chosen_rows(nodes, series, ends, most);
  for (std::size_t i = 0, next = 0; i < nodes; ++i) {
    if (next < kept.nodes.size() && kept.nodes[next] == i) ++next;
    kept.position.push_back(next - 1);
  }
  std::map<std::tuple<std::size_t, std::size_t, int>, std::size_t> best;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::size_t from = kept.position[edges[i].from], to = kept.position[edges[i].to];
    if (from == to) continue;
    const auto [found, added] = best.try_emplace({from, to, edges[i].kind}, i);
    if (!added && edges[i].chi2 > edges[found->second].chi2) found->second = i;
  }
  EdgeRows chain, others;
  for (const auto& [key, row] : best)
    (std::get<1>(key) == std::get<0>(key) + 1 ? chain : others).push_back(row);
  // The largest errors first; a stable order keeps those of the same error in their place.
  std::ranges::stable_sort(others, std::greater(), [&](std::size_t i) { return edges[i].chi2; });
  if (others.size() > 2 * most) others.resize(2 * most);
  kept.edges = std::move(chain);
  kept.edges.insert(kept.edges.end(), others.begin(), others.end());
  std::ranges::sort(kept.edges);
  return kept;
}

/// Fewer nodes until `put`, which gives a smaller table, has so few bytes.
template <class Put>
void fit_nodes(std::size_t nodes, std::size_t bytes, std::size_t most_bytes, const Put& put) {
  auto most = static_cast<std::size_t>(
      static_cast<double>(nodes) * static_cast<double>(most_bytes) / static_cast<double>(bytes));
  most = std::max<std::size_t>(std::min(nodes, 2 * most), 2);
  while (put(most) > most_bytes && most > 2) most -= std::max<std::size_t>(most / 10, 1);
}

std::vector<int> kinds_of(const json& labels) {
  std::vector<int> kinds;
  for (const float value : values_of(labels["index"])) kinds.push_back(static_cast<int>(value));
  return kinds;
}

}  // namespace

void thin_places(json& run, std::size_t most_bytes) {
  const json places = run["places"], constraints = run["constraints"];
  const std::vector<float> id = values_of(places["id"]), from = values_of(constraints["from"]),
                           to = values_of(constraints["to"]);
  const std::vector<int> kinds = kinds_of(constraints["source"]);
  std::unordered_map<float, std::size_t> row_of;
  for (std::size_t i = 0; i < id.size(); ++i) row_of[id[i]] = i;
  std::vector<GraphEdge> edges;
  for (std::size_t i = 0; i < from.size(); ++i)
    edges.push_back({row_of.at(from[i]), row_of.at(to[i]), kinds[i], 0});
  const std::vector<RowSeries> series = {{values_of(places["position"]), 3, 3},
                                         {values_of(places["component"]), 1, 1}};
  fit_nodes(
      id.size(), page_bytes(places) + page_bytes(constraints), most_bytes, [&](std::size_t most) {
        const KeptGraph kept = kept_graph(id.size(), series, edges, most);
        std::vector<std::int32_t> a, b;
        for (const std::size_t i : kept.edges) {
          a.push_back(static_cast<std::int32_t>(id[kept.nodes[kept.position[edges[i].from]]]));
          b.push_back(static_cast<std::int32_t>(id[kept.nodes[kept.position[edges[i].to]]]));
        }
        for (const auto& [name, values] : places.items())
          run["places"][name] = rows_of_column(values, kept.nodes);
        run["constraints"] = {{"from", column(a)},
                              {"to", column(b)},
                              {"source", rows_of_column(constraints["source"], kept.edges)}};
        return page_bytes(run["places"]) + page_bytes(run["constraints"]);
      });
  run["notes"].push_back(
      fmt::format("this page has {} of {} places; those left out are joined with "
                  "the one before",
                  rows_of(run["places"]["id"]), id.size()));
}

void thin_graph(json& graph, std::size_t most_bytes) {
  const json all = graph;
  const std::size_t nodes = rows_of(all["before"]);
  const std::vector<float> ends = values_of(all["edges"]), chi2 = values_of(all["chi2"]);
  const std::vector<int> kinds = kinds_of(all["edge_kind"]);
  std::vector<GraphEdge> edges;
  std::vector<float> largest(nodes, 0);  // chi2 of the edges of each node
  for (std::size_t i = 0; 2 * i < ends.size(); ++i) {
    const float error = std::isfinite(chi2[i]) ? chi2[i] : 0;
    edges.push_back({static_cast<std::size_t>(ends[2 * i]),
                     static_cast<std::size_t>(ends[2 * i + 1]), kinds[i], error});
    largest[edges[i].to] = std::max(largest[edges[i].to], error);
  }
  const std::vector<RowSeries> series = {
      {values_of(all["before"]), 3, 3}, {values_of(all["after"]), 3, 3}, {largest, 1, 1}};
  fit_nodes(nodes, page_bytes(all), most_bytes, [&](std::size_t most) {
    const KeptGraph kept = kept_graph(nodes, series, edges, most);
    std::vector<std::int32_t> positions;
    for (const std::size_t i : kept.edges)
      for (const std::size_t end : {edges[i].from, edges[i].to})
        positions.push_back(static_cast<std::int32_t>(kept.position[end]));
    graph["edges"] = column(positions, 2);
    graph["ends"] = rows_of_column(all["edges"], kept.edges);
    for (const char* name : {"before", "after"})
      graph[name] = rows_of_column(all[name], kept.nodes);
    for (const char* name : {"edge_kind", "chi2", "weight"})
      graph[name] = rows_of_column(all[name], kept.edges);
    return page_bytes(graph) - page_bytes(graph["figures"]);
  });
  graph["all"] = {{"nodes", nodes}, {"edges", edges.size()}};
}

}  // namespace placegraph::report
