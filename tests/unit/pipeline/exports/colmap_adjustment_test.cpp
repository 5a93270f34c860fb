#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_reader.h>
#include <placegraph/pipeline/exports/colmap_adjustment.h>
#include <placegraph/pipeline/exports/colmap_folder.h>

#include <filesystem>

#include "tests/support/scenes/colmap_scene.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace colmap_adjustment_test {

/// A model of exact observations with a disturbed pose.
ColmapModel disturbed_model() {
  Random random{3};
  constexpr int kViews = 4, kPoints = 50;
  const Camera camera = test::pinhole(640, 480, 500);
  const test::PointScene scene = test::make_scene(camera, test::sideways(kViews), kPoints, random);
  return test::disturbed_colmap_model(scene, camera, random);
}

TEST(ColmapAdjustment, ReadsAdjustsAndWritesAModel) {
  const test::TemporaryFolder folder;
  const std::string in = folder / "in", out = folder / "out";
  std::filesystem::create_directory(in);
  std::filesystem::create_directory(out);
  write_colmap_folder(in, disturbed_model(), NumberForm::kText);
  ColmapAdjustment adjustment(in);
  EXPECT_EQ(adjustment.images(), 4u);
  EXPECT_EQ(adjustment.points(), 50u);
  const ColmapAdjustmentReport report = adjustment.adjust({});
  ASSERT_TRUE(report.outcome) << report.outcome.reason;
  EXPECT_GT(report.error_before_px, 0.5);
  EXPECT_LT(report.error_px, 1e-2);
  EXPECT_LT(report.cost_final, report.cost_initial);
  adjustment.write(out);
  EXPECT_EQ(colmap_form(out), NumberForm::kText);
  EXPECT_LT(ColmapAdjustment(out).adjust({}).error_before_px, 1e-2);
}

TEST(ColmapAdjustment, KeepsCamerasThatNoImageHasAndTheIdOfTheOther) {
  ColmapModel model = disturbed_model();
  model.camera_id = 12;
  model.unused_cameras = {{3, "FULL_OPENCV", 7, 8, {1.5, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0.1}},
                          {40, "THIN_PRISM_FISHEYE", 7, 8, std::vector<double>(12, -0.3)}};
  for (const NumberForm form : {NumberForm::kText, NumberForm::kBinary}) {
    const test::TemporaryFolder folder;
    const std::string in = folder / "in", out = folder / "out";
    std::filesystem::create_directory(in);
    std::filesystem::create_directory(out);
    write_colmap_folder(in, model, form);
    folder.write("in/frames.bin", "not read");
    folder.write("out/frames.bin", "of an older model");
    ColmapAdjustment adjustment(in);
    EXPECT_EQ(adjustment.unused_cameras(), (std::vector<std::uint32_t>{3, 40}));
    ASSERT_TRUE(adjustment.adjust({}).outcome);
    adjustment.write(out);
    const char* name = form == NumberForm::kText ? "/cameras.txt" : "/cameras.bin";
    EXPECT_EQ(test::read_file(out + name), test::read_file(in + name));
    EXPECT_EQ(read_colmap(out).camera_id, 12u);
    EXPECT_FALSE(std::filesystem::exists(folder / "out/frames.bin"));
    EXPECT_TRUE(std::filesystem::exists(folder / "in/frames.bin"));
  }
}

TEST(ColmapAdjustment, NamesAFolderWithoutAModel) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(ColmapAdjustment(std::string(folder / "none")), FileError);
}

TEST(ColmapUnusedCameras, AreNamedUpToEight) {
  EXPECT_EQ(describe_unused_cameras({7}), "1 camera that no image has: 7");
  EXPECT_EQ(describe_unused_cameras({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}),
            "10 cameras that no image has: 1, 2, 3, 4, 5, 6, 7, 8 and 2 more");
}

}  // namespace colmap_adjustment_test
}  // namespace placegraph
