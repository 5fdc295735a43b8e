#include "clearway/multi/cell_holds.hpp"

#include <stdexcept>
#include <string>

namespace clearway {

CellHolds::CellHolds(int width, int height, int num_robots, Ticks step, bool wide)
    : width_(width), height_(height), step_(step), wide_(wide) {
  if (width < 1 || height < 1) throw std::invalid_argument("a grid has at least one cell");
  if (num_robots < 0) throw std::invalid_argument("the number of robots must not be negative");
  if (step < 1) throw std::invalid_argument("a step must take at least a tick");
  heads_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -1);
  routes_.resize(static_cast<std::size_t>(num_robots));
}

std::size_t CellHolds::checked(int robot) const {
  if (robot < 0 || static_cast<std::size_t>(robot) >= routes_.size())
    throw std::invalid_argument("there is no robot " + std::to_string(robot));
  return static_cast<std::size_t>(robot);
}

std::array<int, 4> CellHolds::beside(int cell) const {
  const int x = cell % width_;
  return {x + 1 < width_ ? cell + 1 : -1,
          cell + width_ < static_cast<int>(heads_.size()) ? cell + width_ : -1,
          x > 0 ? cell - 1 : -1, cell - width_ >= 0 ? cell - width_ : -1};
}

void CellHolds::check(const std::vector<CellStay>& route) const {
  if (route.empty()) throw std::invalid_argument("a route has at least one cell");
  for (std::size_t i = 0; i < route.size(); ++i) {
    const CellStay& stay = route[i];
    if (stay.cell < 0 || stay.cell >= static_cast<int>(heads_.size()))
      throw std::invalid_argument("there is no cell " + std::to_string(stay.cell));
    if (stay.depart < stay.arrive)
      throw std::invalid_argument("a route leaves cell " + std::to_string(stay.cell) +
                                  " before it arrives");
    if (i == 0) continue;
    const auto around = beside(route[i - 1].cell);
    if (std::find(around.begin(), around.end(), stay.cell) == around.end())
      throw std::invalid_argument("a route jumps to cell " + std::to_string(stay.cell));
    if (stay.arrive <= route[i - 1].depart)
      throw std::invalid_argument("a route takes no time to cell " + std::to_string(stay.cell));
  }
}

Hold CellHolds::hold_of(const std::vector<CellStay>& route, std::size_t i) const {
  const auto towards = [&](std::size_t k) {
    const auto around = beside(route[k].cell);
    return static_cast<Direction>(std::find(around.begin(), around.end(), route[k + 1].cell) -
                                  around.begin());
  };
  const CellStay& stay = route[i];
  Hold hold;
  hold.begin = i == 0 ? stay.arrive : route[i - 1].depart;
  hold.leave = stay.depart;
  hold.end = i + 1 < route.size() ? route[i + 1].arrive : kNever;
  hold.turn_begin = stay.turn_begin;
  hold.turn_end = stay.turn_end;
  hold.index = static_cast<int>(i);
  hold.in = i == 0 ? kNowhere : towards(i - 1);
  hold.out = i + 1 < route.size() ? towards(i) : kNowhere;
  return hold;
}

void CellHolds::put(int robot, const std::vector<CellStay>& route) {
  checked(robot);
  check(route);
  remove(robot);
  for (std::size_t i = 0; i < route.size(); ++i) {
    Hold hold = hold_of(route, i);
    hold.robot = robot;
    int* link = &heads_[static_cast<std::size_t>(route[i].cell)];
    while (*link >= 0 && holds_[static_cast<std::size_t>(*link)].begin <= hold.begin)
      link = &holds_[static_cast<std::size_t>(*link)].next;
    hold.next = *link;
    if (spare_.empty()) {
      *link = static_cast<int>(holds_.size());
      holds_.push_back(hold);
    } else {
      *link = spare_.back();
      holds_[static_cast<std::size_t>(spare_.back())] = hold;
      spare_.pop_back();
    }
  }
  routes_[static_cast<std::size_t>(robot)] = route;
}

