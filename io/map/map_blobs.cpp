#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_blobs.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace placegraph {

static_assert(std::endian::native == std::endian::little, "blobs are little-endian");

void BlobWriter::pose(const SE3& T) {
  for (int i = 0; i < 3; ++i) number(double{T.translation()[i]});
  for (int i = 0; i < 4; ++i) number(double{T.rotation().quaternion().coeffs()[i]});
}

void BlobWriter::similarity(const Sim3& S) {
  pose(SE3(S.rotation(), S.translation()));
  number(double{S.scale()});
}

void BlobWriter::matrix12(const Eigen::Isometry3d& T) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) number(double{T.matrix()(i, j)});
}

void BlobWriter::features(const std::vector<Feature>& features) {
  for (const Feature& feature : features) {
    number(feature.px.x());
    number(feature.px.y());
    number(feature.angle_rad);
    number(static_cast<std::int16_t>(feature.octave));
    number(static_cast<std::uint16_t>(feature.point_cam.has_value()));
    for (const std::uint64_t bits : feature.descriptor) number(bits);
    const Eigen::Vector3f point = feature.point_cam.value_or(Eigen::Vector3f::Zero());
    for (int i = 0; i < 3; ++i) number(float{point[i]});
  }
}

void BlobWriter::landmarks(const PointLandmark* begin, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    number(begin[i].id.value());
    number(begin[i].keyframe.value());
    for (int k = 0; k < 3; ++k) number(double{begin[i].point_cam[k]});
    number(static_cast<std::int32_t>(begin[i].observations));
  }
}

void BlobWriter::colours(const PointLandmark* begin, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<std::array<std::uint8_t, 3>>& rgb = begin[i].rgb;
    for (std::size_t k = 0; k < 3; ++k) number(rgb ? (*rgb)[k] : std::uint8_t{0});
    number(static_cast<std::uint8_t>(rgb.has_value()));
  }
}

void BlobWriter::covariances(const PointLandmark* begin, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Matrix3d covariance = begin[i].covariance.value_or(Eigen::Matrix3d::Zero());
    for (int j = 0; j < 3; ++j)
      for (int k = j; k < 3; ++k) number(static_cast<float>(covariance(j, k)));
  }
}

void BlobWriter::observations(const std::vector<LandmarkObservation>& observations) {
  for (const LandmarkObservation& observation : observations) {
    number(observation.landmark.value());
    number(observation.px.x());
    number(observation.px.y());
    number(static_cast<std::uint8_t>(observation.camera));
  }
}

void BlobWriter::words(const Appearance& appearance) {
  for (const auto& [word, weight] : appearance.words) {
    number(word);
    number(weight);
  }
}

void BlobWriter::grid(const CueGrid& grid) {
  number(static_cast<std::uint16_t>(grid.columns));
  number(static_cast<std::uint16_t>(grid.rows));
  number(static_cast<std::uint16_t>(grid.channels));
  for (const std::int16_t value : grid.values) number(value);
}

void BlobWriter::view(const PlaceView& view) {
  grid(view.tiny.empty() ? CueGrid() : view.tiny.front());
  grid(view.gradients.empty() ? CueGrid() : view.gradients.front());
  grid(view.colour);
  grid(view.gabor);
  grid(view.coarse);
  number(static_cast<std::uint32_t>(view.thumbnail.size()));
  for (const std::int16_t value : view.thumbnail) number(value);
  number(static_cast<std::uint32_t>(view.corners.size()));
  features(view.corners);
}

void BlobReader::require_left(std::uint64_t count, std::size_t bytes_each) const {
  if (count > bytes_.size() / bytes_each)
    throw ArgumentError("is cut off: " + std::to_string(count) + " elements of " +
                        std::to_string(bytes_each) + " bytes should follow, but " +
                        std::to_string(bytes_.size()) + " bytes are left");
}

template <class Number>
Number BlobReader::number() {
  require_left(1, sizeof(Number));
  Number value;
  std::memcpy(&value, bytes_.data(), sizeof(value));
  bytes_.remove_prefix(sizeof(value));
  return value;
}

template <class Number>
Number BlobReader::finite(const char* name) {
  const Number value = number<Number>();
  if (!std::isfinite(value)) throw ArgumentError(std::string(name) + " is not finite");
  return value;
}

SE3 BlobReader::pose() {
  Eigen::Vector3d t;
  Eigen::Vector4d q;
  for (int i = 0; i < 3; ++i) t[i] = finite<double>("a pose's translation");
  for (int i = 0; i < 4; ++i) q[i] = finite<double>("a pose's quaternion");
  constexpr double kTolerance = 1e-6;
  if (std::abs(q.norm() - 1) > kTolerance)
    throw ArgumentError("a pose's quaternion has length " + std::to_string(q.norm()));
  return SE3(SO3(Eigen::Quaterniond(q)), t);
}

Sim3 BlobReader::similarity() {
  const SE3 T = pose();
  const double scale = finite<double>("a similarity's scale");
  if (!(scale > 0)) throw ArgumentError("a similarity's scale is " + std::to_string(scale));
  return Sim3(T.rotation(), T.translation(), scale);
}

