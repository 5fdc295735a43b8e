#include "clearway/search/route_search.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace clearway {

RouteSearch::RouteSearch(int width, int height, std::vector<std::uint8_t> lanes, Ticks step,
                         Ticks turn)
    : width_(width),
      height_(height),
      lanes_(std::move(lanes)),
      step_(step),
      turn_(turn),
      offset_{1, width, -1, -width} {
  if (width < 1 || height < 1 ||
      lanes_.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw std::invalid_argument("lanes must have width times height cells, at least one");
  }
  if (step < 1 || turn < 0) throw std::invalid_argument("step must be above 0 and turn not below");
  states_.resize(4 * lanes_.size());
}

Ticks RouteSearch::estimate(std::int32_t cell, std::int32_t goal) const {
  const int across = std::abs(cell % width_ - goal % width_);
  const int along = std::abs(cell / width_ - goal / width_);
  return step_ * (across + along);
}

bool RouteSearch::later(std::int32_t a, std::int32_t b) const {
  const Node& x = nodes_[static_cast<std::size_t>(a)];
  const Node& y = nodes_[static_cast<std::size_t>(b)];
  if (x.f != y.f) return x.f > y.f;
  if (x.g != y.g) return x.g < y.g;
  if (x.rank != y.rank) return x.rank > y.rank;
  return a > b;
}

void RouteSearch::push(const Node& node) {
  open_.push_back(static_cast<std::int32_t>(nodes_.size()));
  nodes_.push_back(node);
  std::push_heap(open_.begin(), open_.end(),
                 [this](std::int32_t a, std::int32_t b) { return later(a, b); });
}

std::vector<std::int32_t> RouteSearch::route_to(std::int32_t node) const {
  std::vector<std::int32_t> cells;
  for (; node >= 0; node = nodes_[static_cast<std::size_t>(node)].parent) {
    cells.push_back(nodes_[static_cast<std::size_t>(node)].cell);
  }
  std::reverse(cells.begin(), cells.end());
  return cells;
}

std::vector<std::int32_t> RouteSearch::operator()(std::span<const std::uint8_t> moves,
                                                  std::int32_t start, std::int32_t goal,
                                                  int heading) {
  const auto size = static_cast<std::int32_t>(lanes_.size());
  if (moves.size() != lanes_.size())
    throw std::invalid_argument("moves must be of the lanes' size");
  if (std::min(start, goal) < 0 || std::max(start, goal) >= size) {
    throw std::invalid_argument("start and goal must be cells of the grid");
  }
  if (heading < kAnyHeading || heading > 3) throw std::invalid_argument("heading must be -1 to 3");
  if (++round_ == 0) {  // after 2^32 searches stamps repeat
    std::fill(states_.begin(), states_.end(), State{});
    round_ = 1;
  }
  nodes_.clear();
  open_.clear();
  expansions_ = 0;
  push({estimate(start, goal), 0, start, -1, static_cast<std::int8_t>(heading), 0});
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(),
                  [this](std::int32_t a, std::int32_t b) { return later(a, b); });
    const std::int32_t number = open_.back();
    open_.pop_back();
    const Node node = nodes_[static_cast<std::size_t>(number)];
    if (node.cell == goal) return route_to(number);
    if (node.parent >= 0 || node.heading != kAnyHeading) {
      State& state = states_[static_cast<std::size_t>(4 * node.cell + node.heading)];
      if (state.round == round_ && state.closed) continue;
      state = {node.g, round_, true};
    }
    ++expansions_;
    const std::uint8_t legal = moves[static_cast<std::size_t>(node.cell)];
    const std::uint8_t lanes = lanes_[static_cast<std::size_t>(node.cell)];
    const int x = node.cell % width_, y = node.cell / width_;
    for (int k = 0; k < 4; ++k) {
      if ((legal >> k & 1) == 0) continue;
      if ((k == 0 && x == width_ - 1) || (k == 1 && y == height_ - 1) || (k == 2 && x == 0) ||
          (k == 3 && y == 0)) {
        throw std::invalid_argument("a move leads off the grid");
      }
      int quarters = node.heading == kAnyHeading ? 0 : (k - node.heading) & 3;
      if (quarters == 3) quarters = 1;
      const Ticks g = node.g + step_ + turn_ * quarters;
      const std::int32_t cell = node.cell + offset_[static_cast<std::size_t>(k)];
      State& state = states_[static_cast<std::size_t>(4 * cell + k)];
      if (state.round == round_ && (state.closed || g > state.g)) continue;
      state = {g, round_, false};
      const bool off_lane = (lanes >> k & 1) == 0;
      push({g + estimate(cell, goal), g, cell, number, static_cast<std::int8_t>(k),
            static_cast<std::uint8_t>(2 * quarters + (off_lane ? 1 : 0))});
    }
  }
  return {};
}

}  // namespace clearway
