#include <placegraph/frontend/scene/environment.h>
#include <placegraph/frontend/scene/evidence_kind.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <sstream>

namespace placegraph {
namespace {

/// Exponent on a keyframe's probabilities, as errors of neighbours are correlated. Chosen.
constexpr double kEvidenceExponent = 0.5;
/// Number of keyframes before a kind is accepted. Chosen.
constexpr int kMinEnvironmentViews = 3;
/// Probability that the next keyframe is in the same kind of environment. Chosen.
constexpr double kStay = 0.97;

void normalize(std::array<double, kEnvironmentCount>& shares) {
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= sum;
}

/// Standardized evidence; 0 for missing values.
std::array<double, kEvidenceCount> standardized(const EnvironmentModel& model,
                                                const EnvironmentEvidence& evidence) {
  constexpr double kMost = 3;  // limits the effect of a single outlying value
  std::array<double, kEvidenceCount> x{};
  for (std::size_t i = 0; i < kEvidenceCount; ++i)
    if (std::isfinite(evidence.values[i]) && model.sigma[i] > 0)
      x[i] = std::clamp((evidence.values[i] - model.mean[i]) / model.sigma[i], -kMost, kMost);
  return x;
}

std::array<double, kEnvironmentCount> softmax(const EnvironmentModel& model,
                                              const std::array<double, kEvidenceCount>& x) {
  std::array<double, kEnvironmentCount> p{};
  for (std::size_t k = 0; k < kEnvironmentCount; ++k)
    p[k] = std::inner_product(x.begin(), x.end(), model.weights[k].begin(), model.bias[k]);
  const double largest = *std::max_element(p.begin(), p.end());
  for (double& value : p) value = std::exp(value - largest);
  normalize(p);
  return p;
}

/// Variants of a sample: complete, without its points, without metric scale, without its surfaces,
/// and by its points alone, which differ least between rendered and real scenes. Rendered rooms are
/// more rectangular than any real one, so that this evidence is not used.
constexpr std::size_t kVariants = 5;
std::array<EnvironmentEvidence, kVariants> variants_of(const EnvironmentEvidence& evidence) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  std::array<EnvironmentEvidence, kVariants> variants;
  variants.fill(evidence);
  for (EnvironmentEvidence& variant : variants) variant.values[kRectangular] = unknown;
  for (std::size_t i = kSpread; i <= kAbove; ++i) variants[1].values[i] = unknown;
  for (std::size_t i = kDepth; i <= kAbove; ++i) variants[2].values[i] = unknown;
  for (std::size_t i = kSkyAbove; i <= kObject; ++i) variants[3].values[i] = unknown;
  for (std::size_t i = kSkyAbove; i <= kRectangular; ++i) variants[4].values[i] = unknown;
  return variants;
}

void standardize(const std::vector<EnvironmentSample>& samples, EnvironmentModel& model) {
  for (std::size_t i = 0; i < kEvidenceCount; ++i) {
    double n = 0, sum = 0, squares = 0;
    for (const EnvironmentSample& sample : samples) {
      const double value = sample.evidence.values[i];
      if (!std::isfinite(value)) continue;
      n += 1, sum += value, squares += value * value;
    }
    if (n < 2) continue;
    model.mean[i] = sum / n;
    model.sigma[i] = std::sqrt(std::max(1e-6, squares / n - model.mean[i] * model.mean[i]));
  }
}

}  // namespace

std::array<double, kEnvironmentCount> EnvironmentModel::probabilities(
    const EnvironmentEvidence& evidence) const {
  return softmax(*this, standardized(*this, evidence));
}

EnvironmentModel train_environments(const std::vector<EnvironmentSample>& samples, double penalty) {
  std::array<double, kEnvironmentCount> count{};
  for (const EnvironmentSample& sample : samples) count[static_cast<std::size_t>(sample.kind)] += 1;
  const auto kinds = std::count_if(count.begin(), count.end(), [](double n) { return n > 0; });
  require(kinds >= 2, "train_environments: needs samples of two kinds");
  EnvironmentModel model;
  standardize(samples, model);
  struct Row {
    std::array<double, kEvidenceCount> x;
    std::size_t kind;
    double weight;
  };
  std::vector<Row> rows;
  for (const EnvironmentSample& sample : samples) {
    const auto kind = static_cast<std::size_t>(sample.kind);
    for (const EnvironmentEvidence& variant : variants_of(sample.evidence))
      rows.push_back({standardized(model, variant), kind,
                      1 / (kVariants * count[kind] * static_cast<double>(kinds))});
  }
  // A kind without samples gets a negligible probability.
  for (std::size_t k = 0; k < kEnvironmentCount; ++k) model.bias[k] = count[k] > 0 ? 0 : -20;
  // Steps of the descent and their rate. Chosen.
  constexpr int kSteps = 3000;
  constexpr double kRate = 0.5;
  for (int step = 0; step < kSteps; ++step) {
    EnvironmentModel slope;
    for (const Row& row : rows) {
      const auto p = softmax(model, row.x);
      for (std::size_t k = 0; k < kEnvironmentCount; ++k) {
        const double error = row.weight * (p[k] - (k == row.kind ? 1 : 0));
        slope.bias[k] += error;
        for (std::size_t i = 0; i < kEvidenceCount; ++i) slope.weights[k][i] += error * row.x[i];
      }
    }
    for (std::size_t k = 0; k < kEnvironmentCount; ++k) {
      if (count[k] > 0) model.bias[k] -= kRate * slope.bias[k];
      for (std::size_t i = 0; i < kEvidenceCount; ++i)
        model.weights[k][i] -= kRate * (slope.weights[k][i] + penalty * model.weights[k][i]);
    }
  }
  return model;
}

