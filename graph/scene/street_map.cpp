#include <placegraph/graph/core/error.h>
#include <placegraph/graph/scene/street_map.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace placegraph {
namespace {

// Least share of a class: none is impossible. Chosen.
constexpr float kLeastShare = 1e-3F;
constexpr int kBits = 21, kMiddle = 1 << (kBits - 1);  // coordinates in a cell's key

std::uint64_t key_of(const Eigen::Vector3i& at) {
  std::uint64_t key = 0;
  for (int i = 0; i < 3; ++i)
    key = (key << kBits) |
          (static_cast<std::uint64_t>(at[i] + kMiddle) & ((std::uint64_t{1} << kBits) - 1));
  return key;
}

bool before(const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// The contribution of one keyframe to a cell.
struct CellUpdate {
  float weight = 0, height = 0;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  std::vector<float> log_shares;
};

}  // namespace

void visit(OptionVisitor& field, StreetGridOptions& o) {
  field("cell_m", o.cell_m, "side of a cell [m]", {0.05, 5});
  field("max_sigma_m", o.max_sigma_m, "largest standard deviation of the depth of a point [m]",
        {0.01, 100});
  field.formerly("sight_weight")(
      "observation_weight", o.observation_weight,
      "weight of a keyframe; below 1, as errors of keyframes are correlated", {0.01, 1});
  field("full_weight", o.full_weight,
        "weight of a keyframe's points in a cell at which it counts fully", {0.1, 1000});
  field("min_weight", o.min_weight, "minimum weight of the points of a known cell", {0, 1e6});
  field.formerly("min_sights")("min_observations", o.min_observations,
                               "minimum number of keyframes of a known cell", {1, 1000});
  field("min_confidence", o.min_confidence, "minimum probability of the class of a known cell",
        {0, 1});
}

StreetGrid::StreetGrid(const StreetGridOptions& options, std::vector<std::string> classes,
                       const SO3& R_plan_map)
    : options_(options), classes_(std::move(classes)), R_plan_map_(R_plan_map) {
  options_.check();
  require(classes_.size() > 1, "semantic grid: at least two classes needed");
}

std::size_t StreetGrid::cell_at(const Eigen::Vector3i& at) {
  const auto [entry, fresh] = index_.emplace(key_of(at), cells_.size());
  if (fresh) {
    StreetCell cell;
    cell.at = at;
    cells_.push_back(cell);
    log_odds_.resize(log_odds_.size() + classes_.size(), 0);
  }
  return entry->second;
}

void StreetGrid::add(const KeyframeStreetPoints& observation, const SE3& T_map_cam) {
  const std::size_t n = classes_.size();
  std::vector<float> log_shares(observation.shares.size());
  for (std::size_t i = 0; i < log_shares.size(); ++i)
    log_shares[i] = std::log(std::max(observation.shares[i], kLeastShare));
  const SE3 T_plan_cam = SE3(R_plan_map_, Eigen::Vector3d::Zero()) * T_map_cam;
  const Eigen::Matrix3f R = T_plan_cam.rotation().matrix().cast<float>();
  const Eigen::Vector3d t = T_plan_cam.translation();
  const auto cell = static_cast<float>(options_.cell_m);
  // In the order of the first observation, so that sums do not depend on a hash.
  std::unordered_map<std::size_t, std::size_t> update_of;
  std::vector<std::pair<std::size_t, CellUpdate>> all;
  for (const StreetPoint& p : observation.points) {
    require((p.region + std::size_t{1}) * n <= observation.shares.size(),
            "semantic grid: a point names a region that the observation does not have");
    if (static_cast<double>(p.sigma) > options_.max_sigma_m) continue;
    const Eigen::Vector3d at = (R * p.point).cast<double>() + t;
    if (!at.allFinite() || at.cwiseAbs().maxCoeff() >= (kMiddle - 1) * options_.cell_m) continue;
    const Eigen::Vector3i corner = (at / options_.cell_m).array().floor().cast<int>();
    const std::size_t index = cell_at(corner);
    const auto [entry, fresh] = update_of.emplace(index, all.size());
    if (fresh)
      all.emplace_back(index, CellUpdate{0, 0, Eigen::Vector3f::Zero(), std::vector<float>(n)});
    CellUpdate& update = all[entry->second].second;
    const float weight = 1 / (1 + p.sigma * p.sigma / (cell * cell));
    update.weight += weight;
    update.height += weight * p.height_m;
    // Relative to the cell's corner, for numerical precision.
    update.sum += weight * (at - options_.cell_m * corner.cast<double>()).cast<float>();
    for (std::size_t l = 0; l < n; ++l)
      update.log_shares[l] += weight * log_shares[p.region * n + l];
  }
  const float log_prior = -std::log(static_cast<float>(n));
  for (const auto& [index, update] : all) {
    StreetCell& known = cells_[index];
    known.weight += update.weight;
    known.mean += update.sum;
    known.height_m += update.height;
    ++known.observations;
    const float step = static_cast<float>(options_.observation_weight) *
                       std::min(1.0F, update.weight / static_cast<float>(options_.full_weight));
    for (std::size_t l = 0; l < n; ++l)
      log_odds_[index * n + l] += step * (update.log_shares[l] / update.weight - log_prior);
  }
}

StreetMap StreetGrid::map() const {
  StreetMap map;
  map.classes = classes_;
  map.R_plan_map = R_plan_map_;
  map.cell_m = options_.cell_m;
  if (cells_.empty()) {
    map.outcome = Outcome::failure(Outcome::Code::kTooFewData, "nothing was observed");
    return map;
  }
  map.outcome = Outcome::ok();
  std::vector<std::size_t> order(cells_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return before(cells_[a].at, cells_[b].at); });
  const std::size_t n = classes_.size();
  for (const std::size_t i : order) {
    StreetCell cell = cells_[i];
    cell.mean = (options_.cell_m * cell.at.cast<double>()).cast<float>() + cell.mean / cell.weight;
    cell.height_m /= cell.weight;
    const float* cell_log_odds = log_odds_.data() + i * n;
    const float* best = std::max_element(cell_log_odds, cell_log_odds + n);
    float sum = 0;
    for (std::size_t l = 0; l < n; ++l) sum += std::exp(cell_log_odds[l] - *best);
    cell.confidence = 1 / sum;
    if (static_cast<double>(cell.confidence) >= options_.min_confidence &&
        static_cast<double>(cell.weight) >= options_.min_weight &&
        cell.observations >= options_.min_observations)
      cell.label = static_cast<int>(best - cell_log_odds);
    map.cells.push_back(cell);
    map.log_odds.insert(map.log_odds.end(), cell_log_odds, cell_log_odds + n);
  }
  return map;
}

