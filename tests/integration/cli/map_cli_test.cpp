// `placegraph run` saves its map as it goes, `run --resume` goes on from it, `placegraph map` reads
// it.
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/io/map/map_database.h>

#include <placegraph/io/trajectories/trajectory_file.h>

#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "tests/support/cli_test.h"
#include "tests/support/pictures.h"

namespace placegraph {
namespace map_cli_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::CommandResult;
using test::read_file;
using ::testing::HasSubstr;

/// A rendered drive and the run over it, made once for all tests.
class MapCli : public test::CliTest {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    CommandResult result = test::run_placegraph(
        "synth sequence town-loop --frames 40 --stereo --size 448x280 --difficulty clean --out "
        "drive",
        made->path());
    ASSERT_EQ(result.code, 0) << result.err;
    result = test::run_placegraph("run drive --out whole", made->path());
    ASSERT_EQ(result.code, 0) << result.err;
  }
  static void TearDownTestSuite() { delete made; }
  static std::string drive() { return *made / "drive"; }
  static std::string whole() { return *made / "whole"; }
  /// The run's map as a kill would have left it after the commit of its `places`-th place.
  void break_off(std::size_t places) {
    fs::create_directory(dir / "broken");
    StoredMap stored = read_map(whole() + "/map.db");
    ASSERT_GT(stored.map.place_graph.places.size(), places);
    const KeyframeId last = stored.map.place_graph.places[places - 1].anchor_keyframe;
    Map& map = stored.map;
    map.place_graph.places.resize(places);
    map.place_graph.places.back().members.resize(1);
    std::erase_if(map.place_graph.constraints, [&](const RelativePoseConstraint& c) {
      return std::max(c.from, c.to) >= NodeId(places);
    });
    std::erase_if(map.keyframes, [&](const Keyframe& k) { return k.id > last; });
    std::erase_if(map.landmarks, [&](const PointLandmark& l) { return l.keyframe > last; });
    const FrameId frame = map.keyframes.back().frame;
    std::erase_if(map.frames, [&](const FrameRecord& r) { return r.frame > frame; });
    map.trajectory_online.poses.resize(map.frames.size());
    std::erase_if(map.loops, [&](const LoopRecord& l) { return l.query_frame > frame; });
    PlaceHistory& history = stored.history;
    std::erase_if(history.keyframes, [&](const auto& k) { return k.id > last; });
    std::erase_if(history.segments, [&](const auto& p) { return p.anchor > last; });
    history.places.resize(places);
    history.places.back().last_keyframe = last;
    history.merged.clear();
    history.evidence.clear();
    std::erase_if(history.loops, [&](const Loop& l) { return l.query > last; });
    stored.finished = false;
    write_map(dir / "broken/map.db", stored);
  }
  static test::TemporaryFolder* made;
};
test::TemporaryFolder* MapCli::made = nullptr;

TEST_F(MapCli, ARunLeavesOneFileThatHoldsItsMap) {
  EXPECT_FALSE(fs::exists(whole() + "/map.db-wal"));
  EXPECT_FALSE(fs::exists(whole() + "/map.db.new"));
  const json result = json::parse(read_file(whole() + "/result.json"));
  const CommandResult info = run("map info " + whole() + " --json");
  ASSERT_EQ(info.code, 0) << info.err;
  const json map = json::parse(info.out);
  for (const char* key : {"places", "keyframes", "frames", "posed", "loops_accepted", "metric"})
    EXPECT_EQ(map[key], result[key]) << key;
  EXPECT_EQ(map["views"], map["keyframes"]);
  EXPECT_TRUE(map["finished"].get<bool>());
  EXPECT_EQ(run("map validate " + whole()).code, 0);
}

