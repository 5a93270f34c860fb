// Prints the events of a SLAM run at the time they occur: watch_events SEQUENCE
#include <placegraph/placegraph.h>

#include <cstdio>

using namespace placegraph;

/// Override the events of interest; Slam calls them on the thread that calls add_frame.
class Watcher final : public SlamEvents {
 public:
  void frame_lost(const FrameResult& frame) override {
    std::printf("frame %lld has no pose: %s\n", number(frame.frame), frame.outcome.reason.c_str());
  }
  void keyframe_added(const KeyframeAdded& added) override {
    std::printf("frame %lld is keyframe %lld of place %lld\n", number(added.frame),
                number(added.keyframe), number(added.place));
  }
  void loop_accepted(const LoopRecord& loop) override {
    std::printf("frame %lld shows what frame %lld showed, probability %.3f\n",
                number(loop.query_frame), number(loop.match_frame), loop.probability);
  }
  void places_merged(const PlacesMerged& places) override {
    std::printf("place %lld is place %lld\n", number(places.gone), number(places.kept));
  }
  void map_moved(const MapMoved& move) override {
    if (move.translation > 0.1)  // drop snapshots that are out of date
      std::printf("%d places moved, by up to %.2f m\n", move.places, move.translation);
  }

 private:
  template <class Id>
  static long long number(Id id) {
    return static_cast<long long>(id.value());
  }
};

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s SEQUENCE\n", argv[0]);
    return 2;
  }
  Watcher watcher;
  const RunResult run = run_sequence(*open_dataset(argv[1]), RunOptions{}, {.events = &watcher});
  std::printf("%zu keyframes in %zu places\n", run.map.keyframes.size(),
              run.map.place_graph.places.size());
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
