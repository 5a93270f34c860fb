#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/exports/colmap_cameras.h>
#include <placegraph/io/exports/colmap_reader.h>
#include <placegraph/io/files/little_endian.h>

#include <iterator>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace colmap_cameras_test {

using test::message_of;
using testing::HasSubstr;

constexpr const char* kModels[] = {"SIMPLE_PINHOLE",
                                   "PINHOLE",
                                   "SIMPLE_RADIAL",
                                   "RADIAL",
                                   "OPENCV",
                                   "OPENCV_FISHEYE",
                                   "FULL_OPENCV",
                                   "FOV",
                                   "SIMPLE_RADIAL_FISHEYE",
                                   "RADIAL_FISHEYE",
                                   "THIN_PRISM_FISHEYE",
                                   "RAD_TAN_THIN_PRISM_FISHEYE",
                                   "SIMPLE_DIVISION",
                                   "DIVISION",
                                   "SIMPLE_FISHEYE",
                                   "FISHEYE",
                                   "EUCM",
                                   "EQUIRECTANGULAR"};

/// A camera of any model with any parameters.
ColmapModel::RawCamera random_camera(std::uint32_t id, const char* model, Random& random) {
  ColmapModel::RawCamera camera{id, model, 0, 0, {}};
  camera.width = static_cast<std::uint64_t>(1 + random.index(5'000'000));
  camera.height = static_cast<std::uint64_t>(1 + random.index(5000));
  const std::size_t parameters = find_colmap_lens(model)->parameters;
  for (std::size_t i = 0; i < parameters; ++i) camera.parameters.push_back(random.normal(0, 1e3));
  return camera;
}

/// A folder with a model of two images of camera 1000, between cameras of other ids.
class ColmapCameras : public testing::Test {
 protected:
  ColmapCameras() {
    model.camera = {640, 480, 500, 501, 319.25, 239.5, Distortion::kNone, {}};
    model.camera_id = 1000;
    model.images = {{1, "0.png", SE3(), {}}, {2, "1.png", SE3(), {}}};
  }
  void write(NumberForm form) {
    const std::string end = form == NumberForm::kBinary ? ".bin" : ".txt";
    const ColmapFiles files = to_colmap(model, form);
    dir.write("cameras" + end, files.cameras);
    dir.write("images" + end, files.images);
    dir.write("points3D" + end, files.points);
  }
  std::string folder() const { return dir / "."; }
  test::TemporaryFolder dir;
  ColmapModel model;
};

TEST_F(ColmapCameras, KeepsCamerasOfAnyModelThatNoImageHas) {
  Random random(5);
  for (const NumberForm form : {NumberForm::kText, NumberForm::kBinary})
    for (int round = 0; round < 20; ++round) {
      model.unused_cameras.clear();
      for (int count = random.index(6), i = 0; i < count; ++i)  // before and behind 1000
        model.unused_cameras.push_back(random_camera(
            static_cast<std::uint32_t>(900 + 40 * i),
            kModels[static_cast<std::size_t>(random.index(static_cast<int>(std::size(kModels))))],
            random));
      write(form);
      const ColmapModel read = read_colmap(folder());
      EXPECT_EQ(read.camera_id, 1000u);
      EXPECT_EQ(read.camera.cx, model.camera.cx);
      ASSERT_EQ(read.unused_cameras.size(), model.unused_cameras.size());
      for (std::size_t i = 0; i < read.unused_cameras.size(); ++i) {
        const ColmapModel::RawCamera &a = read.unused_cameras[i], &b = model.unused_cameras[i];
        EXPECT_EQ(a.id, b.id);
        EXPECT_EQ(a.model, b.model);
        EXPECT_EQ(a.width, b.width);
        EXPECT_EQ(a.height, b.height);
        EXPECT_EQ(a.parameters, b.parameters);
      }
      const ColmapFiles again = to_colmap(read, form), files = to_colmap(model, form);
      EXPECT_EQ(again.cameras, files.cameras);
      EXPECT_EQ(again.images, files.images);
    }
}

TEST_F(ColmapCameras, EveryModelIsKeptInBothForms) {
  Random random(6);
  std::uint32_t id = 0;
  for (const char* name : kModels)
    model.unused_cameras.push_back(random_camera(++id, name, random));
  for (const NumberForm form : {NumberForm::kText, NumberForm::kBinary}) {
    write(form);
    EXPECT_EQ(to_colmap(read_colmap(folder()), form).cameras, to_colmap(model, form).cameras);
  }
}

TEST_F(ColmapCameras, KeepsUnknownModelsOfTextsAlone) {
  model.unused_cameras = {{7, "NEW_LENS", 3, 4, {1, 2.5}}};
  write(NumberForm::kText);
  const ColmapModel read = read_colmap(folder());
  EXPECT_THAT(to_colmap(read, NumberForm::kText).cameras, HasSubstr("\n7 NEW_LENS 3 4 1 2.5\n"));
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)to_colmap(read, NumberForm::kBinary); }),
              HasSubstr("camera 7 has no model of the binary form: NEW_LENS"));
  std::string bytes;
  append_number(bytes, std::uint64_t{1});
  append_number(bytes, std::uint32_t{7});
  append_number(bytes, std::int32_t{99});
  dir.write("cameras.bin", bytes);
  EXPECT_THAT(message_of<FileError>([&] { read_binary_cameras(dir / "cameras.bin"); }),
              HasSubstr("camera 7 has the unknown model 99"));
}

TEST_F(ColmapCameras, RefusesImagesOfSeveralCamerasAndSharedIds) {
  write(NumberForm::kText);
  dir.write("cameras.txt", "3 FOV 64 48 50 50 32 24 1\n1000 PINHOLE 64 48 50 50 32 24\n");
  dir.write("images.txt", "1 1 0 0 0 0 0 0 1000 a.png\n\n5 1 0 0 0 0 0 0 3 b.png\n\n");
  EXPECT_THAT(message_of<FileError>([&] { read_colmap(folder()); }),
              HasSubstr("images.txt: images 1 (a.png) and 5 (b.png) have cameras 1000 and 3"));
  model.unused_cameras = {{1000, "FOV", 3, 4, {1, 2, 3, 4, 5}}};
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)to_colmap(model, NumberForm::kText); }),
              HasSubstr("the camera id 1000 is not unique"));
  std::string bytes;
  append_number(bytes, std::uint64_t{2});
  for (int i = 0; i < 2; ++i) {
    append_number(bytes, std::uint32_t{7});
    append_number(bytes, std::int32_t{0});
    append_number(bytes, std::uint64_t{64});
    append_number(bytes, std::uint64_t{48});
    for (const double value : {50., 32., 24.}) append_number(bytes, value);
  }
  dir.write("cameras.bin", bytes);
  EXPECT_THAT(message_of<FileError>([&] { read_binary_cameras(dir / "cameras.bin"); }),
              HasSubstr("cameras.bin: camera 7 is there twice"));
}

TEST_F(ColmapCameras, OtherFilesOfTheFolderAreNotRead) {
  write(NumberForm::kBinary);
  dir.write("rigs.bin", "no rig");
  dir.write("frames.bin", "");
  EXPECT_EQ(read_colmap(folder()).images.size(), 2u);
}

}  // namespace colmap_cameras_test
}  // namespace placegraph