namespace {

/// The cells of one column that are in `standing`, or the others: weights by class and in total.
struct Layer {
  std::map<int, float> by_class;
  float weight = 0;
  void add(const StreetCell& cell) {
    by_class[*cell.label] += cell.weight;
    weight += cell.weight;
  }
  int label() const {
    int best = -1;
    float most = 0;
    for (const auto& [label, sum] : by_class)
      if (sum > most) best = label, most = sum;
    return best;
  }
};

}  // namespace

TopView top_view(const StreetMap& map, double standing_m) {
  TopView view;
  view.cell_m = map.cell_m;
  Eigen::Vector2i low = Eigen::Vector2i::Constant(1 << 30), high = -low;
  for (const StreetCell& cell : map.cells) {
    if (!cell.label) continue;
    low = low.cwiseMin(Eigen::Vector2i(cell.at[0], cell.at[2]));
    high = high.cwiseMax(Eigen::Vector2i(cell.at[0], cell.at[2]));
  }
  if (high[0] < low[0]) return view;
  view.low = low;
  view.columns = high[0] - low[0] + 1;
  view.rows = high[1] - low[1] + 1;
  struct Column {
    Layer ground, standing;
  };
  std::map<std::pair<int, int>, Column> columns;
  const auto stands = [&](const StreetCell& cell) {
    return static_cast<double>(cell.height_m) > standing_m;
  };
  for (const StreetCell& cell : map.cells) {
    if (!cell.label) continue;
    Column& column = columns[{cell.at[0], cell.at[2]}];
    (stands(cell) ? column.standing : column.ground).add(cell);
  }
  view.cell.assign(static_cast<std::size_t>(view.columns) * static_cast<std::size_t>(view.rows),
                   -1);
  std::vector<float> weight(view.cell.size(), 0);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const StreetCell& cell = map.cells[i];
    if (!cell.label) continue;
    const Column& column = columns[{cell.at[0], cell.at[2]}];
    // Weight of what stands over that of the ground below. Chosen.
    constexpr float kEnough = 0.25F;
    const bool standing =
        column.standing.weight > 0 && column.standing.weight >= kEnough * column.ground.weight;
    if (stands(cell) != standing) continue;
    if (cell.label != (standing ? column.standing : column.ground).label()) continue;
    const std::size_t at =
        static_cast<std::size_t>(cell.at[2] - low[1]) * static_cast<std::size_t>(view.columns) +
        static_cast<std::size_t>(cell.at[0] - low[0]);
    if (cell.weight > weight[at]) view.cell[at] = static_cast<int>(i), weight[at] = cell.weight;
  }
  return view;
}

std::array<std::uint8_t, 3> class_colour(const std::string& name, int number) {
  static const std::map<std::string, std::array<std::uint8_t, 3>> kNamed = {
      {"Sky", {128, 128, 128}},      {"Building", {128, 0, 0}},    {"Pole", {192, 192, 128}},
      {"Road", {128, 64, 128}},      {"Pavement", {60, 40, 222}},  {"Tree", {128, 128, 0}},
      {"Sign", {192, 128, 128}},     {"Fence", {64, 64, 128}},     {"Car", {64, 0, 128}},
      {"Pedestrian", {200, 120, 0}}, {"Bicyclist", {0, 128, 192}}, {"sky", {86, 180, 233}},
      {"ground", {0, 158, 115}},     {"vertical", {213, 94, 0}},   {"object", {240, 228, 66}}};
  const auto found = kNamed.find(name);
  if (found != kNamed.end()) return found->second;
  const auto byte = [&](int factor) {
    return static_cast<std::uint8_t>(40 + (number * factor) % 200);
  };
  return {byte(67), byte(131), byte(29)};
}

}  // namespace placegraph
