#include "clearway/multi/cell_holds.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace clearway;

namespace {

// A row of ten cells; a step takes 10 ticks.
CellHolds row(bool wide = false) { return CellHolds(10, 2, 3, 10, wide); }

// From cell to cell without waits, at rest for good in the last one.
std::vector<CellStay> drive(std::vector<int> cells, Ticks begin) {
  std::vector<CellStay> route;
  for (const int cell : cells) {
    route.push_back({cell, begin, begin, begin, begin});
    begin += 10;
  }
  route.back().depart = kNever;
  return route;
}

}  // namespace

TEST_CASE("A follower straight on may enter as the one ahead leaves, and no sooner") {
  CellHolds holds = row();
  holds.put(0, drive({1, 2, 3, 4, 5, 6, 7}, 0));
  CHECK(holds.clashes(1, drive({0, 1, 2, 3}, 0)).empty());
  const auto found = holds.clashes(1, drive({0, 1, 2, 3}, -1));
  REQUIRE(!found.empty());
  CHECK(found[0].other == 0);
  CHECK(found[0].index == 1);
  CHECK(found[0].other_index == 0);
}

TEST_CASE("Who comes from the side enters when the one ahead has arrived behind the cell") {
  CellHolds holds = row();
  holds.put(0, drive({2, 3, 4, 5}, 0));  // holds cell 4 in [10, 30]
  CHECK(holds.clashes(1, drive({14, 4}, 29)).size() == 1);
  CHECK(holds.clashes(1, drive({14, 4}, 30)).empty());
}

TEST_CASE("Robots head-on clash in both cells") {
  CellHolds holds = row();
  holds.put(0, drive({3, 4, 5, 6}, 0));
  CHECK(holds.clashes(1, drive({6, 5, 4, 14}, 0)).size() == 2);
}

TEST_CASE("The least delay lets the other pass, or is none where it comes to the waiting place") {
  CellHolds holds = row();
  holds.put(0, drive({3, 4, 5, 6}, 0));  // arrives in cell 5 at 20 and leaves it until 30
  CHECK(holds.least_delay(1, drive({15, 5, 4}, 0), 0, 0) == 30);
  CHECK(holds.least_delay(1, drive({5, 4, 14}, 0), 0, 0) == -1);
  CHECK(holds.clashes(1, delayed(drive({15, 5, 4}, 0), 0, 30)).empty());
}

TEST_CASE("Nobody goes first where another was granted a cell") {
  CellHolds holds = row();
  holds.put(0, drive({3, 4, 5, 6, 7}, 100));  // begins to hold cell 5 at 110
  const auto crossing = drive({15, 5, 6, 16}, 0);
  CHECK(holds.clashes(1, crossing).empty());
  CHECK(holds.clashes(1, crossing, 110).empty());
  CHECK(holds.clashes(1, crossing, 111).size() == 1);
}

TEST_CASE("Wide bodies do not turn side by side") {
  for (const bool wide : {false, true}) {
    CellHolds holds = row(wide);
    holds.put(0, {{3, 0, 20, 10, 20}, {13, 30, kNever, 30, 30}});
    const std::vector<CellStay> beside = {{4, 0, 15, 5, 15}, {14, 25, kNever, 25, 25}};
    CHECK(holds.clashes(1, beside).size() == (wide ? 1 : 0));
    CHECK(holds.least_delay(1, beside, 0, 0) == (wide ? 15 : 0));
  }
}

TEST_CASE("Routes that are none are refused, and a new route replaces the old one") {
  CellHolds holds = row();
  CHECK_THROWS_AS(holds.put(0, {}), std::invalid_argument);
  CHECK_THROWS_AS(holds.put(0, drive({0, 2}, 0)), std::invalid_argument);
  CHECK_THROWS_AS(holds.put(0, drive({9, 10}, 0)), std::invalid_argument);
  CHECK_THROWS_AS(holds.put(3, drive({0, 1}, 0)), std::invalid_argument);
  holds.put(0, drive({0, 1, 2}, 0));
  holds.put(0, drive({7, 8}, 0));
  CHECK(holds.clashes(1, drive({0, 1, 2}, 0)).empty());
  CHECK(holds.holders(8, 1000) == std::vector<int>{0});
  holds.remove(0);
  CHECK(holds.holders(8, 1000).empty());
}
