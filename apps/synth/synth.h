#pragma once
#include <placegraph/io/internal/synthetic/writers/flight_writer.h>

#include <string>

namespace placegraph::apps {

struct SynthArguments {
  SyntheticOptions world;               ///< but the difficulty and the size, which follow
  std::string difficulty = "standard";  ///< clean, standard or hard
  std::string size;                     ///< of the images, "1241x376"; empty: the world's own
  std::string out;                      ///< folder to write: KITTI's layout, hover EuRoC's
  bool stereo = false;                  ///< both eyes, as is the rule outdoors
  bool mono = false;                    ///< the left eye only, as is the rule indoors
  bool depth = false;                   ///< depth images, which are always written indoors
  bool labels = false;                  ///< class and plane of every pixel
  bool flow = false;                    ///< exact optical flow to the next frame
  int threads = 0;                      ///< frames at a time; 0: all processors
  bool force = false;                   ///< replace what is in the folder
};

struct SynthResult {
  std::string world, difficulty, out;
  std::size_t frames = 0;
  double length_m = 0;  ///< of the camera's way
  bool stereo = false;
};

/// `placegraph synth`: renders a sequence with exact ground truth, with progress on stderr. Throws
/// ArgumentError, FileError; then nothing is written.
SynthResult synth(const SynthArguments& arguments);

/// One line.
std::string to_text(const SynthResult& result);

}  // namespace placegraph::apps
