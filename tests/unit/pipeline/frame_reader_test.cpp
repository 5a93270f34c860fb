#include <gtest/gtest.h>
#include <placegraph/pipeline/frame_reader.h>

#include "tests/support/scenes/blank_dataset.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace frame_reader_test {

TEST(FrameReader, ReadsTheFrameThatIsAskedForInAnyOrder) {
  constexpr int kFrames = 9;
  const test::BlankDataset dataset(kFrames);
  Random random = test::seeded_random(1);
  for (const bool ahead : {false, true}) {
    FrameReader reader(dataset, {RunMask(), dataset.calibration(Sensor::kMono)}, Sensor::kMono,
                       kFrames, ahead);
    int index = 0;
    for (int i = 0; i < 60; ++i) {
      index = random.uniform() < 0.5 ? random.index(kFrames) : (index + 1) % kFrames;
      EXPECT_EQ(reader.read(index).id, FrameId(index));
    }
  }
}

}  // namespace frame_reader_test
}  // namespace placegraph
