#include "apps/eval/eval_info.h"

#include <gmock/gmock.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trajectories.h"

namespace placegraph::apps {
namespace eval_info_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;
using testing::Not;

class EvalInfoCommand : public testing::Test {
 protected:
  std::string write_drive(const std::string& name, int lost_from = 0, int lost_to = 0) {
    Trajectory drive = test::winding_drive(100);
    for (int i = lost_from; i < lost_to; ++i)
      drive.poses[static_cast<std::size_t>(i)].T_world_body.reset();
    write_trajectory(folder / name, drive, TrajectoryFormat::kTum);
    return folder / name;
  }
  test::TemporaryFolder folder;
  EvalInfoArguments arguments;
};

TEST_F(EvalInfoCommand, DescribesOneTrajectoryInFull) {
  arguments.files = {write_drive("a.tum", 40, 50)};
  const auto infos = eval_info(arguments);
  const std::string text = to_text(infos);
  EXPECT_THAT(text, HasSubstr("frames              90, 90 with a pose\n"));
  EXPECT_THAT(text, HasSubstr("rate                10 Hz; spacing 0.1 s (median)"));
  EXPECT_THAT(text, HasSubstr("gaps                1: 1.100 s from 3.900 s\n"));
  EXPECT_THAT(text, HasSubstr("stops               none\n"));
  EXPECT_THAT(text, HasSubstr("forward             +z of the body"));
  const json object = json::parse(to_json(infos));
  EXPECT_EQ(object["frames"], 90);
  EXPECT_EQ(object["gaps"][0]["first"], 39);
  EXPECT_NEAR(object["gaps"][0]["length_s"].get<double>(), 1.1, 1e-9);
  EXPECT_EQ(object["forward"]["axis"], "+z");
  EXPECT_GT(object["speed_m_per_s"]["p95"].get<double>(),
            object["speed_m_per_s"]["median"].get<double>());
}

TEST_F(EvalInfoCommand, SaysNullAndTheReasonWhereNothingIsEvident) {
  arguments.files = {folder.write("p.txt", "0 1 2 3\n1 1 2 3\n2 1 2 3\n")};  // positions that stand
  const auto infos = eval_info(arguments);
  const json object = json::parse(to_json(infos));
  EXPECT_TRUE(object["plane"]["axis"].is_null());
  EXPECT_EQ(object["plane"]["reason"], "the body does not move");
  EXPECT_TRUE(object["forward"]["axis"].is_null());
  EXPECT_TRUE(object["unit_of_positions"]["as_read"].is_null());
  EXPECT_TRUE(object["turning_deg_per_s"].is_null());
  EXPECT_THAT(to_text(infos),
              HasSubstr("plane               not evident: the body does not move\n"));
}

TEST_F(EvalInfoCommand, ShowsSeveralAsATable) {
  arguments.files = {write_drive("a.tum"), write_drive("b.tum", 40, 50)};
  const auto infos = eval_info(arguments);
  const std::string text = to_text(infos);
  EXPECT_THAT(text, testing::StartsWith("trajectory "));
  EXPECT_THAT(text, HasSubstr("\na.tum "));
  EXPECT_THAT(text, HasSubstr("\nb.tum "));
  const json list = json::parse(to_json(infos))["trajectories"];
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[1]["name"], "b.tum");
}

TEST_F(EvalInfoCommand, NamesWhatTheReaderLeftOut) {
  arguments.files = {folder.write("t.tum", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n2 5 0 0 0 0 0 1\n")};
  testing::internal::CaptureStderr();
  const auto infos = eval_info(arguments);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("t.tum:3: the stamp stands twice, and the first row of it is kept"));
  EXPECT_EQ(json::parse(to_json(infos))["warnings"].size(), 1u);
}

TEST_F(EvalInfoCommand, AppliesAFilterBefore) {
  arguments.files = {write_drive("a.tum")};
  arguments.apply = "crop 1:2; scale 2";
  EXPECT_EQ(eval_info(arguments)[0].info.frames, 11u);
  arguments.apply = "crop 1:2; enlarge 2";
  EXPECT_THAT(message_of<ArgumentError>([&] { eval_info(arguments); }),
              HasSubstr("step 2 (enlarge 2)"));
}

}  // namespace eval_info_test
}  // namespace placegraph::apps
