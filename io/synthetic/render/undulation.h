#pragma once
#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace placegraph::synthetic {

/// The unevenness of a road: smooth waves of 3 to 30 m in all directions, whose variance grows with
/// the wavelength as in the profiles of ISO 8608. Without waves it is level.
class Undulation {
 public:
  Undulation() = default;
  /// Waves whose heights have this root mean square; none if it is 0.
  Undulation(double rms_m, std::uint64_t seed);

  bool empty() const { return waves_.empty(); }
  /// Height to add to a ground whose y points down [m].
  double height(double x, double z) const;

 private:
  struct Wave {
    Eigen::Vector2d periods_per_m;
    double phase, amplitude_m;
  };
  std::vector<Wave> waves_;
};

}  // namespace placegraph::synthetic
