#pragma once
#include <placegraph/io/synthetic/writers/world_writer.h>

namespace placegraph {

/// Writes a flight of the flight world in EuRoC's layout: mav0/cam0, mav0/imu0,
/// mav0/state_groundtruth_estimate0 (T_world_body, velocity, biases at every inertial sample),
/// beside them markers.yaml, world.yaml, README.txt and, if requested, flow_0 (KITTI's 16-bit
/// format, one file per image). Of the contents only `flow` is used. Otherwise as `write_sequence`.
/// Throws ArgumentError if `world` is not a flight world.
void write_flight(const SyntheticWorld& world, const std::string& path,
                  const SequenceWriterOptions& options,
                  const std::function<void(std::size_t)>& progress = {});

}  // namespace placegraph
