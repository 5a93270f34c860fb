#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A point of a static object as a keyframe observes it, in the keyframe's camera frame.
struct StreetPoint {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< position [m]
  float sigma = 0;                                  ///< standard deviation of its depth [m]
  float height_m = 0;                               ///< height above the ground below it
  std::uint16_t region = 0;  ///< its superpixel: a row of KeyframeStreetPoints::shares
};

/// The labelled points that one keyframe observes; in its frame, so that they move with it.
struct KeyframeStreetPoints {
  KeyframeId keyframe;                              ///< the keyframe
  std::vector<float> shares;                        ///< regions x classes, probabilities
  std::vector<StreetPoint> points;                  ///< points in its camera frame
  Eigen::Vector3f down = Eigen::Vector3f::UnitY();  ///< unit vector of gravity, camera frame
};

/// A cube of space in which something was observed.
struct StreetCell {
  Eigen::Vector3i at = Eigen::Vector3i::Zero();    ///< its lower corner in the plan frame [cells]
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();  ///< mean of its points, plan frame [m]
  float height_m = 0;                              ///< mean height of its points above the ground
  float weight = 0;          ///< number of points, each counted by 1 / (1 + (sigma / cell)^2)
  int observations = 0;      ///< keyframes with a point in it
  std::optional<int> label;  ///< position in StreetMap::classes; nothing: unknown
  float confidence = 0;      ///< probability of its most probable class
};

/// A map of a street: cells of space, each with a class.
/// The plan frame is the map's, rotated so that y points straight down.
struct StreetMap {
  Outcome outcome;  ///< kTooFewData: nothing was observed, or lengths or depths are not known
  std::vector<std::string> classes;  ///< names
  SO3 R_plan_map;                    ///< maps directions of the map frame to the plan frame
  double cell_m = 0.3;               ///< side of a cell
  std::vector<StreetCell> cells;     ///< sorted by `at`
  std::vector<float> log_odds;       ///< cells x classes, see StreetGrid

  /// Number of classes.
  int class_count() const { return static_cast<int>(classes.size()); }
};

/// How observations are fused in a StreetGrid, and when a cell is known.
struct StreetGridOptions {
  double cell_m = 0.3;       ///< side of a cell
  double max_sigma_m = 0.6;  ///< points with a larger standard deviation of depth are left out
  double observation_weight = 0.5;  ///< below 1, as the errors of several keyframes are correlated
  /// Weight of a keyframe's points in a cell with which the keyframe counts fully.
  double full_weight = 4;
  double min_weight = 3;        ///< least weight of a known cell
  int min_observations = 2;     ///< least number of keyframes of a known cell
  double min_confidence = 0.4;  ///< least probability of the class of a known cell
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, StreetGridOptions& options);

/// Fuses the labelled points of keyframes in a grid of cells. For each class l of a cell:
///
///   L_t(l) = L_{t-1}(l) + a (log p(l | z_t) - log p(l)),  P(l) = exp L(l) / sum exp L
///
/// with log p(l | z_t) the mean over the points of keyframe t in the cell, each weighted by
/// 1 / (1 + (sigma / cell)^2), a = observation_weight * min(1, their weights / full_weight), and
/// p(l) the same for all classes. A cell has its most probable class if that has min_confidence and
/// the cell enough weight and keyframes; else it is unknown.
class StreetGrid {
 public:
  /// An empty grid; throws ArgumentError for options out of range or fewer than two classes.
  StreetGrid(const StreetGridOptions& options, std::vector<std::string> classes,
             const SO3& R_plan_map);
  /// Adds the points of a keyframe at its pose.
  /// Points that are too uncertain or not finite are left out. Throws ArgumentError if a point
  /// names a region that `observation` does not have.
  void add(const KeyframeStreetPoints& observation, const SE3& T_map_cam);
  /// The map of all points that were added; kTooFewData if there are none.
  [[nodiscard]] StreetMap map() const;

 private:
  std::size_t cell_at(const Eigen::Vector3i& at);
  StreetGridOptions options_;
  std::vector<std::string> classes_;
  SO3 R_plan_map_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
  std::vector<StreetCell> cells_;  ///< mean and height are sums of weight x value
  std::vector<float> log_odds_;
};

/// A street map seen from above: one cell of each column of cells.
/// In a column with an object it is a cell of the object, as in an aerial photograph, else a cell
/// of the ground.
struct TopView {
  double cell_m = 0;                              ///< side of a cell
  Eigen::Vector2i low = Eigen::Vector2i::Zero();  ///< (x, z) of the first column [cells]
  int columns = 0, rows = 0;                      ///< along x and z; 0 without a known cell
  std::vector<int> cell;  ///< row by row: position in StreetMap::cells, -1: nothing known

  /// The cell shown there; column and row count from `low` and must be within the view.
  int at(int column, int row) const {
    return cell[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(column)];
  }
};

/// The known cells of a map from above.
/// A column has an object if its cells higher than `standing_m` above the ground have at least a
/// quarter of the weight of those below. The view shows the cell of largest weight of the class
/// that has the largest weight, among the cells above or below accordingly.
TopView top_view(const StreetMap& map, double standing_m = 0.5);

/// A colour {red, green, blue} for a class: CamVid's by its name, else one by its number.
std::array<std::uint8_t, 3> class_colour(const std::string& name, int number);

}  // namespace placegraph
