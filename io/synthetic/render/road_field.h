#pragma once
#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace placegraph::synthetic {

/// A strip of asphalt around a line, seen from above (x, z).
struct Roadway {
  std::vector<Eigen::Vector2d> centre;  ///< [m], steps of about 1-3 m
  double half_width_m = 4;
  bool marked = true;  ///< carries lane markings
  bool lined = true;   ///< houses and street furniture stand along it
};

/// The union of all roadways as fields over the plane: the distance of a point from the asphalt's
/// edge, and its position along and across the nearest marked roadway. Interpolated from a grid of
/// 1 m.
class RoadField {
 public:
  static constexpr double kReach_m = 30;  ///< edge_distance is exact up to here, constant beyond

  /// Throws ArgumentError if the roadways' extent is not finite or exceeds 20 km.
  explicit RoadField(const std::vector<Roadway>& roadways);

  struct Sample {
    float edge = 0;       ///< signed distance to the asphalt's edge [m], negative on the road
    bool marked = false;  ///< whether the rest is valid
    float along = 0, lateral = 0;  ///< [m] on the nearest marked roadway, right is positive
    float half_width = 0;
    std::uint32_t road = 0;
  };
  Sample sample(double x, double z) const;
  float edge_distance(double x, double z) const { return sample(x, z).edge; }

  const Eigen::Vector2d& low() const { return low_; }  ///< corner of the area with any road [m]
  const Eigen::Vector2d& high() const { return high_; }

 private:
  struct Node {
    float edge = static_cast<float>(kReach_m);
    float along = 0, lateral = 1e9F;
    std::int32_t road = -1;
  };
  void add(const Roadway& roadway, int index);

  Eigen::Vector2d low_, high_;
  int nx_ = 0, nz_ = 0;
  std::vector<Node> nodes_;
  std::vector<float> half_widths_;
};

}  // namespace placegraph::synthetic
