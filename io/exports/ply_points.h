#pragma once
#include <placegraph/io/exports/number_form.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph {

/// A point of an exported cloud.
struct ColouredPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position in the frame of the cloud
  std::array<std::uint8_t, 3> rgb{};                   ///< red, green, blue
  double sigma = 0;  ///< standard deviation of the position in its worst direction; NaN: unknown
};

/// A PLY file of points: float x y z, uchar red green blue, float sigma_m.
/// Comments stand in its header, one line each. Throws ArgumentError for a comment with a line end.
std::string to_ply(const std::vector<ColouredPoint>& points, NumberForm form,
                   const std::vector<std::string>& comments = {});

}  // namespace placegraph
