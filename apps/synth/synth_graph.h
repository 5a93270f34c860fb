#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace placegraph::apps {

struct SynthGraphArguments {
  std::string world;  ///< manhattan-walk, grid-world, long-loop, or a graph that is made harder
  std::string out;    ///< graph to write, in g2o's form
  /// Options of the world; each has its own otherwise, and none that is of another world is taken.
  std::optional<int> poses, closures;
  std::optional<double> loop_share, laps;
  std::optional<double> translation_noise_m;  ///< of a measurement
  std::optional<double> rotation_noise_rad;   ///< of a measurement, or added to those of a file
  bool spatial = false;                       ///< the long loop in space
  int false_loops = 0;                        ///< added behind the other constraints
  bool shuffle = false;                       ///< the constraints in a random order
  std::uint64_t seed = 1;
  bool force = false;  ///< overwrite `out`
};

struct SynthGraphResult {
  std::string world, out;
  std::size_t poses = 0, constraints = 0;  ///< that were written
};

/// `placegraph synth-graph`: makes a pose graph that starts from drifted odometry, or makes one
/// harder. Throws ArgumentError, FileError; then nothing is written.
SynthGraphResult synth_graph(const SynthGraphArguments& arguments);

/// One line.
std::string to_text(const SynthGraphResult& result);

}  // namespace placegraph::apps
