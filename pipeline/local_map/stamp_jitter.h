#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <cstdint>
#include <deque>
#include <vector>

namespace placegraph {

/// Standard deviation of the stamps of frames about the times at which they were taken, from the
/// track alone: the distance along the path, as a function of the stamps, is smooth over five
/// frames. What the noise of the poses adds counts as noise of the stamps.
class StampJitter {
 public:
  /// Adds a frame of the track, in the order of the stamps.
  void add(std::int64_t stamp_ns, const SE3& T_odom_cam);
  /// The next frame belongs to another track.
  void restart() { last_.clear(); }
  /// The standard deviation [s], at most 5 ms; 0 with fewer than ten differences.
  double sigma_s() const { return sigma_s_; }
  void visit_state(auto& archive) { archive(differences_s_, sigma_s_); }

 private:
  struct Passed {
    double stamp_s, path_m;
    Eigen::Vector3d position;
  };
  std::deque<Passed> last_;            // at most five
  std::vector<double> differences_s_;  // absolute values
  double sigma_s_ = 0;
};

}  // namespace placegraph
