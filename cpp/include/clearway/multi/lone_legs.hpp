// How long single legs last with nobody else on the site.
#pragma once

#include <cstdint>
#include <vector>

#include "clearway/search/tour_search.hpp"

namespace clearway {

struct LoneLeg {
  Pose from, to;
  int body = 0;
};

// Ticks from each leg's start to its goal; -1 where no way is found with `limit` expansions.
// Fewer entries than legs: the budget ended. `margin` as in Team.
std::vector<Ticks> lone_durations(const Model& model, const SearchParams& params,
                                  const Objective& objective, double margin,
                                  const std::vector<LoneLeg>& legs, std::int64_t limit,
                                  Budget& budget);

}  // namespace clearway
