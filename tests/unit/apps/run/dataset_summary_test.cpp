#include "apps/run/dataset_summary.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/io/datasets/open_dataset.h>

#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace dataset_summary_test {

using test::TemporaryFolder;
using test::tiny_depth;
using test::tiny_grey;
using test::write_image;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kCalibration = "width: 8\nheight: 6\nfx: 10\nfy: 11\ncx: 4\ncy: 3\n";

TEST(DatasetSummary, HoldsWhatEverySensorSees) {
  const TemporaryFolder folder;
  for (int i = 0; i < 4; ++i) {
    const std::string name = std::to_string(i) + ".png";
    write_image(folder, "s/" + name, tiny_grey(8, 6, i));
    write_image(folder, "s/right/" + name, tiny_grey(8, 6, i));
    write_image(folder, "s/depth/" + name, tiny_depth(8, 6, 900));
  }
  folder.write("s/calibration.yaml", kCalibration + "baseline_m: 0.2\ndepth:\n  unit_m: 0.001\n");
  folder.write("s/times.txt", "1\n2\n3\n5\n");
  folder.write("s/poses.txt",
               "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 3 0 1 0 0 0 0 1 4\n"
               "nan nan nan nan nan nan nan nan nan nan nan nan\n1 0 0 3 0 1 0 1 0 0 1 4\n");
  const DatasetSummary summary = summarize(*open_dataset(folder / "s"));
  EXPECT_EQ(summary.frames, 4u);
  EXPECT_EQ(summary.first_ns, 1'000'000'000);
  EXPECT_EQ(summary.last_ns, 5'000'000'000);
  EXPECT_EQ(summary.spacing.missing, 1u);
  EXPECT_THAT(summary.sensors, ElementsAre(Sensor::kStereo, Sensor::kRgbd, Sensor::kMono));
  EXPECT_EQ(summary.calibration.baseline_m, 0.2);
  EXPECT_TRUE(summary.calibration.depth);
  ASSERT_TRUE(summary.truth);
  EXPECT_EQ(summary.truth->posed, 3u);
  EXPECT_DOUBLE_EQ(summary.truth->path_m, 6);
}

TEST(DatasetSummary, SaysWhatGivesMetres) {
  Calibration calibration;
  EXPECT_THAT(metric_by(Sensor::kMono, calibration), IsEmpty());
  calibration.camera_height_m = 1.65;
  calibration.baseline_m = 0.537;
  EXPECT_EQ(metric_by(Sensor::kMono, calibration), "the camera's height of 1.65 m");
  EXPECT_EQ(metric_by(Sensor::kStereo, calibration), "the baseline of 0.537 m");
  EXPECT_THAT(metric_by(Sensor::kRgbd, calibration), HasSubstr("depth"));
}

}  // namespace dataset_summary_test
}  // namespace placegraph::apps
