#pragma once
#include <placegraph/frontend/scene/environment_evidence.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/scene/environment.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Probabilities of the kinds of environment of a view, sum 1.
using EnvironmentProbabilities = std::array<double, kEnvironmentCount>;

/// Multinomial logistic regression over standardized evidence.
///
/// Missing evidence counts as the mean, so that it favours no kind.
struct EnvironmentModel {
  std::array<double, kEvidenceCount> mean{};     ///< mean of each value of the evidence
  std::array<double, kEvidenceCount> sigma{};    ///< its standard deviation
  std::array<double, kEnvironmentCount> bias{};  ///< constant of each kind
  /// Weights of the values for each kind.
  std::array<std::array<double, kEvidenceCount>, kEnvironmentCount> weights{};

  /// Probabilities of the kinds, sum 1.
  EnvironmentProbabilities probabilities(const EnvironmentEvidence& evidence) const;
};

/// Model that is built into the library (docs/scene.md documents its training).
const EnvironmentModel& built_in_environments();

/// Text of a model.
///
/// `environment EVIDENCE`, `bias` with one number per kind, then `name mean sigma` and one weight
/// per kind for every evidence.
std::string to_text(const EnvironmentModel& model);
/// Reads the text of a model; throws FileError "path:line: ..." for anything else.
EnvironmentModel parse_environments(const std::string& text, const std::string& path);

/// A view of a training set.
struct EnvironmentSample {
  EnvironmentEvidence evidence;             ///< what is measured in it
  Environment kind = Environment::kStreet;  ///< where it was taken
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
  /// Starts without a kind. Throws ArgumentError for options out of range.
  explicit EnvironmentFilter(const EnvironmentFilterOptions& options);
  /// Adds a view and returns the kind; nothing while it is unknown.
  std::optional<Environment> add(const EnvironmentProbabilities& probabilities);
  /// Probabilities of the kinds by all views so far.
  const EnvironmentProbabilities& probabilities() const { return state_; }
  /// The accepted kind.
  std::optional<Environment> kind() const { return kind_; }
  /// Gives its state to an archive, which saves or restores it.
  void visit_state(auto& archive) { archive(state_, kind_, views_); }

 private:
  EnvironmentFilterOptions options_;
  EnvironmentProbabilities state_{};
  std::optional<Environment> kind_;
  int views_ = 0;
};

/// Probability of an environment in which the classes of streets apply.
///
/// It is the sum over the kinds whose assumptions include the surfaces of streets.
double street_probability(const EnvironmentProbabilities& kinds);

/// Probabilities of the kinds at each of consecutive views by the evidence of all of them.
///
/// The hidden Markov model of EnvironmentFilter, forwards and backwards. `views` are the
/// probabilities of lone views in order of travel.
std::vector<EnvironmentProbabilities> smoothed_kinds(
    const std::vector<EnvironmentProbabilities>& views,
    const EnvironmentFilterOptions& options = {});

}  // namespace placegraph
