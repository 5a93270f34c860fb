#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph {

/// A recording of messages in JSON, as MCAP (mcap.dev) stores it.
struct McapRecording {
  /// Type of messages.
  struct Schema {
    std::string name;         ///< name of the type, e.g. foxglove.PointCloud
    std::string json_schema;  ///< JSON Schema of the type
  };
  /// Messages of one type.
  struct Channel {
    std::string topic;       ///< name of the channel
    std::size_t schema = 0;  ///< position in `schemas`
  };
  /// A message.
  struct Message {
    std::size_t channel = 0;   ///< position in `channels`
    std::int64_t time_ns = 0;  ///< time of the message, not negative
    std::string json;          ///< its content
  };
  std::vector<Schema> schemas;    ///< types
  std::vector<Channel> channels;  ///< channels
  std::vector<Message> messages;  ///< messages, in any order
};

/// A recording as a file: uncompressed chunks of messages by ascending time, with an index of the
/// chunks, statistics and checksums.
/// Throws ArgumentError for a message of a missing channel, a channel of a missing schema, or a
/// negative time.
std::string to_mcap(const McapRecording& recording);

}  // namespace placegraph
