#include <placegraph/frontend/align/genetic_search.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>

namespace placegraph {
namespace {

using Eigen::VectorXd;

/// Index of a parent by tournament; members are sorted, so the least index drawn wins.
const VectorXd& select(const PopulationResult& members, int tournament, Random& random) {
  int winner = static_cast<int>(members.points.size()) - 1;
  for (int i = 0; i < tournament; ++i)
    winner = std::min(winner, random.index(static_cast<int>(members.points.size())));
  return members.points[static_cast<std::size_t>(winner)];
}

VectorXd child_of(const VectorXd& a, const VectorXd& b, double sigma, const GeneticOptions& o,
                  Random& random) {
  VectorXd child(a.size());
  for (Eigen::Index k = 0; k < a.size(); ++k) {
    const double share = random.uniform(-o.blend, 1 + o.blend);
    child[k] = a[k] + share * (b[k] - a[k]);
    if (random.uniform() < o.mutation_rate) child[k] += random.normal(0, sigma);
    child[k] = std::clamp(child[k], -o.bound, o.bound);
  }
  return child;
}

}  // namespace

PopulationResult genetic_search(const PopulationCost& cost, int n, const GeneticOptions& options) {
  require(n >= 1, "genetic_search: at least one dimension");
  options.check();
  Random random(options.seed);
  PopulationResult members;
  members.points.assign(static_cast<std::size_t>(options.members), VectorXd::Zero(n));
  for (std::size_t i = 1; i < members.points.size(); ++i)
    for (int k = 0; k < n; ++k)
      members.points[i][k] = std::clamp(random.normal(), -options.bound, options.bound);
  evaluate_population(cost, members.points, options.threads, members.costs);
  members.evaluations = options.members;
  sort_population(members);
  int idle = 0;
  while (members.generations < options.generations && idle < options.stagnation) {
    const double progress = static_cast<double>(members.generations) / options.generations;
    const double sigma = options.mutation_sigma * (1 - 0.9 * progress), least = members.costs[0];
    PopulationResult next = members;
    std::vector<VectorXd> children;
    for (int i = options.elite; i < options.members; ++i) {
      const VectorXd& a = select(members, options.tournament, random);
      const VectorXd& b = select(members, options.tournament, random);
      children.push_back(child_of(a, b, sigma, options, random));
    }
    std::vector<double> costs;
    evaluate_population(cost, children, options.threads, costs);
    std::copy(children.begin(), children.end(), next.points.begin() + options.elite);
    std::copy(costs.begin(), costs.end(), next.costs.begin() + options.elite);
    ++next.generations;
    next.evaluations += static_cast<int>(children.size());
    members = std::move(next);
    sort_population(members);
    idle = members.costs[0] < least ? 0 : idle + 1;
  }
  return members;
}

}  // namespace placegraph
