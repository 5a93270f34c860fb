// Writes a trajectory, reads it back and judges it, then asks for a data set that is not there: io,
// eval and graph of the installed library.
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <cmath>
#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: whole FILE.tum\n");
    return 2;
  }
  placegraph::Trajectory truth;
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.02 * i;
    const placegraph::SE3 T_world_cam(placegraph::SO3::exp({0, angle, 0}),
                                      {50 * std::sin(angle), 0, 50 * std::cos(angle)});
    truth.poses.push_back({i * 100'000'000ll, T_world_cam.isometry()});
  }
  placegraph::write_trajectory(argv[1], truth, placegraph::TrajectoryFormat::kTum);
  const placegraph::Trajectory estimate = placegraph::read_trajectory(argv[1]);
  const placegraph::EvaluationResult result = placegraph::evaluate(truth, estimate);
  if (!result.outcome || result.frames != 200) return 1;
  std::printf("%d frames\n", result.frames);
  try {
    (void)placegraph::open_dataset("/nonexistent");
  } catch (const placegraph::Error& error) {
    std::printf("%s\n", error.what());
    return 0;
  }
  return 1;
}
