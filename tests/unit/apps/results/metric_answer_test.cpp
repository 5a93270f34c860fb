#include <gtest/gtest.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/map/sqlite.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/exports/gltf_export.h>
#include <placegraph/pipeline/exports/place_tables.h>
#include <placegraph/pipeline/exports/ply_export.h>
#include <placegraph/pipeline/report/run_part.h>
#include <placegraph/pipeline/results/result_json.h>
#include <placegraph/pipeline/results/run_files.h>
#include <placegraph/pipeline/results/run_map.h>
#include <placegraph/pipeline/run.h>

#include <map>
#include <nlohmann/json.hpp>

#include "apps/map/map_info.h"
#include "apps/map/queries/explain.h"
#include "apps/map/queries/georeference_files.h"
#include "apps/results/result_texts.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace metric_answer_test {

using nlohmann::json;

struct JudgedRun {
  RunResult run;
  StoredMap stored;
  bool measured = false;  ///< whether anything gave the map a scale
};

/// A run over a random map: of measured or unknown scale, with notes of the data and of the run
/// that doubt it or do not.
JudgedRun random_run(Random& random) {
  JudgedRun judged;
  StoredMap& stored = judged.stored;
  stored = test::random_map(random, 4, random.index(3) == 0);
  RunResult& run = judged.run;
  run.map = stored.map;
  judged.measured = run.map.metric;
  run.sensor = static_cast<Sensor>(random.index(3));
  run.calibration = *stored.origin.calibration;
  stored.origin.sensor = run.sensor;
  const auto note = [&] {
    return DataNote{"an odd length", random.index(3) == 0, NoteCause::kScale, "measure it"};
  };
  std::vector<DataNote> of_data;
  for (int i = random.index(3); i > 0; --i) of_data.push_back(note());
  for (int i = random.index(3); i > 0; --i) run.notes.push_back(note());
  stored.judgement = judge(run, of_data, 0.2);
  stored.map = run.map;
  return judged;
}

/// Whether lengths are metres, by every output of a run in a folder.
std::map<std::string, bool> answers(const JudgedRun& judged, const test::TemporaryFolder& folder) {
  const RunResult& run = judged.run;
  const Trajectory optimized = run.map.trajectory_optimized();
  const std::string map_file = folder / "map.db";
  write_map(map_file, judged.stored);
  json result = describe_run(run, optimized);
  result["judgement"] = describe_judgement(*judged.stored.judgement);
  folder.write("result.json", result.dump());
  folder.write("places.json", places_json(run.map));
  write_g2o(folder / "graph.g2o", run.map.place_graph.pose_graph());
  write_trajectory(folder / "trajectory_optimized.tum", optimized, TrajectoryFormat::kTum);

  const StoredMap read = read_map(map_file);
  SqliteDatabase database(map_file, SqliteDatabase::Access::kRead);
  const json page = report::describe_run_for_report(map_file);
  const MapInfoResult info = map_info({map_file});
  const json explained = explain({map_file, read.map.keyframes.front().frame}).explanation;
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  const auto rigid = [](const std::string& path) {
    return read_georeference_input(path, "").graph.kind() != PoseKind::kSim3;
  };
  return {{"result.json", result["metric"]},
          {"judgement of result.json", result["judgement"]["metric"]},
          {"the judgement in a text",
           has(judgement_text(result["judgement"], ""), "lengths are in metres")},
          {"plot", run_plot(run.map, optimized, nullptr, "").unit == "m"},
          {"folder", read_run_map(folder.path()).metric},
          {"saved map as a graph", read_run_map(map_file).metric},
          {"map", read.map.metric},
          {"judgement of the map", read.judgement->metric},
          {"table origin", database.integer("SELECT metric FROM origin") == 1},
          {"table judgement", database.integer("SELECT metric FROM judgement") == 1},
          {"page", page["metric"]},
          {"judgement of the page", page["judgement"]["metric"]},
          {"map info", info.summary["metric"]},
          {"map info in a text", !has(to_text(info), "units")},
          {"map explain", explained["assumed"]["metric"]},
          {"georeference of the folder", rigid(folder.path())},
          {"georeference of the map", rigid(map_file)},
          {"ply", has(landmarks_ply(read, 0, NumberForm::kText), "lengths in metres")},
          {"gltf", has(map_gltf(read, 0, GltfForm::kGltf), "metres")}};
}

/// Whether a drift in metres is said, by every output that has one.
std::map<std::string, bool> drifts(const JudgedRun& judged, const test::TemporaryFolder& folder) {
  const Judgement& judgement = *judged.stored.judgement;
  const json page = report::describe_run_for_report(folder / "map.db");
  SqliteDatabase database(folder / "map.db", SqliteDatabase::Access::kRead);
  return {{"judgement", judgement.expected_drift_m.has_value()},
          {"result.json", describe_judgement(judgement).contains("expected_drift_m")},
          {"map", read_map(folder / "map.db").judgement->expected_drift_m.has_value()},
          {"table", database.integer("SELECT count(expected_drift_m) FROM judgement") == 1},
          {"page", !page["judgement"]["expected_drift_m"].is_null()}};
}

TEST(MetricAnswer, IsOneInEveryOutput) {
  int measured = 0, withdrawn = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const test::TemporaryFolder folder;
    const JudgedRun judged = random_run(random);
    const bool metric = judged.stored.judgement->metric;
    for (const auto& [where, answer] : answers(judged, folder)) EXPECT_EQ(answer, metric) << where;
    for (const auto& [where, said] : drifts(judged, folder)) EXPECT_LE(said, metric) << where;
    measured += metric;
    withdrawn += judged.measured && !metric;
  }
  EXPECT_GE(measured, 3);
  EXPECT_GE(withdrawn, 3);
}

TEST(MetricAnswer, IsThatOfTheJudgementInFilesThatHaveTwo) {
  const test::TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const JudgedRun judged = random_run(random);
    (void)answers(judged, folder);
    const bool metric = judged.stored.judgement->metric;
    json result = json::parse(test::read_file(folder / "result.json"));
    result["metric"] = true;
    folder.write("result.json", result.dump());
    SqliteDatabase(folder / "map.db", SqliteDatabase::Access::kWrite)
        .execute("UPDATE origin SET metric = 1");
    EXPECT_EQ(read_run_map(folder.path()).metric, metric);
    EXPECT_EQ(read_map(folder / "map.db").map.metric, metric);
    EXPECT_EQ(read_georeference_input(folder.path(), "").graph.kind() != PoseKind::kSim3, metric);
  }
}

}  // namespace metric_answer_test
}  // namespace placegraph::apps
