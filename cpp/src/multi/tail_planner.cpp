#include "clearway/multi/tail_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace clearway {

namespace {

constexpr double kLook = 0.25;  // of a motion into an obstacle is told at once (m)

}  // namespace

TailPlanner::TailPlanner(std::vector<Model> models, std::vector<int> model_of,
                         const TailParams& params)
    : models_(std::move(models)),
      model_of_(std::move(model_of)),
      params_(params),
      search_(std::make_unique<TourSearch>(params.search, params.objective)),
      traffic_(empty_traffic(models_, params.margin)),
      rests_(model_of_.size()) {}

void TailPlanner::place(int robot, Ticks now, const Pose& start, std::vector<TimedPiece> pieces,
                        int body) {
  if (pieces.empty()) pieces.push_back({now, now + 1, start, {}, -1, body});
  if (traffic_.has(robot)) traffic_.remove(robot);
  traffic_.insert(robot, std::make_shared<const Track>(&model(robot).bodies, start,
                                                       std::move(pieces), kNever, now));
  std::vector<Rest>& rests = rests_[static_cast<std::size_t>(robot)];
  rests.clear();
  const std::vector<TimedPiece>& all = track(robot).pieces();
  for (const TimedPiece& p : all) {
    if (p.mode < 0) rests.push_back({Frame(p.start), p.body});
  }
  rests.push_back({track(robot).at(kNever).frame, all.back().body});
}

std::vector<Leg> TailPlanner::legs_of(const TailQuery& query) const {
  std::vector<Leg> legs = query.legs;
  const Model& m = model(query.robot);
  Pose from = query.start;
  for (Leg& leg : legs) {
    leg.required = leg_gap(m, leg.body, from, leg.goal, params_.margin);
    from = leg.goal;
  }
  if (query.rests.empty()) return legs;
  Leg last{query.rests.front(), 0, query.rest_body};
  last.others.assign(query.rests.begin() + 1, query.rests.end());
  last.required = std::numeric_limits<double>::infinity();
  for (const Pose& rest : query.rests) {
    last.required =
        std::min(last.required, leg_gap(m, query.rest_body, from, rest, params_.margin));
  }
  legs.push_back(std::move(last));
  return legs;
}

std::vector<TailPlanner::Rest> TailPlanner::rests_of(const TailQuery& query) const {
  const int first = query.legs.empty() ? query.rest_body : query.legs.front().body;
  std::vector<Rest> rests{{Frame(query.start), first}};
  for (std::size_t i = 0; i < query.legs.size(); ++i) {
    const Leg& leg = query.legs[i];
    const int next = i + 1 < query.legs.size() ? query.legs[i + 1].body : query.rest_body;
    rests.push_back({Frame(leg.goal), leg.body});
    if (next != leg.body) rests.push_back({Frame(leg.goal), next});
  }
  for (const Pose& rest : query.rests) rests.push_back({Frame(rest), query.rest_body});
  return rests;
}

// Gap to keep to each track: the clearance, or what the poses at which both stand leave where that
// is less, and what is left where the motion begins.
std::vector<double> TailPlanner::gaps(int robot, const std::vector<Rest>& rests,
                                      Ticks ready) const {
  std::vector<double> required(size(), 0.0);
  for (int other = 0; other < static_cast<int>(size()); ++other) {
    const auto j = static_cast<std::size_t>(other);
    double least = std::max({model(robot).clearance, model(other).clearance, params_.margin});
    const auto narrow = [&](const Rest& a, const Frame& at, const Body& theirs) {
      const Body& mine = body(robot, a.body);
      const double near = mine.circumradius() + theirs.circumradius() + least;
      const double dx = a.at.x - at.x, dy = a.at.y - at.y;
      if (dx * dx + dy * dy > near * near) return;
      const double left = gap(mine, a.at, theirs, at, least);
      if (left >= -kLegalOverlap) least = std::min(least, left);
    };
    if (other != robot && traffic_.has(other)) {
      for (const Rest& a : rests) {
        for (const Rest& b : rests_[j]) narrow(a, b.at, body(other, b.body));
      }
      const Track::Sight there = track(other).at(ready);
      narrow(rests.front(), there.frame, *there.body);
    }
    required[j] = least;
  }
  return required;
}

