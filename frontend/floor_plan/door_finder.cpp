#include <placegraph/frontend/floor_plan/door_finder.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace placegraph {
namespace {

/// Minimum depth of a leaf behind its wall's surface (docs/floor_plan.md). Chosen.
constexpr double kMinRecess_m = 0.025;
/// Maximum depth of a leaf behind its wall's surface (docs/floor_plan.md). Chosen.
constexpr double kMaxRecess_m = 0.16;

/// Length without evidence of a door, or without rays where no wall is visible, at which a door
/// ends.
constexpr double kUnseen_m = 0.4;
/// Largest width of a door without both jambs and a head; wider ones are passages of another kind.
constexpr double kWidest_m = 1.4;

/// Ends a door at the end of its evidence: the passage, or the leaf. Between that end and the next
/// visible wall there may be unseen wall.
void trim(const WallProfile& profile, const DoorFinderOptions& options, std::size_t begin,
          std::size_t end, DoorPiece& door) {
  const auto supports = [&](const WallStep& step) { return door.closed ? step.recess : step.open; };
  std::size_t first = begin, last = end;
  while (first < end && !supports(profile.steps[first])) ++first;
  while (last > first && !supports(profile.steps[last - 1])) --last;
  const auto far = [](std::size_t steps) {
    return static_cast<double>(steps) * WallProfile::kStep_m > kUnseen_m;
  };
  if (static_cast<double>(last - first) * WallProfile::kStep_m < options.min_width_m) return;
  if (far(first - begin)) door.from_m = profile.at_m(first);
  if (far(end - last)) door.to_m = profile.at_m(last);
}

/// Door in a stretch without wall at the height of doors, if it is one.
std::optional<DoorPiece> judge(const WallProfile& profile, const DoorFinderOptions& options,
                               std::size_t begin, std::size_t end) {
  const WallPlane& plane = profile.plane;
  const double width = static_cast<double>(end - begin) * WallProfile::kStep_m;
  DoorPiece door{plane.axis,        plane.sign, plane.offset_m, profile.at_m(begin),
                 profile.at_m(end), 0,          false};
  if (width < options.min_width_m - WallProfile::kStep_m || width > options.max_width_m)
    return std::nullopt;
  door.offset_m -= plane.sign * profile.steps[(begin + end) / 2].behind_m;
  std::size_t open = 0, recess = 0, over = 0;
  std::vector<double> heads;
  for (std::size_t i = begin; i < end; ++i) {
    open += profile.steps[i].open, recess += profile.steps[i].recess, over += profile.steps[i].over;
    if (profile.steps[i].head) heads.push_back(*profile.steps[i].head);
  }
  const std::size_t count = end - begin;
  const bool head_seen = 2 * heads.size() >= count;
  if (head_seen) door.head_m = median_of(heads);
  door.closed = recess > open;
  const bool head_fits = head_seen && door.head_m <= options.max_head_m && 2 * over < count;
  const bool leaf = door.closed && head_fits && 3 * recess >= 2 * count && width < 1.6;
  const bool passage = !door.closed && 2 * open >= count &&
                       (head_fits || (!head_seen && profile.crossed(begin, end) &&
                                      width < kWidest_m && 4 * over < count));
  if (!leaf && !passage) return std::nullopt;
  trim(profile, options, begin, end, door);
  return door;
}

/// Whether most of the steps before a position (`direction` -1), or from it on (1), are wall.
bool jamb(const WallProfile& profile, std::size_t at, int direction) {
  // Four of six steps, 20 of 30 cm, are wall. Chosen.
  constexpr std::size_t kLong = 6, kLeast = 4;
  const std::size_t from = direction < 0 ? at - std::min(at, kLong) : at;
  const std::size_t to = direction < 0 ? at : std::min(profile.steps.size(), at + kLong);
  return std::count_if(profile.steps.begin() + static_cast<std::ptrdiff_t>(from),
                       profile.steps.begin() + static_cast<std::ptrdiff_t>(to),
                       [](const WallStep& step) { return step.wall; }) >=
         static_cast<std::ptrdiff_t>(kLeast);
}

/// Doors where the camera went through a stretch without wall, beside a wall at one end. The other
/// end is where rays are stopped, although too little is visible there for a wall.
void find_crossed(const WallProfile& profile, const DoorFinderOptions& options, std::size_t begin,
                  std::size_t end, std::vector<DoorPiece>& doors) {
  const std::size_t unseen = static_cast<std::size_t>(kUnseen_m / WallProfile::kStep_m);
  const auto stops = [&](std::size_t from) {
    const auto first = profile.steps.begin() + static_cast<std::ptrdiff_t>(from);
    const auto last = first + static_cast<std::ptrdiff_t>(unseen);
    return std::none_of(first, last, [](const WallStep& step) { return step.open; }) &&
           2 * std::count_if(first, last, [](const WallStep& step) { return step.faced; }) >=
               static_cast<std::ptrdiff_t>(unseen);
  };
  const auto take = [&](std::size_t from, std::size_t to) {
    if (static_cast<double>(to - from) * WallProfile::kStep_m >= kWidest_m ||
        !profile.crossed(from, to))
      return;
    if (const auto door = judge(profile, options, from, to); door && !door->closed)
      doors.push_back(*door);
  };
  if (jamb(profile, begin, -1)) {
    std::size_t to = begin;
    while (to + unseen <= end && !stops(to)) ++to;
    if (to + unseen <= end) take(begin, to);
  }
  if (jamb(profile, end, 1)) {
    std::size_t from = end;
    while (from >= begin + unseen && !stops(from - unseen)) --from;
    if (from >= begin + unseen) take(from, end);
  }
}

}  // namespace

