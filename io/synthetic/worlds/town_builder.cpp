#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>

#include <algorithm>

namespace placegraph::synthetic {
namespace {
constexpr double kBucket_m = 20;
}

TownSite::TownSite(const TownPlan& town_plan, Scene& out)
    : plan(town_plan), scene(out), road(*out.road), random(town_plan.seed, 11) {
  nx_ = static_cast<int>((road.high()[0] - road.low()[0]) / kBucket_m) + 1;
  nz_ = static_cast<int>((road.high()[1] - road.low()[1]) / kBucket_m) + 1;
  buckets_.resize(static_cast<std::size_t>(nx_) * nz_);
  driven_buckets_.resize(buckets_.size());
  for (std::size_t i = 0; i < plan.driven.size(); ++i) {
    const Eigen::Vector2d at = (plan.driven[i] - road.low()) / kBucket_m;
    const int x = std::clamp(floor_int(at[0]), 0, nx_ - 1),
              z = std::clamp(floor_int(at[1]), 0, nz_ - 1);
    driven_buckets_[static_cast<std::size_t>(z) * nx_ + x].push_back(static_cast<int>(i));
  }
}

template <class Fn>
bool TownSite::any_near(const Footprint& f, const Fn& hit) const {
  // Every solid is in the bucket of its centre; half a house is smaller than a bucket.
  const double reach = std::hypot(f.half_length, f.half_width) + kBucket_m;
  const Eigen::Vector2d low = (f.centre.array() - reach - road.low().array()) / kBucket_m,
                        high = (f.centre.array() + reach - road.low().array()) / kBucket_m;
  for (int z = std::max(0, floor_int(low[1])); z <= std::min(nz_ - 1, floor_int(high[1])); ++z) {
    for (int x = std::max(0, floor_int(low[0])); x <= std::min(nx_ - 1, floor_int(high[0])); ++x) {
      if (hit(static_cast<std::size_t>(z) * nx_ + x)) return true;
    }
  }
  return false;
}

bool TownSite::is_free(const Footprint& f, double min_edge_m) const {
  const Eigen::Vector2d across(-f.axis[1], f.axis[0]);
  const int n = std::max(1, static_cast<int>(std::ceil(2 * f.half_length))),
            m = std::max(1, static_cast<int>(std::ceil(2 * f.half_width)));
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= m; ++j) {
      const Eigen::Vector2d p = f.centre + f.axis * (f.half_length * (2.0 * i / n - 1)) +
                                across * (f.half_width * (2.0 * j / m - 1));
      if (road.edge_distance(p[0], p[1]) < min_edge_m) return false;
    }
  }
  const bool blocked = any_near(f, [&](std::size_t bucket) {
    for (const int i : buckets_[bucket]) {
      if (scene.solids[i].overlaps(f)) return true;
    }
    for (const int i : driven_buckets_[bucket]) {
      if (f.distance(plan.driven[i]) < kCarHalfWidth_m + kClearance_m) return true;
    }
    return false;
  });
  return !blocked;
}

void TownSite::add(Part part) {
  part.finish();
  scene.parts.push_back(std::move(part));
}

void TownSite::add(Part part, const Footprint& footprint) {
  add(std::move(part));
  const Eigen::Vector2d at = (footprint.centre - road.low()) / kBucket_m;
  const int x = std::clamp(floor_int(at[0]), 0, nx_ - 1),
            z = std::clamp(floor_int(at[1]), 0, nz_ - 1);
  buckets_[static_cast<std::size_t>(z) * nx_ + x].push_back(static_cast<int>(scene.solids.size()));
  scene.solids.push_back(footprint);
}

std::optional<Station> station(const Roadway& roadway, double s, int side) {
  for (std::size_t i = 0; i + 1 < roadway.centre.size(); ++i) {
    const Eigen::Vector2d step = roadway.centre[i + 1] - roadway.centre[i];
    const double length = step.norm();
    if (s <= length && length > 0) {
      const Eigen::Vector2d along = step / length;
      const Eigen::Vector2d right(along[1], -along[0]);  // x right, z forward
      return Station{roadway.centre[i] + s * along, along, side * right, roadway.half_width_m};
    }
    s -= length;
  }
  return std::nullopt;
}

double length(const Roadway& roadway) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < roadway.centre.size(); ++i)
    sum += (roadway.centre[i + 1] - roadway.centre[i]).norm();
  return sum;
}

Part transformed(const Part& part, const SE3& T_scene_part) {
  Part out = part;
  for (Face& face : out.faces) {
    for (int i = 0; i < face.count; ++i) face.corners[i] = T_scene_part * face.corners[i];
    face.normal = T_scene_part.rotation() * face.normal;
    face.origin = T_scene_part * face.origin;
    face.s_axis = T_scene_part.rotation() * face.s_axis;
    face.t_axis = T_scene_part.rotation() * face.t_axis;
    face.light = outdoor_light(face.normal);
  }
  out.finish();
  return out;
}

Scene build_town(const TownPlan& plan) {
  Scene scene;
  scene.seed = mix_bits(static_cast<std::uint32_t>(plan.seed) * 2654435761U + 7U);
  scene.road = std::make_shared<RoadField>(plan.roads);
  TownSite site(plan, scene);
  build_ground(site);
  build_houses(site);
  build_furniture(site);
  return scene;
}

}  // namespace placegraph::synthetic
