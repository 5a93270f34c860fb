#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/files/npy_array.h>
#include <placegraph/io/files/little_endian.h>

#include "tests/support/message_of.h"

namespace placegraph {
namespace npy_array_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A file as numpy's format says, of this header and these numbers.
template <class Number>
std::string npy(const std::string& header, const std::vector<Number>& numbers, char version = 1) {
  std::string bytes = "\x93NUMPY";
  bytes += version;
  bytes += '\0';
  if (version == 1)
    append_number(bytes, static_cast<std::uint16_t>(header.size()));
  else
    append_number(bytes, static_cast<std::uint32_t>(header.size()));
  bytes += header;
  for (const Number number : numbers) append_number(bytes, number);
  return bytes;
}

TEST(NpyArray, TypesVersionsAndOrdersAreRead) {
  const std::string list = "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }   \n";
  for (const char version : {1, 2, 3}) {
    const NpyArray array = read_npy(npy<double>(list, {1.5, -2}, version), "a.npy");
    EXPECT_THAT(array.shape, ElementsAre(2));
    EXPECT_THAT(array.values, ElementsAre(1.5, -2));
  }
  EXPECT_THAT(read_npy(npy<float>("{\"descr\": \"<f4\", \"fortran_order\": True, "
                                  "\"shape\": (2, 3)}\n",
                                  {1, 4, 2, 5, 3, 6}),
                       "a.npy")
                  .values,
              ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(
      read_npy(npy<std::int64_t>("{'descr':'<i8','fortran_order':False,'shape':()}", {-3}), "a.npy")
          .values,
      ElementsAre(-3));
  EXPECT_THAT(
      read_npy(npy<std::int32_t>("{'descr': '<i4', 'fortran_order': True, 'shape': (2,)}", {7, 8}),
               "a.npy")
          .values,
      ElementsAre(7, 8));
  EXPECT_THAT(
      read_npy(npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (0,)}", {}), "a.npy")
          .shape,
      ElementsAre(0));
}

/// numpy.save of [1.5, -2.0] by numpy 2.
TEST(NpyArray, TheBytesAreThoseOfNumpy) {
  std::string expected("\x93NUMPY\x01\0v\0", 10);
  expected += "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }";
  expected += std::string(127 - expected.size(), ' ') + "\n";
  append_number(expected, 1.5);
  append_number(expected, -2.0);
  EXPECT_EQ(to_npy({{2}, {1.5, -2}}), expected);
}

TEST(NpyArray, WhatIsWrittenIsReadToTheBit) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    NpyArray array;
    const int dimensions = static_cast<int>(random.uniform(0, 3));
    std::size_t count = 1;
    for (int d = 0; d < dimensions; ++d) {
      array.shape.push_back(static_cast<std::size_t>(random.uniform(0, 12)));
      count *= array.shape.back();
    }
    for (std::size_t k = 0; k < count; ++k) array.values.push_back(random.uniform(-1e9, 1e9));
    const std::string bytes = to_npy(array);
    EXPECT_EQ((bytes.size() - 8 * count) % 64, 0u);
    const NpyArray back = read_npy(bytes, "a.npy");
    EXPECT_EQ(back.shape, array.shape);
    EXPECT_EQ(back.values, array.values);
  }
}

TEST(NpyArray, WhatIsNoneIsRefused) {
  const auto message = [](const std::string& bytes) {
    return test::message_of<FileError>([&] { (void)read_npy(bytes, "r.zip: 'a.npy'"); });
  };
  const std::string good = "{'descr': '<f8', 'fortran_order': False, 'shape': (2,)}";
  EXPECT_THAT(message(""), HasSubstr("r.zip: 'a.npy': is no .npy file"));
  EXPECT_THAT(message("PK\x03\x04 of another kind"), HasSubstr("is no .npy file"));
  EXPECT_THAT(message(npy<double>(good, {1, 2}, 4)), HasSubstr("version 4"));
  EXPECT_THAT(message(npy<double>(good, {1, 2}).substr(0, 40)), HasSubstr("cut short"));
  EXPECT_THAT(message(npy<double>(good, {1})), HasSubstr("8 bytes"));
  EXPECT_THAT(message(npy<double>(good, {1, 2, 3})), HasSubstr("not its shape (2)"));
  EXPECT_THAT(message(npy<double>("{'descr': '<f8'}", {})), HasSubstr("has no descr"));
  EXPECT_THAT(message(npy<double>("{'descr': '>f8', 'fortran_order': False, 'shape': (1,)}", {1})),
              HasSubstr("type '>f8'"));
  EXPECT_THAT(message(npy<double>("{'descr': '|O', 'fortran_order': False, 'shape': (1,)}", {1})),
              HasSubstr("'a.npy'"));
  EXPECT_THAT(
      message(npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 1)}", {1})),
      HasSubstr("3 dimensions"));
  // Sizes whose product is that of two numbers in 64 bits.
  EXPECT_THAT(message(npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': "
                                  "(9223372036854775809, 2)}",
                                  {1, 2})),
              HasSubstr("not its shape"));
  EXPECT_THAT(
      message(npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (-2,)}", {1, 2})),
      HasSubstr("no list of sizes"));
  EXPECT_THROW((void)to_npy({{3}, {1, 2}}), ArgumentError);
}

/// A header of any damaged bytes ends in a FileError, or in numbers, but never elsewhere.
TEST(NpyArray, DamagedBytesNeverGoFurther) {
  const std::string good = to_npy({{2, 3}, {1, 2, 3, 4, 5, 6}});
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = good.substr(
        0, static_cast<std::size_t>(random.uniform(0, static_cast<double>(good.size()))));
    for (int k = 0; k < 3 && !bytes.empty(); ++k)
      bytes[static_cast<std::size_t>(random.uniform(0, static_cast<double>(bytes.size())))] =
          static_cast<char>(random.index(256));
    try {
      const NpyArray array = read_npy(bytes, "a.npy");
      EXPECT_LE(array.values.size(), bytes.size() / 4);
    } catch (const FileError&) {
    }
  }
}

}  // namespace npy_array_test
}  // namespace placegraph
