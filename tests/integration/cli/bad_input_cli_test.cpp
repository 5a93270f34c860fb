// What is no file, too large, not UTF-8 or full of control characters, and an output that is full.
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace bad_input_cli_test {

namespace fs = std::filesystem;
using test::CommandResult;
using test::write_file;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kPose = "1 0 0 0 0 1 0 0 0 0 1 ";
const std::string kPair =
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n";

class BadInput : public test::CliTest {
 protected:
  void SetUp() override {
    write_file(dir / "t.kitti", kPose + "0\n" + kPose + "1\n" + kPose + "2\n");
    write_file(dir / "pair.g2o", kPair);
  }
};

TEST_F(BadInput, AFullDiskBehindStdoutIsAnError) {
  for (const std::string command :
       {"config", "version", "--help", "map info --help", "completion bash", "help run",
        "eval t.kitti t.kitti", "eval t.kitti t.kitti --json",
        "graph optimize pair.g2o -o out.g2o --force --quiet"}) {
    SCOPED_TRACE(command);
    EXPECT_EQ(run(command + " >/dev/full 2>said; exit $?; true").code, 2);
    EXPECT_THAT(
        test::read_file(dir / "said"),
        EndsWith("placegraph: standard output cannot be written: No space left on device\n"));
  }
}

TEST_F(BadInput, APipeOrADeviceIsNoFile) {
  ASSERT_EQ(mkfifo((dir / "pipe").c_str(), 0600), 0);
  expect_usage_error("eval t.kitti pipe", "pipe: is a named pipe, not a file");
  expect_usage_error("graph optimize pipe -o out.g2o", "pipe: is a named pipe, not a file");
  expect_usage_error("config --config ./pipe", "pipe: is a named pipe, not a file");
  expect_usage_error("eval t.kitti /dev/zero", "/dev/zero: is a device, not a file");
}

TEST_F(BadInput, ANameThatIsNotUtf8IsWrittenWithReplacementCharacters) {
  const CommandResult result = run("graph optimize pair.g2o -o \"$(printf 'o\\377.g2o')\" --json");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["out"], "o\xef\xbf\xbd.g2o");
  EXPECT_TRUE(fs::exists(dir / "o\xff.g2o"));
  write_file(dir / "e\xff.kitti", kPose + "0\n" + kPose + "1\n" + kPose + "2\n");
  EXPECT_EQ(run("eval t.kitti e*.kitti --json").code, 0);
}

TEST_F(BadInput, MessagesAreShortAndPrintable) {
  write_file(dir / "c.yaml", "\"\\e[31m" + std::string(1000, 'k') + "\": 1\n");
  const CommandResult result = run("config --config c.yaml");
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("c.yaml:1: "));
  EXPECT_THAT(result.err, HasSubstr("unknown key"));
  EXPECT_THAT(result.err, Not(HasSubstr("\x1b")));
  EXPECT_LT(result.err.size(), 1000u);
}

}  // namespace bad_input_cli_test
}  // namespace placegraph
