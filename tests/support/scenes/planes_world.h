#pragma once
#include <placegraph/frontend/planes/homography.h>
#include <placegraph/frontend/planes/homography_fit.h>

#include <algorithm>
#include <sstream>

#include "tests/support/scenes/scene.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::test {

/// Two views of planes side by side, each seen in an upright strip of the first view, and matches
/// between the views whose plane is known.
struct PlanesWorld {
  Camera camera = pinhole(640, 480, 500);
  SE3 T_cur_ref;
  std::vector<Plane> planes_ref;
  PointMatches matches;
  std::vector<int> labels;  ///< 0: an outlier
};

/// `per_plane` matches on each plane and `outliers` on none, noise of `sigma_px` in both views;
/// neighbouring planes differ by 50 deg or so, as the walls of a zigzag.
inline PlanesWorld make_planes_world(int planes, int per_plane, int outliers, double sigma_px,
                                     const SE3& T_cur_ref, Random& random) {
  PlanesWorld world;
  world.T_cur_ref = T_cur_ref;
  const Camera& camera = world.camera;
  for (int k = 0; k < planes; ++k) {
    const double rotation = (k % 2 == 0 ? 1 : -1) * random.uniform(0.4, 0.5);
    const Eigen::Vector3d normal =
        Eigen::Vector3d(std::sin(rotation), random.uniform(-0.1, 0.1), std::cos(rotation))
            .normalized();
    world.planes_ref.push_back({normal, random.uniform(4, 6)});
    const double width = static_cast<double>(camera.width) / planes;
    for (int placed = 0; placed < per_plane;) {
      const Eigen::Vector2d px(k * width + random.uniform(0.02, 0.98) * width,
                               random.uniform(10, camera.height - 10));
      const Eigen::Vector3d point =
          on_plane(normal, world.planes_ref.back().distance_m)(*camera.unproject(px)) *
          *camera.unproject(px);
      const auto seen = camera.project(T_cur_ref * point);
      if (point[2] < 0.5 || !seen) continue;
      world.matches.px_ref.push_back(px);
      world.matches.px_cur.push_back(*seen);
      world.labels.push_back(k + 1);
      ++placed;
    }
  }
  add_noise(world.matches.px_ref, sigma_px, random);
  add_noise(world.matches.px_cur, sigma_px, random);
  for (int i = 0; i < outliers; ++i) {
    world.matches.px_ref.emplace_back(random.uniform(0, 640), random.uniform(0, 480));
    world.matches.px_cur.emplace_back(random.uniform(0, 640), random.uniform(0, 480));
    world.labels.push_back(0);
  }
  return world;
}

/// The labels in a file that `placegraph image two-view-planes` writes.
inline std::vector<int> plane_labels(const std::string& path) {
  std::vector<int> labels;
  std::istringstream in(read_file(path));
  for (int label; in >> label;) labels.push_back(label);
  return labels;
}

/// Share of items whose label is wrong when each label of `estimate` above 0 stands for at most one
/// of `truth` above 0, and the other way round, as well as can be; 0 stands for 0.
inline double misclassification(const std::vector<int>& truth, const std::vector<int>& estimate) {
  if (truth.empty() || truth.size() != estimate.size()) return 1;
  const int n_truth = *std::max_element(truth.begin(), truth.end());
  const int n_estimate = *std::max_element(estimate.begin(), estimate.end());
  std::vector<std::vector<int>> common(n_estimate + 1, std::vector<int>(n_truth + 1, 0));
  for (std::size_t i = 0; i < truth.size(); ++i) ++common[estimate[i]][truth[i]];
  // best[set]: most items right with the true labels of the set taken (exhaustive, by sets).
  std::vector<int> best(std::size_t{1} << n_truth, 0);
  for (int e = 1; e <= n_estimate; ++e)
    for (std::size_t set = best.size(); set-- > 0;)
      for (int t = 1; t <= n_truth; ++t)
        if (set >> (t - 1) & 1)
          best[set] = std::max(best[set], best[set ^ (std::size_t{1} << (t - 1))] + common[e][t]);
  const int right = best.back() + common[0][0];
  return 1 - static_cast<double>(right) / static_cast<double>(truth.size());
}

}  // namespace placegraph::test
