#include <placegraph/frontend/cloud_planes/depth_planes.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <optional>

namespace placegraph {
namespace {

/// Distance of the pixels used; at most half of the least cell_px. Chosen.
constexpr int kDepthStep_px = 2;
/// Maximum standard deviation of the normal of a plane. Chosen.
constexpr double kMaxPlaneNormalSigma_deg = 1;
/// Maximum deviation from a plane, as a share of the depth. Chosen.
constexpr double kDepthFlatness = 0.002;

constexpr double kSigmas = 3;  ///< largest distance of a plane's cells

/// Sums over pixels of rays (z = 1) and inverse depths.
struct Sums {
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  double c = 0, n = 0;

  void add(const Eigen::Vector3d& ray, double inverse_depth) {
    M.noalias() += ray * ray.transpose();
    v += inverse_depth * ray;
    c += inverse_depth * inverse_depth;
    n += 1;
  }
  Sums& operator+=(const Sums& other) {
    M += other.M, v += other.v, c += other.c, n += other.n;
    return *this;
  }
  /// n / d by least squares; nothing for collinear pixels.
  std::optional<Eigen::Vector3d> fit() const {
    if (n < 4) return std::nullopt;
    const Eigen::LDLT<Eigen::Matrix3d> solver(M);
    const Eigen::Vector3d pivots = solver.vectorD();
    if (!(pivots.minCoeff() > 1e-11 * pivots.maxCoeff())) return std::nullopt;
    const Eigen::Vector3d g = solver.solve(v);
    if (!(g.norm() > 0) || !g.allFinite()) return std::nullopt;
    return g;
  }
  /// Mean residual of the inverse depth, the rays having z = 1.
  double mean_residual(const Eigen::Vector3d& g) const { return (v.z() - M.col(2).dot(g)) / n; }
  double inverse_depth() const { return v.z() / n; }
  double variance(const Eigen::Vector3d& g) const {
    return std::max(0.0, c - 2 * g.dot(v) + g.dot(M * g)) / std::max(1.0, n - 3);
  }
};

struct Cell {
  Sums sums;
  bool even = false;                     ///< whether it is a single surface
  std::optional<Eigen::Vector3d> block;  ///< plane of this cell and its eight neighbours
  double roughness = 0;                  ///< variance of cell means about that plane
};

struct Region {
  std::vector<int> cells;
  Sums sums;
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
};

/// Image divided into cells.
class Grid {
 public:
  Grid(const Image& depth_m, const Camera& camera, const DepthPlanesOptions& options)
      : options_(options),
        camera_(camera),
        cols_(depth_m.cols / options.cell_px),
        rows_(depth_m.rows / options.cell_px),
        cells_(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_)) {
    sum_up(depth_m);
    judge_cells();
    judge_blocks();
  }

  std::vector<Region> regions() const;
  DepthPlane describe(const Region& region) const;

 private:
  const Cell& cell(int i) const { return cells_[static_cast<std::size_t>(i)]; }
  int min_cells() const {
    return std::max(9, static_cast<int>(options_.min_share * static_cast<double>(cells_.size())));
  }
  /// Largest deviation of the mean of a cell from a plane [1/m].
  double tolerance(const Cell& c) const {
    const double bend = kDepthFlatness * c.sums.inverse_depth();
    return kSigmas * std::sqrt(roughness_ + bend * bend);
  }
  Eigen::Vector3d middle_ray(int i) const {
    const double middle = 0.5 * (options_.cell_px - 1);
    return {(i % cols_ * options_.cell_px + middle - camera_.cx) / camera_.fx,
            (i / cols_ * options_.cell_px + middle - camera_.cy) / camera_.fy, 1};
  }
  template <class Use>
  void for_neighbours(int i, Use&& use) const {
    const int x = i % cols_, y = i / cols_;
    if (x > 0) use(i - 1);
    if (x + 1 < cols_) use(i + 1);
    if (y > 0) use(i - cols_);
    if (y + 1 < rows_) use(i + cols_);
  }
  void sum_up(const Image& depth_m);
  void judge_cells();
  void judge_blocks();
  bool fits(int i, const Eigen::Vector3d& g) const;
  Region grow(std::vector<int> start, const std::vector<char>& taken) const;
  double mean_square(const Region& region, const Eigen::Vector3d& g) const;
  int gap(const Region& a, const Region& b) const;
  bool coplanar(const Region& large, const Region& small) const;
  Eigen::Matrix3d covariance(const Region& region, int block_cells) const;

