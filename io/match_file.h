#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace placegraph {

/// Point matches of two views as `xA yA xB yB` lines [px]; what follows on a line is not read, nor
/// are blank lines and those that begin with `#`.
struct MatchFile {
  std::vector<Eigen::Vector2d> px_a, px_b;
};

/// Throws FileError with the line: fewer than four columns, what is no finite number, pixels beyond
/// 1e6; without one, no match at all.
MatchFile read_matches(const std::string& path);

}  // namespace placegraph
