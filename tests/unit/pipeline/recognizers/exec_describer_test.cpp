#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/recognizers/exec_describer.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "tests/support/message_of.h"
#include "tests/support/seed.h"
#include "tests/unit/pipeline/recognizers/scripted_program.h"

namespace placegraph {
namespace exec_describer_test {

using test::message_of;
using test::noise;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

// Longer than any answer of these tests takes on a busy machine.
constexpr double kPatient_s = 300;

/// What kSums answers.
std::vector<double> sums_of(const Image& image) {
  const int channels = image.channels();
  std::vector<double> values = {static_cast<double>(image.cols), static_cast<double>(image.rows),
                                static_cast<double>(channels)};
  values.resize(static_cast<std::size_t>(3 + channels + 2));
  std::size_t i = 0;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      for (int c = 0; c < channels; ++c, ++i) {
        // Red first.
        const double value = image.ptr(y)[x * channels + (channels - 1 - c)] / 1e3;
        values[static_cast<std::size_t>(3 + c)] += value;
        if (i % 7 == 0) values[static_cast<std::size_t>(3 + channels)] += value;
        if (y == 0) values[static_cast<std::size_t>(4 + channels)] += value;
      }
  return values;
}

/// No process that this one has started is left, running or as a zombie.
void expect_no_child() {
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

class Exec : public testing::Test {
 protected:
  /// The message of a failure, in one line; the program has ended then.
  std::string failure(const std::string& command, int images = 3, double timeout_s = kPatient_s) {
    ExecDescriber describer(command, timeout_s);
    const std::string message = message_of<ArgumentError>([&] {
      for (int i = 0; i < images; ++i) describer.describe(noise(1200, 900, CV_8UC3, 1), FrameId(i));
    });
    EXPECT_THAT(message, AllOf(StartsWith("recognizer exec:" + command), Not(HasSubstr("\n"))));
    expect_no_child();
    EXPECT_THROW(describer.describe(noise(8, 8, CV_8UC1, 1), FrameId(9)), ArgumentError);
    expect_no_child();
    return message;
  }
  std::string failure_of(const std::string& rest) { return failure(program.command(rest)); }
  test::ScriptedProgram program;
};

TEST_F(Exec, GetsEveryImageOfAnySizeAndAnswersIt) {
  Random random = test::seeded_random(5);
  const std::string command = program.command(test::kSums);
  for (const int type : {CV_8UC1, CV_8UC3}) {
    ExecDescriber describer(command, kPatient_s);
    for (int i = 0; i < 12; ++i) {
      SCOPED_TRACE(fmt::format("type {}, image {}", type, i));
      // Some are larger than what a pipe holds; all are parts of an image with longer rows.
      const Image whole = noise(1 + random.index(i % 3 == 0 ? 900 : 40) + 5,
                                1 + random.index(i % 3 == 0 ? 700 : 40) + 2, type, random.next());
      const Image image = whole(cv::Rect(2, 1, whole.cols - 5, whole.rows - 2));
      const std::vector<double> expected = sums_of(image);
      const std::vector<float> values = describer.describe(image, FrameId(i));
      EXPECT_EQ(sums_of(image), expected) << "the image has changed";
      ASSERT_EQ(values.size(), expected.size());
      for (std::size_t k = 0; k < values.size(); ++k)
        EXPECT_NEAR(values[k], expected[k], 1e-6 * (1 + expected[k])) << k;  // single precision
    }
  }
  expect_no_child();
}

TEST_F(Exec, OneProcessServesAllImagesAndEndsWithTheObject) {
  const std::string pids = program.path("pids");
  const std::string command = program.command(fmt::format(
      "open('{0}', 'a').write(f'{{os.getpid()}}\\n')\nwhile True:\n    image()\n    answer([1])\n",
      pids));
  {
    ExecDescriber describer(command, kPatient_s);
    EXPECT_EQ(test::read_file(pids), "");  // it starts with the first image
    for (int i = 0; i < 5; ++i)
      EXPECT_THAT(describer.describe(noise(9, 7, CV_8UC1, 1), FrameId(i)), ElementsAre(1));
    const std::string started = test::read_file(pids);
    EXPECT_EQ(std::count(started.begin(), started.end(), '\n'), 1);
    EXPECT_EQ(kill(std::stoi(started), 0), 0);
  }
  EXPECT_EQ(kill(std::stoi(test::read_file(pids)), 0), -1);
  expect_no_child();
}

TEST_F(Exec, NeitherSideWaitsForTheOther) {
  // It writes messages and a long answer, each more than a pipe holds, before it reads the image.
  const std::string command = program.command(
      "for i in range(3):\n    sys.stderr.write('message\\n' * 40000)\n    sys.stderr.flush()\n"
      "    answer([1.5] * 200000)\n    image()\n");
  ExecDescriber describer(command, kPatient_s);
  for (int i = 0; i < 3; ++i) {
    const auto values = describer.describe(noise(1000, 800, CV_8UC3, 2), FrameId(i));
    EXPECT_EQ(values, std::vector<float>(200000, 1.5f));
  }
}

TEST_F(Exec, AProgramThatIsNotThereIsNamed) {
  ExecDescriber describer("no-such-program-here --fast", kPatient_s);
  EXPECT_EQ(
      message_of<ArgumentError>([&] { describer.describe(noise(8, 8, CV_8UC1, 1), FrameId(0)); }),
      "recognizer exec:no-such-program-here --fast: no-such-program-here cannot be started: "
      "No such file or directory");
  expect_no_child();
  EXPECT_THROW(ExecDescriber(" ", 1), ArgumentError);
}

TEST_F(Exec, AProgramThatEndsIsReportedWithItsCodeAndItsLastLine) {
  EXPECT_THAT(failure_of("image(); answer([1, 2])\nraise RuntimeError('no memory')\n"),
              EndsWith("image 1: the program ended with exit code 1; its last line: RuntimeError: "
                       "no memory"));
  EXPECT_THAT(failure_of("sys.exit(7)\n"),
              EndsWith("image 0: the program ended with exit code 7 without a message"));
  EXPECT_THAT(failure_of("image()\nos.kill(os.getpid(), 11)\n"),
              EndsWith("image 0: the program was ended by signal 11 (Segmentation fault) without a "
                       "message"));
  // In the middle of an answer.
  EXPECT_THAT(failure_of("image(); out.write(b'PGD1' + struct.pack('<I', 10) + b'123')\n"),
              EndsWith("image 0: the program ended with exit code 0 without a message"));
  // What a terminal would obey is not shown.
  EXPECT_THAT(failure_of("sys.exit('\\x1b[2Jred')\n"), EndsWith("its last line: ?[2Jred"));
}

TEST_F(Exec, AProgramThatClosesAStreamIsReportedAndEnded) {
  EXPECT_THAT(failure_of("image()\nos.close(1)\ntime.sleep(1000)\n"),
              HasSubstr("image 0: the program closed its input or output"));
  EXPECT_THAT(failure_of("os.close(0)\ntime.sleep(1000)\n"),
              HasSubstr("image 0: the program closed its input or output"));
}

TEST_F(Exec, AProgramThatHangsIsEndedWithWhatItHasStarted) {
  const std::string pids = program.path("pids");
  const std::string command = fmt::format(
      "sh -c 'trap \"\" TERM; sleep 1000 & echo $$ $! > {0}.new; mv {0}.new {0}; wait'", pids);
  // On a busy machine the program may not have begun within the first of these times.
  for (double timeout_s = 1; !std::filesystem::exists(pids) && timeout_s < 100; timeout_s *= 2)
    EXPECT_THAT(
        failure(command, 1, timeout_s),
        EndsWith(fmt::format("image 0: no answer within {} s (describer.timeout_s)", timeout_s)));
  int own = 0, child = 0;
  ASSERT_EQ(std::sscanf(test::read_file(pids).c_str(), "%d %d", &own, &child), 2);
  EXPECT_EQ(kill(own, 0), -1);
  // Its child is a zombie at most, of the process that adopts it.
  const std::string state = test::read_file(fmt::format("/proc/{}/stat", child));
  EXPECT_TRUE(state.empty() || state.find(") Z ") != std::string::npos ||
              state.find(") X ") != std::string::npos)
      << state;
}

TEST_F(Exec, TextAmongTheAnswersIsShown) {
  EXPECT_THAT(failure_of("print('Loading the model ...'); sys.stdout.flush()\nimage()\n"),
              EndsWith("image 0: the program wrote 'Loading the model ...' to its standard output, "
                       "which is for descriptors; messages belong to its standard error"));
  EXPECT_THAT(failure_of("image(); answer([1]); print('done\\x07'); sys.stdout.flush(); image()\n"),
              HasSubstr("image 1: the program wrote 'done?'"));
}

TEST_F(Exec, AnAnswerOfAnotherLengthIsRefused) {
  EXPECT_THAT(failure_of("image(); answer([1, 2]); image(); answer([1, 2, 3]); time.sleep(1000)\n"),
              EndsWith("image 1: a descriptor of 3 values, those before have 2"));
  for (const char* length : {"0", "1 << 21", "0xffffffff"})
    EXPECT_THAT(
        failure_of(fmt::format(
            "image(); out.write(b'PGD1' + struct.pack('<I', {})); out.flush(); image()\n", length)),
        HasSubstr("values; 1 to 1048576 are allowed"));
}

TEST_F(Exec, GetsNoOtherFileOfThisProcess) {
  const int open_file = open("/dev/null", O_RDONLY);  // without O_CLOEXEC
  ASSERT_GE(open_file, 0);
  ChildProcess child({"sh", "-c", "ls /proc/$$/fd"});
  EXPECT_EQ(child.transfer({}, 6, ChildProcess::Clock::now() + std::chrono::minutes(5)),
            ChildProcess::State::kDone);
  EXPECT_EQ(child.transfer({}, 7, ChildProcess::Clock::now() + std::chrono::minutes(5)),
            ChildProcess::State::kEnded);
  EXPECT_EQ(child.received(), "0\n1\n2\n");
  close(open_file);
}

TEST_F(Exec, AnInterruptionEndsTheProgram) {
  struct Stop {};
  ExecDescriber describer(program.command("image(); time.sleep(1000)\n"), kPatient_s);
  int checks = 0;
  const InterruptionScope scope([&] {
    if (++checks == 3) throw Stop();
  });
  EXPECT_THROW(describer.describe(noise(30, 20, CV_8UC1, 1), FrameId(0)), Stop);
  expect_no_child();
}

TEST_F(Exec, ASignalOfABrokenPipeReachesNobody) {
  // This process has the default action for SIGPIPE, by which it would end.
  ASSERT_NE(std::signal(SIGPIPE, SIG_DFL), SIG_ERR);
  for (int i = 0; i < 5; ++i)
    EXPECT_THAT(failure("sh -c 'exit 3'"), HasSubstr("ended with exit code 3"));
  sigset_t pending;
  sigpending(&pending);
  EXPECT_EQ(sigismember(&pending, SIGPIPE), 0);
}

TEST(WordsOfCommand, AreDividedByBlanksAndKeptByQuotes) {
  EXPECT_THAT(words_of_command("a  b\tc "), ElementsAre("a", "b", "c"));
  EXPECT_THAT(words_of_command("run 'my file' \"a \\\"b\\\"\" c\\ d ''"),
              ElementsAre("run", "my file", "a \"b\"", "c d", ""));
  EXPECT_THAT(words_of_command("'a\\b'c $HOME *;|"), ElementsAre("a\\bc", "$HOME", "*;|"));
  EXPECT_THAT(words_of_command("  "), IsEmpty());
  EXPECT_THAT(message_of<ArgumentError>([] { words_of_command("a 'b"); }),
              HasSubstr("a quote is not closed"));
}

}  // namespace exec_describer_test
}  // namespace placegraph
