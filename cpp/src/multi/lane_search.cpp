#include "clearway/multi/lane_search.hpp"

#include <cmath>
#include <stdexcept>

namespace clearway {

namespace {

int quarters(Direction from, Direction to) {
  const int turn = (to - from + 4) % 4;
  return turn == 3 ? 1 : turn;
}

}  // namespace

LaneSearch::LaneSearch(const CellHolds* holds, std::vector<std::uint8_t> may_wait, Ticks turn)
    : holds_(holds), may_wait_(std::move(may_wait)), turn_(turn) {
  const auto cells = static_cast<std::size_t>(holds->width()) * holds->height();
  if (may_wait_.size() != cells)
    throw std::invalid_argument("may_wait must have one value per cell");
  if (turn < 0) throw std::invalid_argument("a turn must not take less than no time");
  slots_.resize(4 * cells);
}

Ticks LaneSearch::estimate(int cell) const {
  const int width = holds_->width();
  return holds_->step() * (std::abs(cell % width - query_.goal % width) +
                           std::abs(cell / width - query_.goal / width));
}

LaneWay LaneSearch::operator()(const std::uint8_t* moves, const LaneQuery& query,
                               std::int64_t limit) {
  moves_ = moves;
  query_ = query;
  nodes_.clear();
  entries_.clear();
  open_.clear();
  if (++epoch_ == 0) {
    std::fill(slots_.begin(), slots_.end(), Slot{});
    epoch_ = 1;
  }
  const auto later = [](const Open& a, const Open& b) {
    if (a.f != b.f) return a.f > b.f;
    if (a.arrive != b.arrive) return a.arrive < b.arrive;
    return a.node > b.node;
  };
  Node start;
  start.cell = query.start;
  start.arrive = query.now;
  for (int id = holds_->first(start.cell); id >= 0; id = holds_->hold(id).next)
    if (holds_->hold(id).robot != query.robot && holds_->hold(id).end <= query.now)
      start.before = id;
  nodes_.push_back(start);
  open_.push_back({query.now + estimate(start.cell), query.now, 0});

  std::int64_t expansions = 0;
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), later);
    const int best = open_.back().node;
    open_.pop_back();
    Node& node = nodes_[static_cast<std::size_t>(best)];
    if (node.closed) continue;
    node.closed = true;
    if (node.cell == query.goal && best != 0) {
      LaneWay way = way_to(best);
      way.expansions = expansions;
      return way;
    }
    if (expansions >= limit) break;
    ++expansions;
    const std::size_t known = nodes_.size();
    expand(best);
    for (std::size_t i = known; i < nodes_.size(); ++i) {
      const Node& n = nodes_[i];
      const Ticks f = n.cell == query.goal ? last_turn(n).end : n.arrive + estimate(n.cell);
      open_.push_back({f, n.arrive, static_cast<int>(i)});
      std::push_heap(open_.begin(), open_.end(), later);
    }
  }
  LaneWay none;
  none.expansions = expansions;
  return none;
}

void LaneSearch::expand(int node) {
  const Node from = nodes_[static_cast<std::size_t>(node)];
  const auto around = holds_->beside(from.cell);
  for (Direction d = 0; d < 4; ++d) {
    if (!(moves_[from.cell] >> d & 1) || around[d] < 0) continue;
    const Ticks turn =
        from.heading == kNowhere ? query_.first_turn[d] : turn_ * quarters(from.heading, d);
    passage_.assign(1, Entry{around[d], d, 0, turn});
    extend(node);
  }
}

// Lengthens the passage until it comes to where one may wait.
void LaneSearch::extend(int node) {
  const Entry last = passage_.back();
  if (last.cell == query_.goal || may_wait_[static_cast<std::size_t>(last.cell)] != 0) {
    place(node);
    return;
  }
  const auto around = holds_->beside(last.cell);
  for (Direction d = 0; d < 4; ++d) {
    if (!(moves_[last.cell] >> d & 1) || around[d] < 0 || around[d] == query_.start) continue;
    const auto again = [&](const Entry& e) { return e.cell == around[d]; };
    if (std::any_of(passage_.begin(), passage_.end(), again)) continue;
    const Ticks turn = turn_ * quarters(last.in, d);
    passage_.push_back({around[d], d, last.begin + holds_->step() + turn, turn});
    extend(node);
    passage_.pop_back();
  }
}

// First moment from `begin` on at which a robot may set out to a cell that it leaves `stay` later.
LaneSearch::Fit LaneSearch::fit(const Entry& entry, Ticks begin, Ticks stay, Direction out) const {
  const Ticks step = holds_->step();
  Fit found{begin, -1, -1};
  for (int id = holds_->first(entry.cell); id >= 0; id = holds_->hold(id).next) {
    const Hold& other = holds_->hold(id);
    if (other.robot == query_.robot) continue;
    const Ticks gone = found.begin + stay;
    const bool follows = out == kNowhere || out == other.in;
    if (gone + (follows ? 0 : step) <= other.begin && other.begin >= query_.granted) return found;
    const Ticks free = other.free_from(entry.in, step);
    found.before = id;
    if (free > found.begin) {
      found.begin = free;
      found.behind = other.robot;
    }
  }
  return found;
}

Ticks LaneSearch::turn_free_from(int cell, Ticks begin, Ticks length, int* behind) const {
  if (!holds_->is_wide() || length == 0) return begin;
  for (bool moved = true; moved;) {
    moved = false;
    for (const int next : holds_->beside(cell)) {
      for (int id = next < 0 ? -1 : holds_->first(next); id >= 0; id = holds_->hold(id).next) {
        const Hold& other = holds_->hold(id);
        if (other.robot == query_.robot || other.turn_begin == other.turn_end) continue;
        if (other.turn_begin < begin + length && begin < other.turn_end) {
          begin = other.turn_end;
          *behind = other.robot;
          moved = true;
        }
      }
    }
  }
  return begin;
}

