#include <placegraph/frontend/cloud_planes/normalized_cuts.h>
#include <placegraph/frontend/cloud_planes/planar_segments.h>
#include <placegraph/graph/core/disjoint_sets.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

constexpr double kDissimilarityScale = 8;  ///< affinity is exp(-dissimilarity / this)
constexpr double kLeastAffinity = 1e-3;    ///< below it two cells are not joined
/// Largest increase of a cell's chi2 per degree of freedom from its own plane to that of the
/// segment.
constexpr double kCellRise = 12;
constexpr double kOddCells = 0.03;  ///< share of the points in cells that may exceed it
/// Largest ratio of the affinities at a cut to those inside; above, the cut does not follow a
/// crease.
constexpr double kSmoothCut = 0.6;
/// Cosine of the largest angle between planes that are merged.
constexpr double kMaxRotationCos = 0.95;

/// Affinity of cells: their similarity, weighted by the number of neighbouring points.
struct Joint : Affinity {
  double pairs = 0;
};

/// Connected cells, with their affinities by the indices of the cells in the cloud.
struct Part {
  std::vector<int> cells;
  std::vector<Joint> joints;
};

std::vector<Part> connected_parts(const std::vector<int>& cells, const std::vector<Joint>& joints,
                                  std::vector<int>& number_of) {
  for (std::size_t i = 0; i < cells.size(); ++i) number_of[cells[i]] = static_cast<int>(i);
  DisjointSets sets(cells.size());
  for (const Joint& edge : joints) sets.join(number_of[edge.a], number_of[edge.b]);
  const std::vector<int> part = sets.numbers();
  std::vector<Part> parts;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (part[i] >= static_cast<int>(parts.size())) parts.resize(part[i] + 1);
    parts[part[i]].cells.push_back(cells[i]);
  }
  for (const Joint& edge : joints) parts[part[number_of[edge.a]]].joints.push_back(edge);
  return parts;
}

/// Two sides of the best cut; nothing if it is not acceptable.
std::vector<Part> halves(const Part& part, double max_cut, std::vector<int>& number_of) {
  if (part.cells.size() < 2) return {};
  for (std::size_t i = 0; i < part.cells.size(); ++i)
    number_of[part.cells[i]] = static_cast<int>(i);
  std::vector<Affinity> local;
  for (const Joint& edge : part.joints)
    local.push_back({number_of[edge.a], number_of[edge.b], edge.weight});
  const auto cut = normalized_cut(static_cast<int>(part.cells.size()), local);
  if (!cut || cut->value > max_cut) return {};
  std::vector<Part> two(2);
  for (std::size_t i = 0; i < part.cells.size(); ++i)
    two[cut->second[i] ? 1 : 0].cells.push_back(part.cells[i]);
  double similar_cut = 0, pairs_cut = 0, similar = 0, pairs = 0;
  for (std::size_t k = 0; k < local.size(); ++k) {
    const bool across = cut->second[local[k].a] != cut->second[local[k].b];
    (across ? similar_cut : similar) += local[k].weight;
    (across ? pairs_cut : pairs) += part.joints[k].pairs;
    if (!across) two[cut->second[local[k].a] ? 1 : 0].joints.push_back(part.joints[k]);
  }
  if (similar_cut * pairs > kSmoothCut * similar * pairs_cut) return {};
  return two;
}

/// Increase of the cost of a segment's points under another plane.
double rise_of(const PlanarSegment& segment, const FittedPlane& plane, const FitModel& model) {
  return segment.sums.misfit(plane, model) - segment.plane.chi2;
}

/// Whether two segments are one plane: either the increase in cost of both under a common plane is
/// within chance and a part of the noise, or the smaller one continues in the larger one's plane up
/// to the allowed deviation. (A common plane tilts over a step between them; the larger one's does
/// not.)
bool are_coplanar(const PlanarSegment& large, const PlanarSegment& small, const FitModel& model) {
  // Four standard deviations, squared; share of the noise and bending that are allowed beside.
  // Chosen.
  constexpr double kChance = 16, kNoiseShare = 0.1, kBending = 4;
  if (std::abs(small.plane.plane.normal.dot(large.plane.plane.normal)) < kMaxRotationCos)
    return false;
  // Noise of these segments, if it is larger than elsewhere.
  const double noise = std::max(
      1.0, (large.plane.chi2 + small.plane.chi2) / (large.sums.count() + small.sums.count()));
  const auto chance = [&](const PlanarSegment& segment) {
    return noise * (kChance + kNoiseShare * segment.sums.count());
  };
  PlaneSums both = large.sums;
  both += small.sums;
  const FittedPlane joint = both.fit(model);
  if (!joint.ok) return false;
  if (rise_of(small, joint, model) <= chance(small) &&
      rise_of(large, joint, model) <= chance(large))
    return true;
  const double bending = small.sums.inflation(large.plane, model) - 1;
  return rise_of(small, large.plane, model) <=
         chance(small) + kBending * bending * small.sums.count();
}

}  // namespace

