// Recognizers that are not the library's: `--recognizer` of `places match` and `run`.
#include <fmt/format.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/files/npy_array.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/unit/apps/places/twelve_views.h"

namespace placegraph {
namespace recognizer_cli_test {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The program that docs/recognizers.md shows.
std::string documented_program() {
  const std::string page = test::read_file(test::source_dir() + "/docs/recognizers.md");
  const std::size_t begin = page.find("# describe.py\n"), end = page.find("```", begin);
  return begin == page.npos ? "" : page.substr(begin, end - begin);
}

class Recognizer : public test::CliTest {
 protected:
  void SetUp() override {
    test::write_twelve_views(dir);
    test::write_file(dir / "describe.py", documented_program());
  }
  /// Share of queries whose first candidate is right.
  double share_right(const std::string& arguments) {
    const auto matched = run("places match . --out found.txt --force " + arguments);
    EXPECT_EQ(matched.code, 0) << matched.err;
    const auto judged = run("eval loops --predictions found.txt --truth gt.txt --json");
    EXPECT_EQ(judged.code, 0) << judged.err;
    return nlohmann::json::parse(judged.out).at("r_at_1");
  }
};

TEST_F(Recognizer, TheProgramOfTheDocumentationFindsThePlaces) {
  EXPECT_EQ(share_right("--recognizer 'exec:python3 describe.py'"), 1);
  EXPECT_EQ(share_right("--recognizer 'exec:python3 describe.py' --sequence"), 1);
}

TEST_F(Recognizer, CuesStandBesideARecognizerThatKnowsNothing) {
  Random random(3);
  NpyArray rows{{12, 16}, {}};
  for (int i = 0; i < 12 * 16; ++i) rows.values.push_back(random.normal());
  test::write_file(dir / "rows.npy", to_npy(rows));
  EXPECT_LE(share_right("--recognizer descriptors:rows.npy"), 0.7);
  EXPECT_EQ(share_right("--recognizer descriptors:rows.npy --appearance tiny,colour"), 1);
}

TEST_F(Recognizer, WhatGoesWrongEndsTheCommandInOneLineAndWritesNothing) {
  test::write_file(dir / "talks.py", "print('Loading', flush=True)\nimport time; time.sleep(9)\n");
  test::write_file(dir / "fails.py", "raise SystemExit('no weights')\n");
  test::write_file(dir / "short.npy", to_npy({{2, 1}, {1, 2}}));
  for (const auto& [recognizer, message] : std::vector<std::pair<std::string, std::string>>{
           {"exec:no-such-program", "no-such-program cannot be started: No such file"},
           {"exec:python3 fails.py", "ended with exit code 1; its last line: no weights"},
           {"exec:python3 talks.py", "the program wrote 'Loading' to its standard output"},
           {"exec:sh -c \"kill -9 $$\"", "was ended by signal 9"},
           {"exec:python3 'a", "a quote is not closed"},
           {"onnx:none.onnx", "none.onnx: cannot be read"},
           {"descriptors:short.npy", "short.npy: has 2 rows, and none for image 2"},
           {"netvlad", "'netvlad' is none of exec:COMMAND, onnx:FILE, descriptors:FILE.npy"}}) {
    std::string quoted = recognizer;
    for (std::size_t at = 0; (at = quoted.find('\'', at)) != quoted.npos; at += 4)
      quoted.replace(at, 1, "'\\''");
    expect_usage_error("places match . --out found.txt --recognizer '" + quoted + "'", message);
    EXPECT_FALSE(fs::exists(dir / "found.txt"));
  }
  expect_usage_error(
      "places match . --out found.txt --set describer.timeout_s=0.5 --recognizer 'exec:sleep 99'",
      "no answer within 0.5 s (describer.timeout_s)");
  expect_usage_error("places match . --out f.txt --codes bow --recognizer 'exec:true'", "--codes");
  expect_usage_error("run . --out out --appearance tiny", "--appearance");
}

TEST_F(Recognizer, NoSettingAndNoFileNamesOne) {
  const std::string command = "exec:touch " + dir / "marker";
  expect_usage_error("places match . --out f.txt --set 'describer.recognizer=" + command + "'",
                     "--set: describer.recognizer 'exec:touch ");
  test::write_file(dir / "shared.yaml", "describer:\n  recognizer: " + command + "\n");
  expect_usage_error("run images --out out --config shared.yaml",
                     "--config shared.yaml: describer.recognizer 'exec:touch ");
  expect_usage_error("run images --out out --set 'describer.recognizer=" + command + "'",
                     "--set: describer.recognizer 'exec:touch ");
  test::write_file(dir / "short.yaml", "recognizer: " + command + "\n");
  expect_usage_error("run images --out out --config short.yaml", "recognizer");
  EXPECT_FALSE(fs::exists(dir / "marker"));
}

/// Once around corridors, ends at an image that cannot be read.
class RunWithRecognizer : public Recognizer {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    const auto result = test::run_placegraph(
        "synth sequence corridor-loop --frames 60 --size 320x240 --out w", made->path());
    ASSERT_EQ(result.code, 0) << result.err;
  }
  static void TearDownTestSuite() { delete made; }
  static inline test::TemporaryFolder* made = nullptr;
};

TEST_F(RunWithRecognizer, ASavedMapNamesItAndStartsNothing) {
  fs::copy(*made / "w", dir / "w", fs::copy_options::recursive);
  fs::path broken;
  for (const auto& file : fs::recursive_directory_iterator(dir / "w"))
    if (file.path().string().find("image_0/") != std::string::npos && file.path() > broken)
      broken = file.path();
  const std::string image = test::read_file(broken);
  test::write_file(broken, "no image");
  // It leaves a marker wherever it is started.
  test::write_file(dir / "marks.py", "open('marker', 'a').write('x')\n" + documented_program());
  const std::string recognizer = " --recognizer 'exec:python3 marks.py'";
  EXPECT_EQ(run("run w --out out --set loops.min_frame_gap=10" + recognizer).code, 2);
  ASSERT_TRUE(fs::exists(dir / "out/map.db"));
  EXPECT_TRUE(fs::remove(dir / "marker"));
  test::write_file(broken, image);
  expect_usage_error("run --resume out",
                     "out/map.db: its loops were found by the recognizer 'exec:python3 marks.py', "
                     "which must be given again (--recognizer)");
  expect_usage_error("run --resume out --recognizer descriptors:other.npy",
                     "describer.recognizer: ");
  for (const std::string command : {"map info out", "map explain out 3", "map validate out"})
    EXPECT_NE(run(command).code, 3) << command;
  EXPECT_FALSE(fs::exists(dir / "marker"));
  const auto resumed = run("run --resume out" + recognizer);
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_TRUE(fs::exists(dir / "marker"));
}

TEST_F(Recognizer, ASignalEndsTheCommandAndItsProgram) {
  // It writes its number, and hangs.
  test::write_file(dir / "hangs.sh", "echo $$ > pid.new\nmv pid.new pid\nsleep 1000\n");
  test::write_file(dir / "interrupt.py",
                   "import os, signal, subprocess, sys, time\n"
                   "run = subprocess.Popen(sys.argv[1:], stderr=open('stderr', 'w'))\n"
                   "while not os.path.exists('pid') and run.poll() is None:\n"
                   "    time.sleep(0.05)\n"
                   "run.send_signal(signal.SIGINT)\n"
                   "code = run.wait()\n"
                   "sys.exit(99 if os.path.exists('/proc/' + open('pid').read().strip()) else "
                   "code % 256)\n");
  const std::string command = "cd '" + dir.path() + "' && python3 interrupt.py '" +
                              test::program() +
                              "' places match . --out found.txt --recognizer 'exec:sh hangs.sh'";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 130);
  EXPECT_EQ(test::read_file(dir / "stderr"), "placegraph: interrupted; nothing was written\n");
  EXPECT_FALSE(fs::exists(dir / "found.txt"));
}

}  // namespace recognizer_cli_test
}  // namespace placegraph
