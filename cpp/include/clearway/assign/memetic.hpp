// Memetic swarm for even splits: fragments of good permutations are mixed, then descend.
#pragma once

#include <cstdint>
#include <vector>

#include "clearway/assign/costs.hpp"
#include "clearway/assign/descent.hpp"
#include "clearway/assign/random.hpp"
#include "clearway/budget.hpp"

namespace clearway::assign {

struct MemeticParams {
  int particles = 30;
  int iterations = 5;
  double mutation = 0.1;            // chance that two coordinates of a child change places
  double c_max = 2.5, c_min = 0.5;  // pull towards the own best (falls) and the best of all (rises)
  double w_max = 1.0, w_min = 0.0;  // staying as one is; falls
  double gamma = 0.2;               // adds to that, the less the swarm differs

  void check() const;  // throws std::invalid_argument
};

struct MemeticResult {
  Routes routes;
  std::int64_t evaluations = 0;
};

// Zhang et al.'s adaptive swarm with inheritance of fragments instead of arithmetic on task
// numbers, and a descent after mutation. Starts from random permutations and one given.
MemeticResult swarm_memetically(const Costs& costs, int seats, const Routes& start,
                                const MemeticParams& params, std::uint64_t seed, Budget& budget);

// For each value that several coordinates hold, one holder is drawn that keeps it; the others get
// the missing values in random order.
void repair(Permutation& permutation, Random& random);

}  // namespace clearway::assign