PlanarSegment make_segment(std::vector<int> cells, const SuperPoints& cloud,
                           const FitModel& model) {
  PlanarSegment segment;
  std::sort(cells.begin(), cells.end());
  for (const int c : cells) segment.sums += cloud.cells[c].sums;
  segment.cells = std::move(cells);
  segment.plane = segment.sums.fit(model);
  return segment;
}

std::vector<std::vector<int>> contacts_of_cells(const SuperPoints& cloud) {
  std::vector<std::vector<int>> contacts(cloud.cells.size());
  for (std::size_t k = 0; k < cloud.contacts.size(); ++k) {
    contacts[cloud.contacts[k].a].push_back(static_cast<int>(k));
    contacts[cloud.contacts[k].b].push_back(static_cast<int>(k));
  }
  return contacts;
}

bool is_one_plane(const PlanarSegment& segment, const SuperPoints& cloud, const FitModel& model) {
  if (!lies_on_plane(segment.sums, segment.plane, model)) return false;
  if (segment.cells.size() == 1) return true;
  double odd = 0;
  for (const int c : segment.cells) {
    const SuperPoint& cell = cloud.cells[c];
    const double rise = cell.sums.misfit(segment.plane, model) - cell.plane.chi2;
    if (rise > 3 * kCellRise * cell.sums.inflation(segment.plane, model)) odd += cell.sums.count();
  }
  return odd <= kOddCells * segment.sums.count();
}

std::vector<PlanarSegment> cut_into_segments(const SuperPoints& cloud, const FitModel& model,
                                             double max_cut) {
  std::vector<int> planar, number_of(cloud.cells.size(), -1);
  for (std::size_t c = 0; c < cloud.cells.size(); ++c)
    if (cloud.cells[c].planar) planar.push_back(static_cast<int>(c));
  std::vector<Joint> joints;
  for (const Contact& contact : cloud.contacts) {
    const SuperPoint &a = cloud.cells[contact.a], &b = cloud.cells[contact.b];
    if (!a.planar || !b.planar) continue;
    const double similar = std::exp(-planar_dissimilarity(a, b, model) / kDissimilarityScale);
    if (similar > kLeastAffinity)
      joints.push_back({{contact.a, contact.b, similar * contact.pairs}, 1.0 * contact.pairs});
  }
  std::vector<PlanarSegment> segments;
  std::vector<Part> stack = connected_parts(planar, joints, number_of);
  while (!stack.empty()) {
    const Part part = std::move(stack.back());
    stack.pop_back();
    PlanarSegment segment = make_segment(part.cells, cloud, model);
    std::vector<Part> two;
    if (!is_one_plane(segment, cloud, model)) two = halves(part, max_cut, number_of);
    if (two.empty()) segments.push_back(std::move(segment));
    for (const Part& half : two)
      for (Part& piece : connected_parts(half.cells, half.joints, number_of))
        stack.push_back(std::move(piece));
  }
  return segments;
}

std::vector<PlanarSegment> merge_coplanar(std::vector<PlanarSegment> segments,
                                          const SuperPoints& cloud, const FitModel& model) {
  std::stable_sort(segments.begin(), segments.end(),
                   [](const PlanarSegment& a, const PlanarSegment& b) {
                     return a.sums.count() > b.sums.count();
                   });
  std::vector<PlanarSegment> merged;
  for (PlanarSegment& segment : segments) {
    PlanarSegment* home = nullptr;
    for (PlanarSegment& other : merged) {
      if (!are_coplanar(other, segment, model)) continue;
      home = &other;
      break;
    }
    if (home == nullptr) {
      merged.push_back(std::move(segment));
      continue;
    }
    home->cells.insert(home->cells.end(), segment.cells.begin(), segment.cells.end());
    *home = make_segment(std::move(home->cells), cloud, model);
  }
  return merged;
}

}  // namespace placegraph
