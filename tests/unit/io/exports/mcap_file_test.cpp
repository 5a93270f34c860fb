#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/io/exports/mcap_file.h>
#include <zlib.h>

#include <cstring>
#include <map>

namespace placegraph {
namespace mcap_file_test {

constexpr std::size_t kMagic = 8, kHead = 9;  // bytes of the magic and of a record's head

template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number{};
  EXPECT_LE(at + sizeof number, bytes.size());
  if (at + sizeof number <= bytes.size()) std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

std::uint32_t checksum(const std::string& bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

struct Record {
  int kind = 0;
  std::size_t begin = 0;
  std::string content;
};

/// The records that follow each other between two positions.
std::vector<Record> records_of(const std::string& bytes, std::size_t begin, std::size_t end) {
  std::vector<Record> records;
  while (begin < end) {
    const auto size = number_at<std::uint64_t>(bytes, begin + 1);
    records.push_back({static_cast<std::uint8_t>(bytes[begin]), begin,
                       bytes.substr(begin + kHead, static_cast<std::size_t>(size))});
    begin += kHead + static_cast<std::size_t>(size);
  }
  EXPECT_EQ(begin, end);
  return records;
}

McapRecording small_recording() {
  McapRecording recording;
  recording.schemas = {{"a.Type", R"({"type":"object"})"}};
  recording.channels = {{"/one", 0}, {"/two", 0}};
  recording.messages = {{0, 20, R"({"n":2})"}, {1, 10, R"({"n":1})"}, {0, 30, R"({"n":3})"}};
  return recording;
}

TEST(McapFile, HasItsRecordsInOrderAndTheirChecksums) {
  const std::string file = to_mcap(small_recording());
  const std::string magic = "\x89MCAP0\r\n";
  EXPECT_EQ(file.substr(0, kMagic), magic);
  EXPECT_EQ(file.substr(file.size() - kMagic), magic);
  const std::vector<Record> records = records_of(file, kMagic, file.size() - kMagic);
  std::vector<int> kinds;
  for (const Record& record : records) kinds.push_back(record.kind);
  EXPECT_EQ(kinds, (std::vector<int>{1, 3, 4, 4, 6, 7, 7, 15, 3, 4, 4, 11, 8, 14, 14, 14, 14, 2}));
  EXPECT_EQ(number_at<std::uint32_t>(records[7].content, 0),
            checksum(file.substr(0, records[7].begin)));
  const Record& footer = records.back();
  const auto summary = static_cast<std::size_t>(number_at<std::uint64_t>(footer.content, 0));
  EXPECT_EQ(summary, records[8].begin);
  EXPECT_EQ(number_at<std::uint64_t>(footer.content, 8), records[13].begin);
  EXPECT_EQ(number_at<std::uint32_t>(footer.content, 16),
            checksum(file.substr(summary, footer.begin + kHead + 16 - summary)));
}

TEST(McapFile, HasMessagesByTimeAndFindsThemByTheIndex) {
  const std::string file = to_mcap(small_recording());
  const std::vector<Record> records = records_of(file, kMagic, file.size() - kMagic);
  const std::string& chunk = records[4].content;
  EXPECT_EQ(number_at<std::uint64_t>(chunk, 0), 10u);
  EXPECT_EQ(number_at<std::uint64_t>(chunk, 8), 30u);
  const auto size = number_at<std::uint64_t>(chunk, 16);
  EXPECT_EQ(number_at<std::uint32_t>(chunk, 28), 0u);  // no compression
  EXPECT_EQ(number_at<std::uint64_t>(chunk, 32), size);
  const std::string inside = chunk.substr(40);
  ASSERT_EQ(inside.size(), size);
  EXPECT_EQ(number_at<std::uint32_t>(chunk, 24), checksum(inside));
  const std::vector<Record> messages = records_of(inside, 0, inside.size());
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[0].content.substr(22), R"({"n":1})");
  EXPECT_EQ(messages[1].content.substr(22), R"({"n":2})");
  EXPECT_EQ(messages[2].content.substr(22), R"({"n":3})");
  EXPECT_EQ(number_at<std::uint16_t>(messages[0].content, 0), 2u);
  EXPECT_EQ(number_at<std::uint32_t>(messages[2].content, 2), 1u);  // the second of its channel
  // The index of the first channel: two entries of a time and an offset into the chunk.
  EXPECT_EQ(number_at<std::uint16_t>(records[5].content, 0), 1u);
  EXPECT_EQ(number_at<std::uint32_t>(records[5].content, 2), 32u);
  EXPECT_EQ(number_at<std::uint64_t>(records[5].content, 6), 20u);
  EXPECT_EQ(number_at<std::uint64_t>(records[5].content, 14), messages[1].begin);
  EXPECT_EQ(number_at<std::uint64_t>(records[12].content, 16), records[4].begin);
}

TEST(McapFile, BeginsANewChunkAfterAMebibyte) {
  McapRecording recording = small_recording();
  for (McapRecording::Message& message : recording.messages) {
    message.json.assign((1 << 20) + 2, 'x');
    message.json.front() = message.json.back() = '"';
  }
  const std::string file = to_mcap(recording);
  int chunks = 0;
  for (const Record& record : records_of(file, kMagic, file.size() - kMagic))
    chunks += record.kind == 6;
  EXPECT_EQ(chunks, 3);
}

TEST(McapFile, RefusesWhatIsNotDescribed) {
  McapRecording recording = small_recording();
  recording.messages[0].channel = 2;
  EXPECT_THROW(to_mcap(recording), ArgumentError);
  recording = small_recording();
  recording.channels[1].schema = 1;
  EXPECT_THROW(to_mcap(recording), ArgumentError);
  recording = small_recording();
  recording.messages[0].time_ns = -1;
  EXPECT_THROW(to_mcap(recording), ArgumentError);
}

TEST(Base64, IsThatOfItsSpecification) {
  EXPECT_EQ(to_base64(""), "");
  EXPECT_EQ(to_base64("f"), "Zg==");
  EXPECT_EQ(to_base64("fo"), "Zm8=");
  EXPECT_EQ(to_base64("foo"), "Zm9v");
  EXPECT_EQ(to_base64("foob"), "Zm9vYg==");
  EXPECT_EQ(to_base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(to_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(to_base64("\xff\xfe"), "//4=");
}

}  // namespace mcap_file_test
}  // namespace placegraph
