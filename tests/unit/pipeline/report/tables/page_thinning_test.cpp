#include <placegraph/pipeline/report/tables/page_thinning.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/report/evaluation_page.h>
#include <placegraph/pipeline/report/graph_page.h>
#include <placegraph/pipeline/report/page.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/parts.h>
#include <placegraph/pipeline/report/tables/column.h>
#include <placegraph/pipeline/report/tables/row_thinning.h>
#include "tests/support/report_page.h"
#include "tests/support/trajectories.h"

namespace placegraph::report {
namespace page_thinning_test {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// What a page takes beside the scripts of every page.
std::size_t data_bytes(const std::string& page) { return page.size() - empty_page().size(); }

TEST(RowThinning, KeepsEndsGapsAndOutliersOfAnyNumberOfRows) {
  Random random(1);
  for (int round = 0; round < 60; ++round) {
    const auto count = static_cast<std::size_t>(40 + random.index(5000));
    const auto most = static_cast<std::size_t>(40 + random.index(400));
    RowSeries series;
    float walk = 0;
    for (std::size_t i = 0; i < count; ++i)
      series.values.push_back(walk += static_cast<float>(random.normal(0, 0.01)));
    const auto outlier = static_cast<std::size_t>(random.index(static_cast<int>(count)));
    const std::size_t gap = (outlier + count / 2) % (count - 12) + 2;
    series.values[outlier] = round % 2 == 0 ? 1e4f : -1e4f;
    for (std::size_t i = gap; i < gap + 5; ++i) series.values[i] = kNaN;
    const std::vector<std::size_t> rows = chosen_rows(count, {series}, {}, most);
    EXPECT_LE(rows.size(), std::max(count, most));
    EXPECT_LE(rows.size(), most);
    EXPECT_TRUE(std::ranges::is_sorted(rows, std::less_equal()));
    EXPECT_THAT(rows, IsSupersetOf({std::size_t{0}, gap - 1, gap, gap + 4, gap + 5, count - 1}));
    if (outlier < gap || outlier >= gap + 5) {
      EXPECT_THAT(rows, Contains(outlier)) << count << " " << most;
    }
  }
}

TEST(RowThinning, KeepsWantedRowsAndEvenOnesOfAConstant) {
  const RowSeries constant{std::vector<float>(3 * 1000, 2), 3, 3};
  const std::vector<std::size_t> rows = chosen_rows(1000, {constant}, {3, 4, 5, 500}, 80);
  EXPECT_THAT(rows, IsSupersetOf({0, 3, 4, 5, 500, 999}));
  EXPECT_LE(rows.size(), 80u);
  EXPECT_EQ(even_rows(5, 9), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(even_rows(101, 3), (std::vector<std::size_t>{0, 50, 100}));
  EXPECT_TRUE(even_rows(0, 3).empty());
  EXPECT_TRUE(even_rows(3, 0).empty());
}

/// A drive with an estimate that has a far outlier and a gap; `moves`: whether it moves at all.
EvaluationResult long_drive(int frames, bool moves, const std::string& name) {
  const Trajectory truth = test::winding_drive(frames, moves ? 1 : 0);
  Random random(2);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body->translation() += Eigen::Vector3d(random.normal(0, 0.1), 0, 0);
  const auto count = static_cast<std::size_t>(frames);
  estimate.poses[count / 3].T_world_body->translation().z() += 500;
  for (std::size_t i = count / 2; i < count / 2 + 9; ++i) estimate.poses[i].T_world_body.reset();
  EvaluationOptions options;
  options.alignment = Alignment::kNone;
  options.association = Association::kIndex;
  options.segments.lengths_m = {100};
  return evaluate(truth, estimate, options, name);
}

/// The path of the frames that have an estimate, without the gap.
double path_of(const EvaluationResult& result) {
  double length = 0;
  for (std::size_t i = 1; i < result.aligned_pairs.size(); ++i) {
    const auto &a = result.aligned_pairs[i - 1].T_world_estimate,
               &b = result.aligned_pairs[i].T_world_estimate;
    if (a && b) length += (b->translation() - a->translation()).norm();
  }
  return length;
}

TEST(PageThinning, AnEvaluationOfAnyNumberOfPosesIsSmall) {
  for (const bool moves : {true, false})
    for (const int frames : {30, 2000, 12'000})
      for (const int runs : {1, frames == 2000 ? 4 : 1}) {
        EvaluationPage page{"street", {}, false};
        for (int i = 0; i < runs; ++i)
          page.results.push_back(long_drive(frames, moves, std::to_string(i)));
        const std::string written = evaluation_page(page, "placegraph 1.2.3");
        EXPECT_LE(data_bytes(written), kMostPageBytes) << frames << " " << runs << " " << moves;
        const test::TemporaryFolder folder;
        folder.write("page.html", written);
        const json report = test::report_in(folder / "page.html");
        for (const json& run : report["runs"]) {
          const std::vector<float> ids = values_of(run["frames"]["id"]);
          const auto n = static_cast<float>(frames), half = static_cast<float>(frames / 2);
          EXPECT_THAT(ids, IsSupersetOf({0.0f, static_cast<float>(frames / 3), half - 1, half,
                                         half + 8, half + 9, n - 1}));
          EXPECT_EQ(run["summary"]["frames"], frames);
          EXPECT_EQ(rows_of(run["frames"]["truth"]), ids.size());
          if (ids.size() == static_cast<std::size_t>(frames)) continue;
          EXPECT_THAT(run["notes"].dump(),
                      HasSubstr(std::to_string(ids.size()) + " of " + std::to_string(frames)));
          EXPECT_NEAR(run["summary"]["path_length"].get<double>(), path_of(page.results[0]),
                      1e-3 * path_of(page.results[0]));
        }
      }
}

TEST(PageThinning, AGraphOfAnyNumberOfPosesIsSmallAndKeepsItsWorstEdges) {
  for (const int nodes : {50, 3000, 60'000}) {
    GraphPage page;
    page.name = "long.g2o";
    const Trajectory drive = test::winding_drive(nodes);
    for (int i = 0; i < nodes; ++i)
      page.before.nodes.push_back(
          {NodeId(i), SE3(drive.poses[static_cast<std::size_t>(i)].T_world_body.value())});
    Random random(3);
    const auto add = [&](int from, int to, ConstraintSource source, double chi2) {
      RelativePoseConstraint edge;
      edge.from = NodeId(from);
      edge.to = NodeId(to);
      edge.information = Information::Identity(6, 6);
      edge.source = source;
      page.before.constraints.push_back(edge);
      page.chi2.push_back(chi2);
    };
    for (int i = 1; i < nodes; ++i)
      add(i - 1, i, ConstraintSource::kOdometry, i == nodes / 2 ? 5e4 : random.uniform());
    for (int i = 0; i < nodes; ++i)
      add(random.index(nodes / 2), nodes / 2 + random.index(nodes / 2), ConstraintSource::kLoop,
          i == 7 ? 1e5 : random.uniform());
    page.after = page.before;
    page.after.nodes[static_cast<std::size_t>(nodes / 3)].T_world_node = SE3(SO3(), {1e5, 0, 0});
    const std::string written = graph_page(page, "placegraph 1.2.3");
    EXPECT_LE(data_bytes(written), kMostPageBytes);
    const test::TemporaryFolder folder;
    folder.write("page.html", written);
    const json graph = test::report_in(folder / "page.html")["graphs"][0];
    EXPECT_THAT(values_of(graph["chi2"]), IsSupersetOf({1e5f, 5e4f}));
    EXPECT_THAT(values_of(graph["after"]), Contains(1e5f));
    const auto kept = static_cast<float>(rows_of(graph["before"]));
    for (const float end : values_of(graph["edges"])) EXPECT_LT(end, kept);
    if (kept == static_cast<float>(nodes)) continue;
    EXPECT_EQ(graph["all"]["nodes"], nodes);
    EXPECT_EQ(graph["all"]["edges"], 2 * nodes - 1);
    EXPECT_EQ(rows_of(graph["ends"]), rows_of(graph["edges"]));
  }
}

/// A run of so many frames, every fourth of which is a keyframe with an image and a place.
json long_run(int frames) {
  std::vector<std::int32_t> ids, keyframe_of, keyframes,
      component(static_cast<std::size_t>(frames));
  std::vector<double> stamps;
  std::vector<std::optional<Eigen::Isometry3d>> poses;
  std::vector<std::string> reasons, images, sources;
  std::vector<std::int32_t> from, to, landmark_of;
  std::vector<float> positions, landmarks;
  const Trajectory drive = test::winding_drive(frames);
  for (int i = 0; i < frames; ++i) {
    ids.push_back(i);
    stamps.push_back(0.1 * i);
    keyframe_of.push_back(i / 4);
    reasons.push_back("reason " + std::to_string(i));
    poses.push_back(drive.poses[static_cast<std::size_t>(i)].T_world_body);
    if (i % 4 != 0) continue;
    keyframes.push_back(i / 4);
    images.push_back("data:image/jpeg;base64,AAAA");
    for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(i));
    for (int k = 0; k < 20; ++k) {
      landmarks.insert(landmarks.end(), 3, static_cast<float>(k));
      landmark_of.push_back(i / 4);
    }
    if (i == 0) continue;
    from.push_back(i / 4 - 1);
    to.push_back(i / 4);
    sources.emplace_back("odometry");
  }
  json run = bare_run("long", bare_frames(ids, stamps));
  run["frames"]["component"] = column(component);
  run["frames"]["keyframe"] = column(keyframe_of);
  run["frames"]["pose"] = pose_column(poses);
  run["frames"]["reason"] = text_column(reasons);
  std::vector<std::int32_t> frame_of, of_main(keyframes.size());
  for (const std::int32_t id : keyframes) frame_of.push_back(4 * id);
  const std::vector<std::int32_t> one_each(keyframes.size(), 1);
  run["keyframes"] = {{"id", column(keyframes)},
                      {"frame", column(frame_of)},
                      {"place", column(keyframes)},
                      {"thumbnails", images},
                      {"tracks",
                       {{"count", column(one_each)},
                        {"landmark", column(keyframes)},
                        {"pixel", column(std::vector<std::uint8_t>(2 * keyframes.size()), 2)}}}};
  run["landmarks"] = {{"position", column(landmarks, 3)},
                      {"colour", nullptr},
                      {"sigma_m", nullptr},
                      {"keyframe", column(landmark_of)}};
  run["places"] = {{"id", column(keyframes)},
                   {"keyframe", column(keyframes)},
                   {"component", column(of_main)},
                   {"position", column(positions, 3)}};
  run["constraints"] = {
      {"from", column(from)}, {"to", column(to)}, {"source", text_column(sources)}};
  const std::vector<std::int32_t> query = {frames - 1, frames - 5}, match = {1, 6};
  run["loops"] = {{"query_frame", column(query)},
                  {"match_frame", column(match)},
                  {"probability", nullptr},
                  {"similarity", nullptr},
                  {"inliers", nullptr},
                  {"lines", nullptr},
                  {"stage", text_column({"accepted", "drift"})},
                  {"reason", nullptr},
                  {"rank", nullptr},
                  {"judged", false}};
  return run;
}

TEST(PageThinning, TablesOfALongRunStayConsistent) {
  for (const int frames : {100, 5000, 60'000}) {
    json report = bare_report("placegraph 1.2.3", "long");
    report["runs"].push_back(long_run(frames));
    thin_report(report, kMostPageBytes);
    const json& run = report["runs"][0];
    EXPECT_LE(page_bytes(report) - page_bytes(run["keyframes"]), kMostPageBytes);
    const std::vector<float> ids = values_of(run["frames"]["id"]),
                             keyframes = values_of(run["keyframes"]["id"]),
                             places = values_of(run["places"]["id"]);
    EXPECT_THAT(ids, IsSupersetOf({0, 1, 6, frames - 5, frames - 1}));
    EXPECT_THAT(ids, IsSupersetOf(values_of(run["keyframes"]["frame"])));
    EXPECT_EQ(run["keyframes"]["thumbnails"].size(), keyframes.size());
    EXPECT_EQ(values_of(run["keyframes"]["tracks"]["landmark"]), keyframes);
    EXPECT_EQ(run["frames"]["reason"]["table"].size(), ids.size());
    for (const float id : values_of(run["landmarks"]["keyframe"]))
      EXPECT_TRUE(std::ranges::binary_search(keyframes, id)) << id;
    // The chain of places is whole.
    std::vector<float> from(places.begin(), places.end() - 1), to(places.begin() + 1, places.end());
    EXPECT_EQ(values_of(run["constraints"]["from"]), from);
    EXPECT_EQ(values_of(run["constraints"]["to"]), to);
    EXPECT_EQ(rows_of(run["loops"]["query_frame"]), 2u);
  }
}

}  // namespace page_thinning_test
}  // namespace placegraph::report
