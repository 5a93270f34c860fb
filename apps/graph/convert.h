#pragma once
#include <cstddef>
#include <string>

namespace placegraph::apps {

struct ConvertArguments {
  std::string in, out;
  std::string to;        ///< kitti, tum, euroc or g2o; empty: what the extension of `out` says
  std::string times;     ///< file of the times of a KITTI trajectory, one [s] a line
  std::string posed_in;  ///< trajectory of as many frames: those without a pose in it are left out
  bool posed_only = false;  ///< frames without a pose are left out
  bool rigid = false;       ///< similarities become poses in space
  bool force = false;       ///< overwrite `out`
};

/// What was written; the counts are those of its kind.
struct ConvertResult {
  enum class Kind { kTrajectory, kGraph, kPosesOfGraph };
  Kind kind = Kind::kTrajectory;
  std::string in, out;
  std::size_t frames = 0, posed = 0;  ///< kTrajectory: as written
  std::size_t left_out = 0;           ///< kTrajectory: frames of `in` that are not in `out`
  std::size_t nodes = 0;
  std::size_t constraints = 0, priors = 0, observations = 0;  ///< kGraph
  std::size_t landmarks = 0;                                  ///< kPosesOfGraph: left out
  bool poses_alone = true;  ///< kGraph: no priors and no landmarks
};

/// `placegraph convert`: reads a trajectory or a pose graph, whichever the content is, and writes
/// it in another form. Throws ArgumentError where the form cannot hold it, FileError.
ConvertResult convert(const ConvertArguments& arguments);

/// One line.
std::string to_text(const ConvertResult& result);

}  // namespace placegraph::apps