TEST_F(MapCli, ItsLandmarksAreWhereItsImagesShowThem) {
  const StoredMap stored = read_map(whole() + "/map.db");
  const Map& map = stored.map;
  const Camera& camera = stored.origin.calibration->camera;
  std::map<LandmarkId, const PointLandmark*> landmarks;
  std::size_t coloured = 0, certain = 0;
  for (const PointLandmark& landmark : map.landmarks) {
    landmarks[landmark.id] = &landmark;
    coloured += landmark.rgb.has_value();
    certain += landmark.covariance.has_value();
  }
  EXPECT_GT(coloured, map.landmarks.size() * 9 / 10);
  EXPECT_GT(certain, map.landmarks.size() * 9 / 10);
  std::vector<double> errors_px;
  std::map<LandmarkId, int> views;
  std::size_t unknown = 0;
  for (const Keyframe& keyframe : map.keyframes) {
    EXPECT_EQ(decode_jpeg(keyframe.thumbnail).cols, 160);
    const Sim3 S_keyframe_map = map.S_map_keyframe(keyframe.id).inverse();
    for (const LandmarkObservation& observation : keyframe.observations) {
      const auto landmark = landmarks.find(observation.landmark);
      if (landmark == landmarks.end()) {
        ++unknown;
        continue;
      }
      ++views[observation.landmark];
      const auto px = camera.project(S_keyframe_map * map.position(*landmark->second));
      ASSERT_TRUE(px);
      errors_px.push_back((*px - observation.px.cast<double>()).norm());
    }
  }
  ASSERT_GT(errors_px.size(), 1000u);
  EXPECT_LT(unknown, errors_px.size() / 5);
  EXPECT_LT(median_of(errors_px), 0.7);
  const auto often = std::ranges::count_if(views, [](const auto& of) { return of.second >= 3; });
  EXPECT_GT(static_cast<std::size_t>(often), views.size() / 3);
  const auto confident = std::ranges::count_if(
      map.frames, [](const FrameRecord& frame) { return frame.confidence.has_value(); });
  EXPECT_GT(static_cast<std::size_t>(confident), map.frames.size() * 3 / 4);
  ASSERT_TRUE(stored.judgement);
  EXPECT_EQ(stored.judgement->verdict, Verdict::kGood);
}

TEST_F(MapCli, AReportShowsTheRun) {
  const CommandResult result = run("report " + whole() + " -o page.html");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("page.html: 1 run"));
  const std::string page = read_file(dir / "page.html");
  const std::string begin = "type=\"application/json\">";
  const std::size_t first = page.find(begin) + begin.size();
  const json report = json::parse(page.substr(first, page.find("</script>", first) - first));
  const json& shown = report["runs"][0];
  EXPECT_EQ(shown["judgement"]["verdict"], "good");
  EXPECT_EQ(shown["summary"]["frames"], 40);
  EXPECT_FALSE(shown["frames"]["error_m"].is_null());
  EXPECT_THAT(shown["figures"].dump(), HasSubstr("align se3"));
  EXPECT_EQ(run("report " + whole() + " -o page.html").code, 2);  // it exists
}

TEST_F(MapCli, ExportsAreWhatTheRunWrote) {
  const CommandResult result = run("map export " + whole() +
                                   " --g2o g.g2o --places p.json --tum t.tum --kitti k.kitti "
                                   "--graphml p.graphml --dot p.dot --revisits r.txt");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(read_file(dir / "g.g2o"), read_file(whole() + "/graph.g2o"));
  EXPECT_EQ(read_file(dir / "p.json"), read_file(whole() + "/places.json"));
  EXPECT_EQ(read_file(dir / "t.tum"), read_file(whole() + "/trajectory_optimized.tum"));
  EXPECT_EQ(read_file(dir / "k.kitti"), read_file(whole() + "/trajectory_optimized.kitti"));
  EXPECT_TRUE(fs::exists(dir / "r.txt"));  // without a line: the drive never comes back
  EXPECT_EQ(read_file(dir / "p.graphml"), read_file(whole() + "/places.graphml"));
  EXPECT_EQ(read_file(dir / "p.dot"), read_file(whole() + "/places.dot"));
  expect_usage_error("map export " + whole(), "nothing to write");
}

