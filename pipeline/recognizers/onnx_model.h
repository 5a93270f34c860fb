#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

/// What an ONNX model takes: the first input that is no weight.
struct OnnxInput {
  std::string name;
  std::vector<std::int64_t> shape;  ///< sizes of its dimensions; 0: any
};

/// Reads the input of a model from the bytes of its file.
///
/// An ONNX file is a message of protocol buffers (ModelProto of onnx.proto). `path` names it in
/// messages. Throws FileError for other bytes, with the byte of the damage, and for a model without
/// an input.
OnnxInput read_onnx_input(std::string_view bytes, const std::string& path);

}  // namespace placegraph
