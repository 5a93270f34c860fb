#pragma once
#include <placegraph/frontend/internal/scene/scene_masks.h>
#include <placegraph/frontend/scene/environment_evidence.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/scene/environment.h>

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// Multinomial logistic regression over standardized evidence; what was not looked at counts as
/// the mean, so that it speaks for none.
struct EnvironmentModel {
  std::array<double, kEvidenceCount> mean{}, sigma{};
  std::array<double, kEnvironmentCount> bias{};
  std::array<std::array<double, kEvidenceCount>, kEnvironmentCount> weights{};

  /// Of each kind, sum 1.
  std::array<double, kEnvironmentCount> probabilities(const EnvironmentEvidence& evidence) const;
};

/// The model that comes with the library (docs/scene.md says what it was trained on).
const EnvironmentModel& built_in_environments();

/// Text: `environment EVIDENCE`, `bias` with a number a kind, then `name mean sigma` and a weight a
/// kind for every evidence. Reading throws FileError "path:line: ..." for anything else.
std::string to_text(const EnvironmentModel& model);
EnvironmentModel parse_environments(const std::string& text, const std::string& path);

struct EnvironmentSample {
  EnvironmentEvidence evidence;
  Environment kind = Environment::kStreet;
};

/// By gradient descent on the log loss with a quadratic penalty; kinds weigh the same in all,
/// whatever their numbers. Every sample counts five times: as it is, without its points, its unit,
/// its surfaces, and by its points alone. Same samples, same bits. Throws ArgumentError
/// unless there are samples of two kinds.
EnvironmentModel train_environments(const std::vector<EnvironmentSample>& samples,
                                    double penalty = 1e-3);

/// The kind of environment over views in order of travel: a hidden Markov model filtered forwards,
/// and two thresholds, so that what is taken lasts.
class EnvironmentFilter {
 public:
  explicit EnvironmentFilter(const EnvironmentFilterOptions& options);
  /// The kind after one more view; nothing while it is unknown.
  std::optional<Environment> add(const std::array<double, kEnvironmentCount>& probabilities);
  const std::array<double, kEnvironmentCount>& probabilities() const { return state_; }
  std::optional<Environment> kind() const { return kind_; }

 private:
  EnvironmentFilterOptions options_;
  std::array<double, kEnvironmentCount> state_{};
  std::optional<Environment> kind_;
  int views_ = 0;
};

}  // namespace placegraph
