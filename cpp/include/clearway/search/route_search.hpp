// Best route over square cells with legal moves: A* that counts quarter turns.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clearway/motion/table.hpp"

namespace clearway {

// The "improved A*" of Yu, Liao, Zu (2024), Systems 12(1), 9, Sec. 4.1: what improves it is the map
// of legal moves, made for each pair of start and goal. A state is a cell and the heading in which
// it was entered, so that turns are priced rightly; the estimate is the Manhattan distance, which
// is consistent, so the first arrival at a state is the best one.
//
// Among nodes of equal estimated cost the one farther from the start goes first, then straight
// ahead, then along a lane, then the one met first: a route is the same whenever it is asked for.
class RouteSearch {
 public:
  // Moves are bits, counter-clockwise from x: east, north, west, south; headings are their numbers.
  static constexpr int kAnyHeading = -1;

  // `lanes`: bits of the lanes of each cell, row by row. `step`, `turn`: ticks to the next cell,
  // and for a turn by 90 degrees.
  RouteSearch(int width, int height, std::vector<std::uint8_t> lanes, Ticks step, Ticks turn);

  // Cells from start to goal, both among them; empty where no way exists. `moves`: bits of the
  // legal moves out of each cell.
  std::vector<std::int32_t> operator()(std::span<const std::uint8_t> moves, std::int32_t start,
                                       std::int32_t goal, int heading);

  std::int64_t expansions() const { return expansions_; }
  int width() const { return width_; }
  std::size_t num_cells() const { return lanes_.size(); }

 private:
  struct Node {
    Ticks f, g;
    std::int32_t cell, parent;  // parent: number of a node, -1 at the start
    std::int8_t heading;
    std::uint8_t rank;  // 2 per quarter turn, 1 off the lanes: less goes first
  };
  struct State {
    Ticks g = 0;
    std::uint32_t round = 0;  // of an earlier search: not reached
    bool closed = false;
  };

  Ticks estimate(std::int32_t cell, std::int32_t goal) const;
  bool later(std::int32_t a, std::int32_t b) const;
  void push(const Node& node);
  std::vector<std::int32_t> route_to(std::int32_t node) const;

  int width_, height_;
  std::vector<std::uint8_t> lanes_;
  Ticks step_, turn_;
  std::array<std::int32_t, 4> offset_;
  std::vector<State> states_;  // four headings per cell
  std::uint32_t round_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> open_;  // heap of node numbers
  std::int64_t expansions_ = 0;
};

}  // namespace clearway
