#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/gate/record.h>
#include <placegraph/eval/gate/trajectory_record.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include "tests/support/message_of.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace record_test {

using test::message_of;
using testing::HasSubstr;

FigureRecord figure(const std::string& key, std::vector<std::optional<double>> values) {
  FigureRecord one;
  one.key = key;
  one.values = std::move(values);
  return one;
}

Record record_with(std::vector<FigureRecord> figures) {
  SequenceRecord sequence;
  sequence.name = "00";
  sequence.figures = std::move(figures);
  return {{"system 1"}, {sequence}};
}

/// A record of any form that check() allows.
Record random_record(Random& random) {
  Record record{{"a \"quoted\" program", "b"}, {}};
  const int sequences = random.index(4), runs = 1 + random.index(6);
  for (int s = 0; s < sequences; ++s) {
    SequenceRecord& sequence = record.sequences.emplace_back();
    sequence.name = "sequence, of \xc3\xa4 town " + std::to_string(s);
    if (random.index(2)) sequence.truth = {"00ff", random.index(1000), random.uniform(0, 1e4)};
    if (random.index(2)) sequence.options = {{"align", "se3"}, {"lengths_m", "100,200"}};
    if (random.index(2)) sequence.reference_s = random.uniform(0.1, 2);
    if (random.index(2)) sequence.failures = {"run 2: too few pairs"};
    for (int f = random.index(5); f > 0; --f) {
      FigureRecord& one = sequence.figures.emplace_back();
      one.key = "figure " + std::to_string(f);
      one.unit = random.index(2) ? "m" : "";
      one.better = static_cast<Better>(random.index(4));
      one.verdict = random.index(4) == 0;
      for (int run = 0; run < runs; ++run)
        if (random.index(5) > 0)
          one.values.emplace_back(one.verdict ? random.index(2) : random.normal(0, 1e3));
        else
          one.values.emplace_back();
      if (std::ranges::none_of(one.values, [](auto& v) { return v.has_value(); }))
        one.verdict = false;
      if (random.index(3) == 0) one.whole = random.index(100);
      if (random.index(3) == 0) one.text = "<= {}";
      if (random.index(3) == 0) one.noise_floor = random.uniform(0.1, 1);
    }
  }
  return record;
}

TEST(RecordText, ReadsWhatItWrites) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const std::string text = to_json(random_record(random));
    const Record read = parse_record(text, "a.json");
    EXPECT_EQ(to_json(read), text);
    for (const SequenceRecord& sequence : read.sequences)
      for (const FigureRecord& one : sequence.figures) EXPECT_FALSE(one.values.empty());
  }
}

TEST(RecordText, NamesWhatIsWrongAndWhere) {
  const std::string good = to_json(record_with({figure("ate", {1.5})}));
  const auto refused = [&good](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    return message_of<FileError>([&] { static_cast<void>(parse_record(text, "a.json")); });
  };
  const std::vector<std::tuple<const char*, const char*, const char*>> cases = {
      {"\"version\": 1", "\"version\": 2", "version: 2 of the format of records"},
      {"\"version\": 1", "\"version\": 0", "version: 0 of the format of records"},
      {"\"version\": 1", "\"version\": \"1\"", "version: is no number"},
      {"placegraph record", "another", "is no record of `placegraph eval record`"},
      {"[1.5]", "[NaN]", "line 6"},
      {"[1.5]", "[1e999]", "a.json: "},
      {"[1.5]", "[\"1.5\"]", "sequences[0].figures[0].values[0]: is no number"},
      {"[1.5]", "[]", "00: ate: has no values"},
      {"[1.5]", "1.5", "sequences[0].figures[0].values: is no list"},
      {"[1.5]", "[true, 0.5]", "values[1]: is no verdict"},
      {"\"smaller\"", "\"small\"", "better: 'small' is none of smaller, larger"},
      {"\"unit\"", "\"units\"", "sequences[0].figures[0]: unknown key 'units'"},
      {"\"key\":\"ate\",", "", "sequences[0].figures[0]: has no 'key'"},
      {"\"key\":\"ate\"", "\"key\":\"a\",\"key\":\"ate\"", "key 'key' stands twice"},
      {"\"name\":\"00\"", "\"name\":7", "sequences[0].name: is no text"},
      {"]}]}", "]}]", "a.json: "},
  };
  for (const auto& [from, to, message] : cases) {
    const std::string told = refused(from, to);
    EXPECT_THAT(told, HasSubstr(message)) << from << " -> " << to;
    EXPECT_THAT(told, testing::StartsWith("a.json: "));
    EXPECT_EQ(told.find('\n'), std::string::npos);
  }
  for (const char* text : {"", "[]", "null", "7"})
    EXPECT_THROW(static_cast<void>(parse_record(text, "a.json")), FileError) << text;
}

