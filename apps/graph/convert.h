#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace placegraph::apps {

struct ConvertArguments {
  std::string in, out;
  std::string to;        ///< kitti, tum, euroc or g2o; empty: according to the extension of `out`
  std::string times;     ///< file of times of a KITTI trajectory, one per line [s]
  std::string posed_in;  ///< trajectory of as many frames; frames without a pose in it are left out
  bool posed_only = false;  ///< leave out frames without a pose
  bool rigid = false;       ///< convert similarities to SE(3) poses
  std::vector<std::string> merge;  ///< trajectories of other times that are joined to `in`
  bool overlap = false;     ///< of joined trajectories that overlap keep the one that begins first
  std::string apply;        ///< filter of the trajectory; empty: none
  std::string split;        ///< "gaps", or the length of a part as "60s"; empty: one part
  bool force = false;       ///< overwrite `out`
};

/// Counts of the written file; only the members of its kind are set.
struct ConvertResult {
  enum class Kind { kTrajectory, kGraph, kPosesOfGraph };
  Kind kind = Kind::kTrajectory;
  std::string in, out;
  std::size_t frames = 0, posed = 0;  ///< kTrajectory: as written
  std::size_t left_out = 0;           ///< kTrajectory: frames that were read and not written
  std::vector<std::string> parts;     ///< kTrajectory: files of `split`, in place of `out`
  std::size_t nodes = 0;
  std::size_t constraints = 0, priors = 0, observations = 0;  ///< kGraph
  std::size_t landmarks = 0;                                  ///< kPosesOfGraph: left out
  bool poses_alone = true;  ///< kGraph: no priors and no landmarks
};

/// Converts a trajectory or a pose graph to another form: `placegraph graph convert`.
/// The content of the file decides which of them it is. Parts of a trajectory are written to files
/// beside `out` whose names end in their numbers, all of them or none. Throws ArgumentError if the
/// form cannot represent it, FileError, NoResult if a filter leaves no pose.
ConvertResult convert(const ConvertArguments& arguments);

/// One line.
std::string to_text(const ConvertResult& result);

}  // namespace placegraph::apps
