#pragma once
#include <placegraph/frontend/scene/environment_evidence.h>
#include <placegraph/frontend/scene/scene_masks.h>
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

/// Multinomial logistic regression over standardized evidence.
///
/// Missing evidence counts as the mean, so that it favours no kind.
struct EnvironmentModel {
  std::array<double, kEvidenceCount> mean{}, sigma{};
  std::array<double, kEnvironmentCount> bias{};
  std::array<std::array<double, kEvidenceCount>, kEnvironmentCount> weights{};

  /// Probabilities of the kinds, sum 1.
  std::array<double, kEnvironmentCount> probabilities(const EnvironmentEvidence& evidence) const;
};

/// Model that is built into the library (docs/scene.md documents its training).
const EnvironmentModel& built_in_environments();

/// Text of a model: `environment EVIDENCE`, `bias` with one number per kind, then `name mean sigma`
/// and one weight per kind for every evidence. Reading throws FileError "path:line: ..." for
/// anything else.
std::string to_text(const EnvironmentModel& model);
EnvironmentModel parse_environments(const std::string& text, const std::string& path);

struct EnvironmentSample {
  EnvironmentEvidence evidence;
  Environment kind = Environment::kStreet;
};

/// Trains a model by gradient descent on the log loss with a quadratic penalty.
///
/// All kinds have the same weight, for any number of samples. Every sample counts five times:
/// complete, without its points, without metric scale, without its surfaces, and by its points
/// alone. The same samples give the same bits. Throws ArgumentError unless there are samples of two
/// kinds.
EnvironmentModel train_environments(const std::vector<EnvironmentSample>& samples,
                                    double penalty = 1e-3);

/// Filter of the kind of environment over views in order of travel.
///
/// A hidden Markov model, filtered forwards, with two thresholds (hysteresis) for the accepted
/// kind.
class EnvironmentFilter {
 public:
  explicit EnvironmentFilter(const EnvironmentFilterOptions& options);
  /// Adds a view and returns the kind; nothing while it is unknown.
  std::optional<Environment> add(const std::array<double, kEnvironmentCount>& probabilities);
  const std::array<double, kEnvironmentCount>& probabilities() const { return state_; }
  std::optional<Environment> kind() const { return kind_; }
  void visit_state(auto& archive) { archive(state_, kind_, views_); }

 private:
  EnvironmentFilterOptions options_;
  std::array<double, kEnvironmentCount> state_{};
  std::optional<Environment> kind_;
  int views_ = 0;
};

}  // namespace placegraph
