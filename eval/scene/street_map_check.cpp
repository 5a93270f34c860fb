#include <placegraph/eval/scene/street_map_check.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace placegraph {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

std::uint64_t key_of(const Vector3i& at) {
  std::uint64_t key = 0;
  for (int i = 0; i < 3; ++i)
    key = (key << 21) | (static_cast<std::uint64_t>(at[i] + (1 << 20)) & ((1U << 21) - 1));
  return key;
}

/// Surface in the cells around those of a map, by class.
class TrueCells {
 public:
  TrueCells(const StreetMap& map, const LabelledMesh& truth, const SE3& T_plan_truth,
            double tolerance_m)
      : cell_(map.cell_m), reach_(static_cast<int>(tolerance_m / map.cell_m) + 1) {
    for (const StreetCell& cell : map.cells)
      if (cell.label) add_blocks(cell.at);
    for (const LabelledMesh::Face& face : truth.faces)
      for (std::size_t k = 2; k < face.corners.size(); ++k) {
        const auto corner = [&](std::size_t i) -> Vector3d {
          return T_plan_truth * truth.vertices[static_cast<std::size_t>(face.corners[i])];
        };
        add_triangle(corner(0), corner(k - 1), corner(k), face.label);
      }
  }

  /// The classes of a cell with their areas, or of the nearest that has any; empty: no surface.
  const std::map<int, double>& at(const Vector3i& cell, double tolerance_m) const {
    static const std::map<int, double> kNone;
    const auto here = areas_.find(key_of(cell));
    if (here != areas_.end()) return here->second;
    const std::map<int, double>* best = &kNone;
    double least = tolerance_m / cell_ + 1e-9;
    for (int x = -reach_; x <= reach_; ++x)
      for (int y = -reach_; y <= reach_; ++y)
        for (int z = -reach_; z <= reach_; ++z) {
          const Vector3i off(x, y, z);
          // Between the cells' nearest faces.
          const double away = (off.cwiseAbs().cast<double>() - Vector3d::Ones()).cwiseMax(0).norm();
          if (away > least) continue;
          const auto found = areas_.find(key_of(cell + off));
          if (found == areas_.end() || (away == least && best != &kNone)) continue;
          best = &found->second;
          least = away;
        }
    return *best;
  }

 private:
  // Cells of a block on a side: the cost. Chosen.
  static constexpr int kBlock = 8;

  void add_blocks(const Vector3i& cell) {
    for (int i = 0; i < 8; ++i) {
      const Vector3i corner =
          cell + (reach_ + 1) * Vector3i((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
      blocks_.insert(key_of((corner.cast<double>() / kBlock).array().floor().cast<int>()));
    }
  }

  /// Whether a box [m] meets a block that is tested.
  bool meets(const Vector3d& low, const Vector3d& high) const {
    const Vector3i a = (low / (kBlock * cell_)).array().floor().cast<int>();
    const Vector3i b = (high / (kBlock * cell_)).array().floor().cast<int>();
    if (((b - a).array() > 6).any()) return true;  // too many to test: the box is divided first
    for (int x = a[0]; x <= b[0]; ++x)
      for (int y = a[1]; y <= b[1]; ++y)
        for (int z = a[2]; z <= b[2]; ++z)
          if (blocks_.count(key_of({x, y, z}))) return true;
    return false;
  }

  void add_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, int label) {
    if (!meets(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c))) return;
    const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
    const double longest = std::max({ab, bc, ca});
    if (longest > 0.4 * cell_) {
      // The longest side is halved.
      if (longest == ab) {
        const Vector3d m = 0.5 * (a + b);
        add_triangle(a, m, c, label), add_triangle(m, b, c, label);
      } else if (longest == bc) {
        const Vector3d m = 0.5 * (b + c);
        add_triangle(a, b, m, label), add_triangle(a, m, c, label);
      } else {
        const Vector3d m = 0.5 * (c + a);
        add_triangle(a, b, m, label), add_triangle(m, b, c, label);
      }
      return;
    }
    const Vector3d middle = (a + b + c) / 3;
    areas_[key_of((middle / cell_).array().floor().cast<int>())][label] +=
        0.5 * (b - a).cross(c - a).norm();
  }

  double cell_;
  int reach_;
  std::unordered_set<std::uint64_t> blocks_;
  std::unordered_map<std::uint64_t, std::map<int, double>> areas_;
};

}  // namespace

StreetMapCheck check_street_map(const StreetMap& map, const LabelledMesh& truth,
                                const SE3& T_truth_map, double tolerance_m) {
  const std::size_t n = map.classes.size();
  StreetMapCheck check;
  check.confusion.assign(n * n, 0);
  const SE3 T_plan_truth = SE3(map.R_plan_map, Vector3d::Zero()) * T_truth_map.inverse();
  const TrueCells cells(map, truth, T_plan_truth, tolerance_m);
  std::vector<int> number;  // positions of the true classes in the map
  for (const std::string& name : truth.classes) {
    const auto found = std::find(map.classes.begin(), map.classes.end(), name);
    number.push_back(found == map.classes.end() ? -1
                                                : static_cast<int>(found - map.classes.begin()));
  }
  std::vector<bool> on_top(map.cells.size(), false);
  for (const int cell : top_view(map).cell)
    if (cell >= 0) on_top[static_cast<std::size_t>(cell)] = true;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const StreetCell& cell = map.cells[i];
    if (!cell.label) continue;
    int most = -1;
    double area = 0;
    bool right = false;
    const std::map<int, double>& there = cells.at(cell.at, tolerance_m);
    for (const auto& [label, part] : there) {
      const int as = number[static_cast<std::size_t>(label)];
      right = right || as == cell.label;
      if (part > area) area = part, most = as;
    }
    if (!there.empty() && most < 0 && !right) {
      ++check.unjudged;
      continue;
    }
    for (StreetMapCheck::Score* score : {&check.all, &check.top}) {
      if (score == &check.top && !on_top[i]) continue;
      ++score->cells;
      score->right += right ? 1 : 0;
      score->most += most == cell.label ? 1 : 0;
      score->nothing += there.empty() ? 1 : 0;
    }
    if (most >= 0)
      ++check.confusion[static_cast<std::size_t>(most) * n + static_cast<std::size_t>(*cell.label)];
  }
  return check;
}

}  // namespace placegraph
