#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/little_endian.h>
#include <placegraph/io/exports/mcap_file.h>
#include <zlib.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace placegraph {
namespace {

/// Kinds of records, from the specification of MCAP.
enum class McapRecord : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

constexpr char kMcapMagic[] = "\x89MCAP0\r\n";

std::uint32_t mcap_checksum(const std::string& bytes, std::size_t begin = 0) {
  return static_cast<std::uint32_t>(crc32_z(crc32_z(0, nullptr, 0),
                                            reinterpret_cast<const Bytef*>(bytes.data()) + begin,
                                            bytes.size() - begin));
}

void append_text(std::string& bytes, const std::string& text) {
  append_number(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

void append_record(std::string& bytes, McapRecord record, const std::string& content) {
  append_number(bytes, static_cast<std::uint8_t>(record));
  append_number(bytes, static_cast<std::uint64_t>(content.size()));
  bytes += content;
}

std::uint16_t mcap_id(std::size_t position) { return static_cast<std::uint16_t>(position + 1); }

std::string mcap_schemas(const McapRecording& recording) {
  std::string bytes;
  for (std::size_t i = 0; i < recording.schemas.size(); ++i) {
    std::string content;
    append_number(content, mcap_id(i));
    append_text(content, recording.schemas[i].name);
    append_text(content, "jsonschema");
    append_text(content, recording.schemas[i].json_schema);
    append_record(bytes, McapRecord::kSchema, content);
  }
  return bytes;
}

std::string mcap_channels(const McapRecording& recording) {
  std::string bytes;
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    std::string content;
    append_number(content, mcap_id(i));
    append_number(content, mcap_id(recording.channels[i].schema));
    append_text(content, recording.channels[i].topic);
    append_text(content, "json");
    append_number(content, std::uint32_t{0});  // no metadata
    append_record(bytes, McapRecord::kChannel, content);
  }
  return bytes;
}

/// Messages that are written together, and where those of each channel begin.
struct McapChunk {
  std::uint64_t first_ns = 0, last_ns = 0;
  std::string records;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> index;

  void add(const McapRecording::Message& message, std::uint32_t sequence) {
    const auto time = static_cast<std::uint64_t>(message.time_ns);
    if (records.empty()) first_ns = time;
    last_ns = time;
    index[mcap_id(message.channel)].emplace_back(time, records.size());
    std::string content;
    append_number(content, mcap_id(message.channel));
    append_number(content, sequence);
    append_number(content, time);  // when it was recorded
    append_number(content, time);  // when it was published
    append_record(records, McapRecord::kMessage, content + message.json);
  }
};

/// Appends a chunk with its message indices to the file, and returns the content of its entry in
/// the index of chunks.
std::string append_chunk(std::string& file, const McapChunk& chunk) {
  const std::size_t begin = file.size();
  std::string content;
  append_number(content, chunk.first_ns);
  append_number(content, chunk.last_ns);
  append_number(content, static_cast<std::uint64_t>(chunk.records.size()));
  append_number(content, mcap_checksum(chunk.records));
  append_text(content, "");  // no compression
  append_number(content, static_cast<std::uint64_t>(chunk.records.size()));
  append_record(file, McapRecord::kChunk, content + chunk.records);

  const std::size_t indices = file.size();
  std::string offsets;
  for (const auto& [channel, messages] : chunk.index) {
    append_number(offsets, channel);
    append_number(offsets, static_cast<std::uint64_t>(file.size()));
    std::string entries;
    for (const auto& [time, offset] : messages) {
      append_number(entries, time);
      append_number(entries, offset);
    }
    std::string index;
    append_number(index, channel);
    append_text(index, entries);
    append_record(file, McapRecord::kMessageIndex, index);
  }

  std::string entry;
  append_number(entry, chunk.first_ns);
  append_number(entry, chunk.last_ns);
  append_number(entry, static_cast<std::uint64_t>(begin));
  append_number(entry, static_cast<std::uint64_t>(indices - begin));
  append_text(entry, offsets);
  append_number(entry, static_cast<std::uint64_t>(file.size() - indices));
  append_text(entry, "");
  append_number(entry, static_cast<std::uint64_t>(chunk.records.size()));
  append_number(entry, static_cast<std::uint64_t>(chunk.records.size()));
  return entry;
}

/// The messages by ascending time.
std::vector<const McapRecording::Message*> in_time_order(const McapRecording& recording) {
  std::vector<const McapRecording::Message*> messages;
  for (const McapRecording::Message& message : recording.messages) messages.push_back(&message);
  std::ranges::stable_sort(messages, {}, &McapRecording::Message::time_ns);
  return messages;
}

void check_recording(const McapRecording& recording) {
  constexpr std::size_t kMost = 65535;
  require(recording.schemas.size() < kMost && recording.channels.size() < kMost,
          "MCAP: too many schemas or channels");
  for (const McapRecording::Channel& channel : recording.channels)
    require(channel.schema < recording.schemas.size(),
            "MCAP: channel " + channel.topic + " has no schema");
  for (const McapRecording::Message& message : recording.messages) {
    require(message.channel < recording.channels.size(), "MCAP: a message has no channel");
    require(message.time_ns >= 0, "MCAP: a message has a negative time");
  }
}

std::string mcap_statistics(const McapRecording& recording, std::size_t chunks) {
  std::map<std::uint16_t, std::uint64_t> counts;
  std::uint64_t first = 0, last = 0;
  for (const McapRecording::Message& message : recording.messages) {
    const auto time = static_cast<std::uint64_t>(message.time_ns);
    first = counts.empty() ? time : std::min(first, time);
    last = std::max(last, time);
    ++counts[mcap_id(message.channel)];
  }
  std::string content;
  append_number(content, static_cast<std::uint64_t>(recording.messages.size()));
  append_number(content, static_cast<std::uint16_t>(recording.schemas.size()));
  append_number(content, static_cast<std::uint32_t>(recording.channels.size()));
  append_number(content, std::uint32_t{0});  // attachments
  append_number(content, std::uint32_t{0});  // metadata
  append_number(content, static_cast<std::uint32_t>(chunks));
  append_number(content, first);
  append_number(content, last);
  std::string by_channel;
  for (const auto& [channel, count] : counts) {
    append_number(by_channel, channel);
    append_number(by_channel, count);
  }
  append_text(content, by_channel);
  std::string record;
  append_record(record, McapRecord::kStatistics, content);
  return record;
}

/// Appends the summary, the offsets of its groups of records, the footer and the magic bytes.
void append_summary(std::string& file, const McapRecording& recording,
                    const std::vector<std::string>& chunk_entries) {
  std::string chunk_index;
  for (const std::string& entry : chunk_entries)
    append_record(chunk_index, McapRecord::kChunkIndex, entry);
  const std::size_t begin = file.size();
  std::string offsets;
  for (const auto& [record, group] :
       {std::pair(McapRecord::kSchema, mcap_schemas(recording)),
        std::pair(McapRecord::kChannel, mcap_channels(recording)),
        std::pair(McapRecord::kStatistics, mcap_statistics(recording, chunk_entries.size())),
        std::pair(McapRecord::kChunkIndex, chunk_index)}) {
    if (group.empty()) continue;
    std::string content;
    append_number(content, static_cast<std::uint8_t>(record));
    append_number(content, static_cast<std::uint64_t>(file.size()));
    append_number(content, static_cast<std::uint64_t>(group.size()));
    append_record(offsets, McapRecord::kSummaryOffset, content);
    file += group;
  }
  const std::size_t offsets_begin = file.size();
  file += offsets;
  append_number(file, static_cast<std::uint8_t>(McapRecord::kFooter));
  append_number(file, std::uint64_t{20});
  append_number(file, static_cast<std::uint64_t>(begin));
  append_number(file, static_cast<std::uint64_t>(offsets_begin));
  append_number(file, mcap_checksum(file, begin));
  file += kMcapMagic;
}

}  // namespace

std::string to_mcap(const McapRecording& recording) {
  constexpr std::size_t kChunkBytes = 1 << 20;
  check_recording(recording);
  std::string file = kMcapMagic;
  std::string header;
  append_text(header, "");  // no profile
  append_text(header, "placegraph");
  append_record(file, McapRecord::kHeader, header);
  file += mcap_schemas(recording) + mcap_channels(recording);

  std::vector<std::string> chunk_entries;
  McapChunk chunk;
  std::vector<std::uint32_t> sequence(recording.channels.size(), 0);
  const auto end_chunk = [&] {
    if (chunk.records.empty()) return;
    chunk_entries.push_back(append_chunk(file, chunk));
    chunk = {};
  };
  for (const McapRecording::Message* message : in_time_order(recording)) {
    chunk.add(*message, sequence[message->channel]++);
    if (chunk.records.size() >= kChunkBytes) end_chunk();
  }
  end_chunk();

  std::string data_end;
  append_number(data_end, mcap_checksum(file));
  append_record(file, McapRecord::kDataEnd, data_end);
  append_summary(file, recording, chunk_entries);
  return file;
}

}  // namespace placegraph