Tail TailPlanner::search(const TailQuery& query, const Traffic* traffic, Budget& budget) {
  const std::vector<Leg> legs = legs_of(query);
  const std::vector<double> required = gaps(query.robot, rests_of(query), query.ready);
  std::vector<std::int32_t> met(size(), 0);
  TourQuery tour;
  tour.model = &model(query.robot);
  tour.fine = query.fine;
  tour.start = query.start;
  tour.mode = query.mode;
  tour.ready = query.ready;
  tour.legs = &legs;
  tour.rest_body = query.rest_body;
  tour.traffic = traffic;
  tour.required = &required;
  tour.met = &met;
  tour.minds_places = true;
  const std::int64_t before = budget.spent;
  Tail tail;
  tail.tour = (*search_)(tour, query.limit, budget);
  tail.expansions = budget.spent - before;
  if (tail.tour.outcome == TourResult::Outcome::kFound) {
    if (query.rests.empty()) return tail;
    tail.rest = tail.tour.goal;
    tail.tour.stops.pop_back();
    return tail;
  }
  std::vector<int> order(size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return met[static_cast<std::size_t>(a)] > met[static_cast<std::size_t>(b)];
  });
  for (const int i : order) {
    if (met[static_cast<std::size_t>(i)] > 0) tail.met.push_back(i);
  }
  return tail;
}

Tail TailPlanner::plan(const TailQuery& query, Budget& budget) {
  // The robot is not in its own way. Whatever ends the search, it is put back.
  struct Absence {
    Traffic& traffic;
    int robot;
    std::shared_ptr<const Track> track;
    ~Absence() {
      if (track) traffic.insert(robot, track);
    }
  };
  Absence absence{traffic_, query.robot, traffic_.share(query.robot)};
  traffic_.remove(query.robot);
  Tail tail = search(query, &traffic_, budget);
  if (tail.tour.outcome != TourResult::Outcome::kFound) return tail;
  absence.track.reset();
  std::vector<TimedPiece> pieces = query.kept;
  pieces.insert(pieces.end(), tail.tour.pieces.begin(), tail.tour.pieces.end());
  const Pose& start = pieces.front().start;
  place(query.robot, query.now, start, std::move(pieces), query.rest_body);
  return tail;
}

Tail TailPlanner::alone(const TailQuery& query, Budget& budget) {
  return search(query, nullptr, budget);
}

std::vector<TailMeeting> TailPlanner::meetings(int robot, const std::vector<TimedPiece>& pieces,
                                               Ticks earlier) const {
  std::vector<Rest> rests;
  if (!pieces.empty()) rests.push_back({Frame(pieces.front().start), pieces.front().body});
  rests.insert(rests.end(), rests_[static_cast<std::size_t>(robot)].begin(),
               rests_[static_cast<std::size_t>(robot)].end());
  std::vector<TailMeeting> met;
  for (const TimedPiece& p : pieces) {
    const double begin = p.begin - earlier;
    const Mover mover{&body(robot, p.body), Frame(p.start), p.twist, begin,
                      static_cast<double>(p.end - p.begin)};
    const std::vector<double> required = gaps(robot, rests, p.begin - earlier);
    for (int other = 0; other < static_cast<int>(size()); ++other) {
      if (other == robot || !traffic_.has(other)) continue;
      const double when = traffic_.first_conflict({other, 0, kNever}, mover,
                                                  required[static_cast<std::size_t>(other)]);
      if (when < 0.0) continue;
      met.push_back({other, moved(p.start, p.twist.part((when - begin) / mover.duration))});
    }
    if (!met.empty()) break;
  }
  return met;
}

Ticks TailPlanner::clear_until(int robot, Ticks now,
                               const std::vector<std::shared_ptr<const Statics>>& statics) const {
  for (const TimedPiece& p : track(robot).pieces()) {
    if (p.end <= now || p.end <= p.begin) continue;
    const Statics& around = *statics[static_cast<std::size_t>(p.body)];
    const int looks = std::max(1, static_cast<int>(std::ceil(p.twist.length() / kLook)));
    for (int i = 0; i < looks; ++i) {
      const auto at = [&](int look) {
        return p.begin + static_cast<Ticks>(static_cast<double>(p.end - p.begin) * look / looks);
      };
      if (at(i + 1) <= now) continue;
      const Frame from = moved(Frame(p.start), p.twist.part(static_cast<double>(i) / looks));
      if (!around.clear(body(robot, p.body), from, p.twist.part(1.0 / looks), 0.0,
                        step_slack(0.0))) {
        return std::max(now, at(i));
      }
    }
  }
  const Track::Sight rest = track(robot).at(kNever);
  const int last = track(robot).pieces().back().body;
  const bool clear = statics[static_cast<std::size_t>(last)]->gap(*rest.body, rest.frame) >= 0.0;
  return clear ? kNever : std::max(now, settled(robot));
}

void TailPlanner::rebuild(const std::vector<std::vector<std::shared_ptr<const Statics>>>& statics) {
  for (std::size_t i = 0; i < models_.size(); ++i) models_[i].statics = statics[i];
  search_ = std::make_unique<TourSearch>(params_.search, params_.objective);
}

}  // namespace clearway
