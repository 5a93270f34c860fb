#include <placegraph/frontend/cloud_planes/super_points.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

constexpr int kBlock = 16, kLeastBlock = 4;  ///< [px]
constexpr int kLeastCell = 12;   ///< number of points of a piece that is not split further
constexpr int kLeastPlanar = 6;  ///< least number of points that determine a plane
constexpr double kDof = 3;       ///< degrees of freedom of a plane

class Maker {
 public:
  explicit Maker(const CloudPoints& points) : points_(points) {
    result_.order.reserve(points.xyz.size());
  }
  SuperPoints make() {
    if (points_.width > 0)
      cut_image();
    else
      cut_cloud();
    result_.cell_of.resize(points_.xyz.size());
    for (std::size_t c = 0; c < result_.cells.size(); ++c)
      for (int k = result_.cells[c].begin; k < result_.cells[c].end; ++k)
        result_.cell_of[result_.order[k]] = static_cast<int>(c);
    find_contacts();
    return std::move(result_);
  }

 private:
  int pixel(int x, int y) const {
    return points_.pixel[static_cast<std::size_t>(y) * points_.width + x];
  }

  void cut_image() {
    across_ = (points_.width + kLeastBlock - 1) / kLeastBlock;
    down_ = (points_.height + kLeastBlock - 1) / kLeastBlock;
    sums_.assign(static_cast<std::size_t>(across_) * down_, {});
    for (int i = 0; i < points_.size(); ++i) {
      const int x = points_.source[i] % points_.width, y = points_.source[i] / points_.width;
      sums_[static_cast<std::size_t>(y / kLeastBlock) * across_ + x / kLeastBlock].add(
          points_.fit[i], points_.model);
    }
    for (int y = 0; y < points_.height; y += kBlock)
      for (int x = 0; x < points_.width; x += kBlock) cut_block(x, y, kBlock);
  }

  void cut_block(int x, int y, int side) {
    PlaneSums sums;
    const int blocks = side / kLeastBlock, bx = x / kLeastBlock, by = y / kLeastBlock;
    for (int v = by; v < std::min(by + blocks, down_); ++v)
      for (int u = bx; u < std::min(bx + blocks, across_); ++u)
        sums += sums_[static_cast<std::size_t>(v) * across_ + u];
    if (sums.count() == 0) return;
    const FittedPlane fit = sums.fit(points_.model);
    const bool planar = sums.count() >= kLeastPlanar && lies_on_plane(sums, fit, points_.model);
    if (!planar && side > kLeastBlock) {
      const int half = side / 2;
      for (const auto& [dx, dy] : {std::pair{0, 0}, {half, 0}, {0, half}, {half, half}})
        if (x + dx < points_.width && y + dy < points_.height) cut_block(x + dx, y + dy, half);
      return;
    }
    const int begin = static_cast<int>(result_.order.size());
    for (int v = y; v < std::min(y + side, points_.height); ++v)
      for (int u = x; u < std::min(x + side, points_.width); ++u)
        if (const int i = pixel(u, v); i >= 0) result_.order.push_back(i);
    add_cell(begin, sums, fit, planar);
  }

  void cut_cloud() {
    result_.order.resize(points_.xyz.size());
    std::iota(result_.order.begin(), result_.order.end(), 0);
    largest_ = std::max(4 * kLeastCell, points_.size() / 64);
    if (points_.size() > 0) cut_piece(0, points_.size());
  }

  void cut_piece(int begin, int end) {
    const int count = end - begin;
    const bool along = points_.model.noise == PointNoise::kAlongRay;
    if (count <= largest_) {
      PlaneSums sums;
      for (int k = begin; k < end; ++k) sums.add(points_.fit[result_.order[k]], points_.model);
      const FittedPlane fit = sums.fit(points_.model);
      const bool planar = count >= kLeastPlanar && lies_on_plane(sums, fit, points_.model);
      if (planar || count < 2 * kLeastCell) {
        add_cell(begin, sums, fit, planar);
        return;
      }
    }
    // By direction as observed by the sensor, or by position in space; split at the widest side.
    const auto where = [&](int i) -> const Eigen::Vector3d& {
      return along ? points_.fit[i].q : points_.xyz[i];
    };
    Eigen::Vector3d least = where(result_.order[begin]), most = least;
    for (int k = begin; k < end; ++k) {
      least = least.cwiseMin(where(result_.order[k]));
      most = most.cwiseMax(where(result_.order[k]));
    }
    int axis = 0;
    (most - least).maxCoeff(&axis);
    const int middle = begin + count / 2;
    std::nth_element(result_.order.begin() + begin, result_.order.begin() + middle,
                     result_.order.begin() + end, [&](int a, int b) {
                       const double x = where(a)[axis], y = where(b)[axis];
                       return x < y || (x == y && a < b);
                     });
    cut_piece(begin, middle);
    cut_piece(middle, end);
  }

  void add_cell(int begin, const PlaneSums& sums, const FittedPlane& fit, bool planar) {
    SuperPoint cell;
    cell.begin = begin;
    cell.end = begin + static_cast<int>(sums.count());
    cell.sums = sums;
    cell.plane = fit;
    cell.planar = planar;
    for (int k = cell.begin; k < cell.end; ++k) cell.centre += points_.xyz[result_.order[k]];
    cell.centre /= sums.count();
    result_.cells.push_back(cell);
  }

  void find_contacts() {
    std::vector<std::int64_t> pairs;
    const auto cells = static_cast<std::int64_t>(result_.cells.size());
    for (int i = 0; i < points_.size(); ++i)
      for (int n = points_.begin[i]; n < points_.begin[i + 1]; ++n) {
        const int a = result_.cell_of[i], b = result_.cell_of[points_.neighbours[n]];
        if (a < b) pairs.push_back(a * cells + b);
      }
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t k = 0; k < pairs.size();) {
      const std::size_t first = k;
      while (k < pairs.size() && pairs[k] == pairs[first]) ++k;
      result_.contacts.push_back({static_cast<int>(pairs[first] / cells),
                                  static_cast<int>(pairs[first] % cells),
                                  static_cast<int>(k - first)});
    }
  }

  const CloudPoints& points_;
  SuperPoints result_;
  std::vector<PlaneSums> sums_;  ///< sums of the smallest blocks
  int across_ = 0, down_ = 0, largest_ = 0;
};

}  // namespace

bool lies_on_plane(const PlaneSums& sums, const FittedPlane& fit, const FitModel& model) {
  // The noise is known only up to a factor; the second term is the effect of chance on a mean
  // square.
  constexpr double kNoiseFactor = 1.5, kChance = 3;
  if (!fit.ok) return false;
  const double dof = std::max(1.0, sums.count() - kDof);
  return fit.chi2 <=
         sums.inflation(fit, model) * dof * (kNoiseFactor + kChance * std::sqrt(2 / dof));
}

SuperPoints make_super_points(const CloudPoints& points) { return Maker(points).make(); }

double planar_dissimilarity(const SuperPoint& a, const SuperPoint& b, const FitModel& model) {
  PlaneSums both = a.sums;
  both += b.sums;
  const FittedPlane fit = both.fit(model);
  if (!fit.ok) return 1e6;
  const double rise = std::max(0.0, fit.chi2 - a.plane.chi2 - b.plane.chi2);
  return rise / (kDof * both.inflation(fit, model));
}

}  // namespace placegraph
