#pragma once
#include <placegraph/graph/map.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <string>
#include <string_view>

namespace placegraph {

/// Writer of the blobs of a saved map (docs/map.md): little-endian numbers in sequence, no padding.
/// Writing appends to `bytes`. Reading throws ArgumentError with the fault of the bytes.
class BlobWriter {
 public:
  explicit BlobWriter(std::string& bytes) : bytes_(bytes) {}
  template <class Number>
  void number(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  void pose(const SE3& T);                    ///< tx ty tz qx qy qz qw, double: 56 bytes
  void similarity(const Sim3& S);             ///< the same and the scale: 64 bytes
  void matrix12(const Eigen::Isometry3d& T);  ///< 3 x 4, row by row: 96 bytes
  /// Rows of a symmetric matrix from the diagonal on, double.
  template <class Matrix>
  void symmetric(const Matrix& matrix) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index j = i; j < matrix.cols(); ++j) number(double{matrix(i, j)});
  }
  void features(const std::vector<Feature>& features);  ///< kFeatureBytes each
  void landmarks(const PointLandmark* begin, std::size_t count);
  void colours(const PointLandmark* begin, std::size_t count);
  void covariances(const PointLandmark* begin, std::size_t count);
  void observations(const std::vector<LandmarkObservation>& observations);
  void words(const Appearance& appearance);
  void view(const PlaceView& view);

 private:
  void grid(const CueGrid& grid);
  std::string& bytes_;
};

constexpr std::size_t kPoseBytes = 56, kSimilarityBytes = 64, kMatrixBytes = 96;
constexpr std::size_t kFeatureBytes = 60, kLandmarkBytes = 44, kWordBytes = 8, kColourBytes = 4,
                      kCovarianceBytes = 24, kObservationBytes = 17;

class BlobReader {
 public:
  explicit BlobReader(std::string_view bytes) : bytes_(bytes) {}
  SE3 pose();
  Sim3 similarity();
  Eigen::Isometry3d matrix12();
  Information symmetric(int size);
  std::vector<Feature> features(std::size_t count);
  std::vector<PointLandmark> landmarks(std::size_t count);
  /// Sets the colours, or covariances, of landmarks that have been read.
  void colours(std::vector<PointLandmark>& landmarks);
  void covariances(std::vector<PointLandmark>& landmarks);
  std::vector<LandmarkObservation> observations(std::size_t count);
  Appearance words(std::size_t count);
  PlaceView view();
  /// Throws unless all bytes have been read.
  void end() const;

 private:
  template <class Number>
  Number number();
  template <class Number>
  Number finite(const char* name);
  /// Throws unless `count` elements of this size are left, before memory is allocated.
  void require_left(std::uint64_t count, std::size_t bytes_each) const;
  CueGrid grid();
  std::string_view bytes_;
};

}  // namespace placegraph
