#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/indoor_walk.h>

#include <algorithm>
#include <string>

namespace placegraph::synthetic {
namespace {

// Plan: a hall with five rows of racks, along its west side an office wing of three rooms.
constexpr double kHall_x0 = 6, kHall_x1 = 32, kDepth = 30, kHallHeight = 6, kOfficeHeight = 2.8;
constexpr double kRacks_z0 = 5, kRacks_z1 = 25;
constexpr double kRack_x[] = {10, 14.5, 19, 23.5, 28};  ///< middles of the racks
constexpr double kRackDepth = 1.2, kBay = 2.5;

BuildingLayout make_plan() {
  using Leaf = Opening::Leaf;
  BuildingLayout plan;
  plan.rooms = {{"hall", {kHall_x0, 0}, {kHall_x1, kDepth}, kHallHeight, 1},
                {"office", {0, 0}, {kHall_x0, 10}, kOfficeHeight, 0.5F},
                {"meeting room", {0, 10}, {kHall_x0, 20}, kOfficeHeight, 0.5F},
                {"dispatch", {0, 20}, {kHall_x0, kDepth}, kOfficeHeight, 0}};
  plan.add_ring({0, 0}, {kHall_x1, kDepth}, kHallHeight, 0.3);
  const double h = 2.1;
  // Each office has a door to the hall and doors to its neighbours.
  plan.walls.push_back(
      {{kHall_x0, 0},
       {kHall_x0, kDepth},
       kHallHeight,
       0.2,
       {{1.9, 3.3, h, Leaf::kNone}, {14.5, 15.5, h, Leaf::kClosed}, {26.6, 28.2, h, Leaf::kNone}}});
  plan.walls.push_back(
      {{0, 10}, {kHall_x0, 10}, kOfficeHeight, 0.14, {{2.4, 3.6, h, Leaf::kOpenLeft}}});
  plan.walls.push_back(
      {{0, 20}, {kHall_x0, 20}, kOfficeHeight, 0.14, {{2.4, 3.6, h, Leaf::kOpenLeft}}});
  return plan;
}

/// Racks: posts, shelves at three heights, cartons on every shelf.
void add_rack(Scene& scene, double x, Random& random) {
  const std::uint32_t steel = random.next();
  const Eigen::Vector2d axis(0, 1);
  const double levels[] = {0.15, 1.65, 3.15};
  const double middle = 0.5 * (kRacks_z0 + kRacks_z1), length = kRacks_z1 - kRacks_z0;
  for (double z = kRacks_z0; z <= kRacks_z1 + 0.01; z += kBay) {
    for (const double side : {-0.5, 0.5})
      add_furniture(scene, {x + side * (kRackDepth - 0.1), z}, axis, {0.1, 4.6, 0.1}, 0,
                    Material::kShelf, steel);
  }
  for (const double y : levels) {
    add_furniture(scene, {x, middle}, axis, {length, 0.1, kRackDepth}, -y + 0.1, Material::kShelf,
                  steel + 1);
    for (double z = kRacks_z0 + 0.2; z < kRacks_z1 - 0.8;) {
      const double w = random.uniform(0.4, 1.15), h = random.uniform(0.3, 1.15),
                   d = random.uniform(0.5, 1.05);
      if (random.uniform() < 0.82 && z + w < kRacks_z1 - 0.1)
        add_furniture(scene, {x + random.uniform(-0.06, 0.06), z + 0.5 * w}, axis, {w, h, d}, -y,
                      Material::kCarton, random.next());
      z += w + random.uniform(0.05, 0.5);
    }
  }
}

void furnish(Scene& scene, const PlanRoom& room, Random& random) {
  // Along the outer (west) wall and the hall's wall, clear of the path through the middle.
  for (double z = room.low[1] + 0.8; z < room.high[1] - 1.2; z += random.uniform(1.6, 2.6)) {
    const bool desk = random.uniform() < 0.5;
    add_furniture(scene, {0.75, z}, {0, 1}, {1.2, desk ? 0.75 : 1.8, 0.7}, 0,
                  desk ? Material::kCarton : Material::kShelf, random.next());
    if (z > room.low[1] + 4.5 && z < room.high[1] - 4.5) {
      add_furniture(scene, {kHall_x0 - 0.5, z}, {0, 1}, {1.1, random.uniform(0.7, 1.6), 0.5}, 0,
                    Material::kCarton, random.next());
    }
  }
}

}  // namespace

Tour make_warehouse(const TourRequest& request) {
  Random random(request.seed, 41);
  Tour tour;
  tour.name = "warehouse";
  tour.scene.outdoor = false;
  tour.scene.seed = mix_bits(static_cast<std::uint32_t>(request.seed) * 2654435761U + 177U);
  const BuildingLayout plan = make_plan();
  build_rooms(plan, tour.scene);
  for (const double x : kRack_x) add_rack(tour.scene, x, random);
  for (std::size_t i = 1; i < plan.rooms.size(); ++i) furnish(tour.scene, plan.rooms[i], random);
  // Pallets and columns along the hall's ends.
  for (double x = 9; x < kHall_x1 - 1.5; x += random.uniform(2.2, 3.4)) {
    add_furniture(tour.scene, {x, 0.8}, {1, 0}, {1.2, random.uniform(0.4, 1.6), 0.9}, 0,
                  Material::kCarton, random.next());
    add_furniture(tour.scene, {x + 0.6, kDepth - 0.8}, {1, 0}, {1.2, random.uniform(0.4, 1.6), 0.9},
                  0, Material::kCarton, random.next());
  }
  const double aisle[] = {8, 12.25, 16.75, 21.25, 25.75, 30.2};
  const double south = 2.6, north = 27.4;
  IndoorWalk walk;
  walk.speed_mps = 1.4;
  walk.corners = {{aisle[0], 5},     {aisle[0], north}, {aisle[1], north}, {aisle[1], south},
                  {aisle[3], south}, {aisle[3], north}, {aisle[0], north}, {3, north},
                  {3, south},        {aisle[0], south}, {aisle[0], north}, {aisle[1], north},
                  {aisle[1], 8}};
  walk_through(plan, walk, tour.scene.seed, tour);
  return tour;
}

}  // namespace placegraph::synthetic
