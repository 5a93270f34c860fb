#pragma once
#include <string>
#include <vector>

namespace placegraph::apps {

/// Folders in which files of one kind ("models", "configs") that come with the program may be.
/// First share/placegraph beside the folder of the program, then the folder of the source.
std::vector<std::string> shipped_folders(const std::string& kind);

/// The file of options that `--config` names: a path, or a shipped file by its bare name.
/// "kitti_mono" is kitti_mono.yaml of the shipped configs. Throws FileError if there is neither,
/// with the names of the shipped files that are spelled similarly, or else of all.
std::string config_path(const std::string& given);

}  // namespace placegraph::apps
