#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>
#include <placegraph/io/internal/files/text_file.h>

#include <map>
#include <string>
#include <vector>

namespace placegraph {

/// What lines of a graph file say beside poses and the edges between them: priors, point landmarks,
/// what sees them, and where sensors sit on a node. Members throw FileError for the line that the
/// file stands at, `add_to` for the line that added what is wrong.
class LandmarkLines {
 public:
  explicit LandmarkLines(const TextFile& file) : file_(&file) {}

  bool empty() const { return priors_.empty() && points_.empty() && observations_.empty(); }
  /// Of the first one; precondition: there is one.
  int first_line() const;

  /// A sensor's pose on a node: T_node_sensor. Other lines name it by its number, in any order.
  void add_offset(std::string_view number, const SE3& T_node_sensor);
  /// A measured pose of a node, or of a sensor on it (an offset's number; none: of the node).
  void add_prior(std::string_view node, const Pose& T_world_sensor, const Information& information,
                 std::string_view offset = {});
  void add_point(std::string_view id, const Eigen::Vector3d& position_world, bool planar);
  /// A point as a node, or a sensor on it, sees it.
  void add_observation(std::string_view node, std::string_view point,
                       const Eigen::Vector3d& position, const Eigen::Matrix3d& information,
                       bool planar, std::string_view offset = {});

  /// Fixes the point of this id, if there is one.
  bool fix(NodeId id);

  /// Adds what the lines say. Points that no line gives a place to are where their first sight
  /// says. Throws FileError for nodes and offsets that are not there, ids that are there twice, and
  /// what is of the plane in space or the other way round.
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
