#include "apps/server/plugin/connections.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "tests/support/local_socket.h"

namespace placegraph::apps {
namespace connections_test {

using test::LocalSocket;

/// Both ends of a connection.
struct Connection {
  explicit Connection(const LocalSocket& listener)
      : client(LocalSocket::connected(listener.port())), server(listener.accept()) {}
  LocalSocket client, server;
};

TEST(Connections, AllOfThePortAreShutDownAtTheEnd) {
  const LocalSocket listener = LocalSocket::listener();
  std::vector<Connection> connections;
  for (int i = 0; i < 3; ++i) connections.emplace_back(listener);
  EXPECT_TRUE(connections[1].server.send("response"));
  Connections guard;
  guard.begin_response(connections[1].client.port());
  guard.close();
  guard.guard(listener.port());
  EXPECT_EQ(connections[0].client.receive_all(), "");
  EXPECT_EQ(connections[1].client.receive_all(), "response");  // what was sent still arrives
  EXPECT_EQ(connections[2].client.receive_all(), "");
  EXPECT_FALSE(connections[2].server.send("late"));
}

TEST(Connections, ThoseThatComeAfterTheEndAreShutDownToo) {
  const LocalSocket listener = LocalSocket::listener();
  Connections guard;
  guard.close();
  guard.guard(listener.port());
  for (int i = 0; i < 3; ++i) {
    const Connection late(listener);  // the port itself stays open
    guard.begin_response(late.client.port());
    guard.end_response(late.client.port());
    EXPECT_EQ(late.client.receive_all(), "") << i;
  }
}

// The end comes at different moments: before the first check, while it is made, and after it. A
// guard that slept until its next check would let this test wait for an hour.
TEST(Connections, TheirEndDoesNotWaitForTheNextCheck) {
  const LocalSocket listener = LocalSocket::listener();
  for (int i = 0; i < 50; ++i) {
    const Connection connection(listener);
    Connections guard{std::chrono::hours(1)};
    guard.begin_response(connection.client.port());
    guard.guard(listener.port());
    for (int moment = 0; moment < 20 * i; ++moment) std::this_thread::yield();
    if (i % 2 == 0) continue;  // ends without having closed
    guard.close();
    EXPECT_EQ(connection.client.receive_all(), "") << i;
  }
}

TEST(Connections, ThoseOfOtherPortsAreLeftAlone) {
  const LocalSocket listener = LocalSocket::listener(), other = LocalSocket::listener();
  const Connection foreign(other);
  Connections guard;
  guard.close();
  guard.guard(listener.port());
  for (int i = 0; i < 2; ++i) {  // what ends has been found after the foreign one was there
    const Connection own(listener);
    EXPECT_EQ(own.client.receive_all(), "");
  }
  ASSERT_TRUE(foreign.server.send("answer"));
  EXPECT_EQ(foreign.client.receive(), "answer");
  ASSERT_TRUE(foreign.client.send("request"));
  EXPECT_EQ(foreign.server.receive(), "request");
}

TEST(Connections, NeedNotBeGuarded) {
  const LocalSocket listener = LocalSocket::listener();
  const Connection connection(listener);
  {
    Connections guard;
    guard.begin_response(connection.client.port());
    guard.close();
  }
  ASSERT_TRUE(connection.server.send("x"));
  EXPECT_EQ(connection.client.receive(), "x");
}

}  // namespace connections_test
}  // namespace placegraph::apps