TEST(Record, NamesAndKeysStandOnceAndRunsAreEquallyMany) {
  EXPECT_THROW(record_with({figure("a", {1.0}), figure("a", {1.0})}).check(), ArgumentError);
  EXPECT_THROW(record_with({figure("a", {1.0}), figure("b", {1.0, 2.0})}).check(), ArgumentError);
  EXPECT_THROW(record_with({figure("a", {NAN})}).check(), ArgumentError);
  Record twice = record_with({figure("a", {1.0})});
  twice.sequences.push_back(twice.sequences.front());
  EXPECT_THROW(twice.check(), ArgumentError);
}

TEST(Record, RunsOfSeveralFilesStandOneBehindTheOther) {
  const Record one = record_with({figure("a", {1.0, 2.0})});
  Record two = record_with({figure("a", {3.0}), figure("b", {4.0})});
  const Record both = merged({one, two}, {"one", "two"});
  ASSERT_EQ(both.sequences.size(), 1u);
  EXPECT_EQ(both.sequences[0].find("a")->values,
            (std::vector<std::optional<double>>{1.0, 2.0, 3.0}));
  EXPECT_EQ(both.sequences[0].find("b")->values,
            (std::vector<std::optional<double>>{std::nullopt, std::nullopt, 4.0}));
  two.sequences[0].name = "05";
  const Record apart = merged({one, two}, {"one", "two"});
  EXPECT_EQ(apart.find("00")->find("a")->values.size(), 3u);
  EXPECT_THAT(apart.find("00")->failures, testing::ElementsAre("two has no sequence 00"));
  EXPECT_THAT(apart.find("05")->failures, testing::ElementsAre("one has no sequence 05"));
}

TEST(Record, RunsOfAnotherTruthOrOtherOptionsAreNotOfOneSystem) {
  Record one = record_with({figure("a", {1.0})}), two = one;
  one.sequences[0].truth = {"0a", 10, 5};
  two.sequences[0].truth = {"0b", 11, 6};
  EXPECT_THAT(message_of<ArgumentError>([&] { static_cast<void>(merged({one, two}, {"1", "2"})); }),
              HasSubstr("the truth is another one: 10 poses over 5.0 m, and 11 over 6.0 m"));
  two.sequences[0].truth = one.sequences[0].truth;
  one.sequences[0].options = {{"align", "se3"}};
  two.sequences[0].options = {{"align", "sim3"}};
  EXPECT_EQ(difference_of(one.sequences[0], two.sequences[0]),
            "the options differ: align is se3, and sim3");
  two.sequences[0].options.clear();
  EXPECT_EQ(difference_of(one.sequences[0], two.sequences[0]), "");
}

TEST(TruthFingerprint, IsOfThePosesAlone) {
  Trajectory truth = test::winding_drive(60, 1, false);
  const std::string print = truth_fingerprint(truth);
  EXPECT_EQ(print.size(), 16u);
  Trajectory timed = truth;
  timed.has_times = true;
  for (StampedPose& pose : timed.poses) pose.stamp_ns += 1000;
  EXPECT_EQ(truth_fingerprint(timed), print);
  for (const double moved_m : {1e-6, -1e-3, 1.0}) {
    Trajectory other = truth;
    other.poses[30].T_world_body->translation().z() += moved_m;
    EXPECT_NE(truth_fingerprint(other), print) << moved_m;
  }
  Trajectory lost = truth;
  lost.poses[3].T_world_body.reset();
  EXPECT_NE(truth_fingerprint(lost), print);
  Trajectory shorter = truth;
  shorter.poses.pop_back();
  EXPECT_NE(truth_fingerprint(shorter), print);
  Trajectory negative_zero = truth, zero = truth;
  zero.poses[0].T_world_body->translation().x() = 0.0;
  negative_zero.poses[0].T_world_body->translation().x() = -0.0;
  EXPECT_EQ(truth_fingerprint(zero), truth_fingerprint(negative_zero));
}

