#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/evo/evo_result.h>
#include <placegraph/io/files/npy_array.h>
#include <placegraph/io/evo/zip_archive.h>

#include <limits>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace evo_result_test {

using ::testing::HasSubstr;

const std::string kInfo =
    R"json({"title": "APE w.r.t. translation part (m)\n(not aligned)", "ref_name": "gt.tum",)json"
    R"json( "est_name": "a.tum", "label": "APE (m)"})json";

std::string contents(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

EvoResult example() {
  EvoResult result;
  result.title = "APE w.r.t. translation part (m)\n(with SE(3) Umeyama alignment)";
  result.label = "APE (m)";
  result.reference = "gt \"00\"";
  result.estimate = "a.tum";
  result.statistics = {{"rmse", 0.1}, {"mean", 1.0 / 3}};
  result.arrays["error_array"] = {3, 1, {0.1, 0.2, 1e-300}};
  result.arrays["alignment_transformation_sim3"] = {2, 2, {1, 2, 3, 4}};
  result.trajectories["a.tum"] = "0 1 2 3 0 0 0 1\n";
  return result;
}

TEST(EvoResult, WhatIsWrittenIsRead) {
  const test::TemporaryFolder folder;
  const EvoResult result = example();
  write_evo_result(folder / "r.zip", result);
  EXPECT_TRUE(is_zip_archive(folder / "r.zip"));
  const EvoResult back = read_evo_result(folder / "r.zip");
  EXPECT_EQ(back.title, result.title);
  EXPECT_EQ(back.label, result.label);
  EXPECT_EQ(back.reference, result.reference);
  EXPECT_EQ(back.estimate, result.estimate);
  EXPECT_EQ(back.statistics, result.statistics);
  ASSERT_EQ(back.arrays.size(), 2u);
  EXPECT_EQ(back.arrays.at("error_array").values, result.arrays.at("error_array").values);
  EXPECT_EQ(back.arrays.at("alignment_transformation_sim3").columns, 2u);
  EXPECT_EQ(back.trajectories, result.trajectories);
}

TEST(EvoResult, EqualResultsGiveEqualBytes) {
  const test::TemporaryFolder folder;
  write_evo_result(folder / "a.zip", example());
  write_evo_result(folder / "b.zip", example());
  EXPECT_EQ(contents(folder / "a.zip"), contents(folder / "b.zip"));
}

TEST(EvoResult, ArchivesOfAnySizeAreRead) {
  const test::TemporaryFolder folder;
  Random random(8);
  for (const std::size_t count : {0u, 1u, 1000u, 400000u}) {
    EvoResult result = example();
    EvoArray& errors = result.arrays["error_array"];
    errors = {count, 1, {}};
    for (std::size_t i = 0; i < count; ++i) errors.values.push_back(random.uniform(0, 1));
    write_evo_result(folder / "r.zip", result);
    EXPECT_EQ(read_evo_result(folder / "r.zip").arrays.at("error_array").values, errors.values);
  }
}

/// Entries of older versions of evo are named .npz and hold the bytes of .npy.
TEST(EvoResult, ArraysOfOlderVersionsAreRead) {
  const test::TemporaryFolder folder;
  write_zip(folder / "r.zip", {{"info.json", kInfo},
                               {"stats.json", R"({"rmse": 2})"},
                               {"error_array.npz", to_npy({{2}, {1, 2}})},
                               {"notes.txt", "passed over"}});
  const EvoResult result = read_evo_result(folder / "r.zip");
  EXPECT_EQ(result.arrays.at("error_array").rows, 2u);
  EXPECT_EQ(result.statistics.front().second, 2);
}

TEST(EvoResult, WhatIsNoResultIsRefusedByName) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "r.zip";
  const auto message = [&](const std::vector<ZipEntry>& entries) {
    write_zip(path, entries);
    return test::message_of<FileError>([&] { (void)read_evo_result(path); });
  };
  const ZipEntry info{"info.json", kInfo}, stats{"stats.json", R"({"rmse": 2})"};
  EXPECT_THAT(message({info}), HasSubstr("is no result archive of evo: it has no stats.json"));
  EXPECT_THAT(message({stats}), HasSubstr("it has no info.json"));
  EXPECT_THAT(message({info, {"stats.json", "{"}}), HasSubstr("stats.json: is not valid JSON"));
  EXPECT_THAT(message({info, {"stats.json", "[1]"}}), HasSubstr("is no object"));
  EXPECT_THAT(message({info, {"stats.json", R"({"rmse": "2"})"}}),
              HasSubstr("'rmse' is no number"));
  EXPECT_THAT(message({info, stats, {"e.npy", "none"}}), HasSubstr("'e.npy': is no .npy file"));
  EXPECT_THAT(message({info, stats, stats}), HasSubstr("'stats.json': stands twice"));
  std::vector<ZipEntry> many(1001, {"", "x"});
  for (std::size_t i = 0; i < many.size(); ++i) many[i].name = std::to_string(i);
  EXPECT_THAT(message(many), HasSubstr("has more than 1000 entries"));
  folder.write("r.zip", "no archive");
  EXPECT_FALSE(is_zip_archive(path));
  EXPECT_THAT(test::message_of<FileError>([&] { (void)read_evo_result(path); }),
              HasSubstr("cannot be opened as a zip archive"));
  EXPECT_THROW((void)read_evo_result(folder / "missing.zip"), FileError);
  EXPECT_FALSE(is_zip_archive(folder / "missing.zip"));
}