  const DepthPlanesOptions& options_;
  const Camera& camera_;
  int cols_, rows_;
  std::vector<Cell> cells_;
  double noise_ = 0;      ///< variance of a pixel about the plane of its cell [1/m^2]
  double roughness_ = 0;  ///< variance of a cell's mean about its surroundings' [1/m^2]
};

void Grid::sum_up(const Image& depth_m) {
  const int step = kDepthStep_px, size = options_.cell_px;
  for (int v = step / 2; v < rows_ * size; v += step) {
    const float* const row = depth_m.ptr<float>(v);
    for (int u = step / 2; u < cols_ * size; u += step) {
      const double z = row[u];
      if (!(z > 0) || !std::isfinite(z)) continue;
      cells_[static_cast<std::size_t>(v / size * cols_ + u / size)].sums.add(
          {(u - camera_.cx) / camera_.fx, (v - camera_.cy) / camera_.fy, 1}, 1 / z);
    }
  }
}

/// A cell with a depth edge in it is not part of a plane.
void Grid::judge_cells() {
  const double full =
      std::pow(std::floor(options_.cell_px / static_cast<double>(kDepthStep_px)), 2);
  std::vector<double> variances(cells_.size(), -1), known;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Sums& sums = cells_[i].sums;
    if (sums.n < 0.75 * full) continue;
    const auto g = sums.fit();
    if (!g) continue;
    variances[i] = sums.variance(*g);
    known.push_back(variances[i]);
  }
  if (known.empty()) return;
  noise_ = median_of(known);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (variances[i] < 0) continue;
    const double bend = 2 * kDepthFlatness * cells_[i].sums.inverse_depth();
    cells_[i].even = variances[i] < kSigmas * kSigmas * noise_ + bend * bend;
  }
}

void Grid::judge_blocks() {
  std::vector<double> known;
  for (int y = 1; y + 1 < rows_; ++y)
    for (int x = 1; x + 1 < cols_; ++x) {
      std::array<const Cell*, 9> of_block{};
      for (int k = 0; k < 9; ++k)
        of_block[static_cast<std::size_t>(k)] = &cell((y + k / 3 - 1) * cols_ + x + k % 3 - 1);
      if (!std::all_of(of_block.begin(), of_block.end(), [](const Cell* c) { return c->even; }))
        continue;
      Sums sums;
      for (const Cell* c : of_block) sums += c->sums;
      Cell& middle = cells_[static_cast<std::size_t>(y * cols_ + x)];
      middle.block = sums.fit();
      if (!middle.block) continue;
      for (const Cell* c : of_block)
        middle.roughness += std::pow(c->sums.mean_residual(*middle.block), 2) / 6;
      known.push_back(middle.roughness);
    }
  if (!known.empty()) roughness_ = median_of(known);
}

/// Whether a cell's mean is on the plane, and its neighbourhood has the same orientation.
bool Grid::fits(int i, const Eigen::Vector3d& g) const {
  const Cell& c = cell(i);
  if (!c.even) return false;
  const double reach = tolerance(c);
  if (std::abs(c.sums.mean_residual(g)) > reach) return false;
  if (!c.block) return true;
  const Eigen::Vector3d difference = *c.block - g;
  const double half = 1.5 * options_.cell_px;
  return std::hypot(difference.x() * half / camera_.fx, difference.y() * half / camera_.fy) <
         2 * reach;
}

