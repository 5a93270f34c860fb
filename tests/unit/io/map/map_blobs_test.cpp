#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_blobs.h>

#include <cstring>
#include <limits>

#include "tests/support/message_of.h"
#include "tests/support/random_map.h"

namespace placegraph {
namespace map_blobs_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The bytes that `write` appends, behind others that must stay.
template <class Write>
std::string written(const Write& write) {
  std::string bytes = "before";
  BlobWriter writer(bytes);
  write(writer);
  EXPECT_EQ(bytes.substr(0, 6), "before");
  return bytes.substr(6);
}

/// What `read` makes of all the bytes.
template <class Read>
auto read_whole(const std::string& bytes, const Read& read) {
  BlobReader reader(bytes);
  auto value = read(reader);
  reader.end();
  return value;
}

/// The message by which the bytes are refused.
template <class Read>
std::string refusal(const std::string& bytes, const Read& read) {
  return test::message_of<ArgumentError>([&] { (void)read_whole(bytes, read); });
}

template <class Number>
std::string replaced(std::string bytes, std::size_t at, Number value) {
  std::memcpy(bytes.data() + at, &value, sizeof(value));
  return bytes;
}

double double_at(const std::string& bytes, std::size_t number) {
  double value = 0;
  std::memcpy(&value, bytes.data() + number * sizeof(value), sizeof(value));
  return value;
}

const auto kReadPose = [](BlobReader& reader) { return reader.pose(); };
const auto kReadSimilarity = [](BlobReader& reader) { return reader.similarity(); };

TEST(MapBlobs, APoseIsItsTranslationAndItsQuaternionWithTheRealPartLast) {
  const SE3 T(SO3(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)), {1, -2, 3});
  const std::string bytes = written([&](BlobWriter& writer) { writer.pose(T); });
  ASSERT_EQ(bytes.size(), kPoseBytes);
  const double expected[] = {1, -2, 3, 0.5, -0.5, 0.5, 0.5};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(double_at(bytes, i), expected[i]) << i;
  const std::string scaled = written(
      [&](BlobWriter& writer) { writer.similarity(Sim3(T.rotation(), T.translation(), 2.5)); });
  ASSERT_EQ(scaled.size(), kSimilarityBytes);
  EXPECT_EQ(scaled.substr(0, kPoseBytes), bytes);
  EXPECT_EQ(double_at(scaled, 7), 2.5);
}

// Only the quaternion may be rounded, by the division by its length.
TEST(MapBlobs, RandomPosesSimilaritiesAndMatricesComeBack) {
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const SE3 T = test::random_pose(random);
    const SE3 T_read = read_whole(written([&](BlobWriter& w) { w.pose(T); }), kReadPose);
    EXPECT_EQ(T_read.translation(), T.translation());
    EXPECT_LT((T_read.rotation().matrix() - T.rotation().matrix()).norm(), kRounding);
    const Sim3 S(T.rotation(), T.translation(), random.uniform(0.1, 9));
    const Sim3 S_read =
        read_whole(written([&](BlobWriter& w) { w.similarity(S); }), kReadSimilarity);
    EXPECT_EQ(S_read.translation(), S.translation());
    EXPECT_EQ(S_read.scale(), S.scale());
    const std::string matrix = written([&](BlobWriter& w) { w.matrix12(T.isometry()); });
    ASSERT_EQ(matrix.size(), kMatrixBytes);
    EXPECT_EQ(double_at(matrix, 3), T.translation().x());  // row by row
    const Eigen::Isometry3d read = read_whole(matrix, [](BlobReader& r) { return r.matrix12(); });
    EXPECT_EQ(read.matrix(), T.isometry().matrix());
  }
}

TEST(MapBlobs, OfASymmetricMatrixTheUpperTriangleIsKept) {
  Random random(6);
  for (int size = 0; size <= 7; ++size) {
    Eigen::MatrixXd matrix(size, size);
    for (double& value : matrix.reshaped()) value = random.normal();
    const std::string bytes = written([&](BlobWriter& w) { w.symmetric(matrix); });
    ASSERT_EQ(bytes.size(), static_cast<std::size_t>(size * (size + 1) / 2) * sizeof(double));
    const Information read =
        read_whole(bytes, [size](BlobReader& reader) { return reader.symmetric(size); });
    ASSERT_EQ(read.rows(), size);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j)
        EXPECT_EQ(read(i, j), matrix(std::min(i, j), std::max(i, j))) << i << " " << j;
  }
}