Eigen::Isometry3d BlobReader::matrix12() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) T.matrix()(i, j) = finite<double>("a pose's matrix");
  return T;
}

Information BlobReader::symmetric(int size) {
  Information matrix(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = i; j < size; ++j) matrix(i, j) = matrix(j, i) = finite<double>("a matrix");
  return matrix;
}

std::vector<Feature> BlobReader::features(std::size_t count) {
  require_left(count, kFeatureBytes);
  std::vector<Feature> features(count);
  for (Feature& feature : features) {
    feature.px.x() = finite<float>("a feature's pixel");
    feature.px.y() = finite<float>("a feature's pixel");
    feature.angle_rad = finite<float>("a feature's angle");
    feature.octave = number<std::int16_t>();
    const auto flags = number<std::uint16_t>();
    if (feature.octave < 0 || flags > 1)
      throw ArgumentError("a feature has octave " + std::to_string(feature.octave) + " and flags " +
                          std::to_string(flags));
    for (std::uint64_t& bits : feature.descriptor) bits = number<std::uint64_t>();
    Eigen::Vector3f point;
    for (int i = 0; i < 3; ++i) point[i] = finite<float>("a feature's point");
    if (flags == 1) feature.point_cam = point;
  }
  return features;
}

std::vector<PointLandmark> BlobReader::landmarks(std::size_t count) {
  require_left(count, kLandmarkBytes);
  std::vector<PointLandmark> landmarks(count);
  for (PointLandmark& landmark : landmarks) {
    landmark.id = LandmarkId(number<std::int64_t>());
    landmark.keyframe = KeyframeId(number<std::int64_t>());
    for (int i = 0; i < 3; ++i) landmark.point_cam[i] = finite<double>("a landmark");
    landmark.observations = number<std::int32_t>();
  }
  return landmarks;
}

void BlobReader::colours(std::vector<PointLandmark>& landmarks) {
  for (PointLandmark& landmark : landmarks) {
    std::array<std::uint8_t, 3> rgb{};
    for (std::uint8_t& value : rgb) value = number<std::uint8_t>();
    if (number<std::uint8_t>() != 0) landmark.rgb = rgb;
  }
}

void BlobReader::covariances(std::vector<PointLandmark>& landmarks) {
  for (PointLandmark& landmark : landmarks) {
    Eigen::Matrix3d covariance;
    for (int j = 0; j < 3; ++j)
      for (int k = j; k < 3; ++k)
        covariance(j, k) = covariance(k, j) = finite<float>("a landmark's covariance");
    if (!covariance.isZero(0)) landmark.covariance = covariance;
  }
}

std::vector<LandmarkObservation> BlobReader::observations(std::size_t count) {
  require_left(count, kObservationBytes);
  std::vector<LandmarkObservation> observations(count);
  for (std::size_t i = 0; i < count; ++i) {
    LandmarkObservation& observation = observations[i];
    observation.landmark = LandmarkId(number<std::int64_t>());
    observation.px.x() = finite<float>("an observation's pixel");
    observation.px.y() = finite<float>("an observation's pixel");
    observation.camera = number<std::uint8_t>();
    if (i > 0 && observations[i - 1].landmark >= observation.landmark)
      throw ArgumentError("its landmarks are not in ascending order");
  }
  return observations;
}

Appearance BlobReader::words(std::size_t count) {
  require_left(count, kWordBytes);
  Appearance appearance;
  appearance.words.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto word = number<std::uint32_t>();
    appearance.words.emplace_back(word, finite<float>("a word's weight"));
    if (i > 0 && appearance.words[i - 1].first >= word)
      throw ArgumentError("its words are not in ascending order");
  }
  return appearance;
}

CueGrid BlobReader::grid() {
  CueGrid grid;
  grid.columns = number<std::uint16_t>();
  grid.rows = number<std::uint16_t>();
  grid.channels = number<std::uint16_t>();
  const std::uint64_t count = std::uint64_t{1} * grid.columns * grid.rows * grid.channels;
  require_left(count, sizeof(std::int16_t));
  if (count == 0) return {};
  grid.values.resize(count);
  for (std::int16_t& value : grid.values) value = number<std::int16_t>();
  grid.energy = cell_energy(grid.columns, grid.rows, grid.channels, grid.values);
  return grid;
}

PlaceView BlobReader::view() {
  PlaceView view;
  if (CueGrid tiny = grid(); !tiny.empty()) view.tiny.push_back(std::move(tiny));
  if (CueGrid gradients = grid(); !gradients.empty())
    view.gradients.push_back(std::move(gradients));
  view.colour = grid();
  view.gabor = grid();
  view.coarse = grid();
  const auto thumbnail = number<std::uint32_t>();
  require_left(thumbnail, sizeof(std::int16_t));
  view.thumbnail.resize(thumbnail);
  for (std::int16_t& value : view.thumbnail) value = number<std::int16_t>();
  view.corners = features(number<std::uint32_t>());
  return view;
}

void BlobReader::end() const {
  if (!bytes_.empty()) throw ArgumentError(std::to_string(bytes_.size()) + " bytes too many");
}

}  // namespace placegraph
