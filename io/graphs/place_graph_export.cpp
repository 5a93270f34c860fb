#include <fmt/format.h>
#include <placegraph/graph/text/id_format.h>
#include <placegraph/io/graphs/place_graph_export.h>

#include <algorithm>
#include <map>
#include <set>

namespace placegraph {
namespace {

using Buffer = std::back_insert_iterator<fmt::memory_buffer>;

std::string escaped_xml(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      result += c;
  }
  return result;
}

std::string escaped_dot(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) result += c;
  }
  return result;
}

std::string labels_of(const Place& place) {
  return fmt::format("{}", fmt::join(place.labels, ","));
}

double length_between(const PlaceGraph& graph, PlaceId a, PlaceId b) {
  return (graph.find(a)->T_map_place.translation() - graph.find(b)->T_map_place.translation())
      .norm();
}

/// Pairs of places that are connected by loop closures, each once.
std::set<std::pair<PlaceId, PlaceId>> loops_of(const PlaceGraph& graph) {
  std::set<std::pair<PlaceId, PlaceId>> loops;
  for (const RelativePoseConstraint& constraint : graph.constraints)
    if (constraint.source == ConstraintSource::kLoop && constraint.from != constraint.to)
      loops.insert(std::minmax(place_of_node(constraint.from), place_of_node(constraint.to)));
  return loops;
}

struct Attribute {
  const char *of, *name, *type;
};

constexpr Attribute kAttributes[] = {
    {"node", "x", "double"},      {"node", "y", "double"},      {"node", "z", "double"},
    {"node", "qx", "double"},     {"node", "qy", "double"},     {"node", "qz", "double"},
    {"node", "qw", "double"},     {"node", "component", "int"}, {"node", "views", "int"},
    {"node", "labels", "string"}, {"edge", "kind", "string"},   {"edge", "count", "int"},
    {"edge", "length", "double"}};

template <class Value>
void data(Buffer& out, const char* key, const Value& value) {
  fmt::format_to(out, "<data key=\"{}\">{}</data>", key, value);
}

}  // namespace

std::string to_graphml(const PlaceGraph& graph, const std::vector<PlaceTransition>& transitions) {
  fmt::memory_buffer text;
  Buffer out(text);
  fmt::format_to(out,
                 "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                 "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n");
  for (const Attribute& a : kAttributes)
    fmt::format_to(out, " <key id=\"{1}\" for=\"{0}\" attr.name=\"{1}\" attr.type=\"{2}\"/>\n",
                   a.of, a.name, a.type);
  fmt::format_to(out, " <graph id=\"places\" edgedefault=\"directed\">\n");
  for (const Place& place : graph.places) {
    const Eigen::Vector3d& t = place.T_map_place.translation();
    const Eigen::Quaterniond q(place.T_map_place.rotation().matrix());
    fmt::format_to(out, "  <node id=\"{}\">", place.id);
    data(out, "x", t.x()), data(out, "y", t.y()), data(out, "z", t.z());
    data(out, "qx", q.x()), data(out, "qy", q.y()), data(out, "qz", q.z()), data(out, "qw", q.w());
    data(out, "component", place.component);
    data(out, "views", place.members.size());
    data(out, "labels", escaped_xml(labels_of(place)));
    fmt::format_to(out, "</node>\n");
  }
  const auto edge = [&](PlaceId from, PlaceId to, const char* kind, int count) {
    fmt::format_to(out, "  <edge source=\"{}\" target=\"{}\" directed=\"{}\">", from, to,
                   kind == std::string_view("transition"));
    data(out, "kind", kind), data(out, "count", count);
    data(out, "length", length_between(graph, from, to));
    fmt::format_to(out, "</edge>\n");
  };
  for (const PlaceTransition& t : transitions) edge(t.from, t.to, "transition", t.count);
  for (const auto& [from, to] : loops_of(graph)) edge(from, to, "loop", 1);
  fmt::format_to(out, " </graph>\n</graphml>\n");
  return fmt::to_string(text);
}

std::string to_dot(const PlaceGraph& graph, const std::vector<PlaceTransition>& transitions) {
  // Two neighbours are about an inch apart.
  double shortest = 0;
  for (const PlaceTransition& t : transitions) {
    const double length = length_between(graph, t.from, t.to);
    if (length > 0 && (shortest == 0 || length < shortest)) shortest = length;
  }
  const double points_per_unit = shortest > 0 ? 72 / shortest : 72;

  fmt::memory_buffer text;
  Buffer out(text);
  fmt::format_to(out, "digraph places {{\n node [shape=ellipse fontsize=10];\n");
  for (const Place& place : graph.places) {
    const Eigen::Vector3d& t = place.T_map_place.translation();
    std::string label = to_string(place.id);
    if (!place.labels.empty()) label += ": " + labels_of(place);
    fmt::format_to(out, " {} [label=\"{}\" pos=\"{:.2f},{:.2f}\"];\n", place.id, escaped_dot(label),
                   points_per_unit * t.x(), points_per_unit * t.z());
  }
  std::map<std::pair<PlaceId, PlaceId>, int> counts;
  for (const PlaceTransition& t : transitions) counts[{t.from, t.to}] = t.count;
  for (const auto& [ends, count] : counts) {
    const auto back = counts.find({ends.second, ends.first});
    if (back == counts.end())
      fmt::format_to(out, " {} -> {} [label=\"{}\"];\n", ends.first, ends.second, count);
    else if (ends.first < ends.second)
      fmt::format_to(out, " {} -> {} [dir=both label=\"{}, {}\"];\n", ends.first, ends.second,
                     count, back->second);
  }
  for (const auto& [from, to] : loops_of(graph))
    fmt::format_to(out, " {} -> {} [dir=none style=dashed];\n", from, to);
  fmt::format_to(out, "}}\n");
  return fmt::to_string(text);
}

}  // namespace placegraph
