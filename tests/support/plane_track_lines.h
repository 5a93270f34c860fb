#pragma once

#include <Eigen/Core>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace placegraph::test {

/// A line of the file that `placegraph track plane` writes.
struct PlaneTrackLine {
  std::size_t frame = 0;
  std::string state;
  std::vector<Eigen::Vector2d> corners;
  double similarity = 0;
};

/// A number, or what does not end as one: "nan".
inline double number_in(std::istringstream& in) {
  std::string word;
  in >> word;
  return std::strtod(word.c_str(), nullptr);
}

inline std::vector<PlaneTrackLine> plane_track_lines(const std::string& path) {
  std::vector<PlaneTrackLine> lines;
  std::istringstream in(read_file(path));
  for (std::string text; std::getline(in, text);) {
    std::istringstream fields(text);
    PlaneTrackLine line;
    fields >> line.frame >> line.state;
    for (int c = 0; c < 4; ++c) {
      const double u = number_in(fields);
      line.corners.emplace_back(u, number_in(fields));
    }
    line.similarity = number_in(fields);
    lines.push_back(line);
  }
  return lines;
}

}  // namespace placegraph::test
