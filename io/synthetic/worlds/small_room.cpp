#include <placegraph/io/synthetic/worlds/small_room.h>

#include <algorithm>
#include <cmath>

namespace placegraph::synthetic {
namespace {

/// Furnishes one wall: positions are along it from its first end, out of it, and up [m].
class WallFurnisher {
 public:
  WallFurnisher(const PlanWall& wall, Scene& scene, Random& random)
      : scene_(scene), random_(random), length_((wall.b - wall.a).norm()) {
    along_ = (wall.b - wall.a) / length_;
    out_ = Eigen::Vector2d(-along_[1], along_[0]);
    origin_ = wall.a + (0.5 * wall.thickness_m + 0.02) * out_;
  }

  /// Piece after piece; the end of the wall is left to the furniture of the next one.
  void furnish(int first_kind) {
    const double end = length_ - SmallRoom::kFurnitureDepth_m - 0.2;
    int kind = first_kind;
    for (double at = 0.15; at < end - 0.4; at += random_.uniform(0.05, 0.35)) {
      const double room = end - at;
      switch (kind++ % 4) {
        case 0:
          at += add_desk(at, std::min(room, random_.uniform(1.1, 1.6)));
          break;
        case 1:
          at += add_shelf(at, std::min(room, random_.uniform(0.7, 1.1)));
          break;
        case 2:
          at += add_boxes(at, std::min(room, random_.uniform(0.4, 0.8)));
          break;
        default:
          at += add_cabinet(at, std::min(room, random_.uniform(0.6, 1.1)));
      }
    }
  }

 private:
  void put(double at, double off, double up, const Eigen::Vector3d& size, Material material,
           double angle = 0) {
    const Eigen::Vector2d centre =
        origin_ + (at + 0.5 * size[0]) * along_ + (off + 0.5 * size[2]) * out_;
    const Eigen::Vector2d axis = std::cos(angle) * along_ + std::sin(angle) * out_;
    add_furniture(scene_, centre, axis, size, -up, material, random_.next());
  }

  /// Small things on a surface of `width` x `depth`, some of them a little askew.
  void put_things(double at, double width, double depth, double up, double tallest) {
    for (double s = at + random_.uniform(0.02, 0.1); s < at + width - 0.08;) {
      const double w = std::min(random_.uniform(0.06, 0.32), at + width - s - 0.02),
                   h = random_.uniform(0.25, 1) * tallest,
                   d = std::min(random_.uniform(0.06, 0.3), 0.8 * depth);
      const double off = random_.uniform(0.1, 0.9) * (depth - d);
      const Material material = random_.uniform() < 0.7 ? Material::kCarton : Material::kShelf;
      put(s, off, up, {w, h, d}, material, random_.uniform(-0.3, 0.3));
      s += w + random_.uniform(0.02, 0.2);
    }
  }

  double add_desk(double at, double width) {
    const double depth = random_.uniform(0.6, SmallRoom::kFurnitureDepth_m), top = 0.74;
    const double screen = std::min(0.55, 0.5 * width);
    put(at, 0, top - 0.04, {width, 0.04, depth}, Material::kCarton);
    for (const double s : {0.02, width - 0.06})
      put(at + s, 0.03, 0, {0.04, top - 0.04, depth - 0.06}, Material::kShelf);
    const double screen_at = at + random_.uniform(0.1, 0.9) * (width - screen);
    put(screen_at + 0.5 * screen - 0.05, 0.2, top, {0.1, 0.12, 0.05}, Material::kShelf);
    put(screen_at, 0.22, top + 0.12, {screen, 0.33, 0.04}, Material::kCarton,
        random_.uniform(-0.15, 0.15));
    put_things(at, width, depth, top, 0.22);
    return width;
  }

  double add_shelf(double at, double width) {
    const double depth = random_.uniform(0.28, 0.38), height = random_.uniform(1.5, 2.0);
    const int boards = 4 + random_.index(2);
    const double gap = (height - 0.1) / (boards - 1);
    for (const double s : {0.0, width - 0.03})
      put(at + s, 0, 0, {0.03, height, depth}, Material::kShelf);
    for (int i = 0; i < boards; ++i) {
      const double up = 0.06 + i * gap;
      put(at + 0.03, 0, up, {width - 0.06, 0.025, depth}, Material::kDoor);
      put_things(at + 0.04, width - 0.1, depth, up + 0.025, i + 1 < boards ? 0.8 * gap : 0.3);
    }
    return width;
  }

  double add_cabinet(double at, double width) {
    const double depth = random_.uniform(0.4, 0.55), height = random_.uniform(0.7, 1.2);
    put(at, 0, 0, {width, height, depth}, Material::kDoor);
    put_things(at, width, depth, height, 0.35);
    return width;
  }

  double add_boxes(double at, double width) {
    const double depth = random_.uniform(0.35, 0.6);
    for (double up = 0; up < 1.0;) {
      const double height = random_.uniform(0.25, 0.5), inset = random_.uniform(0, 0.08);
      put(at + inset, inset, up, {width - 2 * inset, height, depth - 2 * inset}, Material::kCarton,
          random_.uniform(-0.1, 0.1));
      up += height;
    }
    return width;
  }

  Scene& scene_;
  Random& random_;
  double length_;
  Eigen::Vector2d along_, out_, origin_;
};

}  // namespace

SmallRoom build_small_room(Scene& scene, Random& random) {
  SmallRoom room;
  room.size = {random.uniform(4.6, 5.4), random.uniform(3.8, 4.4)};
  room.height_m = random.uniform(2.4, 2.8);
  room.plan.rooms = {
      {"room", {0, 0}, room.size, room.height_m, static_cast<float>(random.uniform())}};
  room.plan.add_ring({0, 0}, room.size, room.height_m);
  build_rooms(room.plan, scene);
  const int first_kind = random.index(4);
  for (std::size_t i = 0; i < room.plan.walls.size(); ++i)
    WallFurnisher(room.plan.walls[i], scene, random).furnish(first_kind + static_cast<int>(i));
  return room;
}

}  // namespace placegraph::synthetic
