#include <placegraph/frontend/floor_plan/door_finder.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace placegraph {
namespace {

constexpr double kAlong_m = 0.05;
/// A door ends where nothing tells of it over this length, or no ray passes where no wall is seen.
constexpr double kUnseen_m = 0.4;
/// Where less than both jambs and a head are seen, what is wider is a passage of another kind.
constexpr double kWidest_m = 1.4;
/// So much of its points' deviation a leaf is farther behind its wall than min_recess_m.
constexpr double kRecessSigmas = 0.1;

/// What one step along a wall's surface shows at the height of doors.
struct Step {
  bool wall = false;           ///< the surface goes on down there
  bool recess = false;         ///< something stands a little behind it
  bool open = false;           ///< rays pass
  bool faced = false;          ///< rays pass in front of it
  bool over = false;           ///< rays pass above where a head would be
  std::optional<double> head;  ///< lowest height of the surface above a door's
};

/// All pieces on one plane: same side, offsets that agree.
struct Plane {
  int axis = 0, sign = 1;
  double offset_m = 0, from_m = 0, to_m = 0;
};

std::vector<Plane> planes_of(const std::vector<WallPiece>& walls, double reach_m) {
  std::vector<WallPiece> left = walls;
  std::sort(left.begin(), left.end(), [](const WallPiece& a, const WallPiece& b) {
    return a.to_m - a.from_m > b.to_m - b.from_m;
  });
  std::vector<Plane> planes;
  for (const WallPiece& piece : left) {
    bool joined = false;
    for (Plane& plane : planes) {
      if (plane.axis != piece.axis || plane.sign != piece.sign ||
          std::abs(plane.offset_m - piece.offset_m) > 0.1)
        continue;
      if (piece.from_m > plane.to_m + reach_m || piece.to_m < plane.from_m - reach_m) continue;
      plane.from_m = std::min(plane.from_m, piece.from_m);
      plane.to_m = std::max(plane.to_m, piece.to_m);
      joined = true;
      break;
    }
    if (!joined)
      planes.push_back({piece.axis, piece.sign, piece.offset_m, piece.from_m, piece.to_m});
  }
  return planes;
}

class PlaneProfile {
 public:
  PlaneProfile(const Plane& plane, const std::vector<PlacedPoint>& points,
               const VoxelEvidence& voxels, const std::vector<Eigen::Vector3d>& path,
               const DoorFinderOptions& options)
      : plane_(plane), options_(options) {
    from_ = plane.from_m - options.max_width_m;
    const int count =
        static_cast<int>((plane.to_m - plane.from_m + 2 * options.max_width_m) / kAlong_m) + 1;
    steps_.resize(count);
    take_points(points);
    take_voxels(voxels);
    crossings(path);
  }

  /// Those with wall at both sides into `doors`, those with one jamb into `half_seen`.
  void find(std::vector<DoorPiece>& doors, std::vector<DoorPiece>& half_seen) const {
    for (std::size_t i = 0; i < steps_.size();) {
      if (steps_[i].wall) {
        ++i;
        continue;
      }
      std::size_t end = i;
      while (end < steps_.size() && !steps_[end].wall) ++end;
      const bool between_walls = i > 0 && end < steps_.size();
      std::optional<DoorPiece> door;
      if (between_walls) door = judge(i, end);
      if (door)
        doors.push_back(*door);
      else
        find_crossed(i, end, half_seen);
      i = end;
    }
  }

 private:
  int step_of(double along) const {
    return static_cast<int>(std::floor((along - from_) / kAlong_m));
  }

