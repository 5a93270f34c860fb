#include <placegraph/frontend/floor_plan/room_partition.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

constexpr double kBehind_m = 0.12;  ///< how thick a surface is taken to be, away from its viewer
const std::array<cv::Point, 4> kAround{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

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

  /// The surface between two places along it, each with its offset.
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

  /// A line that parts boxes: of a wall that has some length.
  void cut(int axis, double offset) {
    cuts_[axis].push_back(axis == 0 ? voxels_.column_of(offset) : voxels_.row_of(offset));
  }
  void enter(const Eigen::Vector3d& p) {
    path_.emplace_back(voxels_.column_of(p[0]), voxels_.row_of(p[1]));
  }

  RoomPartition partition() {
    const int closing = std::max(1, cells(options_.closing_m));
    cv::Mat1b space;
    cv::morphologyEx(free_, space, cv::MORPH_CLOSE, disc(closing));
    space.setTo(0, blocked_);
    // Rooms are what is left where necks are cut; each takes back what is nearest to it.
    cv::Mat1f distance;
    cv::distanceTransform(space, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    const cv::Mat1b wide = distance > 0.5 * options_.neck_m / voxels_.cell_m();
    cv::Mat1i kernels;
    int count = cv::connectedComponents(wide, kernels, 4, CV_32S);
    grow(space, kernels);
    const std::vector<char> entered = entered_of(kernels, count);
    for (int k = 1; k < count; ++k)
      if (entered[k]) fill_shadows(kernels, k, entered);
    complete(kernels, entered);
    RoomPartition result;
    result.room_of_cell = Image(space.size(), CV_32SC1, cv::Scalar(0));
    for (int k = 1; k < count; ++k) add_room(kernels == k, distance, result);
    return result;
  }

 private:
  int cells(double metres) const {
    return static_cast<int>(std::lround(metres / voxels_.cell_m()));
  }
  static Image disc(int radius) {
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
  }

  /// Breadth first from all kernels at once, through free cells only.
  static void grow(const cv::Mat1b& space, cv::Mat1i& rooms) {
    std::vector<cv::Point> front;
    for (int r = 0; r < rooms.rows; ++r)
      for (int c = 0; c < rooms.cols; ++c)
        if (rooms(r, c)) front.emplace_back(c, r);
    while (!front.empty()) {
      std::vector<cv::Point> next;
      for (const cv::Point& p : front)
        for (const cv::Point& d : kAround) {
          const cv::Point q = p + d;
          if (q.x < 0 || q.y < 0 || q.x >= rooms.cols || q.y >= rooms.rows) continue;
          if (!space(q) || rooms(q)) continue;
          rooms(q) = rooms(p);
          next.push_back(q);
        }
      front.swap(next);
    }
  }

  /// Whether the path leads through each label.
  std::vector<char> entered_of(const cv::Mat1i& rooms, int count) const {
    std::vector<char> entered(static_cast<std::size_t>(count), 0);
    for (const cv::Point& p : path_)
      if (p.x >= 0 && p.y >= 0 && p.x < rooms.cols && p.y < rooms.rows && rooms(p))
        entered[rooms(p)] = 1;
    return entered;
  }

  /// A mask with all that lies between two of its cells along an axis, no barrier in between, and
  /// is as wide as a neck.
  cv::Mat1b span(const cv::Mat1b& own, const cv::Mat1b& barrier) const {
    cv::Mat1b grown = own.clone();
    const auto join = [&](cv::Mat1b& joined, cv::Point p, cv::Point step, int length) {
      for (int i = 0, last = -1; i < length; ++i, p += step) {
        if (barrier(p)) last = -1;
        if (!grown(p)) continue;
        if (last >= 0)
          for (int k = last + 1; k < i; ++k) joined(p - (i - k) * step) = 255;
        last = i;
      }
    };
    const Image neck = disc(std::max(1, cells(0.5 * options_.neck_m)));
    for (int before = -1, now = cv::countNonZero(grown); now != before;) {
      cv::Mat1b joined = grown.clone();
      for (int r = 0; r < own.rows; ++r) join(joined, {0, r}, {1, 0}, own.cols);
      for (int c = 0; c < own.cols; ++c) join(joined, {c, 0}, {0, 1}, own.rows);
      cv::morphologyEx(joined, joined, cv::MORPH_OPEN, neck);
      grown |= joined;
      before = now, now = cv::countNonZero(grown);
    }
    return grown;
  }

  /// What furniture hides of a room lies between cells of it that are seen and borders mostly on
  /// such; what walls take much of the border of is another room's.
  void fill_shadows(cv::Mat1i& rooms, int room, const std::vector<char>& entered) const {
    const cv::Mat1b own = rooms == room;
    cv::Mat1b barrier = blocked_.clone();
    for (std::size_t k = 1; k < entered.size(); ++k)
      if (entered[k] && static_cast<int>(k) != room)
        barrier.setTo(255, rooms == static_cast<int>(k));
    const cv::Mat1b shadows = span(own, barrier) & ~own;
    cv::Mat1i parts;
    const auto count = static_cast<std::size_t>(cv::connectedComponents(shadows, parts, 4, CV_32S));
    std::vector<int> open(count, 0), wall(count, 0), unseen(count, 0);
    for (int r = 1; r + 1 < rooms.rows; ++r)
      for (int c = 1; c + 1 < rooms.cols; ++c)
        if (const int part = parts(r, c))
          for (const cv::Point& d : kAround) {
            const cv::Point q = cv::Point(c, r) + d;
            if (parts(q) != part) ++(blocked_(q) ? wall : own(q) ? open : unseen)[part];
          }
    for (int r = 0; r < rooms.rows; ++r)
      for (int c = 0; c < rooms.cols; ++c)
        if (const int part = parts(r, c);
            part && open[part] > unseen[part] &&
            wall[part] <= options_.walled_share * (wall[part] + open[part]))
          rooms(r, c) = room;
  }

  /// Number of the strip between cuts of every column or row; -1 outside of all.
  static std::vector<int> strips(std::vector<int> cuts, int size) {
    std::sort(cuts.begin(), cuts.end());
    std::vector<int> strip(static_cast<std::size_t>(size), -1);
    for (int i = 0; i < size; ++i) {
      const auto next = std::upper_bound(cuts.begin(), cuts.end(), i);
      if (next != cuts.begin() && next != cuts.end())
        strip[i] = static_cast<int>(next - cuts.begin());
    }
    return strip;
  }

  /// Boxes between the lines of walls that are mostly one entered room's become its own.
  void complete(cv::Mat1i& rooms, const std::vector<char>& entered) const {
    const std::vector<int> column = strips(cuts_[0], rooms.cols),
                           row = strips(cuts_[1], rooms.rows);
    std::map<std::pair<int, int>, std::map<int, int>> boxes;  // cells by room, -1: all
    for (int r = 0; r < rooms.rows; ++r)
      for (int c = 0; c < rooms.cols; ++c) {
        if (column[c] < 0 || row[r] < 0 || blocked_(r, c)) continue;
        auto& box = boxes[{column[c], row[r]}];
        ++box[-1];
        if (rooms(r, c) > 0) ++box[rooms(r, c)];
      }
    for (int r = 0; r < rooms.rows; ++r)
      for (int c = 0; c < rooms.cols; ++c) {
        if (column[c] < 0 || row[r] < 0 || blocked_(r, c) || rooms(r, c)) continue;
        const auto& box = boxes[{column[c], row[r]}];
        for (const auto& [room, cells] : box)
          if (room > 0 && entered[room] && cells > options_.completed_share * box.at(-1))
            rooms(r, c) = room;
      }
  }

  /// Whether walls run along much of a hole's border.
  bool walled(const std::vector<cv::Point>& hole) const {
    int near = 0;
    for (const cv::Point& p : hole) {
      const cv::Rect about(p.x - 2, p.y - 2, 5, 5);
      near += cv::countNonZero(blocked_(about & cv::Rect({0, 0}, blocked_.size()))) > 0;
    }
    return near > options_.walled_share * static_cast<double>(hole.size());
  }

  std::vector<Eigen::Vector2d> polygon(const std::vector<cv::Point>& contour) const {
    std::vector<cv::Point> simple;
    cv::approxPolyDP(contour, simple, options_.outline_m / voxels_.cell_m(), true);
    std::vector<Eigen::Vector2d> points;
    // A contour runs through the middles of cells: the border is half a cell outside, about.
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

void visit(OptionVisitor& field, RoomPartitionOptions& o) {
  field("min_area_m2", o.min_area_m2, "of a room", {0.1, 1000});
  field("neck_m", o.neck_m, "free space narrower than this parts rooms", {0, 5});
  field("closing_m", o.closing_m, "unseen cells so near to free ones are free", {0, 5});
  field("completed_share", o.completed_share,
        "of a box between walls that is seen free: then all of it is", {0, 1});
  field("walled_share", o.walled_share,
        "of the border of an unseen part of a room: with more walls it is not the room's", {0, 1});
  field("outline_m", o.outline_m, "tolerance of a room's outline", {0.01, 5});
}

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
  constexpr double kCutting_m = 0.8;
  for (const WallPiece& wall : walls)
    if (wall.to_m - wall.from_m > kCutting_m) partitioner.cut(wall.axis, wall.offset_m);
  for (const Eigen::Vector3d& p : path) partitioner.enter(p);
  return partitioner.partition();
}

}  // namespace placegraph
