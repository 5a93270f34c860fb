// A run that may be interrupted: resume_run SEQUENCE MAP.db [FRAMES]
// It saves its map during the run; if MAP.db exists already, the run is resumed. After FRAMES
// frames it is interrupted, as by a power failure.
#include <placegraph/placegraph.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

using namespace placegraph;

struct Interrupted {};

int main(int argc, char** argv) try {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: %s SEQUENCE MAP.db [FRAMES]\n", argv[0]);
    return 2;
  }
  const std::size_t frames = argc == 4 ? static_cast<std::size_t>(std::atoi(argv[3])) : 0;
  RunInputs inputs;
  inputs.map_file = {
      .path = argv[2], .sequence = argv[1], .resume = std::filesystem::exists(argv[2])};
  inputs.progress = [&](std::size_t done, std::size_t, const FrameResult&) {
    if (done == frames) throw Interrupted();
  };
  const RunResult run = run_sequence(*open_dataset(argv[1]), RunOptions{}, inputs);
  if (run.resumed_at)
    std::printf("went on with frame %lld\n", static_cast<long long>(run.resumed_at->value()));
  std::printf("%zu of %zu frames posed\n", run.map.trajectory_optimized().posed(),
              run.map.frames.size());
  return 0;
} catch (const Interrupted&) {
  std::printf("interrupted; the map was saved\n");
  return 1;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
