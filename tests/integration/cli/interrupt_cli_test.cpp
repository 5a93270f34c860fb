// `placegraph run` that is interrupted by a signal, and resumed.
#include <placegraph/io/trajectories/trajectory_file.h>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace interrupt_cli_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class InterruptedRun : public test::CliTest {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    const auto result = test::run_placegraph(
        "synth sequence corridor-loop --frames 240 --size 320x240 --stereo --out w", made->path());
    ASSERT_EQ(result.code, 0) << result.err;
  }
  static void TearDownTestSuite() { delete made; }
  static inline test::TemporaryFolder* made = nullptr;
  /// Starts the run, sends the signal when its first place is saved, and waits for its end.
  int run_and_send(const std::string& signal) {
    // A shell would start the run with SIGINT ignored.
    test::write_file(dir / "interrupt.py",
                     "import os, signal, subprocess, sys, time\n"
                     "run = subprocess.Popen(sys.argv[2:], stdout=open('stdout', 'w'),\n"
                     "                       stderr=open('stderr', 'w'))\n"
                     "while not os.path.exists('out/map.db') and run.poll() is None:\n"
                     "    time.sleep(0.05)\n"
                     "run.send_signal(getattr(signal, 'SIG' + sys.argv[1]))\n"
                     "sys.exit(run.wait() % 256)\n");
    const std::string command = "cd '" + dir.path() + "' && python3 interrupt.py " + signal + " '" +
                                test::program() + "' run '" + *made / "w" + "' --out out";
    return WEXITSTATUS(std::system(command.c_str()));
  }
};

TEST_F(InterruptedRun, WritesItsResultsAndSaysHowToContinue) {
  EXPECT_EQ(run_and_send("INT"), 130);
  const std::string printed = test::read_file(dir / "stderr");
  EXPECT_THAT(printed, HasSubstr("placegraph: interrupted after "));
  EXPECT_THAT(printed, HasSubstr(" of 240 frames; continue with: placegraph run --resume out\n"));
  const std::string path = dir / "out/trajectory_optimized.kitti";
  const std::size_t frames = read_trajectory(path).size();
  EXPECT_GT(frames, 0u);
  EXPECT_LT(frames, 240u);
  EXPECT_TRUE(fs::exists(dir / "out/result.json"));

  const auto resumed = run("run --resume out/map.db");
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(read_trajectory(path).size(), 240u);
}

TEST_F(InterruptedRun, SaysAgainInWhichEnvironmentsItWas) {
  const auto whole =
      run("run '" + *made / "w" + "' --set max_frames=60 --elements motion,context --out walked");
  ASSERT_EQ(whole.code, 0) << whole.err;
  const std::string environments = test::read_file(dir / "walked/environment.csv");
  EXPECT_GT(std::count(environments.begin(), environments.end(), '\n'), 2);
  fs::remove(dir / "walked/environment.csv");
  const auto again = run("run --resume walked");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(test::read_file(dir / "walked/environment.csv"), environments);
}

TEST_F(InterruptedRun, EndsByTerminationAndByHangUpToo) {
  for (const char* signal : {"TERM", "HUP"}) {
    fs::remove_all(dir / "out");
    EXPECT_EQ(run_and_send(signal), 130) << signal;
    EXPECT_TRUE(fs::exists(dir / "out/result.json")) << signal;
  }
}

}  // namespace interrupt_cli_test
}  // namespace placegraph
