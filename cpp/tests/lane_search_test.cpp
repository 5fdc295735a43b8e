#include "clearway/multi/lane_search.hpp"

#include <doctest/doctest.h>

using namespace clearway;

namespace {

constexpr std::uint8_t kEast = 1, kNorth = 2;

}  // namespace

TEST_CASE("A robot waits before a crossing until the cell behind it is free") {
  // Five cells in a row, the third a crossing; another rests behind it until tick 100.
  CellHolds holds(5, 2, 2, 10, false);
  holds.put(1, {{3, 0, 100, 100, 100}, {8, 110, kNever, 110, 110}});
  LaneSearch search(&holds, {1, 1, 0, 1, 1, 1, 1, 1, 1, 1}, 0);
  const std::vector<std::uint8_t> moves(10, kEast);
  LaneQuery query;
  query.start = 0;
  query.goal = 4;
  const LaneWay way = search(moves.data(), query, 100);
  REQUIRE(way.found);
  // It enters cell 3, which the other leaves aside, from 110 on.
  CHECK(way.stays[1].depart == 100);
  CHECK(way.stays[2].arrive == way.stays[2].depart);
  CHECK(way.ready == 130);
  CHECK(way.behind[1] == 1);
}

TEST_CASE("A goal that another rests at has no way, and neither has one out of reach") {
  CellHolds holds(4, 1, 2, 10, false);
  LaneSearch search(&holds, {1, 1, 1, 1}, 0);
  const std::vector<std::uint8_t> east(4, kEast), north(4, kNorth);
  LaneQuery query;
  query.goal = 3;
  CHECK(search(east.data(), query, 100).ready == 30);
  CHECK(!search(north.data(), query, 100).found);
  CHECK(!search(east.data(), query, 1).found);
  holds.put(1, {{3, 0, kNever, 0, 0}});
  CHECK(!search(east.data(), query, 100).found);
}

TEST_CASE("Turns take their time, the first and the last one as told") {
  CellHolds holds(2, 2, 1, 10, false);
  LaneSearch search(&holds, {1, 1, 1, 1}, 5);
  const std::vector<std::uint8_t> moves = {kEast, kNorth, 0, 0};
  LaneQuery query;
  query.goal = 3;
  query.now = 100;
  query.first_turn = {7, 0, 0, 0};
  query.last_turn = {0, 3, 0, 0};
  const LaneWay way = search(moves.data(), query, 100);
  REQUIRE(way.stays.size() == 3);
  CHECK(way.stays[0].depart == 107);
  CHECK(way.stays[1].turn_begin == 117);
  CHECK(way.stays[1].depart == 122);
  CHECK(way.ready == 135);
}
