#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/io/synthetic/render/height_surface.h>
#include <placegraph/io/synthetic/render/road_field.h>
#include <placegraph/io/synthetic/render/world.h>

namespace placegraph::synthetic {

constexpr double kKerb_m = 0.12;          ///< height of the pavement above the road
constexpr double kCarHalfWidth_m = 0.95;  ///< half the width of the camera's car
constexpr double kClearance_m = 0.6;      ///< least distance between that car and a solid

/// The inputs of a town.
struct TownPlan {
  std::vector<Roadway> roads;
  GroundMesh ground;
  std::vector<Eigen::Vector2d> driven;  ///< (x, z) of every camera position: stays free of solids
  std::uint64_t seed = 1;
};

/// Fills a scene with ground, houses, trees, poles, signs, fences and parked cars along the roads.
/// Every solid is off the asphalt and off the driven path.
Scene build_town(const TownPlan& plan);

/// The state shared by the builders of one town: the occupied ground.
class TownSite {
 public:
  TownSite(const TownPlan& plan, Scene& scene);

  const TownPlan& plan;
  Scene& scene;
  const RoadField& road;
  Random random;

  double ground(const Eigen::Vector2d& p) const { return plan.ground.height(p[0], p[1]); }
  /// Height (y) of the walkable ground: the road, or the pavement 12 cm above it.
  double walkway(const Eigen::Vector2d& p) const { return ground(p) - kKerb_m; }
  /// Whether a solid may be placed here: all of it at least `min_edge_m` off the asphalt, clear of
  /// the driven path and of all previous solids.
  bool is_free(const Footprint& footprint, double min_edge_m) const;
  /// Adds a finished part and, if given, the ground it occupies.
  void add(Part part);
  void add(Part part, const Footprint& footprint);

 private:
  std::vector<std::vector<int>> buckets_;  // indices into scene.solids by 20 m squares
  int nx_ = 0, nz_ = 0;
  template <class Fn>
  bool any_near(const Footprint& footprint, const Fn& hit) const;
  std::vector<std::vector<int>> driven_buckets_;
};

/// One step along a roadway's side: position on its edge, direction of travel, outward normal.
struct Station {
  Eigen::Vector2d centre, along, outward;
  double half_width_m = 0;
};
/// The roadway's point at arc length `s` [m], seen from side -1 (left) or +1; nothing beyond the
/// end.
std::optional<Station> station(const Roadway& roadway, double s, int side);
double length(const Roadway& roadway);

void build_ground(TownSite& site);
void build_houses(TownSite& site);
void build_furniture(TownSite& site);

/// A car of about 4.2 x 1.7 x 1.45 m: its frame has x right, y down, z forward, origin on the
/// ground below its centre.
Part make_car(std::uint32_t seed);
/// The part moved to `T_scene_part`.
Part transformed(const Part& part, const SE3& T_scene_part);

}  // namespace placegraph::synthetic