  /// How far the surface lies behind the plane about each step: poses that drift bend it.
  void find_reference(const std::vector<PlacedPoint>& points) {
    constexpr int kReach = 24;  // steps
    std::vector<std::vector<double>> behind(steps_.size());
    for (const PlacedPoint& p : points) {
      if (p.normal[plane_.axis] * plane_.sign < 0.95F || p.sigma > 0.05F) continue;
      const int step = step_of(p.point[1 - plane_.axis]);
      const double b = plane_.sign * (plane_.offset_m - p.point[plane_.axis]);
      if (step >= 0 && step < static_cast<int>(steps_.size()) && p.point[2] > 0.25F &&
          std::abs(b) < 0.13)
        behind[step].push_back(b);
    }
    reference_.assign(steps_.size(), 0.0);
    for (int i = 0; i < static_cast<int>(steps_.size()); ++i) {
      // The surface is in front of the leaves in it: the lower third.
      std::vector<double> about;
      for (int k = std::max(0, i - kReach); k < std::min<int>(behind.size(), i + kReach + 1); ++k)
        about.insert(about.end(), behind[k].begin(), behind[k].end());
      if (about.size() < 10) continue;
      const auto third = about.begin() + static_cast<std::ptrdiff_t>(about.size() / 3);
      std::nth_element(about.begin(), third, about.end());
      reference_[i] = *third;
    }
  }

  void take_points(const std::vector<PlacedPoint>& points) {
    find_reference(points);
    std::vector<std::vector<double>> low(steps_.size()), sigmas(steps_.size()),
        heads(steps_.size());
    for (const PlacedPoint& p : points) {
      if (p.normal[plane_.axis] * plane_.sign < 0.9F || p.sigma > 0.1F) continue;
      const int step = step_of(p.point[1 - plane_.axis]);
      if (step < 0 || step >= static_cast<int>(steps_.size())) continue;
      const double behind =
          plane_.sign * (plane_.offset_m - p.point[plane_.axis]) - reference_[step];
      if (behind < -0.06 || behind > options_.max_recess_m) continue;
      if (p.point[2] > 0.25F && p.point[2] < options_.min_head_m - 0.1)
        for (int k = std::max(0, step - 1); k <= step + 1 && k < static_cast<int>(low.size()); ++k)
          low[k].push_back(behind), sigmas[k].push_back(p.sigma);
      if (p.point[2] > options_.min_head_m && behind < 0.5 * options_.min_recess_m + 0.01)
        for (int k = std::max(0, step - 2); k <= step + 2 && k < static_cast<int>(low.size()); ++k)
          heads[k].push_back(p.point[2]);
    }
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (low[i].size() >= 3) {
        const double least = options_.min_recess_m + kRecessSigmas * median_of(sigmas[i]);
        steps_[i].wall = median_of(low[i]) < least;
        steps_[i].recess = !steps_[i].wall;
      }
      if (heads[i].size() >= 3) {
        std::sort(heads[i].begin(), heads[i].end());
        steps_[i].head = heads[i][heads[i].size() / 20];
      }
    }
  }

  std::pair<int, int> cell_at(const VoxelEvidence& voxels, double along, double offset) const {
    double at[2];
    at[1 - plane_.axis] = along, at[plane_.axis] = offset;
    return {voxels.column_of(at[0]), voxels.row_of(at[1])};
  }

  static int layers_passed(const VoxelEvidence& voxels, int c, int r, int first, int last) {
    int passed = 0;
    for (int l = first; voxels.contains(c, r) && l <= last; ++l)
      passed += voxels.passes(c, r, l) >= 2 && voxels.passes(c, r, l) > 2 * voxels.hits(c, r, l);
    return passed;
  }