ProfileDoors doors_of(const WallProfile& profile, const DoorFinderOptions& options) {
  const std::vector<WallStep>& steps = profile.steps;
  ProfileDoors doors;
  for (std::size_t i = 0; i < steps.size();) {
    if (steps[i].wall) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < steps.size() && !steps[end].wall) ++end;
    const bool between_walls = i > 0 && end < steps.size();
    std::optional<DoorPiece> door;
    if (between_walls) door = judge(profile, options, i, end);
    if (door)
      doors.between_walls.push_back(*door);
    else
      find_crossed(profile, options, i, end, doors.half_seen);
    i = end;
  }
  return doors;
}

std::vector<DoorPiece> find_doors(const std::vector<WallPiece>& walls,
                                  const std::vector<PlacedPoint>& points,
                                  const VoxelEvidence& voxels,
                                  const std::vector<Eigen::Vector3d>& path,
                                  const DoorFinderOptions& options) {
  options.check();
  const DoorShape shape{options.max_width_m, options.min_head_m, kMinRecess_m, kMaxRecess_m};
  std::vector<DoorPiece> doors, half_seen, once;
  for (const WallPlane& plane : planes_of(walls, options.max_width_m)) {
    const ProfileDoors found = doors_of(profile_wall(plane, points, voxels, path, shape), options);
    doors.insert(doors.end(), found.between_walls.begin(), found.between_walls.end());
    half_seen.insert(half_seen.end(), found.half_seen.begin(), found.half_seen.end());
  }
  doors.insert(doors.end(), half_seen.begin(), half_seen.end());
  for (const DoorPiece& door : doors) {
    const double middle = 0.5 * (door.from_m + door.to_m);
    const auto same = std::find_if(once.begin(), once.end(), [&](const DoorPiece& other) {
      return other.axis == door.axis && std::abs(other.offset_m - door.offset_m) < 0.45 &&
             std::abs(0.5 * (other.from_m + other.to_m) - middle) < 0.4;
    });
    if (same == once.end())
      once.push_back(door);
    else if (!door.closed)  // a door that something passes through is open
      same->closed = false;
  }
  return once;
}

}  // namespace placegraph
