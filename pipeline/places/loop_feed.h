#pragma once
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/loops/keyframe_motion.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include <cstddef>
#include <vector>

namespace placegraph {

/// Passes accepted loops and their uncertainties to the place graph. Their covariances are stated
/// by the noise of their features; how much larger the errors are is learned from the innovations,
/// the differences between the loops and the motions that the map predicted before it had them.
/// What is learned later holds for earlier loops, too: finish() passes their uncertainties again.
class LoopFeed {
 public:
  /// Adds loops that were found at once, with the stated covariance times what earlier loops have
  /// shown. They share the error of the map: one of them, the newest, provides an innovation.
  void add(const std::vector<Loop>& stated, PlaceMapper& mapper);
  /// Passes all uncertainties again.
  void finish(PlaceMapper& mapper);

  /// Factor on the stated variances: the least, from 1 on, with which the squared innovations,
  /// normalized by the covariances of loop and map, have the median of a chi-squared variable of 6
  /// degrees of freedom.
  double factor() const;
  void visit_state(auto& archive) { archive(added_, innovations_); }

 private:
  struct Innovation {
    Vector6d error;
    Matrix6d of_loop, of_map;  // covariances
    void visit_state(auto& archive) { archive(error, of_loop, of_map); }
  };
  struct Added {
    std::size_t number = 0;  // by which the graph knows the loop
    double factor = 1;       // on its covariance
    void visit_state(auto& archive) { archive(number, factor); }
  };
  std::vector<Added> added_;
  std::vector<Innovation> innovations_;  // the newest
};

}  // namespace placegraph