TEST(TrajectoryRecord, HasTheFiguresOfEveryRunAndTheFailedOnes) {
  const Trajectory truth = test::winding_drive(60, 1, false);
  Trajectory near = truth, single = truth;
  for (StampedPose& pose : near.poses) pose.T_world_body->translation().x() += 0.3;
  for (std::size_t i = 1; i < single.size(); ++i) single.poses[i].T_world_body.reset();
  EvaluationOptions options;
  options.alignment = Alignment::kNone;
  const SequenceRecord sequence =
      record_of("00", truth, {evaluate(truth, near, options, "near"),
                              evaluate(truth, single, options, "single")});
  const FigureRecord* ate = sequence.find("ate_rmse_m");
  ASSERT_NE(ate, nullptr);
  ASSERT_EQ(ate->values.size(), 2u);
  EXPECT_NEAR(ate->values[0].value(), 0.3, 1e-9);
  EXPECT_FALSE(ate->values[1].has_value());
  ASSERT_EQ(sequence.failures.size(), 1u);
  EXPECT_THAT(sequence.failures[0], testing::StartsWith("single: "));
  EXPECT_EQ(sequence.find("coverage")->better, Better::kLarger);
  EXPECT_EQ(sequence.options.at("align"), "none");
  EXPECT_EQ(sequence.truth.frames, 60);
  options.alignment = Alignment::kSe3;
  EXPECT_THROW(static_cast<void>(record_of("00", truth, {evaluate(truth, near), evaluate(truth, near, [] {
                                             EvaluationOptions other;
                                             other.alignment = Alignment::kNone;
                                             return other;
                                           }())})),
               ArgumentError);
  EXPECT_THROW(static_cast<void>(record_of("00", truth, {})), ArgumentError);
}

TEST(TrajectoryRecord, KnowsTheNoiseOfItsTruthAndTheIntervalsOfOneRun) {
  // A circle driven at 1 m a frame, with noise of 0.05 m in each axis of the true positions.
  Random random(3);
  Trajectory exact, truth;
  for (int i = 0; i < 600; ++i) {
    Eigen::Isometry3d pose = test::isometry({0, 0, 0.01}, {1, 0, 0});
    if (i > 0) pose = *exact.poses.back().T_world_body * pose;
    exact.poses.push_back({i, pose});
  }
  truth = exact;
  for (StampedPose& pose : truth.poses)
    for (double& part : pose.T_world_body->translation()) part += random.normal(0, 0.05);
  const SequenceRecord sequence = record_of("00", truth, {evaluate(truth, exact)});
  const double sigma = std::sqrt(3.0) * 0.05;
  EXPECT_NEAR(sequence.find("ate_rmse_m")->noise_floor, sigma, 0.3 * sigma);
  EXPECT_NEAR(sequence.find("rpe_trans_m")->noise_floor, std::sqrt(2.0) * sigma, 0.4 * sigma);
  EXPECT_EQ(sequence.find("coverage")->noise_floor, 0);
  EXPECT_TRUE(sequence.find("rpe_trans_m")->interval.outcome);
  EXPECT_EQ(sequence.find("ate_rmse_m")->interval.outcome.reason, "one run");
}

TEST(AddRuns, StandBehindThoseOfTheSameSequenceAndOtherSequencesBehindTheirOwn) {
  Record record = record_with({figure("a", {1.0, 2.0})});
  Record more = record_with({figure("a", {3.0})});
  more.programs = {"system 2"};
  more.sequences.push_back(more.sequences[0]);
  more.sequences[1].name = "05";
  add_runs(more, {"before", "more"}, record);
  EXPECT_EQ(record.programs, (std::vector<std::string>{"system 1", "system 2"}));
  EXPECT_EQ(record.find("00")->find("a")->values.size(), 3u);
  EXPECT_EQ(record.find("05")->find("a")->values.size(), 1u);
  EXPECT_TRUE(record.find("05")->failures.empty());
}

}  // namespace record_test
}  // namespace placegraph
