#pragma once
#include <placegraph/frontend/vanishing/vanishing_evidence.h>
#include <placegraph/frontend/vanishing/vanishing_model.h>
#include <placegraph/graph/core/random.h>

#include <vector>

namespace placegraph {

/// Search for directions that a VanishingModel lacks.
///
/// Pairs of lines propose directions, each with the quick gain of every line; those that add most
/// are tried one by one.
class VanishingSearch {
 public:
  /// Draws the first `samples` pairs. The evidence and the random numbers must outlive the search.
  VanishingSearch(const VanishingEvidence& evidence, int samples, Random& random);

  /// Adds directions to the model as long as its cost decreases, up to `max_directions`. If no
  /// proposal reduces it, half as many pairs are drawn among the lines without a direction.
  void grow(VanishingModel& model, int max_directions);
  /// Computes the gains again, after the noise of the evidence has changed.
  void refresh();

 private:
  void draw(int count, const std::vector<int>& of);
  void score(Eigen::Index proposal);
  std::vector<Eigen::Vector3d> best(const Eigen::ArrayXf& present, int count) const;
  Eigen::ArrayXf present_gains(const VanishingModel& model) const;
  Eigen::Index size() const { return static_cast<Eigen::Index>(directions_.size()); }

  const VanishingEvidence& evidence_;
  int samples_ = 0;
  Random& random_;
  std::vector<Eigen::Vector3d> directions_;
  Eigen::ArrayXXf gains_;  ///< one column per proposal
  Eigen::Index scored_ = 0;
};

}  // namespace placegraph
