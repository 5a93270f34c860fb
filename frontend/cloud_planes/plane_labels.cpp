#include <placegraph/frontend/cloud_planes/plane_labels.h>
#include <placegraph/graph/core/angle.h>

#include <cmath>
#include <unordered_map>

namespace placegraph {
namespace {

const double kFacesCos = std::cos(deg_to_rad(20));
constexpr double kRise = 12;  ///< largest increase of a cell's chi2 per degree of freedom

/// Whether a point's piece of surface may belong to a plane: it is not planar itself, or has the
/// same orientation, or its orientation is too uncertain.
class Facing {
 public:
  Facing(const CloudPoints& points, const SuperPoints& cloud,
         const std::vector<FittedPlane>& planes)
      : points_(points), cloud_(cloud), planes_(planes) {}
  bool operator()(int point, int label) {
    const int c = cloud_.cell_of[point];
    const SuperPoint& cell = cloud_.cells[c];
    if (!cell.planar) return true;
    const auto key =
        static_cast<std::int64_t>(c) * static_cast<std::int64_t>(planes_.size()) + label;
    const auto [entry, fresh] = known_.try_emplace(key, true);
    if (fresh) {
      const FittedPlane& plane = planes_[label];
      if (std::abs(cell.plane.plane.normal.dot(plane.plane.normal)) < kFacesCos) {
        const double rise = cell.sums.misfit(plane, points_.model) - cell.plane.chi2;
        entry->second = rise < 3 * kRise * cell.sums.inflation(plane, points_.model);
      }
    }
    return entry->second;
  }

 private:
  const CloudPoints& points_;
  const SuperPoints& cloud_;
  const std::vector<FittedPlane>& planes_;
  std::unordered_map<std::int64_t, bool> known_;
};

void grow(const CloudPoints& points, double sigmas, Facing& faces, PlaneLabels& result) {
  std::vector<int> queue;
  for (int i = 0; i < points.size(); ++i)
    if (result.labels[i] >= 0) queue.push_back(i);
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const int i = queue[k], label = result.labels[i];
    for (int n = points.begin[i]; n < points.begin[i + 1]; ++n) {
      const int j = points.neighbours[n];
      if (result.labels[j] >= 0) continue;
      if (residual_sigmas(result.planes[label], points.fit[j], points.model) > sigmas ||
          !faces(j, label))
        continue;
      result.labels[j] = label;
      queue.push_back(j);
    }
  }
}

/// Moves points to a neighbour's plane that is nearer, and repeats this around each change.
void settle_borders(const CloudPoints& points, Facing& faces, PlaneLabels& result) {
  std::vector<int> queue;
  const auto at_border = [&](int i) {
    for (int n = points.begin[i]; n < points.begin[i + 1]; ++n) {
      const int other = result.labels[points.neighbours[n]];
      if (other >= 0 && other != result.labels[i]) return true;
    }
    return false;
  };
  for (int i = 0; i < points.size(); ++i)
    if (result.labels[i] >= 0 && at_border(i)) queue.push_back(i);
  // Each change brings a point nearer, so that the loop ends.
  const std::size_t most = 4 * points.xyz.size();
  for (std::size_t k = 0; k < queue.size() && k < most; ++k) {
    const int i = queue[k];
    int best = result.labels[i];
    double least = residual_sigmas(result.planes[best], points.fit[i], points.model);
    for (int n = points.begin[i]; n < points.begin[i + 1]; ++n) {
      const int other = result.labels[points.neighbours[n]];
      if (other < 0 || other == best) continue;
      const double off = residual_sigmas(result.planes[other], points.fit[i], points.model);
      if (off < least && faces(i, other)) best = other, least = off;
    }
    if (best == result.labels[i]) continue;
    result.labels[i] = best;
    for (int n = points.begin[i]; n < points.begin[i + 1]; ++n)
      if (result.labels[points.neighbours[n]] >= 0) queue.push_back(points.neighbours[n]);
  }
}

}  // namespace

void drop_porous(const CloudPoints& points, double least, PlaneLabels& result) {
  std::vector<double> same(result.planes.size(), 0), all(result.planes.size(), 0);
  for (int i = 0; i < points.size(); ++i) {
    const int label = result.labels[i];
    if (label < 0) continue;
    all[label] += points.begin[i + 1] - points.begin[i];
    for (int n = points.begin[i]; n < points.begin[i + 1]; ++n)
      same[label] += result.labels[points.neighbours[n]] == label;
  }
  for (int& label : result.labels)
    if (label >= 0 && same[label] < least * all[label]) label = -1;
}

void refit(const CloudPoints& points, PlaneLabels& result) {
  result.sums.assign(result.planes.size(), {});
  for (int i = 0; i < points.size(); ++i)
    if (result.labels[i] >= 0) result.sums[result.labels[i]].add(points.fit[i], points.model);
  for (std::size_t k = 0; k < result.planes.size(); ++k) {
    const FittedPlane fit = result.sums[k].fit(points.model, true);
    if (fit.ok) result.planes[k] = fit;
  }
}

void spread_labels(const CloudPoints& points, const SuperPoints& cloud, double sigmas,
                   PlaneLabels& result) {
  for (int round = 0; round < 2; ++round) {
    Facing faces(points, cloud, result.planes);
    for (int i = 0; i < points.size(); ++i) {
      int& label = result.labels[i];
      if (label >= 0 && residual_sigmas(result.planes[label], points.fit[i], points.model) > sigmas)
        label = -1;
    }
    grow(points, sigmas, faces, result);
    settle_borders(points, faces, result);
    refit(points, result);
  }
}

void drop_small(const CloudPoints& points, int min_piece, int min_points, PlaneLabels& result,
                std::vector<int>* keep) {
  std::vector<char> seen(points.xyz.size(), 0);
  std::vector<int> piece, count(result.planes.size(), 0);
  for (int start = 0; start < points.size(); ++start) {
    const int label = result.labels[start];
    if (label < 0 || seen[start]) continue;
    piece.assign(1, start);
    seen[start] = 1;
    for (std::size_t k = 0; k < piece.size(); ++k)
      for (int n = points.begin[piece[k]]; n < points.begin[piece[k] + 1]; ++n) {
        const int j = points.neighbours[n];
        if (seen[j] || result.labels[j] != label) continue;
        seen[j] = 1;
        piece.push_back(j);
      }
    if (static_cast<int>(piece.size()) < min_piece)
      for (const int i : piece) result.labels[i] = -1;
    else
      count[label] += static_cast<int>(piece.size());
  }
  std::vector<int> number(result.planes.size(), -1);
  std::vector<FittedPlane> planes;
  if (keep) keep->clear();
  for (std::size_t k = 0; k < number.size(); ++k) {
    if (count[k] < min_points) continue;
    number[k] = static_cast<int>(planes.size());
    planes.push_back(result.planes[k]);
    if (keep) keep->push_back(static_cast<int>(k));
  }
  for (int& label : result.labels)
    if (label >= 0) label = number[label];
  result.planes = std::move(planes);
  refit(points, result);
}

}  // namespace placegraph