int LaneSearch::successor(int hold) const {
  while (hold >= 0 && holds_->hold(hold).robot == query_.robot) hold = holds_->hold(hold).next;
  return hold;
}

Ticks LaneSearch::latest_departure(const Node& node, Direction out) const {
  const int next =
      successor(node.before < 0 ? holds_->first(node.cell) : holds_->hold(node.before).next);
  if (next < 0) return kNever - 1;
  const Hold& other = holds_->hold(next);
  return other.in == out ? other.begin : other.begin - holds_->step();
}

// Drives the passage at every moment at which that leads to another interval of its last cell.
void LaneSearch::place(int node) {
  const Node from = nodes_[static_cast<std::size_t>(node)];
  const std::size_t last = passage_.size() - 1;
  const Ticks latest = latest_departure(from, passage_[0].in);
  Ticks depart = from.arrive + passage_[0].turn;
  int behind = -1;
  const bool ends = passage_[last].cell == query_.goal;
  while (depart <= latest) {
    Ticks wanted = depart;
    const auto later = [&](Ticks begin, int who) {
      if (begin > wanted) {
        wanted = begin;
        behind = who;
      }
    };
    int at = from.cell;
    for (std::size_t k = 0; k <= last; ++k) {
      const Entry& entry = passage_[k];
      int who = -1;
      const Ticks turned = turn_free_from(at, wanted + entry.begin - entry.turn, entry.turn, &who);
      later(turned + entry.turn - entry.begin, who);
      at = entry.cell;
      if (k == last) break;
      const Entry& next = passage_[k + 1];
      const Fit found = fit(entry, wanted + entry.begin, next.begin - entry.begin, next.in);
      if (found.begin >= kNever) return;  // somebody rests there
      later(found.begin - entry.begin, found.behind);
    }
    const Entry& end = passage_[last];
    // At the goal it stays for good.
    const Ticks stay = ends ? kNever - wanted - end.begin : holds_->step();
    const Fit found = fit(end, wanted + end.begin, stay, kNowhere);
    if (found.begin >= kNever) return;
    later(found.begin - end.begin, found.behind);
    if (wanted > depart) {
      depart = wanted;
      continue;
    }
    reach(node, depart, found.before, behind);
    const int next =
        successor(found.before < 0 ? holds_->first(end.cell) : holds_->hold(found.before).next);
    if (next < 0) break;
    const Hold& other = holds_->hold(next);
    if (other.end >= kNever) break;
    depart = std::max(depart + 1, other.free_from(end.in, holds_->step()) - end.begin);
    behind = other.robot;
  }
}

void LaneSearch::reach(int parent, Ticks depart, int before, int behind) {
  const Entry& end = passage_.back();
  Node node;
  node.cell = end.cell;
  node.heading = end.in;
  node.before = before;
  node.depart = depart;
  node.arrive = depart + end.begin + holds_->step();
  const Node& from = nodes_[static_cast<std::size_t>(parent)];
  node.behind = depart > from.arrive + passage_[0].turn ? behind : -1;
  node.parent = parent;
  Slot& slot = slots_[4 * static_cast<std::size_t>(end.cell) + static_cast<std::size_t>(end.in)];
  if (slot.epoch != epoch_) slot = {epoch_, -1};
  for (int other = slot.node; other >= 0; other = nodes_[static_cast<std::size_t>(other)].next) {
    Node& known = nodes_[static_cast<std::size_t>(other)];
    if (known.before != before) continue;
    if (known.arrive <= node.arrive) return;
    known.closed = true;  // the newcomer takes its place
  }
  node.first_entry = static_cast<int>(entries_.size());
  node.num_entries = static_cast<int>(passage_.size());
  entries_.insert(entries_.end(), passage_.begin(), passage_.end());
  node.next = slot.node;
  slot.node = static_cast<int>(nodes_.size());
  nodes_.push_back(node);
}

// At the goal it turns as soon as it may.
LaneSearch::Turn LaneSearch::last_turn(const Node& node) const {
  Turn turn;
  const Ticks length = query_.last_turn[static_cast<std::size_t>(node.heading)];
  turn.begin = turn_free_from(node.cell, node.arrive, length, &turn.behind);
  turn.end = turn.begin + length;
  return turn;
}

LaneWay LaneSearch::way_to(int node) const {
  std::vector<int> chain;
  for (int n = node; n > 0; n = nodes_[static_cast<std::size_t>(n)].parent) chain.push_back(n);
  LaneWay way;
  way.found = true;
  way.stays.push_back({query_.start, query_.now, query_.now, query_.now, query_.now});
  way.behind.push_back(-1);
  for (auto it = chain.rbegin(); it != chain.rend(); ++it) {
    const Node& n = nodes_[static_cast<std::size_t>(*it)];
    way.behind.back() = n.behind;
    for (int k = 0; k < n.num_entries; ++k) {
      const Entry& entry = entries_[static_cast<std::size_t>(n.first_entry + k)];
      CellStay& before = way.stays.back();
      before.depart = n.depart + entry.begin;
      before.turn_begin = before.depart - entry.turn;
      before.turn_end = before.depart;
      const Ticks arrive = before.depart + holds_->step();
      way.stays.push_back({entry.cell, arrive, kNever, arrive, arrive});
      way.behind.push_back(-1);
    }
  }
  CellStay& goal = way.stays.back();
  const Turn last = last_turn(nodes_[static_cast<std::size_t>(node)]);
  goal.turn_begin = last.begin;
  goal.turn_end = last.end;
  way.behind.back() = last.behind;
  way.ready = last.end;
  return way;
}

}  // namespace clearway
