#include "clearway/search/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace clearway {

namespace {

constexpr std::int32_t kUnknown = -3;
constexpr std::size_t kMostWords = 6;  // analytic connections looked at
constexpr double kSame = 1e-4;         // poses nearer than this are one (m)

bool tells_modes_apart(const MotionTable& table, const Objective& objective) {
  bool differ = !objective.time || table.switch_duration > 0;
  for (const Primitive& p : table.primitives) differ = differ || p.from != ~0ULL;
  for (const bool rest : table.rest) differ = differ || !rest;
  return differ;
}

}  // namespace

Lattice::Lattice(const Model& model, const Leg& leg, const Pose& start, bool last,
                 const Objective& objective, const LatticeParams& params)
    : model_(model),
      leg_(leg),
      start_(start),
      last_(last),
      objective_(objective),
      params_(params),
      headings_(model.table, model.bodies, start.theta),
      num_modes_(static_cast<int>(model.table.rest.size())),
      by_mode_(tells_modes_apart(model.table, objective)) {
  const Ticks pause = whole_slots(model.table.switch_duration);
  switch_slots_ = pause / params.slot;
  switch_cost_ = objective.time ? pause
                                : model.table.switch_cost(objective) +
                                      objective.waiting * pause / kTicksPerSecond;
  service_slots_ = whole_slots(leg.service) / params.slot;
  for (const Primitive& p : model.table.primitives) {
    primitives_.push_back({p.mode, p.twist, whole_slots(p.duration)});
    costs_.push_back(objective_of(model.table, objective, primitives_.back()));
  }
  node_at(start.x, start.y, headings_.index(start.theta));
}

std::int32_t Lattice::node_at(double x, double y, int k) {
  const auto fold = [](double v) {
    return static_cast<std::uint64_t>(std::llround(v / kSame)) & 0xfffffffULL;
  };
  const std::uint64_t key =
      fold(x - start_.x) << 36U | fold(y - start_.y) << 8U | static_cast<std::uint64_t>(k);
  const auto [at, is_new] = index_.try_emplace(key, num_nodes());
  if (is_new) {
    nodes_.push_back({x, y, k});
    targets_.resize(targets_.size() + primitives_.size(), kUnknown);
  }
  return at->second;
}

Pose Lattice::pose(std::int32_t node) const {
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  return {n.x, n.y, wrap(headings_.theta(n.k))};
}

Frame Lattice::frame(std::int32_t node) const {
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  return headings_.frame(n.x, n.y, n.k);
}

bool Lattice::may_follow(int mode, std::size_t motion) const {
  if (mode < 0 || motion >= primitives_.size()) return true;
  return model_.table.primitives[motion].from >> mode & 1U;
}

bool Lattice::is_clear(const Frame& from, const std::vector<Step>& steps) const {
  const Statics& statics = *model_.statics[static_cast<std::size_t>(leg_.body)];
  Frame at = from;
  for (const Step& step : steps) {
    if (step.mode < 0) continue;
    if (!statics.clear(body(), at, step.twist, leg_.required, step_slack(leg_.required))) {
      return false;
    }
    at = moved(at, step.twist);
  }
  return true;
}

std::int32_t Lattice::target(std::int32_t node, std::size_t motion) {
  if (motion >= primitives_.size()) return kGoal;
  const std::size_t slot = static_cast<std::size_t>(node) * primitives_.size() + motion;
  if (targets_[slot] != kUnknown) return targets_[slot];
  const Node n = nodes_[static_cast<std::size_t>(node)];
  const Statics& statics = *model_.statics[static_cast<std::size_t>(leg_.body)];
  std::int32_t to = kBlocked;
  if (headings_.surely_clear(statics, leg_.body, n.x, n.y, n.k, motion, leg_.required) ||
      is_clear(frame(node), {primitives_[motion]})) {
    const HeadingTable::Landing& landing = headings_.landing(n.k, motion);
    to = node_at(n.x + landing.dx, n.y + landing.dy, landing.k);
  }
  return targets_[slot] = to;
}

// Ways to the goal as if nothing stood there, cheapest first, switches of mode included.
void Lattice::aim(std::int32_t node) {
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  tried_.clear();
  if (std::hypot(n.x - leg_.goal.x, n.y - leg_.goal.y) > params_.shot_reach) return;
  connect(model_.table, objective_, pose(node), leg_.goal, kMostWords, tried_);
  std::stable_sort(tried_.begin(), tried_.end(),
                   [](const Shot& a, const Shot& b) { return a.cost < b.cost; });
}

