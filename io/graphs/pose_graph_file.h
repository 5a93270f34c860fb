#pragma once
#include <placegraph/graph/pose_graph/landmark_graph.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What to do with edges whose information is indefinite: it has no meaning in least squares.
enum class IndefiniteInformation {
  kRefuse,     ///< refuse the file, and say how many edges it concerns
  kNearest,    ///< the nearest semi-definite matrix: negative eigenvalues become zero
  kIsotropic,  ///< one weight for translation and one for rotation (Rosen et al. 2019, SE-Sync)
};

/// Names of these, "refuse", "nearest" and "isotropic".
const std::vector<std::string>& indefinite_information_names();

/// Options of a pose graph reader: what it rejects and where it reports.
struct PoseGraphReading {
  /// Reject a graph of several components, unless each has a fixed vertex or a measured position:
  /// then all are in one coordinate frame.
  bool connected = false;
  /// Receives a sentence about skipped data (time stamps after vertices); if it is null, such a
  /// file is rejected.
  std::vector<std::string>* remarks = nullptr;
  /// What to do with edges of indefinite information; a remark says how many were changed.
  IndefiniteInformation indefinite = IndefiniteInformation::kRefuse;
  int* replaced = nullptr;  ///< receives the number of edges whose information was replaced
};

/// Reads a pose graph in the g2o, TORO or iSAM format, recognized by the tags of its lines.
///
/// Throws FileError as read_g2o, also for a file in another format.
PoseGraph read_pose_graph(const std::string& path, const PoseGraphReading& reading = {});
/// Reads a graph as read_pose_graph, with the priors and point landmarks of a g2o file.
LandmarkGraph read_landmark_graph(const std::string& path, const PoseGraphReading& reading = {});

}  // namespace placegraph