TEST(MapBlobs, FeaturesComeBackInTheirOrder) {
  Random random(7);
  for (const int count : {0, 1, 2, 37}) {
    const std::vector<Feature> features = test::random_features(random, count);
    const std::string bytes = written([&](BlobWriter& w) { w.features(features); });
    ASSERT_EQ(bytes.size(), features.size() * kFeatureBytes);
    const std::vector<Feature> read =
        read_whole(bytes, [&](BlobReader& reader) { return reader.features(features.size()); });
    for (std::size_t i = 0; i < features.size(); ++i) {
      EXPECT_EQ(read[i].px, features[i].px);
      EXPECT_EQ(read[i].angle_rad, features[i].angle_rad);
      EXPECT_EQ(read[i].octave, features[i].octave);
      EXPECT_EQ(read[i].descriptor, features[i].descriptor);
      EXPECT_EQ(read[i].point_cam, features[i].point_cam);
    }
  }
}

TEST(MapBlobs, LandmarksComeBackWithWhatIsKnownOfThem) {
  Random random(8);
  std::vector<PointLandmark> landmarks = test::random_map(random, 2).map.landmarks;
  landmarks.resize(40);
  const PointLandmark* first = landmarks.data();
  const std::size_t n = landmarks.size();
  const std::string points = written([&](BlobWriter& w) { w.landmarks(first, n); }),
                    colours = written([&](BlobWriter& w) { w.colours(first, n); }),
                    covariances = written([&](BlobWriter& w) { w.covariances(first, n); });
  EXPECT_EQ(points.size(), n * kLandmarkBytes);
  EXPECT_EQ(colours.size(), n * kColourBytes);
  EXPECT_EQ(covariances.size(), n * kCovarianceBytes);
  std::vector<PointLandmark> read =
      read_whole(points, [&](BlobReader& reader) { return reader.landmarks(n); });
  EXPECT_FALSE(read[1].rgb || read[1].covariance);
  BlobReader(colours).colours(read);
  BlobReader(covariances).covariances(read);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(read[i].id, landmarks[i].id);
    EXPECT_EQ(read[i].keyframe, landmarks[i].keyframe);
    EXPECT_EQ(read[i].point_cam, landmarks[i].point_cam);
    EXPECT_EQ(read[i].observations, landmarks[i].observations);
    EXPECT_EQ(read[i].rgb, landmarks[i].rgb);
    EXPECT_EQ(read[i].covariance, landmarks[i].covariance);  // their numbers are floats already
  }
}

TEST(MapBlobs, ObservationsAndWordsMustAscend) {
  Random random(9);
  std::vector<LandmarkObservation> seen;
  Appearance appearance;
  for (int i = 0; i < 20; ++i) {
    seen.push_back({LandmarkId(3 * i), Eigen::Vector2f(i, -0.5F * i), i % 2});
    appearance.words.emplace_back(5 * i, static_cast<float>(random.uniform()));
  }
  const auto read_seen = [&](BlobReader& reader) { return reader.observations(seen.size()); };
  const auto read_words = [&](BlobReader& reader) { return reader.words(20); };
  const std::string seen_bytes = written([&](BlobWriter& w) { w.observations(seen); }),
                    word_bytes = written([&](BlobWriter& w) { w.words(appearance); });
  ASSERT_EQ(seen_bytes.size(), seen.size() * kObservationBytes);
  ASSERT_EQ(word_bytes.size(), 20 * kWordBytes);
  EXPECT_EQ(read_whole(word_bytes, read_words).words, appearance.words);
  const std::vector<LandmarkObservation> read = read_whole(seen_bytes, read_seen);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(read[i].landmark, seen[i].landmark);
    EXPECT_EQ(read[i].px, seen[i].px);
    EXPECT_EQ(read[i].camera, seen[i].camera);
  }
  // The seventh gets the id of the sixth.
  EXPECT_THAT(refusal(replaced(seen_bytes, 7 * kObservationBytes, std::int64_t{18}), read_seen),
              HasSubstr("landmarks are not in ascending order"));
  EXPECT_THAT(refusal(replaced(word_bytes, 7 * kWordBytes, std::uint32_t{30}), read_words),
              HasSubstr("words are not in ascending order"));
}

