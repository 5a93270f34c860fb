#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/recognizers/onnx_model.h>

#include <algorithm>
#include <functional>

namespace placegraph {
namespace {

/// A field of a message of protocol buffers: a number, or bytes that may be a message themselves.
struct Field {
  std::uint64_t number = 0, value = 0;
  std::string_view bytes;
};

/// Reads the fields of messages inside the bytes of one file.
class ProtocolReader {
 public:
  ProtocolReader(std::string_view file, const std::string& path) : file_(file), path_(path) {}

  /// Calls `visit` for each field of a message, which is a part of the file.
  void fields(std::string_view message, const std::function<void(const Field&)>& visit) const {
    const char* at = message.data();
    const char* const end = at + message.size();
    while (at < end) {
      // Kinds of fields: a number, 8 bytes, bytes with their length, 4 bytes.
      enum Kind : std::uint64_t { kNumber = 0, kEight = 1, kBytes = 2, kFour = 5 };
      const char* const begin = at;
      const std::uint64_t key = number(at, end);
      Field field{key >> 3, 0, {}};
      std::uint64_t length = 0;
      switch (key & 7) {
        case kNumber:
          field.value = number(at, end);
          break;
        case kEight:
          length = 8;
          break;
        case kBytes:
          length = number(at, end);
          break;
        case kFour:
          length = 4;
          break;
        default:
          fail(begin);
      }
      if (field.number == 0 || length > static_cast<std::uint64_t>(end - at)) fail(begin);
      field.bytes = {at, static_cast<std::size_t>(length)};
      at += length;
      visit(field);
    }
  }

 private:
  /// A number of seven bits a byte, the last of which has no eighth.
  std::uint64_t number(const char*& at, const char* end) const {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      if (at == end) fail(at);
      const auto byte = static_cast<unsigned char>(*at++);
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    fail(at);
  }
  [[noreturn]] void fail(const char* at) const {
    throw FileError(path_,
                    fmt::format("byte {}: no ONNX model, or a damaged one", at - file_.data()));
  }

  std::string_view file_;
  const std::string& path_;
};

/// The input that a ValueInfoProto describes: its name (1), and in its type (2), of a tensor (1),
/// the shape (2) with the sizes (1) of its dimensions (1).
OnnxInput input_of(const ProtocolReader& reader, std::string_view message) {
  OnnxInput input;
  const auto inside = [&](std::string_view of, std::uint64_t number, const auto& visit) {
    reader.fields(of, [&](const Field& field) {
      if (field.number == number) visit(field);
    });
  };
  inside(message, 1, [&](const Field& name) { input.name = name.bytes; });
  inside(message, 2, [&](const Field& type) {
    inside(type.bytes, 1, [&](const Field& tensor) {
      inside(tensor.bytes, 2, [&](const Field& shape) {
        inside(shape.bytes, 1, [&](const Field& dimension) {
          std::int64_t size = 0;
          inside(dimension.bytes, 1,
                 [&](const Field& value) { size = static_cast<std::int64_t>(value.value); });
          input.shape.push_back(std::max<std::int64_t>(size, 0));
        });
      });
    });
  });
  return input;
}

}  // namespace

OnnxInput read_onnx_input(std::string_view bytes, const std::string& path) {
  const ProtocolReader reader(bytes, path);
  // Numbers of the fields in onnx.proto.
  constexpr std::uint64_t kGraph = 7, kInitializer = 5, kInput = 11, kTensorName = 8;
  std::vector<OnnxInput> inputs;
  std::vector<std::string_view> weights;
  reader.fields(bytes, [&](const Field& model) {
    if (model.number != kGraph) return;
    reader.fields(model.bytes, [&](const Field& part) {
      if (part.number == kInput) inputs.push_back(input_of(reader, part.bytes));
      if (part.number != kInitializer) return;
      reader.fields(part.bytes, [&](const Field& tensor) {
        if (tensor.number == kTensorName) weights.push_back(tensor.bytes);
      });
    });
  });
  // Older models list their weights among the inputs.
  const auto found = std::ranges::find_if(inputs, [&](const OnnxInput& input) {
    return std::ranges::find(weights, input.name) == weights.end();
  });
  if (found == inputs.end()) throw FileError(path, "is no ONNX model with an input");
  return *found;
}

}  // namespace placegraph
