#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A point of something that stands still, as a keyframe sees it, in the keyframe's camera frame.
struct SemanticPoint {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  float sigma = 0;           ///< of its depth [m]
  float height_m = 0;        ///< above the ground under it
  std::uint16_t region = 0;  ///< of the sight: what the point is
};

/// What one keyframe tells of the things around it, and where it hangs: it moves with its place.
struct SemanticSight {
  KeyframeId keyframe;
  std::vector<float> shares;  ///< regions x classes, probabilities
  std::vector<SemanticPoint> points;
  Eigen::Vector3f down = Eigen::Vector3f::UnitY();  ///< unit, camera frame
};

/// A cube of space that something was seen in.
struct SemanticCell {
  Eigen::Vector3i at = Eigen::Vector3i::Zero();    ///< its corner [cells] in the plan frame
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();  ///< of its points, plan frame [m]
  float height_m = 0;                              ///< above the ground
  float weight = 0;                                ///< points, those that are uncertain count less
  int sights = 0;
  int label = -1;        ///< class; -1: unknown
  float confidence = 0;  ///< probability of its most probable class
};

/// What is where in a street: cells with a class each. The plan frame is the map's, turned so that
/// y points straight down.
struct SemanticMap {
  /// Too few data: nothing was seen, or lengths or depths are not known.
  Outcome outcome;
  std::vector<std::string> classes;
  SO3 R_plan_map;
  double cell_m = 0.3;
  std::vector<SemanticCell> cells;  ///< sorted by `at`
  std::vector<float> log_odds;      ///< cells x classes, see SemanticGrid

  int class_count() const { return static_cast<int>(classes.size()); }
};

struct SemanticGridOptions {
  double cell_m = 0.3;        ///< side of a cell
  double max_sigma_m = 0.6;   ///< points whose depth is worse are left out
  double sight_weight = 0.5;  ///< how much a further sight counts: they err alike
  double full_weight = 4;     ///< points of a sight in a cell that make it count wholly
  double min_weight = 3;      ///< of a cell that is known
  int min_sights = 2;         ///< the same
  double min_confidence = 0.4;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SemanticGridOptions& options);

/// Sights laid out in one frame. For each class l of a cell
///   L_t(l) = L_{t-1}(l) + a (log p(l | z_t) - log p(l)),  P(l) = exp L(l) / sum exp L
/// with log p(l | z_t) the mean over the points of sight t in the cell, each weighted by
/// 1 / (1 + (sigma / cell)^2), a = sight_weight * min(1, their weights / full_weight), and p(l) the
/// same for all classes (METHODS 10). A cell is its most probable class where that has
/// min_confidence and the cell enough weight and sights; else it is unknown.
class SemanticGrid {
 public:
  /// Throws ArgumentError for options out of range or fewer than two classes.
  SemanticGrid(const SemanticGridOptions& options, std::vector<std::string> classes,
               const SO3& R_plan_map);
  /// Throws ArgumentError if a point names a region that the sight does not have.
  void add(const SemanticSight& sight, const SE3& T_map_cam);
  [[nodiscard]] SemanticMap map() const;

 private:
  std::size_t cell_at(const Eigen::Vector3i& at);
  SemanticGridOptions options_;
  std::vector<std::string> classes_;
  SO3 R_plan_map_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
  std::vector<SemanticCell> cells_;  ///< mean and height are sums of weight x value
  std::vector<float> log_odds_;
};

/// The map from above: for each column the cell that shows. Where something stands, it is that, as
/// in a picture from the air; else the ground.
struct TopView {
  double cell_m = 0;
  Eigen::Vector2i low = Eigen::Vector2i::Zero();  ///< (x, z) of the first column [cells]
  int columns = 0, rows = 0;                      ///< along x and z
  std::vector<int> cell;                          ///< index of a known cell, -1: nothing known

  int at(int column, int row) const {
    return cell[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(column)];
  }
};

/// Of the known cells. Something stands where cells higher than `standing_m` above the ground have
/// at least a quarter of the weight of those below, of the class that has most of it.
TopView top_view(const SemanticMap& map, double standing_m = 0.5);

/// A colour for a class, as CamVid has them: by its name, else by its number. {red, green, blue}.
std::array<std::uint8_t, 3> class_colour(const std::string& name, int number);

}  // namespace placegraph
