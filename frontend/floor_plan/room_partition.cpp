#include <placegraph/frontend/floor_plan/room_completion.h>
#include <placegraph/frontend/floor_plan/room_partition.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Maximum distance from free cells at which unseen cells count as free. Chosen; three cells.
constexpr double kClosing_m = 0.15;
/// Share of a box between walls above which all of it is added to the room: most
/// (docs/floor_plan.md).
constexpr double kCompletedShare = 0.5;
/// Maximum share of walls in the border of an unseen part that is filled: a fifth
/// (docs/floor_plan.md).
constexpr double kWalledShare = 0.2;
/// Maximum error of the polygon that outlines a room. Chosen.
constexpr double kOutline_m = 0.08;

constexpr double kBehind_m = 0.12;  ///< assumed thickness of a surface, away from its viewer

Image disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

/// Grows all kernels together, breadth first, through free cells only.
void grow(const cv::Mat1b& space, cv::Mat1i& rooms) {
  std::vector<cv::Point> front;
  for (int r = 0; r < rooms.rows; ++r)
    for (int c = 0; c < rooms.cols; ++c)
      if (rooms(r, c)) front.emplace_back(c, r);
  while (!front.empty()) {
    std::vector<cv::Point> next;
    for (const cv::Point& p : front)
      for (const cv::Point& d : kSideBySide) {
        const cv::Point q = p + d;
        if (q.x < 0 || q.y < 0 || q.x >= rooms.cols || q.y >= rooms.rows) continue;
        if (!space(q) || rooms(q)) continue;
        rooms(q) = rooms(p);
        next.push_back(q);
      }
    front.swap(next);
  }
}

/// Whether the path goes through each label.
std::vector<char> entered_of(const std::vector<cv::Point>& path, const cv::Mat1i& rooms,
                             int count) {
  std::vector<char> entered(static_cast<std::size_t>(count), 0);
  for (const cv::Point& p : path)
    if (p.x >= 0 && p.y >= 0 && p.x < rooms.cols && p.y < rooms.rows && rooms(p))
      entered[rooms(p)] = 1;
  return entered;
}

class Partitioner {
 public:
  Partitioner(const VoxelEvidence& voxels, const RoomPartitionOptions& options)
      : voxels_(voxels),
        options_(options),
        free_(voxels.rows(), voxels.columns(), static_cast<uchar>(0)),
        blocked_(free_.clone()) {
    const int first = std::max(0, voxels.layer_of(0.2));
    for (int r = 0; r < voxels.rows(); ++r)
      for (int c = 0; c < voxels.columns(); ++c)
        for (int l = first; l < voxels.layers() && !free_(r, c); ++l)
          if (voxels.passes(c, r, l) >= 3 && voxels.passes(c, r, l) > voxels.hits(c, r, l))
            free_(r, c) = 255;
  }

  /// Blocks the surface between two positions along it, each with its offset.
  void block(int axis, int sign, double from, double offset_from, double to, double offset_to) {
    const double reach = 0.05, half = 0.5 * kBehind_m;
    const double length = to - from + 2 * reach;
    const int steps = std::max(1, static_cast<int>(std::ceil(length / voxels_.cell_m())));
    for (int k = 0; k <= steps; ++k) {
      const double along = from - reach + length * k / steps;
      const double share = (along - from) / std::max(1e-9, to - from);
      const double offset = offset_from + share * (offset_to - offset_from) - sign * half;
      double low[2], high[2];
      low[1 - axis] = along, high[1 - axis] = along;
      low[axis] = offset - half, high[axis] = offset + half - 1e-6;
      const cv::Point a(voxels_.column_of(low[0]), voxels_.row_of(low[1])),
          b(voxels_.column_of(high[0]), voxels_.row_of(high[1]));
      cv::rectangle(blocked_, a, b, 255, cv::FILLED);
    }
  }

  /// Adds a line between boxes, along a wall of some length.
  void cut(int axis, double offset) {
    cuts_[axis].push_back(axis == 0 ? voxels_.column_of(offset) : voxels_.row_of(offset));
  }
  void enter(const Eigen::Vector3d& p) {
    path_.emplace_back(voxels_.column_of(p[0]), voxels_.row_of(p[1]));
  }

