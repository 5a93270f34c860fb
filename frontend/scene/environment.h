#pragma once
#include <placegraph/frontend/scene/scene_masks.h>
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

constexpr int kEvidenceCount = 15;
/// Their names, in order.
const std::array<const char*, kEvidenceCount>& evidence_names();

/// What one view says of the kind of environment it was taken in, each a number of its own; nan
/// where it was not looked at (no depth, no unit).
struct EnvironmentEvidence {
  std::array<double, kEvidenceCount> values;
  EnvironmentEvidence() { values.fill(std::numeric_limits<double>::quiet_NaN()); }

  /// `sky_above ground_above vertical_above ground_below vertical_below object`.
  void see(const SurfaceShares& shares);
  /// `lines upright level rectangular`: how much straight edge there is, shares of it that are
  /// upright and level in the image, and that point along the axes of the likeliest rectangular
  /// world. Edges [px] of an image of `camera`.
  void see(const std::vector<LineSegment>& segments, const Camera& camera);
  /// `spread tall depth side above`: how much farther the far points are than the near ones, how
  /// high they reach for how far they are; and, where `metric`, how far away, how far to the side
  /// and how high above the camera they are. Points in the camera's frame (y down) and unit;
  /// nothing of fewer than 20.
  void see(const std::vector<Eigen::Vector3d>& points_cam, bool metric);
};

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

struct EnvironmentFilterOptions {
  double stay = 0.97;     ///< probability that the next view is of the same kind
  double evidence = 0.5;  ///< power of a view's probabilities: neighbours err alike
  double enter = 0.8;     ///< probability from which a kind is taken
  double leave = 0.4;     ///< and below which it is given up
  int min_views = 3;      ///< before anything is said
  void check() const;
};
void visit(OptionVisitor& field, EnvironmentFilterOptions& options);

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
