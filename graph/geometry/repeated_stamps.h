#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A row of a trajectory that has the stamp of the row before, and is left out.
struct RepeatedStamp {
  std::size_t row = 0;                            ///< line of the file, or row of the array
  std::size_t kept = 0;                           ///< index of the kept pose of that stamp
  std::optional<Eigen::Isometry3d> T_world_body;  ///< pose of the row that is left out
};

/// One line about rows that are left out because their stamps stand twice; empty without any.
///
/// It names the first row, their number, and the greatest distance of one from the pose `kept` of
/// its stamp; and the row where that is farther than three times the motion from row to row (95 %
/// quantile) explains. The line begins with `before_row` and the row: "truth.tum:" gives
/// "truth.tum:172: ...".
std::string repeated_stamps_warning(const std::string& before_row,
                                    const std::vector<StampedPose>& kept,
                                    const std::vector<RepeatedStamp>& left_out);

}  // namespace placegraph
