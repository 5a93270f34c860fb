#include <placegraph/frontend/floor_plan/wall_profile.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Share of its points' standard deviation that is added to min_recess_m for a leaf.
constexpr double kRecessSigmas = 0.1;

int step_of(const WallProfile& profile, double along) {
  return static_cast<int>(std::floor((along - profile.from_m) / WallProfile::kStep_m));
}

/// Distance of the surface behind the plane around each step.
void find_surface(const std::vector<PlacedPoint>& points, WallProfile& profile) {
  constexpr int kReach = 24;  // steps
  const WallPlane& plane = profile.plane;
  std::vector<WallStep>& steps = profile.steps;
  std::vector<std::vector<double>> behind(steps.size());
  for (const PlacedPoint& p : points) {
    if (p.normal[plane.axis] * plane.sign < 0.95F || p.sigma > 0.05F) continue;
    const int step = step_of(profile, p.point[1 - plane.axis]);
    const double b = plane.sign * (plane.offset_m - p.point[plane.axis]);
    if (step >= 0 && step < static_cast<int>(steps.size()) && p.point[2] > 0.25F &&
        std::abs(b) < 0.13)
      behind[step].push_back(b);
  }
  for (int i = 0; i < static_cast<int>(steps.size()); ++i) {
    // The surface is in front of the leaves in it: the lower third.
    std::vector<double> about;
    for (int k = std::max(0, i - kReach); k < std::min<int>(behind.size(), i + kReach + 1); ++k)
      about.insert(about.end(), behind[k].begin(), behind[k].end());
    if (about.size() < 10) continue;
    const auto third = about.begin() + static_cast<std::ptrdiff_t>(about.size() / 3);
    std::nth_element(about.begin(), third, about.end());
    steps[i].behind_m = *third;
  }
}

void take_points(const std::vector<PlacedPoint>& points, const DoorShape& door,
                 WallProfile& profile) {
  const WallPlane& plane = profile.plane;
  std::vector<WallStep>& steps = profile.steps;
  std::vector<std::vector<double>> low(steps.size()), sigmas(steps.size()), heads(steps.size());
  for (const PlacedPoint& p : points) {
    if (p.normal[plane.axis] * plane.sign < 0.9F || p.sigma > 0.1F) continue;
    const int step = step_of(profile, p.point[1 - plane.axis]);
    if (step < 0 || step >= static_cast<int>(steps.size())) continue;
    const double behind =
        plane.sign * (plane.offset_m - p.point[plane.axis]) - steps[step].behind_m;
    if (behind < -0.06 || behind > door.max_recess_m) continue;
    if (p.point[2] > 0.25F && p.point[2] < door.min_head_m - 0.1)
      for (int k = std::max(0, step - 1); k <= step + 1 && k < static_cast<int>(low.size()); ++k)
        low[k].push_back(behind), sigmas[k].push_back(p.sigma);
    if (p.point[2] > door.min_head_m && behind < 0.5 * door.min_recess_m + 0.01)
      for (int k = std::max(0, step - 2); k <= step + 2 && k < static_cast<int>(low.size()); ++k)
        heads[k].push_back(p.point[2]);
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (low[i].size() >= 3) {
      const double least = door.min_recess_m + kRecessSigmas * median_of(sigmas[i]);
      steps[i].wall = median_of(low[i]) < least;
      steps[i].recess = !steps[i].wall;
    }
    if (heads[i].size() >= 3) {
      std::sort(heads[i].begin(), heads[i].end());
      steps[i].head = heads[i][heads[i].size() / 20];
    }
  }
}

int layers_passed(const VoxelEvidence& voxels, int c, int r, int first, int last) {
  int passed = 0;
  for (int l = first; voxels.contains(c, r) && l <= last; ++l)
    passed += voxels.passes(c, r, l) >= 2 && voxels.passes(c, r, l) > 2 * voxels.hits(c, r, l);
  return passed;
}

void take_voxels(const VoxelEvidence& voxels, const DoorShape& door, WallProfile& profile) {
  const WallPlane& plane = profile.plane;
  const auto cell_at = [&](double along, double offset) {
    double at[2];
    at[1 - plane.axis] = along, at[plane.axis] = offset;
    return std::pair(voxels.column_of(at[0]), voxels.row_of(at[1]));
  };
  const int first = std::max(0, voxels.layer_of(0.5)),
            last = std::min(voxels.layers() - 1, voxels.layer_of(door.min_head_m - 0.2));
  for (std::size_t i = 0; i < profile.steps.size(); ++i) {
    WallStep& step = profile.steps[i];
    const double along = profile.from_m + (static_cast<double>(i) + 0.5) * WallProfile::kStep_m;
    const double surface = plane.offset_m - plane.sign * step.behind_m;
    const auto [c, r] = cell_at(along, surface - plane.sign * 0.07);
    if (!voxels.contains(c, r)) continue;
    const int passed = layers_passed(voxels, c, r, first, last);
    const auto [front_c, front_r] = cell_at(along, surface + plane.sign * 0.3);
    step.faced = layers_passed(voxels, front_c, front_r, first, last) >= 2;
    for (int l = voxels.layer_of(door.min_head_m) + 2; l < voxels.layers(); ++l)
      step.over |= voxels.passes(c, r, l) >= 2;
    step.open = passed >= 2 && 2 * passed >= last - first + 1;
    if (step.open && !step.recess) step.wall = false;
  }
}

void take_path(const std::vector<Eigen::Vector3d>& path, WallProfile& profile) {
  const WallPlane& plane = profile.plane;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double a = path[i - 1][plane.axis] - plane.offset_m,
                 b = path[i][plane.axis] - plane.offset_m;
    if ((a < 0) == (b < 0) || (path[i] - path[i - 1]).norm() > 3) continue;
    const double share = a / (a - b);
    profile.crossed_m.push_back(path[i - 1][1 - plane.axis] * (1 - share) +
                                path[i][1 - plane.axis] * share);
  }
}

}  // namespace

std::vector<WallPlane> planes_of(const std::vector<WallPiece>& walls, double reach_m) {
  std::vector<WallPiece> left = walls;
  std::sort(left.begin(), left.end(), [](const WallPiece& a, const WallPiece& b) {
    return a.to_m - a.from_m > b.to_m - b.from_m;
  });
  std::vector<WallPlane> planes;
  for (const WallPiece& piece : left) {
    bool joined = false;
    for (WallPlane& plane : planes) {
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

bool WallProfile::crossed(std::size_t begin, std::size_t end) const {
  return std::any_of(crossed_m.begin(), crossed_m.end(),
                     [&](double at) { return at > at_m(begin) && at < at_m(end); });
}

WallProfile profile_wall(const WallPlane& plane, const std::vector<PlacedPoint>& points,
                         const VoxelEvidence& voxels, const std::vector<Eigen::Vector3d>& path,
                         const DoorShape& door) {
  WallProfile profile{plane, plane.from_m - door.max_width_m};
  const double length = plane.to_m - plane.from_m + 2 * door.max_width_m;
  profile.steps.resize(static_cast<int>(length / WallProfile::kStep_m) + 1);
  find_surface(points, profile);
  take_points(points, door, profile);
  take_voxels(voxels, door, profile);
  take_path(path, profile);
  return profile;
}

}  // namespace placegraph
