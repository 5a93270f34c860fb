#pragma once
#include <placegraph/io/synthetic/writers/world_writer.h>

#include <string>

namespace placegraph::apps {

struct SynthArguments {
  SyntheticOptions world;               ///< difficulty and size are set by the next two members
  std::string difficulty = "standard";  ///< clean, standard or hard
  std::string size;                     ///< image size, "1241x376"; empty: the default of the world
  std::string out;      ///< folder for the sequence: KITTI's layout, EuRoC's for a flight
  bool stereo = false;  ///< both cameras, the default outdoors
  bool mono = false;    ///< left camera only, the default indoors
  bool depth = false;   ///< depth images, which are always written indoors
  bool labels = false;  ///< class and plane of every pixel
  bool flow = false;    ///< exact optical flow to the next frame
  int threads = 0;      ///< number of threads; 0: all processors
  bool force = false;   ///< overwrite the content of the folder
};

struct SynthResult {
  std::string world, difficulty, out;
  std::size_t frames = 0;
  double length_m = 0;  ///< path length of the camera
  bool stereo = false;
  bool depth = false;  ///< with depth images
};

/// Renders a sequence with exact ground truth: `placegraph synth sequence`.
/// Progress goes to stderr. Throws ArgumentError, FileError; then nothing is written.
SynthResult synth(const SynthArguments& arguments);

/// One line.
std::string to_text(const SynthResult& result);

}  // namespace placegraph::apps
