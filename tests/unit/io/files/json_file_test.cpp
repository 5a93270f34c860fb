#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/files/json_file.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace json_file_test {

using nlohmann::json;

TEST(JsonFile, IsReadOrNamedWithTheByteOfItsFault) {
  const test::TemporaryFolder dir;
  EXPECT_EQ(read_json(dir.write("a.json", " {\"x\": [1, 2.5]}\n")), (json{{"x", {1, 2.5}}}));
  for (const auto& [text, byte] : {std::pair("{\"x\": }", 7), {"", 1}, {"[1] 2", 5}}) {
    const std::string path = dir.write("b.json", text);
    EXPECT_EQ(test::message_of([&] { (void)read_json(path); }),
              path + ": is not valid JSON, at byte " + std::to_string(byte));
  }
  EXPECT_THROW((void)read_json(dir / "none.json"), FileError);
  EXPECT_THROW((void)read_json(dir.path()), FileError);
}

TEST(JsonFile, OfAnotherFormIsNamedWithTheCommandThatWritesIt) {
  const test::TemporaryFolder dir;
  const auto take = [&](const char* text) {
    const std::string path = dir.write("result.json", text);
    take_json(path, "run",
              [](const json& file) { require(file.at("frames").get<int>() > 0, "frames: none"); });
  };
  EXPECT_NO_THROW(take(R"({"frames": 3})"));
  const std::string begin = (dir / "result.json") + ": was not written by `placegraph run`: ";
  EXPECT_EQ(test::message_of([&] { take(R"({"frames": 0})"); }), begin + "frames: none");
  for (const char* text : {"[]", "3", "null", "{}", R"({"frames": "x"})", R"({"frames": {}})"}) {
    const std::string message = test::message_of([&] { take(text); });
    EXPECT_EQ(message.substr(0, begin.size()), begin) << text;
    EXPECT_GT(message.size(), begin.size()) << text;
  }
}

// Text has all digits of a double; a quaternion is divided by its length when it is read.
TEST(JsonFile, PosesComeBackFromText) {
  Random random(7);
  for (int i = 0; i < 30; ++i) {
    Vector6d xi;
    for (double& value : xi) value = random.uniform(-3, 3);
    const SE3 T = SE3::exp(xi), read = pose_of(json::parse(pose_json(T).dump()));
    EXPECT_EQ(read.translation(), T.translation());
    EXPECT_LT((read.rotation().matrix() - T.rotation().matrix()).norm(),
              8 * std::numeric_limits<double>::epsilon());
  }
}

TEST(JsonFile, APoseHasTheRealPartOfItsQuaternionLast) {
  const SE3 turned(SO3(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)), {1, 2, 3});
  EXPECT_EQ(pose_json(turned),
            (json{{"position_m", {1.0, 2.0, 3.0}}, {"quaternion_xyzw", {0.5, -0.5, 0.5, 0.5}}}));
  // A turn by 90 degrees about z takes x to y; its numbers are rounded to three digits.
  const SE3 rounded =
      pose_of({{"position_m", {0, 0, 0}}, {"quaternion_xyzw", {0, 0, 0.707, 0.707}}});
  const Eigen::Vector3d y = rounded.rotation().matrix() * Eigen::Vector3d::UnitX();
  EXPECT_LT((y - Eigen::Vector3d::UnitY()).norm(), 1e-15);
}

TEST(JsonFile, WhatIsNoPoseIsRefused) {
  const json good = pose_json(SE3());
  for (const char* key : {"position_m", "quaternion_xyzw"}) {
    json pose = good;
    pose.erase(key);
    EXPECT_THROW((void)pose_of(pose), json::exception);
    pose[key] = {0, 0};
    EXPECT_THROW((void)pose_of(pose), json::exception);
    pose[key] = "0 0 0 1";
    EXPECT_THROW((void)pose_of(pose), json::exception);
  }
  for (const double w : {0.0, 0.98, 1.02, 2.0}) {
    json pose = good;
    pose["quaternion_xyzw"][3] = w;
    EXPECT_EQ(test::message_of<ArgumentError>([&] { (void)pose_of(pose); }),
              "quaternion_xyzw is not of unit length");
  }
}

}  // namespace json_file_test
}  // namespace placegraph