std::string to_text(const EnvironmentModel& model) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(4);
  text << "environment " << kEvidenceCount << "\nkinds";
  for (std::size_t k = 0; k < kEnvironmentCount; ++k)
    text << ' ' << environment_name(static_cast<Environment>(k));
  text << "\nbias";
  for (const double bias : model.bias) text << ' ' << bias;
  text << '\n';
  for (std::size_t i = 0; i < kEvidenceCount; ++i) {
    text << evidence_names()[i] << ' ' << model.mean[i] << ' ' << model.sigma[i];
    for (const auto& weights : model.weights) text << ' ' << weights[i];
    text << '\n';
  }
  return text.str();
}

EnvironmentModel parse_environments(const std::string& text, const std::string& path) {
  std::istringstream stream(text);
  EnvironmentModel model;
  std::array<bool, kEvidenceCount> seen{};
  bool has_bias = false;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    fields.imbue(std::locale::classic());
    std::string name, rest;
    fields >> name;
    if (name == "kinds") {
      for (std::size_t k = 0; k < kEnvironmentCount; ++k)
        if (!(fields >> rest) || rest != environment_name(static_cast<Environment>(k)))
          throw FileError(path, number, "the kinds differ from those of this program");
      continue;
    }
    if (name == "environment") {
      int count = 0;
      if (!(fields >> count) || count != kEvidenceCount)
        throw FileError(path, number,
                        "the number of evidence values differs from that of this program, " +
                            std::to_string(kEvidenceCount));
      continue;
    }
    const auto known = std::find(evidence_names().begin(), evidence_names().end(), name);
    const auto i = static_cast<std::size_t>(known - evidence_names().begin());
    bool good = name == "bias" || known != evidence_names().end();
    if (good && name != "bias") good = static_cast<bool>(fields >> model.mean[i] >> model.sigma[i]);
    for (std::size_t k = 0; good && k < kEnvironmentCount; ++k) {
      double& value = name == "bias" ? model.bias[k] : model.weights[k][i];
      good = (fields >> value) && std::isfinite(value);
    }
    if (!good || fields >> rest)
      throw FileError(path, number,
                      "a line must be: evidence mean sigma, and a weight for every kind");
    (name == "bias" ? has_bias : seen[i]) = true;
  }
  if (!has_bias || !std::all_of(seen.begin(), seen.end(), [](bool s) { return s; }))
    throw FileError(path, "an evidence or the bias is missing");
  return model;
}

EnvironmentFilter::EnvironmentFilter(const EnvironmentFilterOptions& options) : options_(options) {
  options_.check();
  state_.fill(1.0 / kEnvironmentCount);
}

std::optional<Environment> EnvironmentFilter::add(
    const std::array<double, kEnvironmentCount>& probabilities) {
  const double change = (1 - kStay) / (kEnvironmentCount - 1);
  for (std::size_t k = 0; k < kEnvironmentCount; ++k)
    state_[k] = (change + (kStay - change) * state_[k]) *
                std::pow(std::max(1e-3, probabilities[k]), kEvidenceExponent);
  normalize(state_);
  if (++views_ < kMinEnvironmentViews) return kind_;
  if (kind_ && state_[static_cast<std::size_t>(*kind_)] < options_.leave) kind_.reset();
  const auto best = std::max_element(state_.begin(), state_.end());
  if (*best >= options_.enter) kind_ = static_cast<Environment>(best - state_.begin());
  return kind_;
}

double street_probability(const EnvironmentProbabilities& kinds) {
  double sum = 0;
  for (std::size_t k = 0; k < kEnvironmentCount; ++k)
    if (assumptions_of(static_cast<Environment>(k)).street_surfaces) sum += kinds[k];
  return sum;
}

std::vector<EnvironmentProbabilities> smoothed_kinds(
    const std::vector<EnvironmentProbabilities>& views, const EnvironmentFilterOptions& options) {
  EnvironmentFilter before(options), after(options);
  std::vector<EnvironmentProbabilities> ahead;  // by all later views
  for (std::size_t i = views.size(); i-- > 0; after.add(views[i]))
    ahead.push_back(after.probabilities());
  std::reverse(ahead.begin(), ahead.end());
  const double change = (1 - kStay) / (kEnvironmentCount - 1);
  std::vector<EnvironmentProbabilities> smoothed;
  for (std::size_t i = 0; i < views.size(); ++i) {
    before.add(views[i]);
    EnvironmentProbabilities& kinds = smoothed.emplace_back();
    double sum = 0;
    for (std::size_t k = 0; k < kEnvironmentCount; ++k)
      sum += kinds[k] = before.probabilities()[k] * (change + (kStay - change) * ahead[i][k]);
    for (double& kind : kinds) kind /= sum;
  }
  return smoothed;
}

}  // namespace placegraph
