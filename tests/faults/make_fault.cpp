// make_fault list
// make_fault FAULT SEQUENCE OUT [--seed N] [--frames N] [--scale S] [--camera-height H]
//
// Reads a sequence and writes one with a fault, in KITTI's odometry layout. The fault "none" writes
// the sequence as it is. Exit codes: 0 ok, 2 usage or file error.
#include <fmt/format.h>
#include <placegraph/graph/core/error.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>

#include "tests/faults/fault.h"

namespace placegraph::faults {
namespace {

constexpr auto kUsage =
    "usage: make_fault list | make_fault FAULT SEQUENCE OUT [--seed N] [--frames N] [--scale S] "
    "[--camera-height H]";

void print_table() {
  const std::vector<Fault> faults = all_faults();
  fmt::print("# name\tsensors\tgroup\tcauses\twhat\n");
  for (std::size_t i = 0; i < faults.size(); ++i)
    fmt::print("{}\t{}\t{}\t{}\t{}\n", faults[i].name, faults[i].sensors, group_of(i),
               faults[i].causes, faults[i].what);
}

Fault fault_of(const std::string& name) {
  if (name == "none")
    return {name, "", "", "-", [](const Recording& r, std::uint32_t) { return r; }};
  for (const Fault& fault : all_faults())
    if (fault.name == name) return fault;
  throw ArgumentError(name + ": is no fault; `make_fault list` names them");
}

/// The number behind an option.
double number_of(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  require(!text.empty() && *end == '\0' && number >= 0 && number < 4e9,
          fmt::format("{}: '{}' is no number from 0 on", option, text));
  return number;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 1 && arguments[0] == "list") {
    print_table();
    return 0;
  }
  require(arguments.size() >= 3 && arguments.size() % 2 == 1, kUsage);
  std::map<std::string, double> numbers{
      {"--seed", 1}, {"--frames", 0}, {"--scale", 1}, {"--camera-height", 0}};
  for (std::size_t i = 3; i + 1 < arguments.size(); i += 2) {
    require(numbers.count(arguments[i]) == 1, kUsage);
    numbers[arguments[i]] = number_of(arguments[i], arguments[i + 1]);
  }
  const Fault fault = fault_of(arguments[0]);
  ReadingOptions options;
  options.most_frames = static_cast<std::size_t>(numbers["--frames"]);
  options.scale = numbers["--scale"];
  if (numbers["--camera-height"] > 0) options.camera_height_m = numbers["--camera-height"];
  const Recording recording = read_recording(arguments[1], options);
  const Recording faulty = fault.apply(recording, static_cast<std::uint32_t>(numbers["--seed"]));
  write_recording(faulty, fault.name, arguments[2]);
  return 0;
}

}  // namespace
}  // namespace placegraph::faults

int main(int count, char** arguments) {
  try {
    return placegraph::faults::run({arguments + 1, arguments + count});
  } catch (const std::exception& error) {
    fmt::print(stderr, "make_fault: {}\n", error.what());
    return 2;
  }
}
