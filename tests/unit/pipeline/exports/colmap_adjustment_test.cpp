#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_reader.h>
#include <placegraph/pipeline/exports/colmap_adjustment.h>
#include <placegraph/pipeline/exports/colmap_folder.h>

#include <filesystem>

#include "tests/support/scenes/observed_map.h"
#include "tests/support/scenes/poses.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace colmap_adjustment_test {

/// A model of exact observations with a disturbed pose.
ColmapModel disturbed_model() {
  Random random{3};
  constexpr int kViews = 4, kPoints = 50;
  const Camera camera = test::pinhole(640, 480, 500);
  const test::PointScene scene = test::make_scene(camera, test::sideways(kViews), kPoints, random);
  ColmapModel model;
  model.camera = camera;
  for (std::size_t k = 0; k < kPoints; ++k)
    model.points.push_back({k + 1, scene.points_ref[k], {}, -1});
  for (std::size_t i = 0; i < kViews; ++i) {
    ColmapModel::Image& image = model.images.emplace_back();
    image.id = static_cast<std::uint32_t>(i + 1);
    image.name = std::to_string(i) + ".png";
    image.T_world_cam = scene.T_ref_cam[i];
    for (std::size_t k = 0; k < kPoints; ++k)
      if (const auto px = camera.project(scene.T_ref_cam[i].inverse() * scene.points_ref[k]))
        image.observations.push_back({*px, static_cast<int>(k)});
    image.T_world_cam = image.T_world_cam * test::random_motion(random, 0.01, 0.004);
  }
  return model;
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

TEST(ColmapAdjustment, NamesAFolderWithoutAModel) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(ColmapAdjustment(std::string(folder / "none")), FileError);
}

}  // namespace colmap_adjustment_test
}  // namespace placegraph
