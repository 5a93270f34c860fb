#pragma once
#include <placegraph/io/internal/synthetic/writers/sequence_writer.h>

namespace placegraph {

/// Writes a flight of the hover world in EuRoC's layout: mav0/cam0, mav0/imu0,
/// mav0/state_groundtruth_estimate0 (T_world_body, velocity, biases at every inertial sample),
/// beside them markers.yaml, world.yaml, README.txt and, if asked for, flow_0 (KITTI's 16-bit form,
/// one file an image). Of the contents only `flow` is heeded. Otherwise as `write_sequence`. Throws
/// ArgumentError if `world` is no hover world.
void write_flight(const SyntheticWorld& world, const std::string& path,
                  const SequenceWriterOptions& options,
                  const std::function<void(std::size_t)>& progress = {});

}  // namespace placegraph
