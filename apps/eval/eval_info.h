#pragma once
#include <placegraph/eval/info/trajectory_info.h>

#include <string>
#include <vector>

namespace placegraph::apps {

struct EvalInfoArguments {
  std::vector<std::string> files;  ///< trajectories, or folders of sequences with ground truth
  std::string times;               ///< file of times for trajectories without; empty: none
  std::string apply;               ///< filter that is applied before; empty: none
};

/// One trajectory with its name.
struct NamedInfo {
  std::string name;
  TrajectoryInfo info;
};

/// Describes trajectories without ground truth: `placegraph eval info`.
/// Throws ArgumentError, FileError; NoResult if a filter leaves no frame.
std::vector<NamedInfo> eval_info(const EvalInfoArguments& arguments);

/// One trajectory in full, several as a table with what is suspicious below.
std::string to_text(const std::vector<NamedInfo>& infos);
/// An object, or {"trajectories": [...]} for several.
std::string to_json(const std::vector<NamedInfo>& infos);

}  // namespace placegraph::apps
