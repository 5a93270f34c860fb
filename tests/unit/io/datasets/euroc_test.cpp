#include <placegraph/io/datasets/open_dataset.h>

#include "tests/support/message_of.h"
#include "tiny_images.h"

namespace placegraph {
namespace euroc_test {

using test::message_of;
using test::TemporaryFolder;
using test::tiny_grey;
using test::write_image;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// The camera looks along the body's x: camera z = body x, camera x = -body y, camera y = -body z.
std::string sensor(double y_in_body_m) {
  return "# camera\nsensor_type: camera\ncomment: tiny\n"
         "T_BS:\n  cols: 4\n  rows: 4\n"
         "  data: [0, 0, 1, 0.5,\n         -1, 0, 0, " +
         std::to_string(y_in_body_m) +
         ",\n         0, -1, 0, 0,\n         0, 0, 0, 1]\n"
         "rate_hz: 20\nresolution: [64, 48]\ncamera_model: pinhole\n"
         "intrinsics: [60, 60, 31.5, 23.5]\n"
         "distortion_model: radial-tangential\n"
         "distortion_coefficients: [-0.05, 0.01, 0, 0]\n";
}

std::vector<std::string> texts(const std::vector<DataNote>& notes) {
  std::vector<std::string> result;
  for (const DataNote& note : notes) result.push_back(note.text);
  return result;
}

void write_sequence(const TemporaryFolder& folder) {
  for (const char* camera : {"cam0", "cam1"}) {
    const std::string at = std::string("s/mav0/") + camera + "/";
    for (int i = 1; i <= 3; ++i) {
      write_image(folder, at + "data/" + std::to_string(i) + "00.png", tiny_grey(64, 48, i));
    }
  }
  folder.write("s/mav0/cam0/data.csv",
               "#timestamp [ns],filename\r\n100,100.png\r\n200,200.png\r\n300,300.png\r\n");
  folder.write("s/mav0/cam1/data.csv", "#timestamp [ns],filename\n100,100.png\n300,300.png\n");
  folder.write("s/mav0/cam0/sensor.yaml", sensor(0.05));
  folder.write("s/mav0/cam1/sensor.yaml", sensor(-0.06));
  folder.write("s/mav0/state_groundtruth_estimate0/data.csv",
               "#timestamp, p_x\n50,10,0,0,1,0,0,0,1,2,3\n250,20,0,0,1,0,0,0,1,2,3\n"
               "350,20,0,0,0.70710678118654757,0,0,0.70710678118654757,1,2,3\n");
}

TEST(Euroc, PairsTheCamerasByStampAndRectifiesThem) {
  const TemporaryFolder folder;
  write_sequence(folder);
  for (const char* path : {"s", "s/mav0"}) {
    const auto dataset = open_dataset(folder / path);
    EXPECT_EQ(dataset->format(), "euroc");
    EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kStereo, Sensor::kMono));
    ASSERT_EQ(dataset->size(), 2u);  // stamp 200 has no right eye
    EXPECT_EQ(dataset->stamp_ns(1), 300);
    const Calibration calibration = dataset->calibration(Sensor::kStereo);
    EXPECT_NEAR(calibration.baseline_m, 0.11, 1e-9);
    EXPECT_EQ(calibration.camera.distortion, Distortion::kNone);
    EXPECT_EQ(calibration.camera.width, 64);
    const Frame frame = dataset->frame(1, Sensor::kStereo);
    EXPECT_EQ(frame.image.size(), cv::Size(64, 48));
    EXPECT_EQ(frame.right.size(), cv::Size(64, 48));
  }
}

TEST(Euroc, ConvertsThePoseOfTheBodyToThatOfTheRectifiedLeftCamera) {
  const TemporaryFolder folder;
  write_sequence(folder);
  const auto dataset = open_dataset(folder / "s");
  const Trajectory& truth = *dataset->ground_truth();
  ASSERT_EQ(truth.size(), 2u);
  // The eyes are parallel already, so that rectification turns nothing: camera z = body x, which is
  // world x at stamp 100, where the body is a quarter of the way from x = 10 to 20.
  const Eigen::Isometry3d& T_world_cam = *truth.poses[0].T_world_body;
  EXPECT_LT((T_world_cam.translation() - Eigen::Vector3d(12.5 + 0.5, 0.05, 0)).norm(), 1e-9);
  EXPECT_LT((T_world_cam.linear().col(2) - Eigen::Vector3d::UnitX()).norm(), 1e-9);
  EXPECT_LT((T_world_cam.linear().col(0) + Eigen::Vector3d::UnitY()).norm(), 1e-9);
}

TEST(Euroc, PairsNearestStampsAndTellsWhatIsLeftOut) {
  const TemporaryFolder folder;
  write_sequence(folder);
  const std::string head = "#timestamp [ns],filename\n";
  folder.write("s/mav0/cam1/data.csv", head + "103,100.png\n207,200.png\n296,300.png\n");
  const auto near = open_dataset(folder / "s");
  EXPECT_EQ(near->size(), 3u);
  EXPECT_THAT(texts(near->notes()),
              Contains(HasSubstr("the stamps of the two cameras differ by up to")));
  folder.write("s/mav0/cam1/data.csv", head + "100,100.png\n220,200.png\n300,300.png\n");
  EXPECT_THAT(texts(open_dataset(folder / "s")->notes()),
              Contains(HasSubstr("2 stereo pairs: 1 of 3 images of cam0 and 1 of 3 of cam1")));
}