Region Grid::grow(std::vector<int> start, const std::vector<char>& taken) const {
  Region region;
  std::vector<char> inside(cells_.size(), 0);
  std::deque<int> border;
  const auto take = [&](int i) {
    inside[static_cast<std::size_t>(i)] = 1;
    region.cells.push_back(i);
    region.sums += cell(i).sums;
    border.push_back(i);
  };
  for (const int i : start) take(i);
  std::size_t fitted = 0;
  const auto refit = [&] {
    if (const auto g = region.sums.fit()) region.g = *g;
    fitted = region.cells.size();
  };
  refit();
  while (!border.empty()) {
    const int i = border.front();
    border.pop_front();
    for_neighbours(i, [&](int j) {
      const auto at = static_cast<std::size_t>(j);
      if (inside[at] || taken[at] || !fits(j, region.g)) return;
      take(j);
      if (5 * region.cells.size() > 6 * fitted) refit();
    });
  }
  refit();
  return region;
}

/// Mean square of the residuals of a region's cells about a plane.
double Grid::mean_square(const Region& region, const Eigen::Vector3d& g) const {
  double sum = 0;
  for (const int i : region.cells) sum += std::pow(cell(i).sums.mean_residual(g), 2);
  return sum / static_cast<double>(region.cells.size());
}

/// Distance between the nearest cells of two regions [cells].
int Grid::gap(const Region& a, const Region& b) const {
  int least = cols_ + rows_;
  for (const int i : a.cells)
    for (const int j : b.cells)
      least = std::min(least,
                       std::max(std::abs(i % cols_ - j % cols_), std::abs(i / cols_ - j / cols_)));
  return least;
}

/// Whether one plane fits both regions nearly as well as one plane each.
bool Grid::coplanar(const Region& large, const Region& small) const {
  Sums both = large.sums;
  both += small.sums;
  const auto g = both.fit();
  if (!g) return false;
  for (const Region* region : {&large, &small}) {
    const double bend = kDepthFlatness * region->sums.inverse_depth();
    if (mean_square(*region, *g) > 1.5 * mean_square(*region, region->g) + bend * bend)
      return false;
  }
  return gap(large, small) <= std::sqrt(static_cast<double>(large.cells.size()));
}

std::vector<Region> Grid::regions() const {
  std::vector<int> seeds;
  for (int i = 0; i < cols_ * rows_; ++i)
    if (cell(i).block && std::sqrt(cell(i).roughness) < tolerance(cell(i))) seeds.push_back(i);
  const auto unevenness = [&](int i) {
    return cell(i).roughness / std::pow(tolerance(cell(i)), 2);
  };
  std::stable_sort(seeds.begin(), seeds.end(),
                   [&](int a, int b) { return unevenness(a) < unevenness(b); });
  std::vector<char> taken(cells_.size(), 0), tried(taken);
  std::vector<Region> found;
  const auto is_free = [&](int i) { return !taken[static_cast<std::size_t>(i)]; };
  for (const int seed : seeds) {
    if (tried[static_cast<std::size_t>(seed)]) continue;
    std::vector<int> start;
    for (int k = 0; k < 9; ++k) start.push_back(seed + (k / 3 - 1) * cols_ + k % 3 - 1);
    if (!std::all_of(start.begin(), start.end(), is_free)) continue;
    Region region = grow(start, taken);
    // Repeated from the cells that agree with the plane of the whole region.
    std::erase_if(region.cells, [&](int i) { return !fits(i, region.g); });
    if (region.cells.size() >= 9) region = grow(region.cells, taken);
    if (static_cast<int>(region.cells.size()) < min_cells() / 2) {
      for (const int i : region.cells) tried[static_cast<std::size_t>(i)] = 1;
      continue;
    }
    for (const int i : region.cells) taken[static_cast<std::size_t>(i)] = 1;
    found.push_back(std::move(region));
  }
  const auto larger = [](const Region& a, const Region& b) {
    return a.cells.size() > b.cells.size();
  };
  std::stable_sort(found.begin(), found.end(), larger);
  for (std::size_t a = 0; a < found.size(); ++a)
    for (std::size_t b = a + 1; b < found.size();) {
      if (!coplanar(found[a], found[b])) {
        ++b;
        continue;
      }
      found[a].cells.insert(found[a].cells.end(), found[b].cells.begin(), found[b].cells.end());
      found[a].sums += found[b].sums;
      found[a].g = *found[a].sums.fit();
      found.erase(found.begin() + static_cast<std::ptrdiff_t>(b));
      b = a + 1;
    }
  std::erase_if(found, [&](const Region& region) {
    return static_cast<int>(region.cells.size()) < min_cells();
  });
  std::stable_sort(found.begin(), found.end(), larger);
  return found;
}

