// Runs that are killed at random moments.
#include <filesystem>
#include <sstream>
#include <vector>

#include "tests/support/cli_test.h"
#include "tests/support/paths.h"

namespace placegraph {
namespace kill_test {

TEST(KilledRun, GoesOnFromWhatItHadSaved) {
  const test::TemporaryFolder dir;
  const test::CommandResult rendered = test::run_placegraph(
      "synth sequence town-loop --frames 60 --stereo --size 448x280 --difficulty clean --out drive",
      dir.path());
  ASSERT_EQ(rendered.code, 0) << rendered.err;
  constexpr int kRounds = 4;
  const std::string command = "'" + test::source_dir() + "/scripts/kill_study' '" +
                              test::program() + "' '" + (dir / "drive") + "' '" + (dir / "out") +
                              "' " + std::to_string(kRounds) + " 3 >'" + (dir / "lines") + "' 2>'" +
                              (dir / "err") + "' </dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0) << test::read_file(dir / "err");
  std::istringstream lines(test::read_file(dir / "lines"));
  std::string line;
  std::vector<double> ate;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string round, killed, frames_saved, places_saved;
    int posed = 0, frames = 0, places = 0, loops = 0;
    double ate_m = 0;
    ASSERT_TRUE(fields >> round >> killed >> frames_saved >> places_saved >> posed >> frames >>
                places >> loops >> ate_m)
        << line;
    EXPECT_EQ(posed, frames) << line;
    ate.push_back(ate_m);
  }
  ASSERT_EQ(ate.size(), kRounds + 1u);
  // Centimetres over these sixty metres; tracking that begins anew may double them.
  for (const double each : ate) EXPECT_LT(each, 2 * ate.front() + 0.01);
}

// With a static overlay, a distorted lens and a mask, too: what a first pass learns is kept.
TEST(KilledRun, IsJudgedAsTheWholeRun) {
  const test::TemporaryFolder dir;
  const std::string build = std::filesystem::path(test::program()).parent_path().string();
  if (!std::filesystem::exists(build + "/tests/faults/make_fault"))
    GTEST_SKIP() << "the program that makes the sequences is not built";
  const std::string command = "cd '" + test::source_dir() + "' && scripts/kill_variants '" + build +
                              "' '" + (dir / "out") + "' 3 >'" + (dir / "lines") + "' 2>'" +
                              (dir / "err") + "' </dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0) << test::read_file(dir / "err");
}

}  // namespace kill_test
}  // namespace placegraph
