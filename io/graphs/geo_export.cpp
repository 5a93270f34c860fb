#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/graph/text/id_format.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/graphs/geo_export.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_map>

namespace placegraph {
namespace {

using Buffer = std::back_insert_iterator<fmt::memory_buffer>;
using Line = std::vector<GeodeticPosition>;

/// Cuts a line where two neighbours are on both sides of the 180th meridian; both ends of a cut are
/// on it (RFC 7946, 3.1.9).
std::vector<Line> cut_at_180(const Line& line) {
  std::vector<Line> parts(1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const GeodeticPosition& next = line[i];
    if (i > 0 && std::abs(next.longitude_deg - line[i - 1].longitude_deg) > 180) {
      const GeodeticPosition& last = line[i - 1];
      const double side = last.longitude_deg > 0 ? 180 : -180;
      const double to_edge = std::abs(side - last.longitude_deg);
      const double whole = to_edge + std::abs(-side - next.longitude_deg);
      const double share = whole > 0 ? to_edge / whole : 0;
      GeodeticPosition edge{last.latitude_deg + share * (next.latitude_deg - last.latitude_deg),
                            side, last.height_m + share * (next.height_m - last.height_m)};
      parts.back().push_back(edge);
      edge.longitude_deg = -side;
      parts.push_back({edge});
    }
    parts.back().push_back(next);
  }
  std::erase_if(parts, [](const Line& part) { return part.size() < 2; });
  return parts;
}

/// The document in geodetic coordinates.
struct Shapes {
  struct Edge {
    const RelativePoseConstraint* constraint;
    std::vector<Line> lines;
  };
  std::vector<Line> trajectory;
  std::vector<Edge> edges;
  std::vector<GeodeticPosition> nodes;  ///< in the order of graph.nodes
};

Shapes shapes_of(const GeoDocument& document) {
  require(document.node_stamps_ns.empty() ||
              document.node_stamps_ns.size() == document.graph.nodes.size(),
          "geographic export: there are not as many stamps as nodes");
  const EnuFrame enu(document.origin);
  Shapes shapes;
  Line line;
  const auto end_line = [&] {
    for (Line& part : cut_at_180(line)) shapes.trajectory.push_back(std::move(part));
    line.clear();
  };
  for (const StampedPose& pose : document.trajectory.poses) {
    if (pose.T_world_body)
      line.push_back(enu.to_geodetic(pose.T_world_body->translation()));
    else
      end_line();
  }
  end_line();
  for (const PoseNode& node : document.graph.nodes)
    shapes.nodes.push_back(enu.to_geodetic(position_of(node.T_world_node)));
  const auto index = document.graph.index_by_id();
  for (const Constraint& constraint : document.graph.constraints)
    if (const auto* edge = std::get_if<RelativePoseConstraint>(&constraint))
      shapes.edges.push_back({edge, cut_at_180({shapes.nodes.at(index.at(edge->from)),
                                                shapes.nodes.at(index.at(edge->to))})});
  return shapes;
}

void put_position(Buffer out, const GeodeticPosition& p, const char* brackets) {
  if (brackets[0]) fmt::format_to(out, "{}", brackets[0]);
  fmt::format_to(out, "{:.9f},{:.9f},{:.4f}", p.longitude_deg, p.latitude_deg, p.height_m);
  if (brackets[0]) fmt::format_to(out, "{}", brackets[1]);
}

void put_lines(Buffer out, const std::vector<Line>& lines) {
  fmt::format_to(out, "[");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    fmt::format_to(out, "{}", i ? ",[" : "[");
    for (std::size_t k = 0; k < lines[i].size(); ++k) {
      if (k) fmt::format_to(out, ",");
      put_position(out, lines[i][k], "[]");
    }
    fmt::format_to(out, "]");
  }
  fmt::format_to(out, "]");
}

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (static_cast<unsigned char>(c) >= 32 || c == '\n' || c == '\t')
      out += c;
  }
  return out;
}

std::string origin_text(const GeodeticPosition& origin) {
  return fmt::format(
      "Positions were estimated in an east-north-up frame, tangent to the WGS84 ellipsoid at "
      "latitude {:.9f} deg, longitude {:.9f} deg, height {:.4f} m.",
      origin.latitude_deg, origin.longitude_deg, origin.height_m);
}

void put_placemark(Buffer out, const std::string& name, const char* style,
                   const std::vector<Line>& lines) {
  fmt::format_to(out, "<Placemark><name>{}</name><styleUrl>#{}</styleUrl><MultiGeometry>", name,
                 style);
  for (const Line& line : lines) {
    fmt::format_to(out, "<LineString><tessellate>1</tessellate><coordinates>");
    for (const GeodeticPosition& p : line) {
      put_position(out, p, "");
      fmt::format_to(out, " ");
    }
    fmt::format_to(out, "</coordinates></LineString>\n");
  }
  fmt::format_to(out, "</MultiGeometry></Placemark>\n");
}