  void take_voxels(const VoxelEvidence& voxels) {
    const int first = std::max(0, voxels.layer_of(0.5)),
              last = std::min(voxels.layers() - 1, voxels.layer_of(options_.min_head_m - 0.2));
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const double along = from_ + (static_cast<double>(i) + 0.5) * kAlong_m;
      const double surface = plane_.offset_m - plane_.sign * reference_[i];
      const auto [c, r] = cell_at(voxels, along, surface - plane_.sign * 0.07);
      if (!voxels.contains(c, r)) continue;
      const int passed = layers_passed(voxels, c, r, first, last);
      const auto [front_c, front_r] = cell_at(voxels, along, surface + plane_.sign * 0.3);
      steps_[i].faced = layers_passed(voxels, front_c, front_r, first, last) >= 2;
      for (int l = voxels.layer_of(options_.min_head_m) + 2; l < voxels.layers(); ++l)
        steps_[i].over |= voxels.passes(c, r, l) >= 2;
      steps_[i].open = passed >= 2 && 2 * passed >= last - first + 1;
      if (steps_[i].open && !steps_[i].recess) steps_[i].wall = false;
    }
  }

  void crossings(const std::vector<Eigen::Vector3d>& path) {
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double a = path[i - 1][plane_.axis] - plane_.offset_m,
                   b = path[i][plane_.axis] - plane_.offset_m;
      if ((a < 0) == (b < 0) || (path[i] - path[i - 1]).norm() > 3) continue;
      const double share = a / (a - b);
      crossings_.push_back(path[i - 1][1 - plane_.axis] * (1 - share) +
                           path[i][1 - plane_.axis] * share);
    }
  }

  /// Where the camera went through a stretch without wall, beside a wall at one of its ends: the
  /// other end is where something stops rays, though too little is seen of it to be a wall.
  void find_crossed(std::size_t begin, std::size_t end, std::vector<DoorPiece>& doors) const {
    const std::size_t unseen = static_cast<std::size_t>(kUnseen_m / kAlong_m);
    const auto stops = [&](std::size_t from) {
      const auto first = steps_.begin() + static_cast<std::ptrdiff_t>(from);
      const auto last = first + static_cast<std::ptrdiff_t>(unseen);
      return std::none_of(first, last, [](const Step& step) { return step.open; }) &&
             2 * std::count_if(first, last, [](const Step& step) { return step.faced; }) >=
                 static_cast<std::ptrdiff_t>(unseen);
    };
    const auto take = [&](std::size_t from, std::size_t to) {
      if (static_cast<double>(to - from) * kAlong_m >= kWidest_m || !crossed(from, to)) return;
      if (const auto door = judge(from, to); door && !door->closed) doors.push_back(*door);
    };
    if (jamb(begin, -1)) {
      std::size_t to = begin;
      while (to + unseen <= end && !stops(to)) ++to;
      if (to + unseen <= end) take(begin, to);
    }
    if (jamb(end, 1)) {
      std::size_t from = end;
      while (from >= begin + unseen && !stops(from - unseen)) --from;
      if (from >= begin + unseen) take(from, end);
    }
  }

  /// Whether most of the steps before a place (`way` -1), or from it on (1), are wall.
  bool jamb(std::size_t at, int way) const {
    constexpr std::size_t kLong = 6, kLeast = 4;
    const std::size_t from = way < 0 ? at - std::min(at, kLong) : at;
    const std::size_t to = way < 0 ? at : std::min(steps_.size(), at + kLong);
    return std::count_if(steps_.begin() + static_cast<std::ptrdiff_t>(from),
                         steps_.begin() + static_cast<std::ptrdiff_t>(to), [](const Step& step) {
                           return step.wall;
                         }) >= static_cast<std::ptrdiff_t>(kLeast);
  }

  /// Whether the camera went through these steps.
  bool crossed(std::size_t begin, std::size_t end) const {
    const double from = from_ + begin * kAlong_m, to = from_ + end * kAlong_m;
    return std::any_of(crossings_.begin(), crossings_.end(),
                       [&](double at) { return at > from && at < to; });
  }

  /// The door that a stretch without wall at the height of doors is, if it is one.
  std::optional<DoorPiece> judge(std::size_t begin, std::size_t end) const {
    const double width = static_cast<double>(end - begin) * kAlong_m;
    DoorPiece door{
        plane_.axis, plane_.sign, plane_.offset_m, from_ + begin * kAlong_m, from_ + end * kAlong_m,
        0,           false};
    if (width < options_.min_width_m - kAlong_m || width > options_.max_width_m)
      return std::nullopt;
    door.offset_m -= plane_.sign * reference_[(begin + end) / 2];
    std::size_t open = 0, recess = 0, over = 0;
    std::vector<double> heads;
    for (std::size_t i = begin; i < end; ++i) {
      open += steps_[i].open, recess += steps_[i].recess, over += steps_[i].over;
      if (steps_[i].head) heads.push_back(*steps_[i].head);
    }
    const std::size_t count = end - begin;
    const bool head_seen = 2 * heads.size() >= count;
    if (head_seen) door.head_m = median_of(heads);
    door.closed = recess > open;
    const bool head_fits = head_seen && door.head_m <= options_.max_head_m && 2 * over < count;
    const bool leaf = door.closed && head_fits && 3 * recess >= 2 * count && width < 1.6;
    const bool passage =
        !door.closed && 2 * open >= count &&
        (head_fits || (!head_seen && crossed(begin, end) && width < kWidest_m && 4 * over < count));
    if (!leaf && !passage) return std::nullopt;
    trim(begin, end, door);
    return door;
  }

  /// Ends a door where what tells of it ends: the passage, or the leaf. What lies between there and
  /// the next wall that is seen may be wall that is not.
  void trim(std::size_t begin, std::size_t end, DoorPiece& door) const {
    const auto tells = [&](const Step& step) { return door.closed ? step.recess : step.open; };
    std::size_t first = begin, last = end;
    while (first < end && !tells(steps_[first])) ++first;
    while (last > first && !tells(steps_[last - 1])) --last;
    const auto far = [](std::size_t steps) {
      return static_cast<double>(steps) * kAlong_m > kUnseen_m;
    };
    if (static_cast<double>(last - first) * kAlong_m < options_.min_width_m) return;
    if (far(first - begin)) door.from_m = from_ + first * kAlong_m;
    if (far(end - last)) door.to_m = from_ + last * kAlong_m;
  }

  const Plane& plane_;
  const DoorFinderOptions& options_;
  double from_ = 0;
  std::vector<Step> steps_;
  std::vector<double> reference_;
  std::vector<double> crossings_;
};

}  // namespace

