#pragma once
#include <map>
#include <string>
#include <vector>

namespace placegraph {

/// Files of poses in a folder, by the names of their sequences.
struct PoseFolder {
  std::map<std::string, std::string> files;  ///< paths by names as "00"
  std::vector<std::string> others;           ///< paths of other files, but hidden ones
};

/// Finds the files of poses of sequences in a folder: `00.txt`, or `00/poses.txt`.
/// A name of a sequence is made of digits. Throws ArgumentError if there is none, or both forms of
/// one, and FileError if it is no folder.
PoseFolder pose_folder(const std::string& path);

}  // namespace placegraph
