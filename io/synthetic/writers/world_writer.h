#pragma once
#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include <cstddef>
#include <functional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// How a rendered sequence is written.
struct SequenceWriterOptions {
  SyntheticContents contents;  ///< files beside the left images
  int threads = 1;             ///< frames rendered and written at the same time
  bool force = false;  ///< write into a folder that is not empty, replacing a sequence there
};

/// What a sequence of a world holds unless something else is asked for.
///
/// Images of two cameras outdoors, of one with depth indoors.
SyntheticContents usual_contents(const SyntheticWorld& world);

/// Writes a whole sequence: a flight in EuRoC's layout, of any other world in KITTI's.
///
/// Everything is written to a folder beside `path` that is renamed when complete. `progress(done)`
/// is called after each frame, never by two threads at once. Throws ArgumentError if `path` exists
/// and is not an empty folder (unless forced), or for contents that a flight lacks; FileError if
/// something cannot be written.
void write_world(const SyntheticWorld& world, const std::string& path,
                 const SequenceWriterOptions& options,
                 const std::function<void(std::size_t)>& progress = {});

}  // namespace placegraph