void visit(OptionVisitor& field, DoorFinderOptions& o) {
  field("min_width_m", o.min_width_m, "of a door", {0.2, 5});
  field("max_width_m", o.max_width_m, "of a door", {0.2, 10});
  field("min_head_m", o.min_head_m, "of an opening's head above the floor", {0.5, 5});
  field("max_head_m", o.max_head_m, "of an opening's head above the floor", {0.5, 10});
  field("min_recess_m", o.min_recess_m, "of a leaf behind its wall's surface", {0.005, 1});
  field("max_recess_m", o.max_recess_m, "of a leaf behind its wall's surface", {0.005, 1});
}

std::vector<DoorPiece> find_doors(const std::vector<WallPiece>& walls,
                                  const std::vector<PlacedPoint>& points,
                                  const VoxelEvidence& voxels,
                                  const std::vector<Eigen::Vector3d>& path,
                                  const DoorFinderOptions& options) {
  options.check();
  std::vector<DoorPiece> doors, half_seen, once;
  for (const Plane& plane : planes_of(walls, options.max_width_m))
    PlaneProfile(plane, points, voxels, path, options).find(doors, half_seen);
  doors.insert(doors.end(), half_seen.begin(), half_seen.end());
  for (const DoorPiece& door : doors) {
    const double middle = 0.5 * (door.from_m + door.to_m);
    const auto same = std::find_if(once.begin(), once.end(), [&](const DoorPiece& other) {
      return other.axis == door.axis && std::abs(other.offset_m - door.offset_m) < 0.45 &&
             std::abs(0.5 * (other.from_m + other.to_m) - middle) < 0.4;
    });
    if (same == once.end())
      once.push_back(door);
    else if (!door.closed)  // What passes through is no leaf.
      same->closed = false;
  }
  return once;
}

}  // namespace placegraph