/// Covariance of n / d if the errors within blocks of so many cells a side are common: the sum over
/// blocks of the squares of their gradients, with a correction for a small number of blocks. Zero
/// with too few.
Eigen::Matrix3d Grid::covariance(const Region& region, int block_cells) const {
  // Twice the unknowns of a plane.
  constexpr std::size_t kLeastBlocks = 6;
  std::map<int, Eigen::Vector3d> pulls;
  for (const int i : region.cells) {
    const int block = i / cols_ / block_cells * cols_ + i % cols_ / block_cells;
    const Sums& sums = cell(i).sums;
    pulls.try_emplace(block, Eigen::Vector3d::Zero()).first->second += sums.v - sums.M * region.g;
  }
  if (pulls.size() < kLeastBlocks) return Eigen::Matrix3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const auto& [block, pull] : pulls) squares += pull * pull.transpose();
  const double count = static_cast<double>(pulls.size());
  const Eigen::Matrix3d inverse = region.sums.M.inverse();
  return count / (count - 3) * inverse * squares * inverse;
}

DepthPlane Grid::describe(const Region& region) const {
  DepthPlane result;
  const Eigen::Vector3d& g = region.g;
  const double pixels = region.sums.n / static_cast<double>(region.cells.size());
  // Independent cells.
  Eigen::Matrix3d of_g = region.sums.M.inverse() * std::max(noise_, roughness_ * pixels);
  for (const int block_cells : {2, 4, 8}) {
    const Eigen::Matrix3d similar = covariance(region, block_cells);
    if (similar.trace() > of_g.trace()) of_g = similar;
  }
  const double square = g.squaredNorm();
  const Eigen::Matrix3d J = (Eigen::Matrix3d::Identity() - 2 * g * g.transpose() / square) / square;
  result.plane_cam = Plane3::from_closest_point(g / square);
  result.covariance = tangent_covariance(result.plane_cam, J * of_g * J.transpose()) +
                      plane_information(result.plane_cam, options_.floor_deg * kRadPerDeg,
                                        options_.floor_distance / std::sqrt(square))
                          .inverse();
  for (const int i : region.cells) {
    const Eigen::Vector3d ray = middle_ray(i);
    const double inverse_depth = g.dot(ray);
    if (inverse_depth > 0) result.points_cam.emplace_back(ray / inverse_depth);
  }
  return result;
}

/// Standard deviation of the normal, the worse of two directions.
double sigma_normal_rad(const DepthPlane& plane) {
  Eigen::Matrix3d J;
  plane.plane_cam.normal(&J);
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(J * plane.covariance * J.transpose())
          .eigenvalues()[2]);
}

}  // namespace

std::vector<DepthPlane> find_depth_planes(const Image& depth_m, const Camera& depth_camera,
                                          const DepthPlanesOptions& options) {
  options.check();
  require(depth_m.type() == CV_32FC1 && depth_m.cols == depth_camera.width &&
              depth_m.rows == depth_camera.height,
          "depth planes: needs a CV_32FC1 depth image of the camera's size");
  const Grid grid(depth_m, depth_camera, options);
  std::vector<DepthPlane> planes;
  for (const Region& region : grid.regions()) {
    if (static_cast<int>(planes.size()) == options.max_planes) break;
    const DepthPlane plane = grid.describe(region);
    if (plane.covariance.allFinite() && !plane.points_cam.empty() &&
        sigma_normal_rad(plane) < kMaxPlaneNormalSigma_deg * kRadPerDeg)
      planes.push_back(plane);
  }
  return planes;
}

DepthPlane transform(const SE3& T_new_old, const DepthPlane& plane_old) {
  DepthPlane plane_new;
  Eigen::Matrix3d J;
  plane_new.plane_cam = transform_to(T_new_old.inverse(), plane_old.plane_cam, nullptr, &J);
  plane_new.covariance = J * plane_old.covariance * J.transpose();
  for (const Eigen::Vector3d& p : plane_old.points_cam)
    plane_new.points_cam.push_back(T_new_old * p);
  return plane_new;
}

}  // namespace placegraph
