#include "clearway/search/route_search.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace clearway;

namespace {

constexpr std::uint8_t kEast = 1, kNorth = 2, kWest = 4, kSouth = 8;
using Cells = std::vector<std::int32_t>;
using Bits = std::vector<std::uint8_t>;

// Every move that stays on the floor.
Bits open_floor(int width, int height) {
  Bits moves;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int bits = 0;
      if (x + 1 < width) bits |= kEast;
      if (y + 1 < height) bits |= kNorth;
      if (x > 0) bits |= kWest;
      if (y > 0) bits |= kSouth;
      moves.push_back(static_cast<std::uint8_t>(bits));
    }
  }
  return moves;
}

}  // namespace

TEST_CASE("Of two ways of one length the one with fewer turns is taken, then straight ahead") {
  // Five columns, two rows; the lower row is closed to the east of its second cell.
  Bits moves(10, 0);
  moves[0] = kEast | kNorth;
  moves[1] = kNorth;
  for (const int cell : {5, 6, 7, 8}) moves[static_cast<std::size_t>(cell)] = kEast;
  RouteSearch search(5, 2, Bits(10, 0), 1000, 1000);
  // Heading north, one turn at the top; by the second cell there would be three.
  CHECK(search(moves, 0, 9, 1) == Cells{0, 5, 6, 7, 8, 9});
  // Heading east two turns either way, then the way that begins straight ahead.
  CHECK(search(moves, 0, 9, 0) == Cells{0, 1, 6, 7, 8, 9});
}

TEST_CASE("Searches leave nothing behind for the next one") {
  RouteSearch used(6, 6, Bits(36, 0), 1000, 500);
  const Bits moves = open_floor(6, 6);
  for (std::int32_t start = 0; start < 36; ++start) {
    for (std::int32_t goal = 0; goal < 36; ++goal) {
      RouteSearch fresh(6, 6, Bits(36, 0), 1000, 500);
      const int heading = (start + goal) % 5 - 1;
      CHECK(used(moves, start, goal, heading) == fresh(moves, start, goal, heading));
      CHECK(used.expansions() == fresh.expansions());
    }
  }
}

TEST_CASE("Straight ahead in the open a route expands its own cells only") {
  RouteSearch search(40, 40, Bits(1600, 0), 1000, 0);
  CHECK(search(open_floor(40, 40), 0, 1599, 0).size() == 79);
  CHECK(search.expansions() == 78);
}

TEST_CASE("What is no grid, no cell or no heading is refused") {
  CHECK_THROWS_AS(RouteSearch(3, 2, Bits(5, 0), 1, 0), std::invalid_argument);
  CHECK_THROWS_AS(RouteSearch(3, 2, Bits(6, 0), 0, 0), std::invalid_argument);
  CHECK_THROWS_AS(RouteSearch(3, 2, Bits(6, 0), 1, -1), std::invalid_argument);
  RouteSearch search(3, 2, Bits(6, 0), 1, 0);
  CHECK_THROWS_AS(search(Bits(5, 0), 0, 1, 0), std::invalid_argument);
  CHECK_THROWS_AS(search(Bits(6, 0), 0, 6, 0), std::invalid_argument);
  CHECK_THROWS_AS(search(Bits(6, 0), -1, 0, 0), std::invalid_argument);
  CHECK_THROWS_AS(search(Bits(6, 0), 0, 1, 4), std::invalid_argument);
  CHECK_THROWS_AS(search(Bits(6, kWest), 0, 1, 0), std::invalid_argument);
}