void expect_grid(const CueGrid& read, const CueGrid& grid) {
  EXPECT_EQ(read.columns, grid.columns);
  EXPECT_EQ(read.rows, grid.rows);
  EXPECT_EQ(read.channels, grid.channels);
  EXPECT_EQ(read.values, grid.values);
  EXPECT_EQ(read.energy, grid.energy);
}

TEST(MapBlobs, ViewsComeBackAlsoWhereACueIsMissing) {
  const auto read_view = [](BlobReader& reader) { return reader.view(); };
  Random random(10);
  for (int missing = 0; missing < 6; ++missing) {
    PlaceView view = test::random_view(random);
    if (missing == 1) view.tiny.clear();
    if (missing == 2) view.gradients.clear();
    if (missing == 3) view.colour = {};
    if (missing == 4) view.gabor = {};
    if (missing == 5) view = {};
    const PlaceView read =
        read_whole(written([&](BlobWriter& writer) { writer.view(view); }), read_view);
    SCOPED_TRACE(missing);
    EXPECT_EQ(read.empty(), view.empty());
    ASSERT_EQ(read.tiny.size(), view.tiny.size());
    ASSERT_EQ(read.gradients.size(), view.gradients.size());
    if (!view.tiny.empty()) expect_grid(read.tiny[0], view.tiny[0]);
    if (!view.gradients.empty()) expect_grid(read.gradients[0], view.gradients[0]);
    expect_grid(read.colour, view.colour);
    expect_grid(read.gabor, view.gabor);
    expect_grid(read.coarse, view.coarse);
    EXPECT_EQ(read.thumbnail, view.thumbnail);
    EXPECT_EQ(read.corners.size(), view.corners.size());
  }
}

TEST(MapBlobs, BytesThatEndTooEarlyOrTooLateAreRefused) {
  Random random(11);
  const PlaceView view = test::random_view(random);
  const std::string bytes = written([&](BlobWriter& writer) {
    writer.similarity(Sim3());
    writer.view(view);
    writer.features(view.corners);
  });
  const auto read = [](BlobReader& reader) {
    (void)reader.similarity();
    (void)reader.view();
    return reader.features(5);
  };
  EXPECT_EQ(read_whole(bytes, read).size(), 5U);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 40)
    EXPECT_THAT(refusal(bytes.substr(0, size), read), HasSubstr("is cut off")) << size;
  EXPECT_EQ(refusal(bytes + "abc", read), "3 bytes too many");
}

TEST(MapBlobs, NumbersThatAreNotFiniteAreNamed) {
  const std::string bytes = written([](BlobWriter& writer) { writer.similarity(Sim3()); });
  const char* names[] = {"a pose's translation", "a pose's quaternion", "a similarity's scale"};
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()})
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_THAT(refusal(replaced(bytes, i * sizeof(double), bad), kReadSimilarity),
                  AllOf(HasSubstr(names[i < 3 ? 0 : i < 7 ? 1 : 2]), HasSubstr("not finite")))
          << i;
  for (const double scale : {0.0, -1.0})
    EXPECT_THAT(refusal(replaced(bytes, kPoseBytes, scale), kReadSimilarity),
                HasSubstr("a similarity's scale is"));
  EXPECT_THAT(refusal(replaced(bytes, 6 * sizeof(double), 1.001), kReadSimilarity),
              HasSubstr("quaternion has length 1.001"));
}

TEST(MapBlobs, AFeatureHasAnOctaveAndKnownFlags) {
  Random random(12);
  const std::vector<Feature> features = test::random_features(random, 1);
  const std::string bytes = written([&](BlobWriter& writer) { writer.features(features); });
  const auto read = [](BlobReader& reader) { return reader.features(1); };
  EXPECT_THAT(refusal(replaced(bytes, 12, std::int16_t{-1}), read), HasSubstr("octave -1"));
  EXPECT_THAT(refusal(replaced(bytes, 14, std::uint16_t{2}), read), HasSubstr("flags 2"));
}

}  // namespace map_blobs_test
}  // namespace placegraph