/// Zeros take a thousandth of their length.
TEST(EvoResult, AnArchiveThatUnpacksToTooMuchIsRefused) {
  const test::TemporaryFolder folder;
  const std::string zeros(std::size_t{2} << 20, '\0');
  write_zip(folder / "r.zip", {{"a.npy", zeros}, {"b.npy", zeros}, {"c.txt", zeros}});
  EXPECT_LT(std::filesystem::file_size(folder / "r.zip"), 20000u);
  EXPECT_EQ(read_zip(folder / "r.zip", {".npy"}, std::size_t{4} << 20).size(), 2u);
  EXPECT_THAT(test::message_of<FileError>(
                  [&] { (void)read_zip(folder / "r.zip", {".npy"}, (std::size_t{4} << 20) - 1); }),
              HasSubstr("unpacks to more than 4194303 bytes"));
}

TEST(EvoResult, DamagedArchivesEndInAnError) {
  const test::TemporaryFolder folder;
  write_evo_result(folder / "good.zip", example());
  const std::string good = contents(folder / "good.zip");
  Random random(2);
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::string bytes = good;
    if (i % 2 == 0)
      bytes.resize(static_cast<std::size_t>(random.uniform(0, static_cast<double>(good.size()))));
    else
      bytes[static_cast<std::size_t>(random.uniform(0, static_cast<double>(good.size())))] ^= 0x20;
    folder.write("r.zip", bytes);
    try {
      (void)read_evo_result(folder / "r.zip");
    } catch (const FileError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 200);  // every one that is cut short
}

TEST(EvoResult, WhatCannotBeWrittenIsRefused) {
  const test::TemporaryFolder folder;
  EvoResult infinite = example(), ragged = example(), unnamed = example();
  infinite.statistics[0].second = std::numeric_limits<double>::infinity();
  ragged.arrays["error_array"].rows = 4;
  unnamed.trajectories["a.txt"] = "";
  for (const EvoResult& result : {infinite, ragged, unnamed})
    EXPECT_THROW(write_evo_result(folder / "r.zip", result), ArgumentError);
  EXPECT_FALSE(std::filesystem::exists(folder / "r.zip"));
  EXPECT_THROW(write_evo_result(folder / "no/such/r.zip", example()), FileError);
}

}  // namespace evo_result_test
}  // namespace placegraph
