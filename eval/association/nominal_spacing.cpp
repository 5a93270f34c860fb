#include <placegraph/eval/association/nominal_spacing.h>

#include <algorithm>

namespace placegraph {

double nominal_spacing_ns(const std::vector<std::int64_t>& stamps_ns) {
  // Half way between one spacing and two.
  constexpr double kNotTwo = 1.5;
  // Of stamps of which 85 % are lost, 15 % of the spacings are single ones.
  constexpr std::size_t kDecile = 10;
  if (stamps_ns.size() < 2) return 0;
  std::vector<double> spacings_ns;
  spacings_ns.reserve(stamps_ns.size() - 1);
  for (std::size_t i = 1; i < stamps_ns.size(); ++i)
    spacings_ns.push_back(static_cast<double>(stamps_ns[i] - stamps_ns[i - 1]));
  std::sort(spacings_ns.begin(), spacings_ns.end());
  double spacing_ns = spacings_ns[spacings_ns.size() / kDecile];
  while (true) {  // ends: the steps are of one direction, because a larger spacing has no smaller next
    const auto single =
        std::upper_bound(spacings_ns.begin(), spacings_ns.end(), kNotTwo * spacing_ns);
    const double next_ns = spacings_ns[static_cast<std::size_t>(single - spacings_ns.begin()) / 2];
    if (next_ns == spacing_ns) return spacing_ns;
    spacing_ns = next_ns;
  }
}

}  // namespace placegraph
