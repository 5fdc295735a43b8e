#include "clearway/assign/memetic.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace clearway::assign {

namespace {

struct Particle {
  Permutation here, best;
  double value, best_value;
};

// Shares of the own best, the best of all and the particle itself.
struct Pull {
  double own, all, self;
};

Pull pull_at(const MemeticParams& params, int iteration, double least, double mean) {
  const double done = static_cast<double>(iteration) / std::max(1, params.iterations);
  const double fall = (params.c_max - params.c_min) * done;
  return {params.c_max - fall, params.c_min + fall,
          params.w_max - (params.w_max - params.w_min) * done +
              params.gamma * (mean > 0.0 ? least / mean : 1.0)};
}

// Each coordinate comes from one of three, then what is there twice is mended.
Permutation inherit(const Particle& particle, const Permutation& best, const Pull& pull,
                    Random& random) {
  Permutation child = particle.here;
  const double all = pull.own + pull.all + pull.self;
  for (std::size_t i = 0; i < child.size(); ++i) {
    const double drawn = random.unit() * all;
    if (drawn < pull.own) {
      child[i] = particle.best[i];
    } else if (drawn < pull.own + pull.all) {
      child[i] = best[i];
    }
  }
  repair(child, random);
  return child;
}

// Two parts at the same places of both change sides.
void cross(Permutation& a, Permutation& b, Random& random) {
  const int size = static_cast<int>(a.size());
  for (int part = 0; part < 2; ++part) {
    const int i = random.below(size), j = random.below(size);
    std::swap_ranges(a.begin() + std::min(i, j), a.begin() + std::max(i, j) + 1,
                     b.begin() + std::min(i, j));
  }
  repair(a, random);
  repair(b, random);
}

}  // namespace

void MemeticParams::check() const {
  const auto require = [](bool right, const char* what) {
    if (!right) throw std::invalid_argument(what);
  };
  require(particles >= 1, "particles must be 1 or above");
  require(iterations >= 0, "iterations must be 0 or above");
  require(mutation >= 0.0 && mutation <= 1.0, "mutation must be in [0, 1]");
  for (const double factor : {c_max, c_min, w_max, w_min, gamma}) {
    require(std::isfinite(factor) && factor >= 0.0,
            "c_max, c_min, w_max, w_min and gamma must be 0 or above and finite");
  }
  require(c_max + c_min > 0.0, "c_max and c_min must not both be 0");
}

void repair(Permutation& permutation, Random& random) {
  const auto size = permutation.size();
  std::vector<int> holders(size, 0), keeper(size, -1), missing;
  for (std::size_t i = 0; i < size; ++i) {
    const auto value = static_cast<std::size_t>(permutation[i]);
    if (random.below(++holders[value]) == 0) keeper[value] = static_cast<int>(i);
  }
  for (std::size_t value = 0; value < size; ++value) {
    if (!holders[value]) missing.push_back(static_cast<int>(value));
  }
  random.shuffle(missing);
  for (std::size_t i = 0; i < size; ++i) {
    if (keeper[static_cast<std::size_t>(permutation[i])] == static_cast<int>(i)) continue;
    permutation[i] = missing.back();
    missing.pop_back();
  }
}

MemeticResult swarm_memetically(const Costs& costs, int seats, const Routes& start,
                                const MemeticParams& params, std::uint64_t seed, Budget& budget) {
  if (costs.tasks() == 0) return {start, 0};
  Random random(seed);
  Descent descent(costs, seats);
  const auto size = static_cast<std::size_t>(descent.size());
  const auto number = static_cast<std::size_t>(params.particles);
  std::vector<Particle> swarm(number);
  for (Particle& particle : swarm) {
    particle.here.resize(size);
    std::iota(particle.here.begin(), particle.here.end(), 0);
    random.shuffle(particle.here);
  }
  int idle = costs.tasks();
  for (std::size_t i = 0; i < size; ++i) {
    const auto& route = start[i / static_cast<std::size_t>(seats)];
    const std::size_t at = i % static_cast<std::size_t>(seats);
    swarm[0].here[i] = at < route.size() ? route[at] : idle++;
  }
  std::size_t best = 0;
  for (std::size_t i = 0; i < number; ++i) {
    swarm[i].best = swarm[i].here;
    swarm[i].best_value = swarm[i].value = descent.value(swarm[i].here);
    if (swarm[i].best_value < swarm[best].best_value) best = i;
  }
  std::vector<std::size_t> pairs(number);
  std::iota(pairs.begin(), pairs.end(), std::size_t{0});
  std::vector<Permutation> children(number);
  for (int iteration = 0; iteration < params.iterations && !budget.ended; ++iteration) {
    double mean = 0.0;
    for (const Particle& particle : swarm) mean += particle.value / static_cast<double>(number);
    const Pull pull = pull_at(params, iteration, swarm[best].best_value, mean);
    for (std::size_t i = 0; i < number; ++i) {
      children[i] = inherit(swarm[i], swarm[best].best, pull, random);
    }
    random.shuffle(pairs);
    for (std::size_t i = 0; i + 1 < number; i += 2) {
      cross(children[pairs[i]], children[pairs[i + 1]], random);
    }
    for (std::size_t i = 0; i < number; ++i) {
      if (budget.ended) break;
      if (random.unit() < params.mutation) {
        const int a = random.below(descent.size()), b = random.below(descent.size());
        std::swap(children[i][static_cast<std::size_t>(a)],
                  children[i][static_cast<std::size_t>(b)]);
      }
      const double value = descent(children[i], budget);
      Particle& particle = swarm[i];
      if (value < particle.value) {
        particle.here = children[i];
        particle.value = value;
      }
      if (value < particle.best_value) {
        particle.best = children[i];
        particle.best_value = value;
        if (value < swarm[best].best_value) best = i;
      }
    }
  }
  return {descent.routes(swarm[best].best), descent.evaluations()};
}

}  // namespace clearway::assign
