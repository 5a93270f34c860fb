#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/isam.h>
#include <placegraph/io/graphs/parse_graph.h>
#include <placegraph/io/graphs/pose_graph_file.h>
#include <placegraph/io/graphs/toro.h>

namespace placegraph {
namespace {

std::string_view tag_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t\v\f\r"), line.size()));
  return line.substr(0, line.find_first_of(" \t\v\f\r"));
}

/// Whether the six numbers of an EDGE2 are TORO's information. iSAM's root has its diagonal at the
/// first, fourth and sixth number, TORO has correlations at the fifth and sixth: a zero there
/// excludes iSAM.
bool has_toro_information(std::string_view line) {
  std::vector<std::string_view> fields;
  split_blank(line, fields);
  if (fields.size() < 12) return false;
  for (const std::size_t i : {6, 9, 11})
    if (parse_double(fields[i]) == 0.0) return true;
  return false;
}

}  // namespace

PoseGraphFormat pose_graph_format(TextFile& file) {
  std::optional<PoseGraphFormat> format;
  bool edges = false, toro_edges = false;
  for (std::string_view line; !format && file.next_data(line);) {
    const std::string_view tag = tag_of(line);
    if (tag.starts_with("VERTEX_") || tag.starts_with("EDGE_") || tag.starts_with("PARAMS_") ||
        tag == "FIX")
      format = PoseGraphFormat::kG2o;
    else if (tag == "VERTEX2" || tag == "VERTEX3")
      format = PoseGraphFormat::kToro;
    else if (tag == "ODOMETRY" || tag == "LANDMARK" || tag == "POINT3")
      format = PoseGraphFormat::kIsam;
    else if (tag == "EDGE2" || tag == "EDGE3")
      edges = true, toro_edges = toro_edges || (tag == "EDGE2" && has_toro_information(line));
    else
      file.fail(in_quotes(tag) + ": not a tag of a pose graph in the g2o, TORO or iSAM format");
  }
  if (!format && edges) format = toro_edges ? PoseGraphFormat::kToro : PoseGraphFormat::kIsam;
  if (!format) throw FileError(file.path(), "holds no vertices");
  file.rewind();
  return *format;
}

namespace {

PoseGraph parse(TextFile& file, PoseGraphFormat format, const PoseGraphReading& reading) {
  switch (format) {
    case PoseGraphFormat::kG2o:
      return parse_g2o(file, reading);
    case PoseGraphFormat::kToro:
      return parse_toro(file, reading);
    case PoseGraphFormat::kIsam:
      break;
  }
  return parse_isam(file, reading);
}

}  // namespace

LandmarkGraph read_landmark_graph(const std::string& path, const PoseGraphReading& reading) {
  TextFile file(path);
  const PoseGraphFormat format = pose_graph_format(file);
  if (format == PoseGraphFormat::kG2o) return parse_g2o_landmarks(file, reading);
  return {parse(file, format, reading), {}, {}, {}};
}

const std::vector<std::string>& indefinite_information_names() {
  static const std::vector<std::string> names = {"refuse", "nearest", "isotropic"};
  return names;
}

PoseGraph read_pose_graph(const std::string& path, const PoseGraphReading& reading) {
  TextFile file(path);
  const PoseGraphFormat format = pose_graph_format(file);
  return parse(file, format, reading);
}

}  // namespace placegraph
