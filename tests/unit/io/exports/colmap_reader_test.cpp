#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_reader.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace colmap_reader_test {

using test::message_of;
using testing::HasSubstr;

class ColmapReader : public testing::Test {
 protected:
  ColmapReader() {
    model.camera = {640, 480, 500, 501, 319.25, 239.5, Distortion::kNone, {}};
    model.images = {{1, "left/0.png", SE3(), {{{0, 0}, 1}, {{10, 20.25}, 0}}},
                    {2, "left/1.png", SE3(), {}},
                    {4,
                     "left/3.png",
                     SE3::exp((Vector6d() << 1, 2, 3, 0.3, -0.2, 2.5).finished()),
                     {{{30, 40}, 1}}}};
    model.points = {{7, {1, 2, 3}, {9, 8, 7}, 0.25}, {11, {4, 5, 6}, {0, 255, 1}, 0.5}};
  }
  /// Writes the model into a new folder and returns its path.
  std::string write(NumberForm form) {
    const std::string at = "m" + std::to_string(++folders) + "/";
    const std::string end = form == NumberForm::kBinary ? ".bin" : ".txt";
    const ColmapFiles files = to_colmap(model, form);
    dir.write(at + "cameras" + end, files.cameras);
    dir.write(at + "images" + end, files.images);
    dir.write(at + "points3D" + end, files.points);
    return dir / at;
  }
  test::TemporaryFolder dir;
  int folders = 0;
  ColmapModel model;
};

TEST_F(ColmapReader, ReadsWhatIsWritten) {
  for (const NumberForm form : {NumberForm::kBinary, NumberForm::kText}) {
    const ColmapModel read = read_colmap(write(form));
    EXPECT_EQ(read.camera.width, 640);
    EXPECT_EQ(read.camera.height, 480);
    EXPECT_EQ(read.camera.fy, 501);
    EXPECT_EQ(read.camera.cx, 319.25);
    ASSERT_EQ(read.images.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const ColmapModel::Image &a = read.images[i], &b = model.images[i];
      EXPECT_EQ(a.id, b.id);
      EXPECT_EQ(a.name, b.name);
      EXPECT_LT((a.T_world_cam.inverse() * b.T_world_cam).log().norm(), 1e-12);
      ASSERT_EQ(a.observations.size(), b.observations.size());
      for (std::size_t k = 0; k < a.observations.size(); ++k) {
        EXPECT_EQ(a.observations[k].px, b.observations[k].px);
        EXPECT_EQ(a.observations[k].point, b.observations[k].point);
      }
    }
    ASSERT_EQ(read.points.size(), 2u);
    EXPECT_EQ(read.points[1].id, 11u);
    EXPECT_EQ(read.points[1].p_world, Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(read.points[1].rgb, model.points[1].rgb);
    EXPECT_EQ(read.points[1].error_px, 0.5);
  }
}

TEST_F(ColmapReader, ReadsASimplePinholeAndLeavesImagePointsWithoutPointOut) {
  const std::string folder = write(NumberForm::kText);
  dir.write("m1/cameras.txt", "# cameras\n3 SIMPLE_PINHOLE 64 48 50 32 24\n");
  dir.write("m1/images.txt",
            "1 1 0 0 0 0 0 0 3 a.png\n3 4 -1 5.5 6.5 7\n2 1 0 0 0 0 0 0 3 b.png\n");
  const ColmapModel read = read_colmap(folder);
  EXPECT_EQ(read.camera.fy, 50);
  EXPECT_EQ(read.camera.cy, 23.5);
  ASSERT_EQ(read.images.size(), 2u);
  ASSERT_EQ(read.images[0].observations.size(), 1u);
  EXPECT_EQ(read.images[0].observations[0].px, Eigen::Vector2d(5, 6));
  EXPECT_TRUE(read.images[1].observations.empty());
}

TEST_F(ColmapReader, RefusesEveryTruncationOfBytes) {
  const ColmapFiles files = to_colmap(model, NumberForm::kBinary);
  for (const char* name : {"cameras", "images", "points3D"}) {
    const std::string folder = write(NumberForm::kBinary);
    const std::string file = folder + name + ".bin";
    const std::string whole = test::read_file(file);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      std::ofstream(file, std::ios::binary) << whole.substr(0, size);
      EXPECT_THROW(read_colmap(folder), FileError) << name << " " << size;
    }
    std::ofstream(file, std::ios::binary) << whole << 'x';
    EXPECT_THAT(message_of([&] { read_colmap(folder); }), HasSubstr("bytes after the last entry"));
  }
}

