#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "apps/server/event_log.h"

namespace placegraph::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(EventLog, ReadersGetTheEventsFromTheirBeginOn) {
  const auto log = std::make_shared<EventLog>();
  log->add("frame", "1");
  const auto reader = log->reader();
  EXPECT_THAT(*reader->next(), StartsWith(":"));
  log->add("frame", "2");
  log->add("loop", "{}");
  EXPECT_EQ(*reader->next(), "id: 1\nevent: frame\ndata: 2\n\nid: 2\nevent: loop\ndata: {}\n\n");
}

TEST(EventLog, AnEventWakesAWaitingReader) {
  const auto log = std::make_shared<EventLog>();
  const auto reader = log->reader();
  (void)reader->next();
  std::thread writer([&] { log->add("frame", "7"); });
  std::string text;
  while (text.find("data: 7") == std::string::npos) text += *reader->next();
  writer.join();
}

TEST(EventLog, AReaderThatFallsBehindGetsAReset) {
  const auto log = std::make_shared<EventLog>();
  const auto reader = log->reader();
  (void)reader->next();
  for (int i = 0; i < 5000; ++i) log->add("frame", std::to_string(i));
  std::string text = *reader->next();
  EXPECT_THAT(text, StartsWith("event: reset\ndata: {\"version\":0}\n"));
  while (text.find("data: 4999\n") == std::string::npos) text += *reader->next();
  EXPECT_THAT(text, Not(HasSubstr("data: 3\n")));
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

}  // namespace
}  // namespace placegraph::apps