TEST_F(MapCli, TheWayOverItsPlacesIsThatOfTheRunsFiles) {
  const CommandResult by_files = run("map route " + whole() + " --from 0 --to 4");
  const CommandResult by_map = run("map route " + whole() + "/map.db --from 0 --to 4");
  ASSERT_EQ(by_map.code, 0) << by_map.err;
  EXPECT_EQ(by_map.out, by_files.out);
}

TEST_F(MapCli, ARunThatWasBrokenOffGoesOn) {
  break_off(3);
  EXPECT_EQ(run("map validate broken").code, 0);
  expect_usage_error("run " + drive() + " --out broken", "--resume continues it");
  expect_usage_error("run --resume broken --seed 5", "the run was begun with seed: 0, not 5");
  expect_usage_error("run " + dir.path() + " --resume broken", "the run was begun on");
  const CommandResult resumed = run("run --resume broken --json");
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  const json now = json::parse(resumed.out);
  const json before = json::parse(read_file(whole() + "/result.json"));
  EXPECT_GT(now["resumed_at"].get<int>(), 0);
  EXPECT_LT(now["resumed_at"].get<int>(), 40);
  EXPECT_EQ(now["posed"], before["posed"]);
  // Tracking that begins anew costs a little; a wrong link would cost metres.
  EXPECT_LT(now["evaluation"]["se3"]["ate_rmse_m"].get<double>(),
            before["evaluation"]["se3"]["ate_rmse_m"].get<double>() + 0.02);
  EXPECT_EQ(run("map validate broken").code, 0);
  EXPECT_FALSE(fs::exists(dir / "broken/map.db-wal"));
}

TEST_F(MapCli, ARunThatABrokenImageEndedGoesOnWhenItIsMended) {
  fs::copy(drive(), dir / "damaged", fs::copy_options::recursive);
  const fs::path image = dir / "damaged/image_0/000025.png";
  fs::resize_file(image, fs::file_size(image) / 2);
  const CommandResult stopped = run("run damaged --out stopped");
  EXPECT_EQ(stopped.code, 2);
  EXPECT_THAT(stopped.err, HasSubstr("000025.png"));
  EXPECT_EQ(json::parse(run("map info stopped --json").out)["finished"], false);
  expect_failure("map label stopped damaged", 1, "--resume");
  fs::copy(drive() + "/image_0/000025.png", image, fs::copy_options::overwrite_existing);
  const CommandResult resumed = run("run --resume stopped --json");
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(json::parse(resumed.out)["frames"], 40);
  EXPECT_EQ(json::parse(resumed.out)["posed"], 40);
}

TEST_F(MapCli, ARunThatHadEndedIsWrittenAgain) {
  fs::create_directory(dir / "ended");
  fs::copy(whole() + "/map.db", dir / "ended/map.db");
  const CommandResult again = run("run --resume ended");
  ASSERT_EQ(again.code, 0) << again.err;
  for (const char* name : {"trajectory_optimized.tum", "graph.g2o", "places.json", "loops.csv"})
    EXPECT_EQ(read_file((dir / "ended") + "/" + name), read_file(whole() + "/" + name)) << name;
}

TEST_F(MapCli, NothingSavedIsSaid) {
  fs::create_directory(dir / "empty");
  expect_usage_error("run --resume empty", "nothing was saved");
  expect_usage_error("map info empty", "there is no such file");
  expect_usage_error("run", "SEQUENCE and --out are needed, or --resume");
}