TEST_F(ColmapReader, NamesWhatItCannotRead) {
  const std::string folder = write(NumberForm::kText);
  const auto message = [&](const std::string& name, const std::string& text) {
    const std::string before = test::read_file(folder + name);
    dir.write("m1/" + name, text);
    const std::string found = message_of([&] { read_colmap(folder); });
    dir.write("m1/" + name, before);
    return found;
  };
  EXPECT_THAT(message("cameras.txt", "1 OPENCV 64 48 50 50 32 24 0 0 0 0\n"),
              HasSubstr("camera model OPENCV: PINHOLE and SIMPLE_PINHOLE are read"));
  EXPECT_THAT(message("cameras.txt", "1 PINHOLE 64 48 50 50 32 24\n1 PINHOLE 64 48 50 50 32 24\n"),
              HasSubstr("cameras.txt:2: camera 1 is there twice"));
  EXPECT_THAT(message("cameras.txt", "1 PINHOLE 64 48 50 50 32 24\n3 FULL_OPENCV 64 48 50 50\n"),
              HasSubstr("cameras.txt:2: FULL_OPENCV has 12 parameters"));
  EXPECT_THAT(message("cameras.txt", "# none\n"), HasSubstr("cameras.txt: no camera in it"));
  EXPECT_THAT(message("cameras.txt", "-1 PINHOLE 64 48 50 50 32 24\n"),
              HasSubstr("cameras.txt:1: camera: -1 is no id"));
  EXPECT_THAT(message("images.txt", "1 1 0 0 0 0 0 0 3 a.png\n\n"),
              HasSubstr("images.txt: image 1 (a.png) has camera 3, which is not there"));
  EXPECT_THAT(message("cameras.txt", "1 PINHOLE 64 48 0 50 32 24\n"),
              HasSubstr("a focal length is not positive"));
  EXPECT_THAT(message("images.txt", "1 1 0 0 0 0 0 3 a.png\n\n"),
              HasSubstr("images.txt:1: not an"));
  EXPECT_THAT(message("images.txt", "1 0 0 0 0 0 0 0 3 a.png\n\n"), HasSubstr("quaternion"));
  EXPECT_THAT(message("images.txt", "1 1 0 0 0 0 0 0 1 a.png\n1 2 8\n"),
              HasSubstr("image 1 has an observation of point 8, which is not there"));
  EXPECT_THAT(message("points3D.txt", "7 1 2 3 9 8 256 0.1\n"),
              HasSubstr("points3D.txt:1: colour"));
  EXPECT_THAT(message_of([&] { read_colmap(dir / "none"); }), HasSubstr("cameras.txt"));
}

TEST_F(ColmapReader, ReadsLensesWhereTheyAreAllowed) {
  const std::string folder = write(NumberForm::kText);
  const auto camera = [&](const std::string& text) {
    dir.write("m1/cameras.txt", text);
    return read_colmap(folder, ColmapLenses::kAny).camera;
  };
  const Camera simple = camera("1 SIMPLE_RADIAL 64 48 50 32 24 -0.1\n");
  EXPECT_EQ(simple.distortion, Distortion::kRadialTangential);
  EXPECT_EQ(simple.fy, 50);
  EXPECT_EQ(simple.cx, 31.5);
  EXPECT_EQ(simple.coefficients, (std::array<double, 5>{-0.1, 0, 0, 0, 0}));
  EXPECT_EQ(camera("1 RADIAL 64 48 50 32 24 -0.1 0.02\n").coefficients[1], 0.02);
  EXPECT_EQ(camera("1 OPENCV 64 48 50 51 32 24 1 2 3 4\n").coefficients,
            (std::array<double, 5>{1, 2, 3, 4, 0}));
  EXPECT_EQ(camera("1 OPENCV_FISHEYE 64 48 50 51 32 24 1 2 3 4\n").distortion,
            Distortion::kEquidistant);
  EXPECT_EQ(camera("1 PINHOLE 64 48 50 51 32 24\n").distortion, Distortion::kNone);
  EXPECT_THAT(message_of<FileError>([&] { camera("1 FOV 64 48 50 51 32 24 1\n"); }),
              HasSubstr("camera model FOV: PINHOLE, SIMPLE_PINHOLE, SIMPLE_RADIAL, RADIAL"));
  EXPECT_THAT(message_of<FileError>([&] { camera("1 RADIAL 64 48 50 32 24 -0.1\n"); }),
              HasSubstr("cameras.txt:1: RADIAL has 5 parameters"));
}

TEST_F(ColmapReader, LensesAreWrittenAsTheyAreRead) {
  for (const Distortion lens : {Distortion::kRadialTangential, Distortion::kEquidistant})
    for (const NumberForm form : {NumberForm::kBinary, NumberForm::kText}) {
      model.camera.distortion = lens;
      model.camera.coefficients = {0.1, -0.2, 0.003, 0.004, 0};
      const Camera read = read_colmap(write(form), ColmapLenses::kAny).camera;
      EXPECT_EQ(read.distortion, lens);
      EXPECT_EQ(read.coefficients, model.camera.coefficients);
      EXPECT_EQ(read.cx, model.camera.cx);
    }
}

}  // namespace colmap_reader_test
}  // namespace placegraph
