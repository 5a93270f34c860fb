#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "tests/support/command.h"
#include "tests/support/data.h"

// The cases that judge themselves: every `case.sh` in the folder of inputs from the field runs the
// program and ends with exit code 0 where it does right. (The other cases are files with right
// values, which tests of the commands know.)

namespace placegraph {
namespace field_cases_test {

namespace fs = std::filesystem;

/// Cases in which the program is known to do wrong today; who mends one removes it here.
const std::set<std::string> kOpen = {
    "export_gltf_colours",
    "graph_covariance_for_information",
    "graph_indefinite_information",
    "loops_matrix_of_two_sets",
    "run_alpha_cuts_out",
    "run_circle_of_constant_curve",
    "run_datasets_as_shipped",
    "run_fisheye_beyond_ninety",
    "run_follow_a_person",
    "run_moved_to_another_disk",
    "run_thermal_counts",
    "run_truck_ahead",
    "view_forwarded_to_another_port"};

std::vector<std::string> judging_cases() {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(test::cases_dir(), error))
    if (fs::exists(entry.path() / "case.sh")) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

class FieldCases : public testing::TestWithParam<std::string> {};

TEST_P(FieldCases, AreRight) {
  if (kOpen.contains(GetParam())) GTEST_SKIP() << "cases that are still wrong";
  const test::TemporaryFolder folder;
  const std::string script = (fs::path(test::cases_dir()) / GetParam() / "case.sh").string();
  const std::string command = "PLACEGRAPH='" + test::program() + "' sh '" + script + "' '" +
                              (folder / "work") + "' >'" + (folder / "said") + "' 2>&1 </dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0) << test::read_file(folder / "said");
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Judging, FieldCases, testing::ValuesIn(judging_cases()), name_of);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(FieldCases);

TEST(FieldCasesFolder, IsThere) {
  if (judging_cases().empty()) GTEST_SKIP() << "cases absent: " << test::cases_dir();
}

}  // namespace field_cases_test
}  // namespace placegraph