// Whether a shot begins as some primitive does: then that one and a shot from its end are the way,
// so that no way is there twice.
bool Lattice::is_primitive(const Shot& shot) const {
  if (shot.steps.empty()) return false;
  const Step& first = shot.steps.front();
  for (const Step& p : primitives_) {
    if (p.mode != first.mode) continue;
    const double length = p.twist.length(), turn = std::abs(p.twist.c);
    const double share = length > 0.0 ? first.twist.length() / length
                                      : (turn > 0.0 ? std::abs(first.twist.c) / turn : 0.0);
    const Twist part = p.twist.part(share);
    if (share > 1.0 - 1e-9 && std::abs(part.a - first.twist.a) + std::abs(part.b - first.twist.b) +
                                      std::abs(part.c - first.twist.c) <
                                  1e-6) {
      return true;
    }
  }
  return false;
}

Lattice::Span Lattice::shots(std::int32_t node) {
  if (nodes_[static_cast<std::size_t>(node)].first_shot < 0) {
    const auto first = static_cast<std::int32_t>(shots_.size());
    const Frame from = frame(node);
    aim(node);
    for (Shot& shot : tried_) {
      if (shots_.size() - static_cast<std::size_t>(first) == params_.shot_words) break;
      if (is_primitive(shot) || !is_clear(from, shot.steps)) continue;
      const Ticks whole = whole_slots(shot.duration);
      // The rest of its last slot is driven, not stood.
      if (!shot.steps.empty()) shot.steps.back().duration += whole - shot.duration;
      const double drive = objective_.time ? whole : shot.cost;
      const double serve = objective_.time && !last_ ? service_slots_ * params_.slot : 0;
      shots_.push_back({std::move(shot.steps), whole, drive + serve});
    }
    nodes_[static_cast<std::size_t>(node)].first_shot = first;
    nodes_[static_cast<std::size_t>(node)].num_shots =
        static_cast<std::int32_t>(shots_.size()) - first;
  }
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  return {shots_.data() + n.first_shot, static_cast<std::size_t>(n.num_shots)};
}

Lattice::Way Lattice::way(std::int32_t node, std::size_t motion) {
  if (motion < primitives_.size()) {
    const Step& step = primitives_[motion];
    return {{&step, 1, step.duration},
            step.duration / params_.slot,
            step.mode,
            step.mode,
            costs_[motion]};
  }
  const Shooting& shot = shots(node).first[motion - primitives_.size()];
  const bool moves = !shot.steps.empty();
  return {{shot.steps.data(), shot.steps.size(), shot.duration},
          shot.duration / params_.slot + service_slots_,
          moves ? shot.steps.front().mode : -1,
          moves ? shot.steps.back().mode : -1,
          shot.cost};
}

Ticks Lattice::drives(std::int32_t node, const Way& way, bool arrives,
                      const Stretch& stretch) const {
  if (stretch.mode < 0) return arrives ? way.drive.duration : -1;
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  double x = n.x, y = n.y;
  Ticks t = 0;
  Frame at;
  for (std::size_t i = 0; i < way.drive.size; ++i) {
    const Step& step = way.drive.steps[i];
    const double length = step.twist.length();
    if (step.mode == stretch.mode && step.duration >= stretch.duration) {
      const double dx = stretch.start.x - x, dy = stretch.start.y - y, far = length + kSame;
      if (dx * dx + dy * dy <= far * far) {
        if (i == 0) at = frame(node);
        const Point local = at.to_local({stretch.start.x, stretch.start.y});
        const double turn = wrap(stretch.start.theta - std::atan2(at.s, at.c));
        const double done =
            step.twist.c != 0.0
                ? turn / step.twist.c
                : (local.x * step.twist.a + local.y * step.twist.b) / (length * length);
        const double begin = done * step.duration;
        const double share = static_cast<double>(stretch.duration) / step.duration;
        const Pose there = displacement(step.twist.part(done));
        if (begin >= -0.5 && begin + stretch.duration <= step.duration + 0.5 &&
            std::hypot(there.x - local.x, there.y - local.y) + std::abs(wrap(there.theta - turn)) <
                kSame &&
            std::abs(step.twist.a * share - stretch.twist.a) +
                    std::abs(step.twist.b * share - stretch.twist.b) +
                    std::abs(step.twist.c * share - stretch.twist.c) <
                kSame) {
          return t + static_cast<Ticks>(std::lround(begin));
        }
      }
    }
    if (i + 1 < way.drive.size) {
      at = moved(i == 0 ? frame(node) : at, step.twist);
      x = at.x;
      y = at.y;
    }
    t += step.duration;
  }
  return -1;
}

