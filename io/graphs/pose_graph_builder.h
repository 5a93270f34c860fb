#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/pose_graph.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/graphs/landmark_lines.h>
#include <placegraph/io/graphs/pose_graph_file.h>

#include <optional>
#include <span>

namespace placegraph {

/// Builds a pose graph from the lines of a text file in any format; edges may precede their
/// vertices. Errors name the line of their cause: members throw FileError for the current line of
/// the file, finish() for the line that added the faulty data.
class PoseGraphBuilder {
 public:
  using Fields = std::vector<std::string_view>;

  /// `file` must outlive the builder.
  explicit PoseGraphBuilder(const TextFile& file);

  /// Numbers of the present line, from field `at` on.
  SE2 se2(const Fields& fields, std::size_t at) const;  ///< x y theta
  /// n (n + 1) / 2 numbers, row by row, the lower triangle zero.
  Information upper_triangle(const Fields& fields, std::size_t at, int n) const;
  /// The same, mirrored into the lower triangle.
  Information symmetric(const Fields& fields, std::size_t at, int n) const;
  /// Rejects the line unless `count` fields follow its tag.
  void require_count(const Fields& fields, std::size_t count) const;
  /// The same for a vertex, whose line may have a time stamp after its numbers if all vertices have
  /// one: a number that increases from line to line. Any other number may be a part of the pose.
  void require_count_before_stamp(const Fields& fields, std::size_t count);
  /// The matrix, or the semi-definite one that its printed digits represent. Rejects a matrix that
  /// is indefinite by more than that, all zero or above 1e100.
  Information plausible(const Information& information) const;
  /// The same; empty for a matrix that is indefinite.
  std::optional<Information> definite(const Information& information) const;
  /// Rejects positions beyond 1e50 m.
  void require_near(const Eigen::Vector3d& position) const;

  /// Rejects SE2, SE3 and Sim3 mixed, and positions beyond 1e50 m.
  void add_node(std::string_view id, const Pose& T_world_node);
  /// Rejects mixed kinds, an edge from a node to itself, information that is all zero or above
  /// 1e100, and positions beyond 1e50 m; finish() rejects or replaces information that is
  /// indefinite by more than its printed digits allow. Edges of consecutive ids are odometry,
  /// others loops, unless `source` is given; see finish().
  void add_edge(std::string_view from, std::string_view to, const Pose& T_from_to,
                const Information& information, std::optional<ConstraintSource> source = {});
  /// Adds a measured position of a node in the plane [m].
  void add_position(std::string_view node, const Eigen::Vector2d& position_world,
                    const Eigen::Matrix2d& information);
  void fix(std::string_view id);
  LandmarkLines& landmarks() { return landmarks_; }

  /// The graph, in the order of the file. If the file has only edges, the vertices are those that
  /// the edges name, by ascending id, with poses chained along the spanning tree (odometry first)
  /// from the origin. If ids have gaps such that hardly an edge joins consecutive ones (every tenth
  /// frame is a node), edges from an id to the next larger existing one are the odometry instead.
  /// Rejects duplicate ids, edges and fixes with missing vertices, an empty file, and the graphs
  /// that `reading` excludes. Priors and landmarks are rejected.
  [[nodiscard]] PoseGraph finish(const PoseGraphReading& reading);
  /// The same with priors and landmarks. Components that are each fixed in the world need not be
  /// connected.
  [[nodiscard]] LandmarkGraph finish_landmarks(const PoseGraphReading& reading);

 private:
  void make_room();
  PoseGraph finish_poses();
  void require_kind(PoseKind kind);
  void report_stamps(const PoseGraphReading& reading) const;
  int find(const NodeIndex& index, NodeId id, int line) const;
  void require_connected(const PoseGraph& graph) const;
  void add_nodes_of_edges();
  void find_odometry_by_order();
  void replace_indefinite(const PoseGraphReading& reading);

  const TextFile* file_;
  /// Fields of the last matrix in the present line.
  mutable std::span<const std::string_view> information_fields_;
  PoseGraph graph_;
  std::optional<PoseKind> kind_;
  std::size_t edges_begin_ = 0;  ///< end of the first edge in the file [bytes]
  std::vector<int> node_lines_, edge_lines_;
  std::vector<std::size_t> indefinite_;                        ///< edges of indefinite information
  std::vector<std::pair<PositionConstraint, int>> positions_;  ///< with their lines
  LandmarkLines landmarks_;
  /// Numbers of vertices with and without a time stamp, the line of the first stamp.
  int stamped_ = 0, unstamped_ = 0, first_stamp_line_ = 0;
  double last_stamp_ = 0;
  std::vector<char> source_is_given_;  ///< whether the tag of each edge determines its source
  std::vector<std::pair<NodeId, int>> fixed_;  ///< id and line
};

/// Passes every line that is neither blank nor a comment, split into fields, to `parse_line`.
PoseGraphBuilder parse_lines(TextFile& file,
                             void (*parse_line)(const TextFile&, const PoseGraphBuilder::Fields&,
                                                PoseGraphBuilder&));

}  // namespace placegraph