TEST_F(MapCli, ExplainsAFrame) {
  const CommandResult result = run("map explain " + whole() + " 20 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json explanation = json::parse(result.out);
  EXPECT_EQ(explanation["frame"], 20);
  EXPECT_EQ(explanation["where"]["posed"], true);
  EXPECT_EQ(explanation["where"]["unit"], "m");
  EXPECT_EQ(explanation["where"]["covariance"].size(), 6u);
  EXPECT_GT(explanation["known_by"]["inliers"], 10);
  EXPECT_GT(explanation["known_by"]["constraints"]["odometry"], 0);
  EXPECT_GT(explanation["sees"]["surfaces"]["ground"], 0.05);
  EXPECT_EQ(explanation["assumed"]["sensor"], "measured depth");
  EXPECT_THAT(run("map explain " + whole() + " 20").out, HasSubstr("known by"));
  expect_failure("map explain " + whole() + " 99", 1, "has no frame 99");
  expect_usage_error("map explain " + whole() + " -1", "FRAME");
  expect_usage_error("map explain nowhere 1", "nowhere");
}

TEST_F(MapCli, FramesOfTheDriveStandWhereTheyWere) {
  const CommandResult result = run("map localize " + whole() + " " + drive() + " --out placed.txt");
  ASSERT_EQ(result.code, 0) << result.err;
  std::istringstream lines(read_file(dir / "placed.txt"));
  std::string line;
  int posed = 0;
  while (std::getline(lines, line)) {
    if (line.starts_with("#")) continue;
    std::istringstream fields(line);
    int image, place, view;
    double probability, x, y, z;
    std::string stage;
    ASSERT_TRUE(fields >> image >> place >> view >> probability >> stage) << line;
    if (place < 0) continue;
    EXPECT_LE(std::abs(view - image), 6) << line;
    if (fields >> x >> y >> z) ++posed;
  }
  EXPECT_GE(posed, 30);
}

/// Another camera at the places of the drive, and how its images come from the drive's.
struct OtherCamera {
  const char* what;
  int width, height;
  double zoom;             ///< focal length over that of the drive's camera
  double cx, cy;           ///< [px]
  const char* distortion;  ///< line of calibration.yaml
};

void PrintTo(const OtherCamera& camera, std::ostream* out) { *out << camera.what; }

class LocalizeByAnotherCamera : public MapCli, public testing::WithParamInterface<OtherCamera> {
 protected:
  static constexpr int kStep = 4;
  /// Every fourth image of the drive as the other camera takes it.
  void write_queries(const OtherCamera& other) {
    const Camera camera = read_map(whole() + "/map.db").origin.calibration->camera;
    Camera query = camera;
    query.width = other.width, query.height = other.height;
    query.fx *= other.zoom, query.fy *= other.zoom;
    query.cx = other.cx, query.cy = other.cy;
    const std::string distortion = other.distortion;
    if (!distortion.empty()) {
      query.distortion = Distortion::kRadialTangential;
      query.coefficients = {-0.2, 0.05};
    }
    cv::Mat map_x(query.height, query.width, CV_32FC1), map_y = map_x.clone();
    for (int v = 0; v < query.height; ++v)
      for (int u = 0; u < query.width; ++u) {
        const auto ray = query.unproject({u, v});
        map_x.at<float>(v, u) = static_cast<float>(camera.fx * ray->x() + camera.cx);
        map_y.at<float>(v, u) = static_cast<float>(camera.fy * ray->y() + camera.cy);
      }
    fs::create_directory(dir / "query");
    for (int i = 0; i < 40; i += kStep) {
      const std::string name = "/" + std::string(i < 10 ? "00000" : "0000") + std::to_string(i);
      cv::Mat image = test::read_grey_picture(drive() + "/image_0" + name + ".png"), taken;
      cv::remap(image, taken, map_x, map_y, cv::INTER_AREA);
      test::write_picture(dir / "query" + name + ".png", taken);
    }
    std::ostringstream text;
    text << "width: " << query.width << "\nheight: " << query.height << "\nfx: " << query.fx
         << "\nfy: " << query.fy << "\ncx: " << query.cx << "\ncy: " << query.cy << "\n"
         << distortion;
    dir.write("query/calibration.yaml", text.str());
  }
};

TEST_P(LocalizeByAnotherCamera, StandsWhereTheDriveWas) {
  write_queries(GetParam());
  const CommandResult result = run("map localize " + whole() + " query --out placed.txt");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("resampled to the map's"));
  const Trajectory drive = read_trajectory(whole() + "/trajectory_optimized.kitti");
  std::istringstream lines(read_file(dir / "placed.txt"));
  std::string line;
  int posed = 0;
  while (std::getline(lines, line)) {
    if (line.starts_with("#")) continue;
    std::istringstream fields(line);
    std::size_t image;
    std::string place, view, probability, stage;
    Eigen::Vector3d position;
    fields >> image >> place >> view >> probability >> stage;
    if (!(fields >> position.x() >> position.y() >> position.z())) continue;
    ++posed;
    EXPECT_LT((position - drive.poses[kStep * image].T_world_body->translation()).norm(), 0.5)
        << line;
  }
  EXPECT_GE(posed, 6);
}

