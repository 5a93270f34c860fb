#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/writers/flight_writer.h>
#include <placegraph/io/synthetic/writers/sequence_writer.h>
#include <placegraph/io/synthetic/writers/world_writer.h>

namespace placegraph {

SyntheticContents usual_contents(const SyntheticWorld& world) {
  SyntheticContents contents;
  if (world.flight_setting()) return contents;
  contents.right = !world.is_indoor();
  contents.depth = world.is_indoor();
  return contents;
}

void write_world(const SyntheticWorld& world, const std::string& path,
                 const SequenceWriterOptions& options,
                 const std::function<void(std::size_t)>& progress) {
  const SyntheticContents& contents = options.contents;
  if (world.flight_setting()) {
    require(!(contents.right || contents.depth || contents.labels),
            "flight: has one camera, and neither depth nor labels");
    write_flight(world, path, options, progress);
  } else {
    write_sequence(world, path, options, progress);
  }
}

}  // namespace placegraph
