// How much effort a search may spend.
#pragma once

#include <cstdint>
#include <functional>

namespace clearway {

// Counted in expansions; `stop` is asked now and then and ends the search when it says true.
struct Budget {
  std::int64_t expansions = -1;  // negative: unlimited
  std::function<bool()> stop;
  bool timed = false;   // whether `stop` will say so some time
  bool improve = true;  // whether effort that a first plan leaves is for a better one
  std::int64_t spent = 0;
  bool ended = false;

  // Counts one expansion; false when the effort is used up or a stop was asked for.
  bool spend() {
    if (!ended) {
      ended = (expansions >= 0 && spent >= expansions) || ((spent & 511) == 511 && stop && stop());
    }
    if (!ended) ++spent;
    return !ended;
  }
};

}  // namespace clearway