INSTANTIATE_TEST_SUITE_P(
    Cameras, LocalizeByAnotherCamera,
    testing::Values(OtherCamera{"half the size", 224, 140, 0.5, 111.5, 69.5, ""},
                    OtherCamera{"a longer lens", 448, 280, 1.3, 223.5, 139.5, ""},
                    OtherCamera{"other middle and aspect", 300, 400, 1.1, 149.5, 199.5, ""},
                    OtherCamera{"a lens with distortion", 448, 280, 1.25, 223.5, 139.5,
                                "distortion: {model: radial_tangential, coefficients: [-0.2, "
                                "0.05, 0, 0]}\n"}));

TEST_F(MapCli, QueriesWithoutOrWithABrokenCalibrationAreReported) {
  fs::create_directory(dir / "query");
  for (const char* name : {"/000004.png", "/000020.png"}) {
    cv::Mat small;
    cv::resize(test::read_picture(drive() + "/image_0" + name), small, {224, 140}, 0, 0,
               cv::INTER_AREA);
    test::write_picture(dir / "query" + name, small);
  }
  CommandResult result = run("map localize " + whole() + " query --out placed.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json counts = json::parse(result.out);
  EXPECT_EQ(counts["images"], 2);
  EXPECT_EQ(counts["posed"], 0);
  EXPECT_EQ(counts["without_pose"],
            json({{"of 224 x 140 px by an unknown camera, the map's is of 448 x 280 px", 2}}));
  EXPECT_EQ(counts["notes"].size(), 1);
  // One of the map's size among them: each is told by its own.
  fs::copy_file(drive() + "/image_0/000012.png", dir / "query/000003.png");
  result = run("map localize " + whole() + " query --out mixed.txt");
  EXPECT_THAT(result.out, HasSubstr("3 images, 3 placed (1 with a pose; 2 without: of 224 x 140"));
  EXPECT_THAT(result.err, HasSubstr("taken for the map's, without distortion"));
  dir.write("query/calibration.yaml", "width: 224\nheight: 140\nfx: abc\nfy: 1\ncx: 1\ncy: 1\n");
  expect_usage_error("map localize " + whole() + " query --out no.txt", "calibration.yaml:3");
  EXPECT_FALSE(fs::exists(dir / "no.txt"));
}

TEST_F(MapCli, AMapOfImagesAloneHasPlacesAndNoPoses) {
  CommandResult result = run("map learn " + drive() + " --range 0 29 --out images.db");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(run("map validate images.db").code, 0);
  result = run("map export images.db --tum t.tum");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("without a camera has no poses"));
  result =
      run("map localize images.db " + drive() + " --range 5 25 --sequence --out placed.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json placed = json::parse(read_file(dir / "placed.txt"));
  EXPECT_EQ(placed["images"].size(), 21u);
  expect_usage_error("map localize images.db " + drive() + " --range 5 99 --out no.txt",
                     "two numbers of images needed, from 0 to 39");
}

}  // namespace map_cli_test
}  // namespace placegraph
