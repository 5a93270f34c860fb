#pragma once
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::report {

/// A column of a report: {"type", "width", "data"} with little-endian values in base64, `width` of
/// them a row. Throws ArgumentError if the values are no whole number of rows.
nlohmann::json column(const std::vector<float>& values, int width = 1);
nlohmann::json column(const std::vector<double>& values, int width = 1);
nlohmann::json column(const std::vector<std::int32_t>& values, int width = 1);
nlohmann::json column(const std::vector<std::uint8_t>& values, int width = 1);

/// A column of texts: {"table": the different texts, "index": a column with a position in it for
/// every row, -1 for an empty text}.
nlohmann::json text_column(const std::vector<std::string>& texts);

/// The values of a column of floats or of integers of 32 bits, as floats.
std::vector<float> values_of(const nlohmann::json& column);

/// Number of rows of a column.
std::size_t rows_of(const nlohmann::json& column);

/// Bytes that a column, or any part of a report, takes in a page.
std::size_t page_bytes(const nlohmann::json& part);

/// Some rows of a column, or of a column of texts; null remains null.
nlohmann::json rows_of_column(const nlohmann::json& column, const std::vector<std::size_t>& rows);

}  // namespace placegraph::report
