#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/indoor_walk.h>

#include <algorithm>
#include <string>

namespace placegraph::synthetic {
namespace {

// Plan: offices around the outside, a ring of corridor, a core of store rooms.
constexpr double kLong = 28, kWide = 20;      ///< the building [m]
constexpr double kOuter = 4.4, kInner = 6.6;  ///< the corridor's walls, from each outside
constexpr double kHeight = 2.7;

/// Doors into `rooms` rooms of equal width along a wall; open ones swing into the room.
std::vector<Opening> doors(double length, int rooms, Opening::Leaf open, Random& random) {
  std::vector<Opening> openings;
  const double pitch = length / rooms;
  for (int i = 0; i < rooms; ++i) {
    const double at = pitch * i + random.uniform(0.6, pitch - 1.7);
    const auto leaf = random.uniform() < 0.45 ? open : Opening::Leaf::kClosed;
    openings.push_back({at, at + random.uniform(0.85, 1.0), random.uniform(2.0, 2.15), leaf});
  }
  return openings;
}

void furnish(const PlanRoom& room, Scene& scene, Random& random) {
  const Eigen::Vector2d size = room.high - room.low;
  const int pieces = static_cast<int>(2 + size[0] * size[1] / 6);
  for (int i = 0; i < pieces; ++i) {
    const double w = random.uniform(0.5, 1.6), d = random.uniform(0.4, 0.8),
                 h = random.uniform() < 0.5 ? random.uniform(0.7, 0.8) : random.uniform(1.0, 2.0);
    const Eigen::Vector2d p(random.uniform(room.low[0] + 0.3 + w, room.high[0] - 0.3 - w),
                            random.uniform(room.low[1] + 0.3 + w, room.high[1] - 0.3 - w));
    const Footprint f{p, {1, 0}, 0.5 * w + 0.1, 0.5 * d + 0.1};
    const bool taken = std::any_of(scene.solids.begin(), scene.solids.end(),
                                   [&](const Footprint& s) { return s.overlaps(f); });
    const Material material = random.uniform() < 0.5 ? Material::kCarton : Material::kShelf;
    if (!taken) add_furniture(scene, p, {1, 0}, {w, h, d}, 0, material, random.next());
  }
}

BuildingLayout make_plan(Random& random) {
  BuildingLayout plan;
  plan.add_ring({0, 0}, {kLong, kWide}, kHeight, 0.3);
  const std::size_t outer = plan.walls.size();
  plan.add_ring({kOuter, kOuter}, {kLong - kOuter, kWide - kOuter}, kHeight);
  const std::size_t inner = plan.walls.size();
  plan.add_ring({kInner, kInner}, {kLong - kInner, kWide - kInner}, kHeight);
  const double l = kLong - 2 * kOuter, w = kWide - 2 * kOuter;
  constexpr int kAlong = 5, kAcross = 3, kCore = 4;
  for (const int i : {0, 2})
    plan.walls[outer + i].openings = doors(l, kAlong, Opening::Leaf::kOpenRight, random);
  for (const int i : {1, 3})
    plan.walls[outer + i].openings = doors(w, kAcross, Opening::Leaf::kOpenRight, random);
  const double core = kLong - 2 * kInner, depth = kWide - 2 * kInner;
  for (const int i : {0, 2})
    plan.walls[inner + i].openings = doors(core, kCore, Opening::Leaf::kOpenLeft, random);

  // The corridor's floor runs under its four sides.
  const double a = kOuter, b = kInner, x1 = kLong - kOuter, z1 = kWide - kOuter;
  plan.rooms.push_back({"corridor south", {a, a}, {x1, b}, kHeight, 0});
  plan.rooms.push_back({"corridor north", {a, kWide - b}, {x1, z1}, kHeight, 0});
  plan.rooms.push_back({"corridor west", {a, b}, {b, kWide - b}, kHeight, 0});
  plan.rooms.push_back({"corridor east", {kLong - b, b}, {x1, kWide - b}, kHeight, 0});
  const auto add_rooms = [&](Eigen::Vector2d low, Eigen::Vector2d high, int axis, int count,
                             const std::string& name) {
    const double step = (high[axis] - low[axis]) / count;
    for (int i = 0; i < count; ++i) {
      PlanRoom room{name + " " + std::to_string(i + 1), low, high, kHeight,
                    static_cast<float>(random.uniform())};
      room.low[axis] = low[axis] + i * step;
      room.high[axis] = low[axis] + (i + 1) * step;
      plan.rooms.push_back(room);
      if (i == 0) continue;
      Eigen::Vector2d p = room.low, q = room.high;
      q[axis] = p[axis];
      plan.walls.push_back({p, q, kHeight, 0.12, {}});
    }
  };
  add_rooms({a, 0}, {x1, a}, 0, kAlong, "office south");
  add_rooms({a, z1}, {x1, kWide}, 0, kAlong, "office north");
  add_rooms({0, a}, {a, z1}, 1, kAcross, "office west");
  add_rooms({x1, a}, {kLong, z1}, 1, kAcross, "office east");
  add_rooms({b, b}, {kLong - b, b + 0.5 * depth}, 0, kCore, "store south");
  add_rooms({b, b + 0.5 * depth}, {kLong - b, kWide - b}, 0, kCore, "store north");
  plan.walls.push_back({{b, b + 0.5 * depth}, {kLong - b, b + 0.5 * depth}, kHeight, 0.12, {}});
  // Four corner rooms without doors close the outline.
  const Eigen::Vector2d corners[4] = {{0, 0}, {x1, 0}, {0, z1}, {x1, z1}};
  for (const Eigen::Vector2d& low : corners) {
    plan.rooms.push_back({"shaft", low, low + Eigen::Vector2d(a, a), kHeight, 1});
    const Eigen::Vector2d in(low[0] > 1 ? low[0] : a, low[1] > 1 ? low[1] : a);
    plan.walls.push_back({{in[0], low[1]}, {in[0], low[1] + a}, kHeight, 0.12, {}});
    plan.walls.push_back({{low[0], in[1]}, {low[0] + a, in[1]}, kHeight, 0.12, {}});
  }
  return plan;
}

}  // namespace

Tour make_corridor_loop(const TourRequest& request) {
  Random random(request.seed, 31);
  Tour tour;
  tour.name = "corridor-loop";
  tour.scene.outdoor = false;
  tour.scene.seed = mix_bits(static_cast<std::uint32_t>(request.seed) * 2654435761U + 77U);
  const BuildingLayout plan = make_plan(random);
  build_rooms(plan, tour.scene);
  for (std::size_t i = 4; i < plan.rooms.size(); ++i) furnish(plan.rooms[i], tour.scene, random);
  // Furniture along the corridor's walls, clear of the walker's path.
  const double middle = 0.5 * (kOuter + kInner);
  for (double s = 7.5; s < kLong - 8; s += random.uniform(2.5, 5)) {
    const double h = random.uniform(0.6, 1.8);
    add_furniture(tour.scene, {s, kInner - 0.30}, {1, 0}, {random.uniform(0.4, 0.8), h, 0.3}, 0,
                  Material::kCarton, random.next());
    add_furniture(tour.scene, {s + 1, kWide - kInner + 0.30}, {1, 0},
                  {random.uniform(0.4, 0.8), h, 0.3}, 0, Material::kShelf, random.next());
  }
  const double x0 = middle, x1 = kLong - middle, z0 = middle, z1 = kWide - middle;
  IndoorWalk walk;
  walk.corners = {{x0, z0 + 1.5}, {x0, z1}, {x1, z1}, {x1, z0}, {x0, z0},
                  {x0, z1},       {x1, z1}, {x1, z0}, {x0, z0}, {x0, z0 + 3}};
  walk_through(plan, walk, tour.scene.seed, tour);
  return tour;
}

}  // namespace placegraph::synthetic