  RoomPartition partition() {
    const int closing = std::max(1, cells(kClosing_m));
    cv::Mat1b space;
    cv::morphologyEx(free_, space, cv::MORPH_CLOSE, disc(closing));
    space.setTo(0, blocked_);
    // Rooms are the parts left after cutting at necks; each is then extended to its nearest cells.
    cv::Mat1f distance;
    cv::distanceTransform(space, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    const cv::Mat1b wide = distance > 0.5 * options_.neck_m / voxels_.cell_m();
    RoomGrid grid;
    const int count = cv::connectedComponents(wide, grid.rooms, 4, CV_32S);
    grow(space, grid.rooms);
    grid.blocked = blocked_;
    grid.entered = entered_of(path_, grid.rooms, count);
    const Image neck = disc(std::max(1, cells(0.5 * options_.neck_m)));
    for (int k = 1; k < count; ++k)
      if (grid.entered[k]) fill_shadows(grid, k, neck, kWalledShare);
    fill_boxes(grid, cuts_, kCompletedShare);
    RoomPartition result;
    result.room_of_cell = Image(space.size(), CV_32SC1, cv::Scalar(0));
    for (int k = 1; k < count; ++k) add_room(grid.rooms == k, distance, result);
    return result;
  }

 private:
  int cells(double metres) const {
    return static_cast<int>(std::lround(metres / voxels_.cell_m()));
  }

  /// Whether walls are along much of a hole's border.
  bool walled(const std::vector<cv::Point>& hole) const {
    int near = 0;
    for (const cv::Point& p : hole) {
      const cv::Rect about(p.x - 2, p.y - 2, 5, 5);
      near += cv::countNonZero(blocked_(about & cv::Rect({0, 0}, blocked_.size()))) > 0;
    }
    return near > kWalledShare * static_cast<double>(hole.size());
  }

  std::vector<Eigen::Vector2d> polygon(const std::vector<cv::Point>& contour) const {
    std::vector<cv::Point> simple;
    cv::approxPolyDP(contour, simple, kOutline_m / voxels_.cell_m(), true);
    std::vector<Eigen::Vector2d> points;
    // A contour goes through the middles of cells: the border is about half a cell outside.
    for (const cv::Point& p : simple)
      points.push_back(voxels_.low().head<2>() +
                       voxels_.cell_m() * Eigen::Vector2d(p.x + 0.5, p.y + 0.5));
    return points;
  }

  void add_room(const cv::Mat1b& mask, const cv::Mat1f& distance, RoomPartition& result) const {
    std::vector<std::vector<cv::Point>> contours;
    std::vector<cv::Vec4i> tree;
    cv::findContours(mask, contours, tree, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
    int outer = -1;
    for (int i = 0; i < static_cast<int>(contours.size()); ++i)
      if (tree[i][3] < 0 && (outer < 0 || contours[i].size() > contours[outer].size())) outer = i;
    if (outer < 0) return;
    RoomPartition::Room room;
    cv::Mat1b filled(mask.size(), static_cast<uchar>(0));
    cv::drawContours(filled, contours, outer, 255, cv::FILLED);
    for (int i = tree[outer][2]; i >= 0; i = tree[i][0]) {
      if (!walled(contours[i])) continue;
      cv::Mat1b hole(mask.size(), static_cast<uchar>(0));
      cv::drawContours(hole, contours, i, 255, cv::FILLED);
      filled.setTo(0, hole & ~mask);
      room.holes.push_back(polygon(contours[i]));
    }
    room.area_m2 = cv::countNonZero(filled) * voxels_.cell_m() * voxels_.cell_m();
    if (room.area_m2 < options_.min_area_m2) return;
    double widest = 0;
    cv::minMaxLoc(distance, nullptr, &widest, nullptr, nullptr, mask);
    room.width_m = 2 * widest * voxels_.cell_m();
    room.outline = polygon(contours[outer]);
    result.rooms.push_back(std::move(room));
    result.room_of_cell.setTo(static_cast<double>(result.rooms.size()), filled);
  }

  const VoxelEvidence& voxels_;
  const RoomPartitionOptions& options_;
  cv::Mat1b free_, blocked_;
  std::array<std::vector<int>, 2> cuts_;
  std::vector<cv::Point> path_;
};

}  // namespace

RoomPartition partition_rooms(const VoxelEvidence& voxels, const std::vector<WallPiece>& walls,
                              const std::vector<DoorPiece>& doors,
                              const std::vector<Eigen::Vector3d>& path,
                              const RoomPartitionOptions& options) {
  options.check();
  Partitioner partitioner(voxels, options);
  for (const WallPiece& wall : walls)
    partitioner.block(wall.axis, wall.sign, wall.from_m, wall.offset_at(wall.from_m), wall.to_m,
                      wall.offset_at(wall.to_m));
  for (const DoorPiece& door : doors)
    partitioner.block(door.axis, door.sign, door.from_m, door.offset_m, door.to_m, door.offset_m);
  // Length of a wall whose line cuts the plan. Chosen.
  constexpr double kCutting_m = 0.8;
  for (const WallPiece& wall : walls)
    if (wall.to_m - wall.from_m > kCutting_m) partitioner.cut(wall.axis, wall.offset_m);
  for (const Eigen::Vector3d& p : path) partitioner.enter(p);
  return partitioner.partition();
}

}  // namespace placegraph