// Dijkstra from the goal over (pose, mode). Beside the modes of a pose stands its value for any
// mode, a switch included; shots are tested only when their turn comes.
bool Lattice::look_back(const std::vector<double>& after) {
  const std::size_t count = primitives_.size();
  std::vector<std::int32_t> first_before;
  for (std::int32_t n = 0; n < num_nodes(); ++n) {
    if (num_nodes() > params_.most_nodes) return false;
    for (std::size_t p = 0; p < count; ++p) target(n, p);
  }
  const auto size = static_cast<std::size_t>(num_nodes());
  first_before.assign(size + 1, 0);
  for (const std::int32_t to : targets_) {
    if (to >= 0) ++first_before[static_cast<std::size_t>(to) + 1];
  }
  for (std::size_t n = 0; n < size; ++n) first_before[n + 1] += first_before[n];
  std::vector<std::int32_t> before(static_cast<std::size_t>(first_before[size]));
  std::vector<std::int32_t> filled(first_before.begin(), first_before.end() - 1);
  for (std::size_t slot = 0; slot < targets_.size(); ++slot) {
    if (targets_[slot] < 0) continue;
    before[static_cast<std::size_t>(filled[static_cast<std::size_t>(targets_[slot])]++)] =
        static_cast<std::int32_t>(slot);
  }
  const std::size_t wide = stride();
  const double change = by_mode_ ? switch_cost_ : 0.0;
  const double least_after = *std::min_element(after.begin(), after.end());
  // Per pose: any mode first, then each mode. Values are final once settled.
  std::vector<float> value(size * wide, std::numeric_limits<float>::infinity());
  std::vector<std::uint8_t> settled(size * wide, 0);
  struct Entry {
    double value;
    std::int64_t state;  // negative: shots of pose -1 - state are due
    bool operator>(const Entry& other) const { return value > other.value; }
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto offer = [&](std::size_t node, int mode, double v) {
    const std::size_t any = node * wide;
    const auto put = [&](std::size_t state, double w) {
      if (settled[state] || static_cast<float>(w) >= value[state]) return;
      value[state] = static_cast<float>(w);
      queue.push({w, static_cast<std::int64_t>(state)});
    };
    put(any, v + change);
    if (by_mode_) put(any + 1 + static_cast<std::size_t>(mode), v);
  };
  const auto relax = [&](std::size_t node, int mode, double v) {
    for (std::int32_t i = first_before[node]; i < first_before[node + 1]; ++i) {
      const auto slot = static_cast<std::size_t>(before[static_cast<std::size_t>(i)]);
      const std::size_t p = slot % count;
      if (by_mode_ && primitives_[p].mode != mode) continue;
      offer(slot / count, primitives_[p].mode, costs_[p] + v);
    }
  };
  for (std::size_t n = 0; n < size; ++n) {
    aim(static_cast<std::int32_t>(n));
    if (tried_.empty()) continue;
    queue.push({tried_.front().cost + least_after, -1 - static_cast<std::int64_t>(n)});
  }
  while (!queue.empty()) {
    const Entry top = queue.top();
    queue.pop();
    if (top.state < 0) {
      const auto node = static_cast<std::size_t>(-1 - top.state);
      if (settled[node * wide]) continue;  // no mode costs more than that
      const auto n = static_cast<std::int32_t>(node);
      for (std::size_t s = 0; s < shots(n).size(); ++s) {
        const Way shot = way(n, count + s);
        const double v = shot.cost + after[static_cast<std::size_t>(by_mode_ ? shot.last + 1 : 0)];
        if (shot.first < 0) {
          for (int m = 0; m < num_modes_; ++m) offer(node, m, v);
        } else {
          offer(node, shot.first, v);
        }
      }
      continue;
    }
    const auto state = static_cast<std::size_t>(top.state);
    if (settled[state] || static_cast<float>(top.value) > value[state]) continue;
    settled[state] = 1;
    const std::size_t node = state / wide;
    if (state % wide != 0) {
      relax(node, static_cast<int>(state % wide) - 1, value[state]);
      continue;
    }
    if (!by_mode_) {
      relax(node, 0, value[state]);
      continue;
    }
    for (std::size_t m = 1; m < wide; ++m) {
      if (settled[state + m]) continue;
      settled[state + m] = 1;
      value[state + m] = value[state];
      relax(node, static_cast<int>(m) - 1, value[state]);
    }
  }
  // Standing, any mode may begin without a switch. Rounding must not make a value too large.
  for (std::size_t n = 0; n < size; ++n) {
    if (by_mode_) value[n * wide] -= static_cast<float>(change);
  }
  for (float& v : value) v *= 1.0F - 1e-6F;
  cost_to_go_ = std::move(value);
  return true;
}

}  // namespace clearway