void put_placemark(Buffer out, const std::string& name, const char* style,
                   const GeodeticPosition& p) {
  fmt::format_to(out, "<Placemark><name>{}</name><styleUrl>#{}</styleUrl><Point><coordinates>",
                 name, style);
  put_position(out, p, "");
  fmt::format_to(out, "</coordinates></Point></Placemark>\n");
}

void commit(const std::string& path, const fmt::memory_buffer& text) {
  AtomicFile file(path);
  file.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  file.commit();
}

}  // namespace

void write_geojson(const std::string& path, const GeoDocument& document) {
  const Shapes shapes = shapes_of(document);
  const GeodeticPosition& origin = document.origin;
  fmt::memory_buffer text;
  const Buffer out = std::back_inserter(text);
  fmt::format_to(out,
                 "{{\"type\":\"FeatureCollection\",\n\"placegraph\":{{\"name\":{},\"origin\":"
                 "{{\"latitude_deg\":{:.9f},\"longitude_deg\":{:.9f},\"height_m\":{:.4f}}},"
                 "\"frame\":{}}},\n\"features\":[\n",
                 json_text(document.name), origin.latitude_deg, origin.longitude_deg,
                 origin.height_m, json_text(origin_text(origin)));
  fmt::format_to(out,
                 "{{\"type\":\"Feature\",\"properties\":{{\"kind\":\"origin\"}},\"geometry\":"
                 "{{\"type\":\"Point\",\"coordinates\":");
  put_position(out, origin, "[]");
  fmt::format_to(out, "}}}}");
  if (!shapes.trajectory.empty()) {
    fmt::format_to(out,
                   ",\n{{\"type\":\"Feature\",\"properties\":{{\"kind\":\"trajectory\"}},"
                   "\"geometry\":{{\"type\":\"MultiLineString\",\"coordinates\":");
    put_lines(out, shapes.trajectory);
    fmt::format_to(out, "}}}}");
  }
  for (const Shapes::Edge& edge : shapes.edges) {
    if (edge.lines.empty()) continue;
    fmt::format_to(
        out,
        ",\n{{\"type\":\"Feature\",\"properties\":{{\"kind\":\"edge\",\"from\":{},\"to\":{},"
        "\"source\":\"{}\"}},\"geometry\":{{\"type\":\"MultiLineString\",\"coordinates\":",
        edge.constraint->from, edge.constraint->to, to_string(edge.constraint->source));
    put_lines(out, edge.lines);
    fmt::format_to(out, "}}}}");
  }
  for (std::size_t i = 0; i < shapes.nodes.size(); ++i) {
    fmt::format_to(out, ",\n{{\"type\":\"Feature\",\"properties\":{{\"kind\":\"node\",\"id\":{}",
                   document.graph.nodes[i].id);
    if (!document.node_stamps_ns.empty())
      fmt::format_to(out, ",\"stamp_ns\":{}", document.node_stamps_ns[i]);
    fmt::format_to(out, "}},\"geometry\":{{\"type\":\"Point\",\"coordinates\":");
    put_position(out, shapes.nodes[i], "[]");
    fmt::format_to(out, "}}}}");
  }
  fmt::format_to(out, "\n]}}\n");
  commit(path, text);
}

void write_kml(const std::string& path, const GeoDocument& document) {
  const Shapes shapes = shapes_of(document);
  fmt::memory_buffer text;
  const Buffer out = std::back_inserter(text);
  fmt::format_to(out,
                 "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                 "<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document>\n<name>{}</name>\n"
                 "<description>{}</description>\n",
                 xml_text(document.name), origin_text(document.origin));
  for (const auto& [style, colour, width] :
       {std::tuple("trajectory", "ff0000ff", 3), std::tuple("odometry", "ffff8000", 1),
        std::tuple("loop", "ff00ff00", 2), std::tuple("other", "ff00ffff", 1),
        std::tuple("node", "ffffffff", 1)})
    fmt::format_to(
        out,
        "<Style id=\"{}\"><LineStyle><color>{}</color><width>{}</width></LineStyle>"
        "<IconStyle><scale>0.4</scale></IconStyle><LabelStyle><scale>0</scale></LabelStyle>"
        "</Style>\n",
        style, colour, width);
  put_placemark(out, "origin", "node", document.origin);
  fmt::format_to(out, "<Folder><name>trajectory</name>\n");
  if (!shapes.trajectory.empty()) put_placemark(out, "trajectory", "trajectory", shapes.trajectory);
  fmt::format_to(out, "</Folder>\n<Folder><name>edges</name>\n");
  for (const Shapes::Edge& edge : shapes.edges)
    if (!edge.lines.empty())
      put_placemark(out, fmt::format("{} - {}", edge.constraint->from, edge.constraint->to),
                    to_string(edge.constraint->source), edge.lines);
  fmt::format_to(out, "</Folder>\n<Folder><name>nodes</name>\n");
  for (std::size_t i = 0; i < shapes.nodes.size(); ++i)
    put_placemark(out, to_string(document.graph.nodes[i].id), "node", shapes.nodes[i]);
  fmt::format_to(out, "</Folder>\n</Document></kml>\n");
  commit(path, text);
}

}  // namespace placegraph
