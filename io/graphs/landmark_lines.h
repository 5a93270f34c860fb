#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>
#include <placegraph/io/files/text_file.h>

#include <map>
#include <string>
#include <vector>

namespace placegraph {

/// The lines of a graph file beside poses and the edges between them: priors, point landmarks,
/// their observations, and the mounting of sensors on a node. Members throw FileError for the
/// current line of the file, `add_to` for the line that added the faulty data.
class LandmarkLines {
 public:
  explicit LandmarkLines(const TextFile& file) : file_(&file) {}

  bool empty() const { return priors_.empty() && points_.empty() && observations_.empty(); }
  /// Line number of the first such line; precondition: there is one.
  int first_line() const;

  /// Adds a sensor's pose on a node: T_node_sensor. Other lines refer to it by its number, in any
  /// order.
  void add_offset(std::string_view number, const SE3& T_node_sensor);
  /// Adds a measured pose of a node, or of a sensor on it (number of an offset; empty: of the
  /// node).
  void add_prior(std::string_view node, const Pose& T_world_sensor, const Information& information,
                 std::string_view offset = {});
  void add_point(std::string_view id, const Eigen::Vector3d& position_world, bool planar);
  /// Adds an observation of a point from a node, or from a sensor on it.
  void add_observation(std::string_view node, std::string_view point,
                       const Eigen::Vector3d& position, const Eigen::Matrix3d& information,
                       bool planar, std::string_view offset = {});

  /// Fixes the point with this id, if there is one.
  bool fix(NodeId id);

  /// Adds the content of the lines to a graph. A point without a given position is placed by its
  /// first observation. Throws FileError for missing nodes and offsets, duplicate ids, and planar
  /// data in a spatial graph or the other way round.
  void add_to(LandmarkGraph& graph) const;

 private:
  struct Prior {
    PosePriorConstraint prior;
    int line;
    std::string offset;
  };
  struct Point {
    GraphPoint point;
    int line;
    bool planar;
  };
  struct Observation {
    PointObservation observation;
    int line;
    bool planar;
    std::string offset;
  };
  SE3 T_node_sensor(const std::string& offset, int line) const;

  const TextFile* file_;
  std::map<std::string, SE3> offsets_;
  std::vector<Prior> priors_;
  std::vector<Point> points_;
  std::vector<Observation> observations_;
};

}  // namespace placegraph
