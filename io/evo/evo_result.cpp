#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/evo/evo_result.h>
#include <placegraph/io/files/npy_array.h>
#include <placegraph/io/evo/zip_archive.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

using EvoJson = nlohmann::ordered_json;

bool is_array_name(const std::string& name) {
  return name.ends_with(".npy") || name.ends_with(".npz");
}

bool is_trajectory_name(const std::string& name) {
  return name.ends_with(".tum") || name.ends_with(".kitti");
}

/// The object of an entry, which must be there.
EvoJson evo_json(const std::vector<ZipEntry>& entries, const std::string& path,
                 const std::string& name) {
  const auto found = std::ranges::find(entries, name, &ZipEntry::name);
  if (found == entries.end())
    throw FileError(path, "is no result archive of evo: it has no " + name);
  EvoJson json = EvoJson::parse(found->bytes, nullptr, false);
  if (json.is_discarded()) throw FileError(path, name + ": is not valid JSON");
  if (!json.is_object()) throw FileError(path, name + ": is no object of JSON");
  return json;
}

std::string evo_text(const EvoJson& info, const std::string& key) {
  const auto found = info.find(key);
  return found != info.end() && found->is_string() ? found->get<std::string>() : std::string();
}

EvoArray evo_array(const NpyArray& npy) {
  EvoArray array;
  array.rows = npy.shape.empty() ? 1 : npy.shape[0];
  array.columns = npy.shape.size() > 1 ? npy.shape[1] : 1;
  array.values = npy.values;
  return array;
}

}  // namespace

EvoResult read_evo_result(const std::string& path) {
  const std::vector<ZipEntry> entries = read_zip(path, {".json", ".npy", ".npz", ".tum", ".kitti"});
  const EvoJson info = evo_json(entries, path, "info.json"),
                statistics = evo_json(entries, path, "stats.json");
  EvoResult result{evo_text(info, "title"),
                   evo_text(info, "label"),
                   evo_text(info, "ref_name"),
                   evo_text(info, "est_name"),
                   {},
                   {},
                   {}};
  for (const auto& [name, value] : statistics.items()) {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      throw FileError(path, "stats.json: " + in_quotes(name) + " is no number");
    result.statistics.emplace_back(name, value.get<double>());
  }
  for (const ZipEntry& entry : entries) {
    if (is_array_name(entry.name))
      result.arrays[entry.name.substr(0, entry.name.size() - 4)] =
          evo_array(read_npy(entry.bytes, path + ": " + in_quotes(entry.name)));
    if (is_trajectory_name(entry.name)) result.trajectories[entry.name] = entry.bytes;
  }
  return result;
}

void write_evo_result(const std::string& path, const EvoResult& result) {
  const EvoJson info = {{"title", result.title},
                        {"ref_name", result.reference},
                        {"est_name", result.estimate},
                        {"label", result.label}};
  EvoJson statistics = EvoJson::object();
  for (const auto& [name, value] : result.statistics) {
    require(std::isfinite(value), "evo result: the statistic " + name + " is not finite");
    statistics[name] = value;
  }
  const auto dumped = [](const EvoJson& json) {
    return json.dump(-1, ' ', false, EvoJson::error_handler_t::replace);
  };
  std::vector<ZipEntry> entries = {{"info.json", dumped(info)}, {"stats.json", dumped(statistics)}};
  for (const auto& [name, array] : result.arrays) {
    NpyArray npy{{array.rows}, array.values};
    if (array.columns != 1) npy.shape.push_back(array.columns);
    require(array.rows * array.columns == array.values.size(),
            "evo result: the values of " + name + " are not rows * columns");
    entries.push_back({name + ".npy", to_npy(npy)});
  }
  for (const auto& [name, text] : result.trajectories) {
    require(is_trajectory_name(name),
            "evo result: the name of a trajectory ends in .tum or .kitti, not " + name);
    entries.push_back({name, text});
  }
  write_zip(path, entries);
}

bool is_zip_archive(const std::string& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return false;
  std::ifstream stream(path, std::ios::binary);
  std::string begin(4, '\0');
  stream.read(begin.data(), 4);
  // The head of an entry, or the end of an archive without any.
  return stream.gcount() == 4 && (begin == "PK\x03\x04" || begin == "PK\x05\x06");
}

}  // namespace placegraph
