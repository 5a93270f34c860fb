#include <placegraph/io/trajectories/body_state_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace body_state_file_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

TEST(BodyStateFile, ReadsTheColumnsOfEuroc) {
  const TemporaryFolder folder;
  const auto states = read_body_states(folder.write(
      "data.csv", "#timestamp\n7,1,2,3,0.6,0,0,0.8,0.1,0.2,0.3,0.01,0.02,0.03,0.4,0.5,0.6\r\n"));
  ASSERT_EQ(states.size(), 1u);
  EXPECT_EQ(states[0].stamp_ns, 7);
  EXPECT_EQ(states[0].T_world_body.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(states[0].T_world_body.rotation().quaternion().w(), 0.6, 1e-12);
  EXPECT_NEAR(states[0].T_world_body.rotation().quaternion().z(), 0.8, 1e-12);
  EXPECT_EQ(states[0].velocity_world, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(states[0].gyro_bias, Eigen::Vector3d(0.01, 0.02, 0.03));
  EXPECT_EQ(states[0].accel_bias, Eigen::Vector3d(0.4, 0.5, 0.6));
}

TEST(BodyStateFile, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  BodyState state;
  state.stamp_ns = 1234567890123456789;
  state.T_world_body = SE3(SO3::exp({0.1, -0.2, 0.3}), Eigen::Vector3d(-1, 2.5, 3));
  state.velocity_world = {0.25, -0.5, 1};
  state.accel_bias = {0.01, 0.02, -0.03};
  write_body_states(folder / "data.csv", {state});
  const auto again = read_body_states(folder / "data.csv");
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].stamp_ns, state.stamp_ns);
  EXPECT_LT((again[0].T_world_body.inverse() * state.T_world_body).log().norm(), 1e-8);
  EXPECT_LT((again[0].velocity_world - state.velocity_world).norm(), 1e-8);
  EXPECT_LT((again[0].accel_bias - state.accel_bias).norm(), 1e-8);
}

TEST(BodyStateFile, NamesFileAndLineOfWhatIsWrong) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text) {
    const std::string path = folder.write("data.csv", text);
    return message_of([&] { (void)read_body_states(path); });
  };
  const std::string rest = ",1,2,3,1,0,0,0,0,0,0,0,0,0,0,0,0\n";
  EXPECT_THAT(refused("1" + rest + "2,1,2,3\n"), HasSubstr("data.csv:2: expected"));
  EXPECT_THAT(refused("2" + rest + "1" + rest), HasSubstr("data.csv:2: time 1 ns"));
  EXPECT_THAT(refused("1,nan,2,3,1,0,0,0,0,0,0,0,0,0,0,0,0\n"), HasSubstr("data.csv:1: state"));
  EXPECT_THAT(refused("1,1,2,3,0,0,0,0,0,0,0,0,0,0,0,0,0\n"), HasSubstr("data.csv:1: the quat"));
  EXPECT_THAT(refused(""), HasSubstr("holds no states"));
}

}  // namespace body_state_file_test
}  // namespace placegraph
