#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_reader.h>
#include <placegraph/pipeline/exports/colmap_adjustment.h>
#include <placegraph/pipeline/exports/colmap_folder.h>
#include <placegraph/pipeline/map/colmap_bundle.h>

#include <filesystem>

#include "tests/support/scenes/observed_map.h"
#include "tests/support/scenes/poses.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace colmap_adjustment_test {

/// A model of some points that three images see, with noise in the points.
ColmapModel disturbed_model() {
  Random random(5);
  ColmapModel model;
  model.camera = test::pinhole(640, 480, 500);
  const test::PointScene scene = test::make_scene(model.camera, test::sideways(3), 30, random);
  for (std::size_t k = 0; k < scene.points_ref.size(); ++k)
    model.points.push_back({k + 1, scene.points_ref[k] * (1 + random.normal(0, 0.01)), {}, -1});
  for (std::size_t i = 0; i < 3; ++i) {
    ColmapModel::Image& image = model.images.emplace_back();
    image.id = static_cast<std::uint32_t>(i + 1);
    image.name = std::to_string(i) + ".png";
    image.T_world_cam = scene.T_ref_cam[i];
    for (std::size_t k = 0; k < scene.points_ref.size(); ++k)
      if (const auto px = model.camera.project(scene.T_ref_cam[i].inverse() * scene.points_ref[k]))
        image.observations.push_back({*px, static_cast<int>(k)});
  }
  return model;
}

TEST(ColmapAdjustment, IsThatOfTheModelInTheFolderAndKeepsItsForm) {
  const test::TemporaryFolder folder;
  for (const NumberForm form : {NumberForm::kText, NumberForm::kBinary}) {
    const std::string in = folder / "in", out = folder / "out";
    write_colmap_folder(in, disturbed_model(), form);
    const ColmapBundleReport expected = adjust_colmap(read_colmap(in, ColmapLenses::kAny), {});
    ColmapAdjustment adjustment(in);
    const ColmapAdjustmentReport report = adjustment.adjust({});
    EXPECT_TRUE(report.outcome);
    EXPECT_EQ(report.images, 3U);
    EXPECT_EQ(report.points, 30U);
    EXPECT_EQ(report.observations, expected.observations);
    EXPECT_EQ(report.cost_final, expected.cost_final);
    EXPECT_LT(report.error_px, report.error_before_px);
    adjustment.write(out);
    EXPECT_EQ(std::filesystem::exists(out + "/points3D.txt"), form == NumberForm::kText);
    write_colmap_folder(folder / "expected", expected.model, form);
    for (const std::string& name : {std::string("cameras"), std::string("points3D")}) {
      const std::string file = "/" + name + (form == NumberForm::kText ? ".txt" : ".bin");
      EXPECT_EQ(test::read_file(out + file), test::read_file(folder / "expected" + file)) << name;
    }
  }
}

TEST(ColmapAdjustment, NeedsAModel) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(ColmapAdjustment(folder.path()), FileError);
}

}  // namespace colmap_adjustment_test
}  // namespace placegraph
