#include "clearway/search/encounters.hpp"

#include <algorithm>
#include <cmath>

namespace clearway {

bool Encounters::is_hit(HitList list, int track) const {
  for (; list != kNobody; list = hits_[static_cast<std::size_t>(list)].next) {
    if (hits_[static_cast<std::size_t>(list)].track == track) return true;
  }
  return false;
}

Ticks Encounters::safe_until(const Body& body, const Frame& at, Ticks from, HitList hits,
                             Ticks* met) const {
  *met = kNever;
  if (!traffic_) return kNever;
  double end = kNever;
  for (const Traffic::Presence& who : traffic_->near(at.x, at.y)) {
    if (who.end < from || who.begin >= end || is_hit(hits, who.track)) continue;
    const Mover mover{&body, at, {}, static_cast<double>(from), end - from};
    double clear = from;
    const double when = traffic_->first_conflict(who, mover, required(who.track), &clear);
    if (when < 0.0 || clear >= end) continue;
    end = clear;
    *met = std::max(static_cast<Ticks>(std::ceil(when)), static_cast<Ticks>(end) + 1);
  }
  return static_cast<Ticks>(end);
}

Ticks Encounters::next_free(const Body& body, const Frame& at, Ticks from, HitList hits) const {
  Ticks t = from;
  for (bool again = true; again;) {
    again = false;
    for (const Traffic::Presence& who : traffic_->near(at.x, at.y)) {
      if (t < who.begin || t > who.end || is_hit(hits, who.track)) continue;
      const Ticks clear = traffic_->clear_after(who.track, body, at, t, required(who.track));
      if (clear >= kNever) return kNever;
      if (clear > t) {
        t = clear;
        again = true;
      }
    }
  }
  return t;
}

bool Encounters::conflict(const Body& body, const Frame& from, const Drive& edge, Ticks departure,
                          HitList hits, int* track, Ticks last_departure,
                          Ticks* free_departure) const {
  if (!traffic_ || traffic_->empty()) return false;
  Frame at = from;
  double t = departure;
  const auto meets = [&](const Traffic::Presence& who, const Mover& mover) {
    const double when = traffic_->any_conflict(who, mover, required(who.track));
    if (when < 0.0) return false;
    *track = who.track;
    if (free_departure) {
      const double progress = (when - mover.begin) / mover.duration;
      const Frame place = moved(mover.start, mover.twist.part(progress));
      const auto offset = static_cast<Ticks>(std::ceil(when - departure));
      const Ticks limit = last_departure >= kNever ? kNever : last_departure + offset;
      const Ticks clear = traffic_->clear_after(who.track, body, place, departure + offset,
                                                required(who.track), limit);
      *free_departure = clear >= kNever ? kNever : clear - offset;
    }
    return true;
  };
  for (std::size_t i = 0; i < edge.size; ++i) {
    const Step& step = edge.steps[i];
    const int chunks =
        std::max(1, static_cast<int>(std::ceil(step.twist.length() / traffic_->reach() - 1e-9)));
    const Twist part = step.twist.part(1.0 / chunks);
    const double duration = static_cast<double>(step.duration) / chunks;
    for (int c = 0; c < chunks; ++c) {
      const Mover mover{&body, at, part, t, duration};
      const double end = t + duration;
      const Circle around = mover.around();
      for (const Traffic::Presence& who : traffic_->near(at.x, at.y)) {
        if (who.end < t || who.begin > end ||
            traffic_->surely_clear(who.track, around, t, end, required(who.track)) ||
            is_hit(hits, who.track)) {
          continue;
        }
        if (meets(who, mover)) return true;
      }
      at = moved(at, part);
      t = end;
    }
  }
  return false;
}

HitList Encounters::collect(const Body& body, const Frame& from, const Drive& edge, Ticks departure,
                            HitList hits) {
  int track = 0;
  while (conflict(body, from, edge, departure, hits, &track)) {
    hits = add(track, hits);
  }
  return hits;
}

HitList Encounters::collect_standing(const Body& body, const Frame& at, Ticks from, Ticks until,
                                     HitList hits) {
  if (!traffic_) return hits;
  for (const Traffic::Presence& who : traffic_->near(at.x, at.y)) {
    if (who.end < from || who.begin > until || is_hit(hits, who.track)) continue;
    const Mover mover{&body, at, {}, static_cast<double>(from), static_cast<double>(until - from)};
    if (traffic_->first_conflict(who, mover, required(who.track)) < 0.0) continue;
    hits = add(who.track, hits);
  }
  return hits;
}

}  // namespace clearway
