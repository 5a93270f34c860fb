#include <placegraph/frontend/align/particle_swarm.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace placegraph {
namespace {

using Eigen::VectorXd;

// Maximum change of a coordinate in one generation [standard deviations of the start]. Chosen.
constexpr double kMaxSpeed = 0.8;

struct Particle {
  Random random;
  VectorXd x, velocity;
};

/// Moves a particle back into the box and reverses its velocity where it left the box.
void reflect(VectorXd& x, VectorXd& velocity, double bound) {
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    if (std::abs(x[k]) <= bound) continue;
    x[k] = std::clamp(std::copysign(2 * bound, x[k]) - x[k], -bound, bound);
    velocity[k] = -velocity[k];
  }
}

/// Index of the best point among those that attract particle i.
std::size_t leader(const std::vector<double>& best, std::size_t i, SwarmTopology topology) {
  if (topology == SwarmTopology::kGlobal)
    return static_cast<std::size_t>(std::min_element(best.begin(), best.end()) - best.begin());
  const std::size_t n = best.size();
  std::size_t lead = i;
  for (const std::size_t other : {(i + n - 1) % n, (i + 1) % n})
    if (best[other] < best[lead]) lead = other;
  return lead;
}

void move(Particle& particle, const VectorXd& own, const VectorXd& lead, double progress,
          const SwarmOptions& o) {
  double keep = constriction(4.1), pull = keep * 2.05;
  if (o.damping == SwarmDamping::kInertia) keep = 0.9 - 0.5 * progress, pull = 1.7;
  for (Eigen::Index k = 0; k < particle.x.size(); ++k) {
    const double to_own = particle.random.uniform(), to_lead = particle.random.uniform();
    double& v = particle.velocity[k];
    v = keep * v + pull * (to_own * (own[k] - particle.x[k]) + to_lead * (lead[k] - particle.x[k]));
    v = std::clamp(v, -kMaxSpeed, kMaxSpeed);
  }
  particle.x += particle.velocity;
  reflect(particle.x, particle.velocity, o.bound);
}

}  // namespace

double constriction(double phi) { return 2 / std::abs(2 - phi - std::sqrt(phi * phi - 4 * phi)); }

void evaluate_population(const PopulationCost& cost, const std::vector<VectorXd>& points,
                         int threads, std::vector<double>& costs) {
  costs.resize(points.size());
  parallel_for(static_cast<int>(points.size()), threads, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    costs[at] = cost(points[at]);
  });
}

void sort_population(PopulationResult& population) {
  std::vector<std::size_t> order(population.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return population.costs[a] < population.costs[b];
  });
  PopulationResult sorted = population;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.points[i] = population.points[order[i]];
    sorted.costs[i] = population.costs[order[i]];
  }
  population = std::move(sorted);
}

PopulationResult swarm_search(const PopulationCost& cost, int n, const SwarmOptions& options) {
  require(n >= 1, "swarm_search: at least one dimension");
  options.check();
  std::vector<Particle> swarm;
  std::vector<VectorXd> points;
  for (int i = 0; i < options.particles; ++i) {
    Particle particle{Random(options.seed, static_cast<std::uint64_t>(i)), VectorXd::Zero(n),
                      VectorXd::Zero(n)};
    if (i > 0)
      for (int k = 0; k < n; ++k)
        particle.x[k] = std::clamp(particle.random.normal(), -options.bound, options.bound);
    points.push_back(particle.x);
    swarm.push_back(std::move(particle));
  }
  PopulationResult best;
  evaluate_population(cost, points, options.threads, best.costs);
  best.points = points;
  best.evaluations = options.particles;
  std::vector<double> costs;
  int idle = 0;
  while (best.generations < options.generations && idle < options.stagnation) {
    const double progress = static_cast<double>(best.generations) / options.generations;
    for (std::size_t i = 0; i < swarm.size(); ++i) {
      const std::size_t lead = leader(best.costs, i, options.topology);
      move(swarm[i], best.points[i], best.points[lead], progress, options);
      points[i] = swarm[i].x;
    }
    evaluate_population(cost, points, options.threads, costs);
    const double least = *std::min_element(best.costs.begin(), best.costs.end());
    for (std::size_t i = 0; i < swarm.size(); ++i) {
      if (!(costs[i] < best.costs[i])) continue;
      best.costs[i] = costs[i];
      best.points[i] = points[i];
    }
    idle = *std::min_element(best.costs.begin(), best.costs.end()) < least ? 0 : idle + 1;
    ++best.generations;
    best.evaluations += options.particles;
  }
  sort_population(best);
  return best;
}

}  // namespace placegraph
