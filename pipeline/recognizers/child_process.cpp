#include <fcntl.h>
#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/pipeline/recognizers/child_process.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

extern char** environ;

namespace placegraph {
namespace {

using namespace std::chrono_literals;

/// Blocks SIGPIPE in this thread, as long as it exists: a write to a program that has ended fails
/// instead.
class WithoutSigpipe {
 public:
  WithoutSigpipe() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutSigpipe() {
    constexpr timespec kNow{};
    if (!was_pending_)
      while (sigtimedwait(&pipe_, nullptr, &kNow) == -1 && errno == EINTR) continue;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutSigpipe(const WithoutSigpipe&) = delete;
  WithoutSigpipe& operator=(const WithoutSigpipe&) = delete;

 private:
  sigset_t pipe_, before_;
  bool was_pending_ = false;
};

void make_pipe(int& read_end, int& write_end) {
  int ends[2];
  require(pipe2(ends, O_CLOEXEC) == 0, fmt::format("no pipe: {}", std::strerror(errno)));
  read_end = ends[0];
  write_end = ends[1];
}

void never_wait(int fd) { fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) | O_NONBLOCK); }

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status))
    return fmt::format("was ended by signal {} ({})", WTERMSIG(status),
                       strsignal(WTERMSIG(status)));
  return fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

}  // namespace

void ChildProcess::End::close() {
  if (fd >= 0) ::close(fd);
  fd = -1;
}

ChildProcess::ChildProcess(const std::vector<std::string>& words) {
  require(!words.empty(), "no program is named");
  End in, out, error;
  make_pipe(in.fd, in_.fd);
  make_pipe(out_.fd, out.fd);
  make_pipe(error_.fd, error.fd);
  for (const End* end : {&in_, &out_, &error_}) never_wait(end->fd);
  start(words, in.fd, out.fd, error.fd);
}

void ChildProcess::start(const std::vector<std::string>& words, int in, int out, int error) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  // First to numbers that no standard stream has, should this process lack one.
  constexpr int kApart = 10;
  const int given[3] = {fcntl(in, F_DUPFD_CLOEXEC, kApart), fcntl(out, F_DUPFD_CLOEXEC, kApart),
                        fcntl(error, F_DUPFD_CLOEXEC, kApart)};
  for (int stream = 0; stream < 3; ++stream)
    posix_spawn_file_actions_adddup2(&files, given[stream], stream);
  posix_spawn_file_actions_addclosefrom_np(&files, 3);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, pipe;
  sigemptyset(&none);
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);  // a host may ignore it
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &pipe);
  posix_spawnattr_setflags(
      &attributes,
      static_cast<short>(POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int problem =
      posix_spawnp(&process_, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  for (const int fd : given) ::close(fd);
  if (problem == 0) return;
  process_ = -1;
  throw ArgumentError(fmt::format("{} cannot be started: {}", words[0], std::strerror(problem)));
}

ChildProcess::~ChildProcess() { end(); }

ChildProcess::State ChildProcess::transfer(std::string_view sent, std::size_t wanted,
                                           Clock::time_point deadline) {
  const WithoutSigpipe quiet;
  while (!sent.empty() || received_.size() < wanted) {
    check_interruption();
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    if (left <= 0ms) return State::kTimedOut;
    // So often is looked for an interruption.
    if (!serve(sent, static_cast<int>(std::min(left, 100ms).count()) + 1)) return State::kEnded;
  }
  return State::kDone;
}

/// Waits for the streams and moves what can be moved; false if the program takes or gives no more.
bool ChildProcess::serve(std::string_view& sent, int wait_ms) {
  pollfd streams[] = {
      {out_.fd, POLLIN, 0}, {error_.fd, POLLIN, 0}, {sent.empty() ? -1 : in_.fd, POLLOUT, 0}};
  if (poll(streams, 3, wait_ms) <= 0) return true;
  if (streams[1].revents != 0) receive(error_, errors_);
  if (streams[0].revents != 0 && !receive(out_, received_)) return false;
  return streams[2].revents == 0 || send(sent);
}

bool ChildProcess::send(std::string_view& sent) {
  const ssize_t count = write(in_.fd, sent.data(), sent.size());
  if (count > 0) sent.remove_prefix(static_cast<std::size_t>(count));
  return count >= 0 || errno == EAGAIN || errno == EINTR;
}

bool ChildProcess::receive(End& end, std::string& text) {
  char buffer[1 << 16];
  const ssize_t count = read(end.fd, buffer, sizeof buffer);
  if (count < 0) return errno == EAGAIN || errno == EINTR;
  if (count == 0) {
    end.close();
    return false;
  }
  text.append(buffer, static_cast<std::size_t>(count));
  // Of the messages only the last line is reported.
  constexpr std::size_t kKept = 1 << 16;
  if (&end == &error_ && text.size() > kKept) text.erase(0, text.size() - kKept);
  return true;
}

/// Whether the program ends within a time; what it writes meanwhile is received. It stays a zombie,
/// so that its number is that of no other process yet.
bool ChildProcess::ends_within(Clock::duration time) {
  const Clock::time_point deadline = Clock::now() + time;
  std::string_view nothing;
  for (;;) {
    siginfo_t info{};
    const int found =
        waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT);
    if (info.si_pid == process_ || (found < 0 && errno != EINTR)) return true;
    if (Clock::now() >= deadline) return false;
    serve(nothing, 5);
    if (out_.fd < 0 && error_.fd < 0) std::this_thread::sleep_for(5ms);
  }
}

std::string ChildProcess::end() {
  in_.close();
  if (process_ < 0) return "had ended";
  // What it may take to end after the end of its input, and after SIGTERM. Chosen.
  constexpr Clock::duration kByItself = 1s, kAsked = 500ms;
  const bool by_itself = ends_within(kByItself);
  if (!by_itself) {
    kill(-process_, SIGTERM);
    ends_within(kAsked);
  }
  kill(-process_, SIGKILL);  // with what it has started itself
  int status = 0;
  pid_t reaped = -1;
  do reaped = waitpid(process_, &status, 0);
  while (reaped < 0 && errno == EINTR);
  for (std::size_t before = errors_.size() + 1; error_.fd >= 0 && errors_.size() != before;) {
    before = errors_.size();
    receive(error_, errors_);
  }
  process_ = -1;
  if (!by_itself) return "closed its input or output";
  return reaped < 0 ? "ended" : how_it_ended(status);
}

std::string ChildProcess::last_error_line() const {
  std::size_t end = errors_.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return "";
  const std::size_t before = errors_.find_last_of("\r\n", end);
  return errors_.substr(before + 1, end - before);
}

}  // namespace placegraph
