// Runs a recorded sequence or a folder of images, frame by frame as on a robot, and writes the
// trajectory: run_folder SEQUENCE OUT.tum
#include <placegraph/placegraph.h>

#include <cstdio>

using namespace placegraph;

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s SEQUENCE OUT.tum\n", argv[0]);
    return 2;
  }
  const auto dataset = open_dataset(argv[1]);
  const Sensor sensor = dataset->sensors().front();  // the best one of the data set

  Slam slam(SlamOptions{}, dataset->calibration(sensor));
  for (std::size_t i = 0; i < dataset->size(); ++i) {
    const FrameResult result = slam.add_frame(dataset->frame(i, sensor));
    if (result.T_map_cam) {
      const Eigen::Vector3d& p = result.T_map_cam->translation();
      std::printf("frame %zu: %.3f %.3f %.3f m\n", i, p.x(), p.y(), p.z());
    } else {
      std::printf("frame %zu: no pose: %s\n", i, result.outcome.reason.c_str());
    }
  }
  const Map map = slam.finish();
  const Trajectory trajectory = map.trajectory_optimized();
  write_trajectory(argv[2], trajectory, TrajectoryFormat::kTum);
  std::printf("%zu of %zu frames posed, %zu places\n", trajectory.posed(), trajectory.size(),
              map.place_graph.places.size());
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
