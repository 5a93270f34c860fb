#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace placegraph::apps {

struct SynthGraphArguments {
  std::string world;  ///< manhattan-walk, grid-world, long-loop, or file of a graph to make harder
  std::string out;    ///< file for the graph, in g2o format
  /// Options of the world, with defaults per world; options of other worlds are rejected.
  std::optional<int> poses, closures;
  std::optional<double> loop_share, laps;
  std::optional<double> translation_noise_m;  ///< standard deviation of a measured translation
  std::optional<double>
      rotation_noise_rad;  ///< standard deviation of a measured rotation, or noise added to a file
  bool spatial = false;    ///< three-dimensional long loop
  int false_loops = 0;     ///< number of false loops, appended to the constraints
  bool shuffle = false;    ///< write the constraints in a random order
  std::uint64_t seed = 1;
  bool force = false;  ///< overwrite `out`
};

struct SynthGraphResult {
  std::string world, out;
  std::size_t poses = 0, constraints = 0;  ///< numbers of written poses and constraints
};

/// Makes a pose graph with drifted odometry, or makes one harder: `placegraph synth graph`.
/// Throws ArgumentError, FileError; then nothing is written.
SynthGraphResult synth_graph(const SynthGraphArguments& arguments);

/// One line.
std::string to_text(const SynthGraphResult& result);

}  // namespace placegraph::apps
