#include "clearway/space/traffic.hpp"

#include <algorithm>
#include <cmath>

namespace clearway {

namespace {

// Speed of a body-frame point under a twist of this duration (m per tick).
double speed_of(const Twist& t, double x, double y, double duration) {
  return std::hypot(t.a - t.c * y, t.b + t.c * x) / duration;
}

Circle placed(const Circle& c, const Frame& f) {
  const Point p = f.to_world({c.x, c.y});
  return {p.x, p.y, c.r};
}

constexpr double kTile = 2.5;
constexpr double kChunk = 1.0;  // longest stretch of path marked at once (m)
constexpr Ticks kMarch = 100;  // coarsest step when waiting for somebody to get clear

}  // namespace

Track::Track(const std::vector<Body>* bodies, const Pose& start, std::vector<TimedPiece> pieces,
             Ticks gone)
    : bodies_(bodies), pieces_(std::move(pieces)), gone_(gone) {
  if (!pieces_.empty() && pieces_.front().begin > 0) {
    const TimedPiece& first = pieces_.front();
    pieces_.insert(pieces_.begin(), {0, first.begin, first.start, {}, -1, first.body});
  }
  while (!pieces_.empty() && pieces_.back().mode < 0 && pieces_.size() > 1 &&
         pieces_.back().body == pieces_[pieces_.size() - 2].body) {
    pieces_.pop_back();  // standing at the end needs no piece
  }
  circumradius_ = (*bodies_)[0].circumradius();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const TimedPiece& p = pieces_[i];
    frames_.emplace_back(p.start);
    const Body& body = (*bodies_)[static_cast<std::size_t>(p.body)];
    circumradius_ = std::max(circumradius_, body.circumradius());
    if (p.end > p.begin) {
      const double travel = p.twist.length() + std::abs(p.twist.c) * body.circumradius();
      speed_ = std::max(speed_, travel / (p.end - p.begin));
      const Circle& bound = body.bound();
      centre_speed_ = std::max(centre_speed_, speed_of(p.twist, bound.x, bound.y, p.end - p.begin));
    }
    changes_shape_ = changes_shape_ || p.body != pieces_.front().body;
    while (static_cast<Ticks>(slot_.size()) * kSlot < p.end) {
      slot_.push_back(static_cast<std::int32_t>(i));
    }
  }
  frames_.push_back(pieces_.empty() ? Frame(start)
                                    : Frame(moved(pieces_.back().start, pieces_.back().twist)));
  // A body that changes its shape is held by a circle about the reference point at all times.
  const auto bound = [&](const Sight& sight) {
    if (!changes_shape_) return placed(sight.body->bound(), sight.frame);
    return Circle{sight.frame.x, sight.frame.y, circumradius_};
  };
  if (changes_shape_) centre_speed_ = speed_;
  for (std::size_t i = 0; i < slot_.size(); ++i) {
    centres_.push_back(bound(at(static_cast<double>(i) * kSlot)));
  }
  rest_ = bound(at(kNever));
}

Track::Sight Track::at(double tick) const {
  if (tick >= settled()) {
    const int body = pieces_.empty() ? 0 : pieces_.back().body;
    return {frames_.back(), &(*bodies_)[static_cast<std::size_t>(body)], kNever, gone_};
  }
  const double slot = std::max(0.0, tick) / kSlot;
  auto i = static_cast<std::size_t>(slot_[static_cast<std::size_t>(slot)]);
  while (tick >= pieces_[i].end) ++i;
  const TimedPiece& p = pieces_[i];
  const Body* body = &(*bodies_)[static_cast<std::size_t>(p.body)];
  const double until = changes_shape_ ? p.end : kNever;
  if (p.mode < 0) return {frames_[i], body, until, p.end};
  return {moved(frames_[i], p.twist.part((tick - p.begin) / (p.end - p.begin))), body, until, 0};
}

Traffic::Traffic(const Box& box, double radius, double reach, double gap)
    : box_(box), radius_(radius), reach_(reach), gap_(gap) {
  width_ = static_cast<int>((box.x1 - box.x0) / kTile) + 1;
  height_ = static_cast<int>((box.y1 - box.y0) / kTile) + 1;
  tiles_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
}

std::size_t Traffic::tile(double x, double y) const {
  const int ix = std::clamp(static_cast<int>((x - box_.x0) / kTile), 0, width_ - 1);
  const int iy = std::clamp(static_cast<int>((y - box_.y0) / kTile), 0, height_ - 1);
  return static_cast<std::size_t>(iy) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(ix);
}

const std::vector<Traffic::Presence>& Traffic::near(double x, double y) const {
  return tiles_[tile(x, y)];
}

