// Lower bound on the weighted sum of distances and turns, from spanning trees.
#pragma once

#include "clearway/assign/costs.hpp"

namespace clearway::assign {

// Routes form a tree from the starts in which no task has more than two neighbours; a least
// spanning tree with prices on neighbours beyond two costs no more.
// Source: M. Held, R. M. Karp, "The traveling-salesman problem and minimum spanning trees",
// Operations Research 18 (1970).
double spanning_bound(const Costs& costs);

}  // namespace clearway::assign