void CellHolds::remove(int robot) {
  std::vector<CellStay>& route = routes_[checked(robot)];
  for (const CellStay& stay : route) {
    int* link = &heads_[static_cast<std::size_t>(stay.cell)];
    while (*link >= 0) {
      Hold& hold = holds_[static_cast<std::size_t>(*link)];
      if (hold.robot == robot) {
        spare_.push_back(*link);
        *link = hold.next;
      } else {
        link = &hold.next;
      }
    }
  }
  route.clear();
}

bool CellHolds::meet(const Hold& mine, const Hold& theirs, Ticks granted) const {
  return mine.begin < theirs.free_from(mine.in, step_) &&
         theirs.begin < std::max(mine.free_from(theirs.in, step_), granted);
}

std::vector<Clash> CellHolds::clashes(int robot, const std::vector<CellStay>& route,
                                      Ticks granted) const {
  checked(robot);
  check(route);
  std::vector<Clash> found;
  for (std::size_t i = 0; i < route.size(); ++i) {
    const Hold mine = hold_of(route, i);
    for (int id = first(route[i].cell); id >= 0; id = hold(id).next) {
      const Hold& theirs = hold(id);
      if (theirs.robot != robot && meet(mine, theirs, granted))
        found.push_back({route[i].cell, mine.index, theirs.robot, theirs.index,
                         std::max(mine.begin, theirs.begin)});
    }
    if (!wide_ || mine.turn_begin == mine.turn_end) continue;
    for (const int next : beside(route[i].cell)) {
      for (int id = next < 0 ? -1 : first(next); id >= 0; id = hold(id).next) {
        const Hold& theirs = hold(id);
        const Ticks both = std::max(mine.turn_begin, theirs.turn_begin);
        if (theirs.robot != robot && both < std::min(mine.turn_end, theirs.turn_end))
          found.push_back({next, mine.index, theirs.robot, theirs.index, both});
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Clash& a, const Clash& b) { return a.at < b.at; });
  return found;
}

std::vector<CellStay> delayed(std::vector<CellStay> route, std::size_t index, Ticks by) {
  for (std::size_t i = index; i < route.size(); ++i) {
    CellStay& stay = route[i];
    if (i > index) stay.arrive += by;
    if (stay.depart < kNever) stay.depart += by;
    stay.turn_begin += by;
    stay.turn_end += by;
  }
  return route;
}

Ticks CellHolds::least_delay(int robot, const std::vector<CellStay>& route, std::size_t index,
                             int other, Ticks granted) const {
  checked(robot);
  checked(other);
  check(route);
  if (index + 1 >= route.size()) throw std::invalid_argument("nobody goes on from a last cell");
  Ticks by = 0;
  // Each round passes one of the other's holds or turns for good, so there are not many.
  for (bool again = true; again;) {
    again = false;
    const std::vector<CellStay> later = delayed(route, index, by);
    for (std::size_t i = index; i < later.size() && !again; ++i) {
      const Hold mine = hold_of(later, i);
      for (int id = first(later[i].cell); id >= 0 && !again; id = hold(id).next) {
        const Hold& theirs = hold(id);
        if (theirs.robot != other || !meet(mine, theirs, granted)) continue;
        if (i == index || theirs.end >= kNever) return -1;
        by += theirs.free_from(mine.in, step_) - mine.begin;
        again = true;
      }
      if (!wide_ || mine.turn_begin == mine.turn_end || again) continue;
      for (const int next : beside(later[i].cell)) {
        for (int id = next < 0 ? -1 : first(next); id >= 0 && !again; id = hold(id).next) {
          const Hold& theirs = hold(id);
          if (theirs.robot != other || mine.turn_begin >= theirs.turn_end ||
              theirs.turn_begin >= mine.turn_end)
            continue;
          by += theirs.turn_end - mine.turn_begin;
          again = true;
        }
      }
    }
  }
  return by;
}

std::vector<int> CellHolds::holders(int cell, Ticks from) const {
  std::vector<int> robots;
  for (int id = first(cell); id >= 0; id = hold(id).next)
    if (hold(id).end > from) robots.push_back(hold(id).robot);
  return robots;
}

}  // namespace clearway