void Traffic::insert(int id, std::shared_ptr<const Track> track) {
  const auto index = static_cast<std::size_t>(id);
  if (tracks_.size() <= index) {
    tracks_.resize(index + 1);
    where_.resize(index + 1);
  }
  tracks_[index] = track;
  ++count_;
  const double around = track->circumradius() + radius_ + reach_ + gap_;
  const auto mark = [&](double x, double y, double radius, Ticks begin, Ticks end) {
    const auto row = [](double v, int top) {
      return std::clamp(static_cast<int>(std::floor(v / kTile)), 0, top - 1);
    };
    for (int iy = row(y - radius - box_.y0, height_); iy <= row(y + radius - box_.y0, height_);
         ++iy) {
      for (int ix = row(x - radius - box_.x0, width_); ix <= row(x + radius - box_.x0, width_);
           ++ix) {
        const double dx = std::max({box_.x0 + ix * kTile - x, 0.0, x - box_.x0 - (ix + 1) * kTile});
        const double dy = std::max({box_.y0 + iy * kTile - y, 0.0, y - box_.y0 - (iy + 1) * kTile});
        if (dx * dx + dy * dy > radius * radius) continue;
        const std::size_t t = static_cast<std::size_t>(iy) * static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(ix);
        auto& list = tiles_[t];
        if (!list.empty() && list.back().track == id && list.back().end + 1 >= begin) {
          list.back().end = std::max(list.back().end, end);
        } else {
          list.push_back({id, begin, end});
          where_[index].push_back(static_cast<std::int32_t>(t));
        }
      }
    }
  };
  for (const TimedPiece& p : track->pieces()) {
    const int chunks = std::max(1, static_cast<int>(std::ceil(p.twist.length() / kChunk)));
    const double duration = p.end - p.begin;
    for (int i = 0; i < chunks; ++i) {
      const Pose middle = moved(p.start, p.twist.part((i + 0.5) / chunks));
      mark(middle.x, middle.y, around + 0.5 * p.twist.length() / chunks,
           p.begin + static_cast<Ticks>(duration * i / chunks),
           p.begin + static_cast<Ticks>(std::ceil(duration * (i + 1) / chunks)));
    }
  }
  const Frame rest = track->at(kNever).frame;
  mark(rest.x, rest.y, around, track->settled(), track->gone());
}

void Traffic::remove(int id) {
  const auto index = static_cast<std::size_t>(id);
  for (const std::int32_t t : where_[index]) {
    std::erase_if(tiles_[static_cast<std::size_t>(t)],
                  [id](const Presence& p) { return p.track == id; });
  }
  where_[index].clear();
  tracks_[index].reset();
  --count_;
}

Circle Mover::around() const {
  const Circle& bound = body->bound();
  Circle c = placed(bound, moved(start, twist.part(0.5)));
  c.r += 0.5 * speed_of(twist, bound.x, bound.y, 1.0);
  return c;
}

double Traffic::first_conflict(const Presence& who, const Mover& mover, double required,
                               double* last_clear) const {
  const Track& track = *tracks_[static_cast<std::size_t>(who.track)];
  const double finish = std::min(mover.begin + mover.duration, static_cast<double>(who.end));
  double t = std::max(mover.begin, static_cast<double>(who.begin));
  if (t > finish) return -1.0;
  const double radius = mover.body->circumradius();
  const double travel = mover.twist.length() + std::abs(mover.twist.c) * radius;
  const double own_speed = travel > 0.0 ? travel / mover.duration : 0.0;
  const Circle& bound = mover.body->bound();
  const double centre_speed =
      travel > 0.0 ? speed_of(mover.twist, bound.x, bound.y, mover.duration) : 0.0;
  const double slack = step_slack(required);
  if (last_clear) *last_clear = t;
  while (true) {
    const Track::Sight other = track.at(t);
    const Frame self =
        travel > 0.0 ? moved(mover.start, mover.twist.part((t - mover.begin) / mover.duration))
                     : mover.start;
    const Circle mine = placed(bound, self), its = placed(other.body->bound(), other.frame);
    const double dx = mine.x - its.x, dy = mine.y - its.y;
    const double apart = mine.r + its.r + required;
    const double square = dx * dx + dy * dy;
    const bool settled = t >= track.settled();
    double room, speed;
    bool sure = true;  // that nothing happens before the room is used up
    if (square > (apart + slack) * (apart + slack)) {
      room = std::sqrt(square) - apart;
      speed = centre_speed + (settled ? 0.0 : track.centre_speed());
    } else {
      room = gap(*mover.body, self, *other.body, other.frame, required + 0.5) - required;
      if (room < -1e-7) return t;
      sure = room >= slack;
      room = std::max(room, slack);  // so that a straight approach is told to its very end
      speed = own_speed + (settled ? 0.0 : track.speed());
    }
    if (last_clear) *last_clear = t;
    if (t >= finish) return -1.0;
    const double next = speed > 0.0 ? t + room / speed : finish;
    if (sure && next >= finish && other.until >= finish) {
      if (last_clear) *last_clear = finish;
      return -1.0;
    }
    t = std::min({finish, next, other.until});
  }
}

Ticks Traffic::clear_after(int id, const Body& body, const Frame& at, Ticks from, double required,
                           Ticks limit) const {
  const Track& track = *tracks_[static_cast<std::size_t>(id)];
  const Circle mine = placed(body.bound(), at);
  Ticks still = 0;
  const auto missing = [&](Ticks t) {
    const Track::Sight other = track.at(t);
    const Circle its = placed(other.body->bound(), other.frame);
    const double dx = mine.x - its.x, dy = mine.y - its.y;
    const double apart = mine.r + its.r + required;
    if (dx * dx + dy * dy >= apart * apart) return 0.0;
    still = other.still;
    return required - gap(body, at, *other.body, other.frame, required);
  };
  Ticks before = from, t = from;
  while (t <= limit && t < track.gone()) {
    const double lacking = missing(t);
    if (lacking <= 0.0) {
      for (Ticks step = (t - before) / 2; step > kMarch / 4; step /= 2) {
        if (missing(t - step) <= 0.0) t -= step;
      }
      return t;
    }
    const auto wait =
        static_cast<Ticks>(track.speed() > 0.0 ? std::min(lacking / track.speed(), 1e6) : 0.0);
    before = std::max(t + wait, still);
    t = std::max(t + kMarch, before);
  }
  return t >= track.gone() ? track.gone() : t;
}

}  // namespace clearway
