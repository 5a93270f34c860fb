#include <gmock/gmock.h>
#include <placegraph/io/sensors/odometry_file.h>
#include <placegraph/io/trajectories/body_state_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace repeated_rows_test {

using test::message_of;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

/// Keeps the warnings of a reader.
struct Warnings {
  std::vector<std::string> texts;
  LogSink sink() {
    return [this](LogLevel level, const std::string& text) {
      EXPECT_EQ(level, LogLevel::kWarning);
      texts.push_back(text);
    };
  }
};

TEST(RepeatedRows, OfTumEurocAndTablesKeepTheFirstPose) {
  const TemporaryFolder folder;
  const std::string tum = folder.write(
      "t.tum", "# of TUM\n1 1 0 0 0 0 0 1\n2 2 0 0 0 0 0 1\n2 9 0 0 0 0 0 1\n3 3 0 0 0 0 0 1\n");
  const std::string euroc = folder.write(
      "t.csv", "1000000000,1,0,0,1,0,0,0\n2000000000,2,0,0,1,0,0,0\n2000000000,9,0,0,1,0,0,0\n"
               "3000000000,3,0,0,1,0,0,0\n");
  const std::string table =
      folder.write("t.txt", "time,x,y,z\n1,1,0,0\n2,2,0,0\n2,9,0,0\n3,3,0,0\n");
  for (const auto& [path, line] : {std::pair{tum, 4}, {euroc, 3}, {table, 4}}) {
    SCOPED_TRACE(path);
    const Trajectory read = read_trajectory(path, {}, Orientation::kOptional);
    ASSERT_EQ(read.size(), 3u);
    EXPECT_EQ(read.poses[1].T_world_body->translation().x(), 2);
    EXPECT_THAT(read.warnings,
                ElementsAre(HasSubstr(path + ":" + std::to_string(line) + ": the stamp stands")));
    EXPECT_THAT(read.warnings[0], HasSubstr("up to 7 m"));
  }
}

TEST(RepeatedRows, ThatGoBackOrAreMostOfAFileStayRefused) {
  const TemporaryFolder folder;
  const std::string back = folder.write("b", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  EXPECT_THAT(message_of([&] { read_trajectory(back); }),
              HasSubstr("b:3: time 1000000000 ns does"));
  std::string digits;
  for (int i = 0; i < 10; ++i) digits += i < 5 ? "1e9 0 0 0 0 0 0 1\n" : "1.1e9 0 0 0 0 0 0 1\n";
  const std::string lost = folder.write("l", digits);
  EXPECT_THAT(message_of([&] { read_trajectory(lost); }),
              HasSubstr("l:2: 8 of 10 lines have the time of the line before"));
}

TEST(RepeatedRows, OfStatesAndOfOdometryKeepTheFirst) {
  const TemporaryFolder folder;
  const std::string rest = ",2,3,1,0,0,0,0,0,0,0,0,0,0,0,0\n";
  const std::string states =
      folder.write("data.csv", "1,1" + rest + "1,5" + rest + "2,2" + rest);
  Warnings of_states;
  const std::vector<BodyState> read = read_body_states(states, of_states.sink());
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].T_world_body.translation().x(), 1);
  EXPECT_THAT(of_states.texts, ElementsAre(HasSubstr("data.csv:2: the stamp stands twice")));

  const std::string odometry =
      folder.write("o.txt", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n2 7 0 0 0 0 0 1\n3 2 0 0 0 0 0 1\n");
  Warnings of_odometry;
  const MeasuredMotion motion = read_odometry(odometry, {}, {}, of_odometry.sink());
  ASSERT_EQ(motion.steps().size(), 2u);
  EXPECT_EQ(motion.steps()[1].T_from_to.translation().x(), 1);
  EXPECT_THAT(of_odometry.texts, ElementsAre(HasSubstr("o.txt:3: the stamp stands twice")));
}

TEST(RepeatedRows, OfFramesWithoutTimesAreRefused) {
  const TemporaryFolder folder;
  const std::string line = " 1 0 0 0 0 1 0 0 0 0 1 0\n";
  const std::string path = folder.write("n", "1" + line + "1" + line);
  EXPECT_THAT(message_of([&] { read_trajectory(path); }), HasSubstr("does not increase"));
}

}  // namespace repeated_rows_test
}  // namespace placegraph
