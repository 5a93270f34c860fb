#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <thread>
#include <vector>

#include "apps/server/event_log.h"
#include "tests/support/sleeping_thread.h"

namespace placegraph::apps {
namespace event_log_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(EventLog, ReadersGetTheEventsFromTheirBeginOn) {
  const auto log = std::make_shared<EventLog>();
  EXPECT_EQ(log->last(), 0);
  EXPECT_EQ(log->add("frame", "1"), 1);
  const auto reader = log->reader();
  EXPECT_EQ(log->add("frame", "2"), 2);
  EXPECT_EQ(*reader->next(), "id: 1\nevent: joined\ndata: {}\n\n");
  log->add("loop", "{}");
  EXPECT_EQ(*reader->next(), "id: 2\nevent: frame\ndata: 2\n\nid: 3\nevent: loop\ndata: {}\n\n");
  EXPECT_EQ(log->last(), 3);
}

// A reader that nothing wakes finds its event when its keep-alive is due. The keep-alives of a log
// without events, which are as far apart, count such waits.
TEST(EventLog, AnEventWakesAWaitingReader) {
  constexpr int kEvents = 6;
  const auto log = std::make_shared<EventLog>(), quiet = std::make_shared<EventLog>();
  const auto reader = log->reader(), other = quiet->reader();
  (void)reader->next();
  (void)other->next();
  int keep_alives = 0;
  std::thread counting([&] {
    while (other->next()) ++keep_alives;
  });
  for (int i = 1; i <= kEvents; ++i) {
    std::string text;
    test::ObservedThread waiting([&] { text = *reader->next(); });
    waiting.await_sleep();
    EXPECT_FALSE(waiting.ended());
    log->add("frame", "7");
    waiting.join();
    EXPECT_EQ(text, "id: " + std::to_string(i) + "\nevent: frame\ndata: 7\n\n");
  }
  quiet->close();
  counting.join();
  EXPECT_LT(keep_alives, kEvents / 2);
}

TEST(EventLog, ItsEndWakesAWaitingReader) {
  const auto log = std::make_shared<EventLog>();
  const auto reader = log->reader();
  (void)reader->next();
  std::optional<std::string> text;
  test::ObservedThread waiting([&] { text = reader->next(); });
  waiting.await_sleep();
  log->close();
  waiting.join();
  EXPECT_FALSE(text);
}

TEST(EventLog, AReaderThatFallsBehindGetsTheNewestEventsWithTheirNumbers) {
  const auto log = std::make_shared<EventLog>();
  const auto reader = log->reader();
  (void)reader->next();
  constexpr int kEvents = 5000;
  for (int i = 1; i <= kEvents; ++i) log->add("frame", std::to_string(i));
  log->close();
  std::string text;
  while (const auto more = reader->next()) text += *more;
  ASSERT_THAT(text, StartsWith("id: "));
  const int oldest = std::stoi(text.substr(4));
  EXPECT_GT(oldest, 1);
  std::string expected;
  for (int i = oldest; i <= kEvents; ++i)
    expected +=
        "id: " + std::to_string(i) + "\nevent: frame\ndata: " + std::to_string(i) + "\n\n";
  EXPECT_TRUE(text == expected) << "from " << oldest;
}

TEST(EventLog, EndsAfterTheLastEvent) {
  const auto log = std::make_shared<EventLog>();
  const auto reader = log->reader();
  (void)reader->next();
  log->add("done", "{}");
  log->close();
  EXPECT_THAT(*reader->next(), HasSubstr("event: done"));
  EXPECT_FALSE(reader->next());
}

TEST(EventLog, CountsItsReaders) {
  const auto log = std::make_shared<EventLog>();
  {
    const auto one = log->reader(), other = log->reader();
    EXPECT_EQ(log->readers(), 2);
  }
  EXPECT_EQ(log->readers(), 0);
  EXPECT_TRUE(log->visited());
}

TEST(EventLog, HasNoMoreReadersThanThreads) {
  const auto log = std::make_shared<EventLog>();
  EXPECT_FALSE(log->visited());
  std::vector<std::shared_ptr<HttpStream>> readers;
  for (int i = 0; i < EventLog::kMostReaders; ++i) readers.push_back(log->reader());
  EXPECT_NE(readers.back(), nullptr);
  EXPECT_EQ(log->reader(), nullptr);
  readers.pop_back();
  EXPECT_NE(log->reader(), nullptr);
}

}  // namespace event_log_test
}  // namespace placegraph::apps
