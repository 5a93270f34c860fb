// make_gps_scenario KITTI_GT OUT SEED FIRST-LAST[,FIRST-LAST...] [time|line] [A B]: writes what the
// scenario of tests/support/gps_scenario.h is made of, for `placegraph map georeference` and
// `placegraph eval`: odometry.g2o, odometry.kitti, origin.txt, times.txt, oxts.txt with
// times_oxts.txt, and the reference as inside.tum and outside.tum (of the dropouts, FIRST to LAST
// in seconds). A and B: the walks of position and attitude, if not the defaults.
#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/graphs/g2o.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "tests/support/gps_scenario.h"

namespace {

using namespace placegraph;

std::vector<std::pair<double, double>> parse_spans(const std::string& text) {
  std::vector<std::pair<double, double>> spans;
  std::vector<std::string_view> fields;
  split_comma(text, fields);
  for (const std::string_view field : fields) {
    const std::size_t dash = field.find('-');
    const auto begin = parse_double(field.substr(0, dash));
    const auto end = dash == std::string_view::npos ? begin : parse_double(field.substr(dash + 1));
    require(begin && end && *begin < *end, "dropouts: " + in_quotes(field) + " is not FIRST-LAST");
    spans.emplace_back(*begin, *end);
  }
  return spans;
}

/// The readings with other positions and accuracy; all else as the receiver wrote it.
void write_oxts(const std::string& kitti, const std::string& out,
                const test::GpsScenario& scenario) {
  std::vector<std::string> lines;
  std::ifstream in(kitti + "/oxts.txt");
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::ofstream readings(out + "/oxts.txt"), times(out + "/times_oxts.txt");
  for (std::size_t i = 0; i < scenario.input.fixes.size(); ++i) {
    const GpsFix& fix = scenario.input.fixes[i];
    std::vector<std::string_view> fields;
    split_blank(lines[scenario.reading[i]], fields);
    readings << fmt::format("{:.11f} {:.11f} {:.6f}", fix.position.latitude_deg,
                            fix.position.longitude_deg, fix.position.height_m);
    for (std::size_t k = 3; k < fields.size(); ++k)
      readings << ' ' << (k == 23 ? fmt::format("{}", fix.accuracy_m) : std::string(fields[k]));
    readings << '\n';
    times << fmt::format("{:.9f}\n", 1e-9 * static_cast<double>(fix.stamp_ns));
  }
}

void write_scenario(const std::string& kitti, const std::string& out,
                    const test::GpsScenario& scenario) {
  std::filesystem::create_directories(out);
  const GeoreferenceInput& input = scenario.input;
  write_g2o(out + "/odometry.g2o", input.graph);
  std::ofstream(out + "/origin.txt")
      << fmt::format("{:.17g},{:.17g},{:.17g}\n", input.origin->latitude_deg,
                     input.origin->longitude_deg, input.origin->height_m);
  write_oxts(kitti, out, scenario);
  Trajectory odometry, spans[2];
  std::ofstream times(out + "/times.txt");
  for (std::size_t i = 0; i < input.graph.nodes.size(); ++i) {
    const std::int64_t stamp = input.visits[i].stamp_ns;
    times << fmt::format("{:.9f}\n", 1e-9 * static_cast<double>(stamp));
    odometry.poses.push_back({stamp, std::get<SE3>(input.graph.nodes[i].T_world_node).isometry()});
    if (scenario.reference.poses[i].T_world_body)
      spans[scenario.inside[i] != 0].poses.push_back(scenario.reference.poses[i]);
  }
  write_trajectory(out + "/odometry.kitti", odometry, TrajectoryFormat::kKitti);
  write_trajectory(out + "/outside.tum", spans[0], TrajectoryFormat::kTum);
  write_trajectory(out + "/inside.tum", spans[1], TrajectoryFormat::kTum);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5 || argc > 8 || argc == 7) {
    std::fputs(
        "make_gps_scenario KITTI_GT OUT SEED FIRST-LAST[,FIRST-LAST...] [time|line [WALK_M "
        "WALK_RAD]]\n",
        stderr);
    return 2;
  }
  try {
    test::GpsScenarioOptions options;
    options.seed = std::stoull(argv[3]);
    options.dropouts_s = parse_spans(argv[4]);
    options.reference_by_line = argc > 5 && std::string(argv[5]) == "line";
    if (argc == 8) {
      options.translation_walk = std::stod(argv[6]);
      options.rotation_walk = std::stod(argv[7]);
    }
    write_scenario(argv[1], argv[2], test::make_gps_scenario(argv[1], options));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_gps_scenario: %s\n", error.what());
    return 2;
  }
}
