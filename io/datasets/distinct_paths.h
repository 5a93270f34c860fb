#pragma once
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A path that a command was given, with the option that gave it.
struct NamedPath {
  std::string option;  ///< such as "--csv"
  std::string path;    ///< as it was given; it need not exist
};

/// Checks that no output of a command would destroy another one or an input.
///
/// Throws ArgumentError, which names the options, if two outputs are one file, if an output lies
/// in a folder that is another output, if an output is an input, a file of a run in a folder that
/// is an input, or the folder of an input file, or if it is a part of a recording. Paths are one
/// file however they are written, and through links of either kind. Inputs that do not exist and
/// outputs that are devices are left out.
void require_distinct_paths(const std::vector<NamedPath>& outputs,
                            const std::vector<NamedPath>& inputs);

}  // namespace placegraph
