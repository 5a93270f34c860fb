#pragma once
#include <placegraph/io/synthetic/writers/world_writer.h>

#include <functional>
#include <string>

namespace placegraph {

/// Writes a whole sequence in KITTI's layout: image_0/%06d.png, image_1, depth_0 (16-bit; its unit
/// and camera in calib_depth.txt), labels_0, planes_0 (with planes.txt), flow_0 (KITTI's 16-bit
/// format), calib.txt, times.txt, poses.txt, world.yaml, README.txt, and floorplan.json indoors.
/// Everything is written to a folder beside `path` that is renamed when complete. `progress(done)`
/// is called after each frame, never by two threads at once. Throws ArgumentError if `path` exists
/// and is not an empty folder (unless forced), FileError if something cannot be written.
void write_sequence(const SyntheticWorld& world, const std::string& path,
                    const SequenceWriterOptions& options,
                    const std::function<void(std::size_t)>& progress = {});

}  // namespace placegraph
