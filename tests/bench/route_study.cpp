// Ways over the places of a run: shortest ones against the truth, and the way back replayed with
// frames that the map does not keep.
//   bench_route_study SEQUENCE [MAP_FRAMES=0: all] [CAMERA_HEIGHT=0: as the sequence says]
// The map is made of the first MAP_FRAMES frames; the way back is replayed with frames of later
// passes where there are any. Prints figure, tab, value.
#include <fmt/format.h>
#include <placegraph/eval/loops/route_check.h>
#include <placegraph/eval/errors/statistics.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/run.h>

#include <cstdio>
#include <cstdlib>

#include "tests/support/scenes/way_back.h"

namespace placegraph {
namespace {

using test::Recognition;
using test::ReturnPath;
using test::ViewOnThePath;

void tell(const std::string& figure, double value) { fmt::print("{}\t{:.5g}\n", figure, value); }

/// Places by what became of them on the way back; a step of a way is one of them.
struct Replay {
  std::map<PlaceId, ViewOnThePath> views;
  std::map<PlaceId, Recognition> recognitions;
};

Replay replay_places(const Map& map, const ReturnPath& back) {
  Replay replay;
  for (const auto& [place, frame] : test::frames_of_places(map)) {
    replay.views[place] = back.view_at(frame.value());
    replay.recognitions[place] = back.recognize(replay.views[place]);
  }
  return replay;
}

void tell_places(const Replay& replay, bool another_pass) {
  const std::string whose = another_pass ? "another pass" : "neighbours";
  int places = 0, right = 0;
  std::vector<double> position;
  for (const auto& [place, recognition] : replay.recognitions) {
    if (replay.views.at(place).another_pass != another_pass) continue;
    ++places;
    if (recognition.result != Recognition::Result::kRight) continue;
    ++right;
    position.push_back(recognition.position_error_m);
  }
  tell(whose + ", places", places);
  tell(whose + ", recognized", right);
  if (!position.empty())
    tell(whose + ", position error, median [m]", statistics_of(position).median);
}

/// The way back between the two ends of the map and between places spread over it.
void tell_ways(const Map& map, const Replay& replay) {
  constexpr std::size_t kEnds = 12;
  const auto& places = map.place_graph.places;
  const std::size_t step = std::max<std::size_t>(1, places.size() / kEnds);
  int paths = 0, whole = 0, steps = 0, right = 0;
  for (std::size_t i = 0; i < places.size(); i += step)
    for (std::size_t j = i + step; j < places.size(); j += step) {
      const Route path = shortest_route(map.place_graph, places[i].id, places[j].id);
      if (!path.outcome) continue;
      ++paths;
      bool all = true;
      for (const RouteStep& at : backtracked(path).steps) {
        const bool known = replay.recognitions.at(at.place).result == Recognition::Result::kRight;
        ++steps;
        right += known;
        all = all && known;
      }
      whole += all;
    }
  tell("ways back", paths);
  tell("ways back recognized at every step", whole);
  tell("steps back", steps);
  tell("steps back recognized", right);
}

void study(const std::string& sequence, int map_frames, double camera_height_m) {
  const auto dataset = open_dataset(sequence);
  require(dataset->ground_truth().has_value(), sequence + ": has no truth");
  RunOptions options;
  options.max_frames = map_frames;
  options.camera_height_m = camera_height_m;
  const RunResult run = run_sequence(*dataset, options);
  const Map& map = run.map;
  tell("places", static_cast<double>(map.place_graph.places.size()));
  Trajectory truth = *dataset->ground_truth();
  truth.poses.resize(map.frames.size());  // the roads that the map can know
  const RouteCheck check = check_routes(map.place_graph, test::frames_of_places(map), truth);
  tell("pairs", check.pairs);
  tell("pairs apart", check.apart);
  tell("pairs over the same places", check.same_places);
  tell("excess, worst [%]", 100 * check.worst_excess);
  tell("detour, median [%]", 100 * check.median_detour);
  tell("detour, worst [m]", check.worst_detour_m);
  tell("length error, median [%]", 100 * check.median_length_error);
  tell("length error, worst [%]", 100 * check.worst_length_error);

  const LoopCloser memory(options.slam.loops, run.calibration, options.slam.seed, map);
  const Replay replay =
      replay_places(map, ReturnPath(map, memory, *dataset, run.sensor, map_frames));
  tell_places(replay, true);
  tell_places(replay, false);
  tell_ways(map, replay);
}

}  // namespace
}  // namespace placegraph

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("bench_route_study SEQUENCE [MAP_FRAMES] [CAMERA_HEIGHT]\n", stderr);
    return 2;
  }
  try {
    placegraph::study(argv[1], argc > 2 ? std::atoi(argv[2]) : 0,
                      argc > 3 ? std::atof(argv[3]) : 0);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
