#include <fmt/format.h>
#include <placegraph/frontend/places/descriptors/combined_retrieval.h>
#include <placegraph/frontend/places/descriptors/descriptor_retrieval.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/pipeline/recognizers/descriptor_file.h>
#include <placegraph/pipeline/recognizers/exec_describer.h>
#include <placegraph/pipeline/recognizers/image_recognizer.h>
#include <placegraph/pipeline/recognizers/onnx_describer.h>

#include <algorithm>

namespace placegraph {
namespace {

/// A name that a file may hold, as a message shows it.
std::string shown_name(std::string name) {
  constexpr std::size_t kMost = 200;
  if (name.size() > kMost) name.replace(kMost, std::string::npos, "...");
  std::ranges::replace_if(
      name, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return "'" + name + "'";
}

}  // namespace

std::shared_ptr<ImageDescriber> open_describer(const std::string& name,
                                               const DescriberOptions& options) {
  const auto colon = std::min(name.find(':'), name.size());
  const std::string kind = name.substr(0, colon);
  const std::string rest = name.substr(std::min(colon + 1, name.size()));
  if (!rest.empty()) {
    if (kind == "exec") return std::make_shared<ExecDescriber>(rest, options.timeout_s);
    if (kind == "onnx") return std::make_shared<OnnxDescriber>(rest);
    if (kind == "descriptors") return std::make_shared<DescriptorFile>(rest);
  }
  throw ArgumentError(fmt::format(
      "recognizer: {} is none of exec:COMMAND, onnx:FILE, descriptors:FILE.npy", shown_name(name)));
}

std::shared_ptr<PlaceRetrieval> make_recognizer(std::shared_ptr<ImageDescriber> describer,
                                                const DescriberOptions& options,
                                                const PlaceRecognizerOptions& cues) {
  options.check();
  if (options.beside.empty())
    return std::make_shared<DescriptorRetrieval>(std::move(describer), options.normalize);
  std::vector<std::string_view> fields;
  split_comma(options.beside, fields);
  PlaceRecognizerOptions beside = cues;
  beside.cues = only_cues(cues.cues, {fields.begin(), fields.end()});
  return std::make_shared<CombinedRetrieval>(std::move(describer), options.normalize, beside);
}

void require_no_recognizer(const DescriberOptions& options, const std::string& source) {
  require(options.recognizer.empty(),
          fmt::format("{}: describer.recognizer {}: no file and no setting names a recognizer, "
                      "which may be a program to start; give it as --recognizer",
                      source, shown_name(options.recognizer)));
  require(options.beside.empty(), fmt::format("{}: describer.beside {}: give it as --appearance",
                                              source, shown_name(options.beside)));
}

void require_recognizer_again(const DescriberOptions& begun, const std::string& path, bool given) {
  if (!begun.recognizer.empty() && !given)
    throw FileError(path, fmt::format("its loops were found by the recognizer {}, which must be "
                                      "given again (--recognizer)",
                                      shown_name(begun.recognizer)));
}

}  // namespace placegraph
