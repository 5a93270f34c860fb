#include <gtest/gtest.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/state_archive.h>

#include "tests/support/seed.h"

namespace placegraph {
namespace state_archive_test {

struct Part {
  std::optional<FrameId> frame;
  std::vector<std::pair<double, int>> values;
  Eigen::MatrixXd matrix;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  SE3 pose;
  std::array<bool, 3> flags{};
  std::map<FrameId, double> numbers;
  void visit_state(auto& archive) { archive(frame, values, matrix, vector, pose, flags, numbers); }
};

Part random_part(Random& random) {
  Part part;
  if (random.uniform() < 0.5) part.frame = FrameId(random.index(1000));
  for (int i = random.index(5); i > 0; --i)
    part.values.emplace_back(random.uniform(), random.index(9));
  part.matrix = Eigen::MatrixXd::Random(random.index(4), random.index(4));
  part.vector = Eigen::Vector3d::Random();
  part.pose = SE3::exp(Vector6d::Random());
  part.flags[random.index(3)] = true;
  for (int i = random.index(5); i > 0; --i)
    part.numbers[FrameId(random.index(9))] = random.uniform();
  return part;
}

std::string bytes_of(Part part) {
  StateWriter writer;
  writer(part);
  return writer.written();
}

TEST(StateArchive, ReadAfterWriteIsIdentity) {
  Random random = test::seeded_random(1);
  for (int round = 0; round < 200; ++round) {
    Part part = random_part(random), read = random_part(random);
    const std::string bytes = bytes_of(part);
    StateReader reader(bytes);
    reader(read);
    reader.end();
    EXPECT_EQ(bytes_of(read), bytes);
    EXPECT_EQ(read.frame, part.frame);
    EXPECT_EQ(read.values, part.values);
    EXPECT_EQ(read.vector, part.vector);
    EXPECT_EQ(read.flags, part.flags);
    EXPECT_EQ(read.numbers, part.numbers);
  }
}

TEST(StateArchive, RefusesBytesThatEndTooEarlyOrTooLate) {
  Random random = test::seeded_random(2);
  for (int round = 0; round < 20; ++round) {
    const std::string bytes = bytes_of(random_part(random)) + "x";
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
      if (size + 1 == bytes.size()) continue;
      Part read;
      StateReader reader(std::string_view(bytes).substr(0, size));
      EXPECT_THROW((reader(read), reader.end()), ArgumentError) << size;
    }
  }
}

}  // namespace state_archive_test
}  // namespace placegraph