TEST(Euroc, WithoutListsTakesTheStampsFromTheNames) {
  const TemporaryFolder folder;
  write_sequence(folder);
  for (const char* camera : {"cam0", "cam1"})
    std::filesystem::remove(folder / "s/mav0/" + camera + "/data.csv");
  const auto dataset = open_dataset(folder / "s");
  EXPECT_EQ(dataset->size(), 3u);
  EXPECT_EQ(dataset->stamp_ns(2), 300);
  EXPECT_EQ(dataset->sensors().front(), Sensor::kStereo);
  std::filesystem::rename(folder / "s/mav0/cam0/data/100.png", folder / "s/mav0/cam0/data/a.png");
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }),
              HasSubstr("cam0/data.csv: is missing, and "));
  std::filesystem::rename(folder / "s/mav0/cam0/data", folder / "s/mav0/cam0/frames");
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }),
              HasSubstr("cam0/data.csv: is missing; there are 3 images in frames/"));
}

TEST(Euroc, WithOneCameraIsUndistortedMono) {
  const TemporaryFolder folder;
  write_sequence(folder);
  std::filesystem::remove_all(folder / "s/mav0/cam1");
  const auto dataset = open_dataset(folder / "s");
  EXPECT_EQ(dataset->size(), 3u);
  EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kMono));
  EXPECT_EQ(dataset->calibration(Sensor::kMono).camera.distortion, Distortion::kNone);
  EXPECT_EQ(dataset->ground_truth()->posed(), 3u);
}

TEST(Euroc, NamesTheFileAndLineOfEveryFault) {
  const TemporaryFolder folder;
  write_sequence(folder);
  const auto message = [&](const std::string& file, const std::string& from,
                           const std::string& to) {
    const std::string before = test::read_file(folder / "s/mav0/" + file);
    std::string text = before;
    text.replace(text.find(from), from.size(), to);
    folder.write("s/mav0/" + file, text);
    const std::string seen = message_of([&] { open_dataset(folder / "s"); });
    folder.write("s/mav0/" + file, before);
    return seen;
  };
  EXPECT_THAT(message("cam0/data.csv", "200,200.png", "200"),
              HasSubstr("cam0/data.csv:3: expected t_ns,filename, found 1"));
  EXPECT_THAT(message("cam0/data.csv", "200,", "nan,"), HasSubstr("cam0/data.csv:3: time [ns]"));
  EXPECT_THAT(message("cam0/data.csv", "200,", "100,"),
              HasSubstr("data.csv:3: time 100 ns does not"));
  EXPECT_THAT(message("cam0/data.csv", "100.png", "7.png"), HasSubstr("7.png: image is missing"));
  EXPECT_THAT(message("cam1/data.csv", "100,100.png\n300", "50,100.png\n60"),
              HasSubstr("cam1/data.csv: has no stamp near one of cam0"));
  const auto yaml = [&](const char* from, const char* to) {
    return message("cam0/sensor.yaml", from, to);
  };
  EXPECT_THAT(yaml("intrinsics: [60,", "intrinsics: [.nan,"),
              HasSubstr("sensor.yaml:14: intrinsics: "));
  EXPECT_THAT(yaml("intrinsics: [60,", "intrinsics: ["),
              HasSubstr("sensor.yaml:14: intrinsics: expe"));
  EXPECT_THAT(yaml("intrinsics: [60,", "intrinsics: [-60,"), HasSubstr("sensor.yaml:14: "));
  EXPECT_THAT(yaml("intrinsics:", "intrinsic:"), HasSubstr("intrinsics: is missing"));
  EXPECT_THAT(yaml("[64, 48]", "[64, 1e12]"), HasSubstr("sensor.yaml:12: resolution: "));
  EXPECT_THAT(yaml("[64, 48]", "[64, 49]"), HasSubstr("image is 64x48, but 64x49 is expected"));
  EXPECT_THAT(yaml("pinhole", "omni"), HasSubstr("sensor.yaml:13: camera_model: only pinhole"));
  EXPECT_THAT(yaml("radial-tangential", "fov"),
              HasSubstr("sensor.yaml:15: distortion_model: 'fov'"));
  EXPECT_THAT(yaml("0.01, 0, 0]", "0.01]"), HasSubstr("sensor.yaml:16: distortion_coefficients"));
  EXPECT_THAT(yaml("data: [0,", "data: [9,"), HasSubstr("sensor.yaml:5: T_BS: "));
  EXPECT_THAT(yaml("0, 0, 0, 1]", "0, 0, 0, 2]"), HasSubstr("T_BS: the last row"));
  EXPECT_THAT(yaml("data: [0,", "data: ["), HasSubstr("data: expected 16 numbers"));
  EXPECT_THAT(yaml("T_BS:", "T_BS: ["), HasSubstr("sensor.yaml:"));
  // The right eye on the left of the left one.
  EXPECT_THAT(message("cam0/sensor.yaml", "0.05", "-0.5"), HasSubstr("cam1/sensor.yaml: stereo: "));
  const std::string truth = "state_groundtruth_estimate0/data.csv";
  EXPECT_THAT(message(truth, "250,20,", "250,nan,"), HasSubstr("data.csv:3: pose: 'nan'"));
  EXPECT_THAT(message(truth, "250,20,0,0,1", "250,20,0,0,2"), HasSubstr("data.csv:3: the quat"));
}

}  // namespace euroc_test
}  // namespace placegraph
