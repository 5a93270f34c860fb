#include <placegraph/graph/core/median.h>
#include <placegraph/io/files/name_order.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>

namespace placegraph {
namespace {

std::string_view digits_at(std::string_view text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && is_digit(text[end])) ++end;
  return text.substr(begin, end - begin);
}

bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      std::string_view x = digits_at(a, i), y = digits_at(b, j);
      i += x.size();
      j += y.size();
      x.remove_prefix(std::min(x.find_first_not_of('0'), x.size()));
      y.remove_prefix(std::min(y.find_first_not_of('0'), y.size()));
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  const std::size_t rest_a = a.size() - i, rest_b = b.size() - j;
  return rest_a != rest_b ? rest_a < rest_b : a < b;
}

/// A name with one decimal number in it.
struct DecimalName {
  std::string_view before, whole, fraction, behind;
  double decimal_s = 0, nanoseconds_s = 0;  ///< its two interpretations
};

/// The last number with a point followed by digits, as in "img_9.5s.png"; not the extension's
/// point.
std::optional<DecimalName> decimal_name(std::string_view name) {
  for (std::size_t point = name.rfind('.'); point != name.npos && point > 0;
       point = name.rfind('.', point - 1)) {
    const std::string_view fraction = digits_at(name, point + 1);
    std::size_t begin = point;
    while (begin > 0 && is_digit(name[begin - 1])) --begin;
    if (fraction.empty() || begin == point) continue;
    DecimalName parts{name.substr(0, begin), name.substr(begin, point - begin), fraction,
                      name.substr(point + 1 + fraction.size())};
    const double whole = parse_double(parts.whole).value_or(0);
    const double digits = parse_double(fraction).value_or(0);
    parts.decimal_s = whole + digits * std::pow(10.0, -static_cast<double>(fraction.size()));
    parts.nanoseconds_s = whole + 1e-9 * digits;
    return parts;
  }
  return std::nullopt;
}

/// Share of the time steps within a tenth of their median: most of them, if frames are evenly
/// spaced and some are missing.
double evenness(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  std::vector<double> distances;
  for (std::size_t i = 1; i < times.size(); ++i) distances.push_back(times[i] - times[i - 1]);
  const double middle = median_of(distances);
  if (!(middle > 0)) return 0;
  const auto near = std::count_if(distances.begin(), distances.end(), [&](double distance) {
    return std::abs(distance - middle) <= 0.1 * middle;
  });
  return static_cast<double>(near) / static_cast<double>(distances.size());
}

/// Whether all names differ in one decimal number that is more likely a decimal than seconds and
/// nanoseconds.
bool are_decimal_times(const std::vector<std::string>& names) {
  std::vector<double> decimal, nanoseconds;
  std::optional<DecimalName> first;
  bool lengths_differ = false;
  for (const std::string& name : names) {
    const std::optional<DecimalName> parts = decimal_name(name);
    if (!parts) return false;
    if (!first) first = parts;
    if (parts->before != first->before || parts->behind != first->behind) return false;
    lengths_differ |= parts->fraction.size() != first->fraction.size();
    decimal.push_back(parts->decimal_s);
    nanoseconds.push_back(parts->nanoseconds_s);
  }
  return names.size() > 2 && lengths_differ && evenness(decimal) > evenness(nanoseconds);
}

}  // namespace

void sort_by_name(std::vector<std::string>& paths) {
  std::sort(paths.begin(), paths.end(), natural_less);
  std::vector<std::string> names;
  for (const std::string& path : paths)
    names.push_back(std::filesystem::path(path).filename().string());
  if (!are_decimal_times(names)) return;
  std::vector<std::size_t> order(paths.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::size_t i) { return *decimal_name(names[i]); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const DecimalName x = key(a), y = key(b);
    if (x.whole != y.whole) return natural_less(std::string(x.whole), std::string(y.whole));
    return x.fraction < y.fraction;
  });
  std::vector<std::string> sorted;
  for (const std::size_t i : order) sorted.push_back(std::move(paths[i]));
  paths = std::move(sorted);
}

}  // namespace placegraph
