#include "clearway/space/traffic.hpp"

#include <algorithm>
#include <cmath>

namespace clearway {

namespace {

// Way of a body's bounding centre under a whole twist, in the body frame (m).
Point centre_way(const Twist& t, const Circle& bound) {
  return {t.a - t.c * bound.y, t.b + t.c * bound.x};
}

// For how many ticks a room (m) lasts for sure when it closes at first at a rate (m per tick,
// negative: it opens) that rises by at most `bend` per tick.
double lasts(double room, double rate, double bend) {
  const double scale = rate + std::sqrt(rate * rate + 2.0 * bend * room);
  return scale > 1e-12 ? 2.0 * room / scale : kNever;
}

Circle placed(const Circle& c, const Frame& f) {
  const Point p = f.to_world({c.x, c.y});
  return {p.x, p.y, c.r};
}

constexpr double kTouching = 1e-7;  // a gap that much too small is rounding (m)
constexpr double kTile = 2.5;
constexpr double kChunk = 1.0;  // longest stretch of path marked at once (m)
constexpr Ticks kMarch = 100;   // coarsest step when waiting for somebody to get clear

}  // namespace

void join(std::vector<TimedPiece>& pieces, const TimedPiece& next) {
  if (!pieces.empty() && next.mode >= 0) {
    TimedPiece& last = pieces.back();
    const double rate = static_cast<double>(last.end - last.begin) / (next.end - next.begin);
    const Twist& t = next.twist;
    if (last.mode == next.mode && last.body == next.body && last.end == next.begin &&
        std::abs(last.twist.a - t.a * rate) + std::abs(last.twist.b - t.b * rate) +
                std::abs(last.twist.c - t.c * rate) <
            1e-9) {
      last.twist = {last.twist.a + t.a, last.twist.b + t.b, last.twist.c + t.c};
      last.end = next.end;
      return;
    }
  }
  pieces.push_back(next);
}

Track::Track(const std::vector<Body>* bodies, const Pose& start, std::vector<TimedPiece> pieces,
             Ticks gone, Ticks from)
    : bodies_(bodies), pieces_(std::move(pieces)), gone_(gone), from_(from) {
  if (!pieces_.empty() && pieces_.front().begin > from) {
    const TimedPiece& first = pieces_.front();
    pieces_.insert(pieces_.begin(), {from, first.begin, first.start, {}, -1, first.body});
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
      rates_.emplace_back(body, p.twist, p.end - p.begin);
      centre_speed_ = std::max(centre_speed_, rates_.back().speed);
    } else {
      rates_.emplace_back();
    }
    changes_shape_ = changes_shape_ || p.body != pieces_.front().body;
    while (from + static_cast<Ticks>(slot_.size()) * kSlot < p.end) {
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
    centres_.push_back(bound(at(from + static_cast<double>(i) * kSlot)));
  }
  rest_ = bound(at(kNever));
}

Track::Sight Track::at(double tick) const {
  if (tick >= settled()) {
    const int body = pieces_.empty() ? 0 : pieces_.back().body;
    return {{frames_.back(), &(*bodies_)[static_cast<std::size_t>(body)], {}},
            static_cast<double>(settled()),
            kNever,
            gone_};
  }
  const double slot = std::max(0.0, tick - from_) / kSlot;
  auto i = static_cast<std::size_t>(slot_[static_cast<std::size_t>(slot)]);
  while (tick >= pieces_[i].end) ++i;
  const TimedPiece& p = pieces_[i];
  const Body* body = &(*bodies_)[static_cast<std::size_t>(p.body)];
  const auto since = static_cast<double>(p.begin), until = static_cast<double>(p.end);
  if (p.mode < 0) return {{frames_[i], body, {}}, since, until, p.end};
  const Frame frame = moved(frames_[i], p.twist.part((tick - since) / (until - since)));
  return {{frame, body, rates_[i]}, since, until, 0};
}

double Track::may_be_near(double from, double to, Point p, double apart) const {
  const double reach = apart + 0.5 * kSlot * centre_speed_;
  auto slot = static_cast<std::size_t>(std::max(0.0, from - from_) / kSlot + 0.5);
  for (; slot < centres_.size(); ++slot) {
    const Circle& c = centres_[slot];
    const double dx = c.x - p.x, dy = c.y - p.y, r = reach + c.r;
    const double begin = from_ + (static_cast<double>(slot) - 0.5) * kSlot;
    if (begin > to) return begin;
    if (dx * dx + dy * dy <= r * r) return std::max(from, begin);
  }
  const double dx = rest_.x - p.x, dy = rest_.y - p.y, r = reach + rest_.r;
  return dx * dx + dy * dy <= r * r
             ? std::max(from, from_ + (static_cast<double>(centres_.size()) - 0.5) * kSlot)
             : kNever;
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

Rate::Rate(const Body& body, const Twist& twist, double duration) {
  const Point way = centre_way(twist, body.bound());
  velocity = {way.x / duration, way.y / duration};
  speed = length(velocity);
  turn = std::abs(twist.c) / duration;
}

Circle Mover::around() const {
  Circle c = placed(body->bound(), moved(start, twist.part(0.5)));
  c.r += 0.5 * length(centre_way(twist, body->bound()));
  return c;
}

namespace {

// What two bodies are sure of at a moment: their gap less what is required, and for how many ticks
// that stays above 0, from then on and before then.
struct Outlook {
  double room, ahead, back;
};

Outlook look(const Motion& self, const Track::Sight& other, double required, double slack) {
  const Point mine = self.centre(), its = other.centre();
  const Point apart{its.x - mine.x, its.y - mine.y};
  const double reach = self.body->bound().r + other.body->bound().r + required;
  const double bend = self.rate.speed * self.rate.turn + other.rate.speed * other.rate.turn;
  const Point relative = self.velocity() - other.velocity();
  const double square = dot(apart, apart);
  if (square > (reach + slack) * (reach + slack)) {
    const double distance = std::sqrt(square), rate = dot(relative, apart) / distance;
    const double room = distance - reach;
    return {room, lasts(room, rate, bend), lasts(room, -rate, bend)};
  }
  // Along the axis of each pair of parts: their centres close, and turning bodies reach out.
  const double swing =
      self.rate.turn * self.body->bound().r + other.rate.turn * other.body->bound().r;
  Outlook sure{kNever, kNever, kNever};
  for_each_separation(*self.body, self.frame, *other.body, other.frame, required + 2.0,
                      [&](const Separation& s) {
                        const double room = s.gap - required, rate = dot(relative, s.axis);
                        sure.room = std::min(sure.room, room);
                        if (room <= 0.0) {
                          sure.ahead = sure.back = 0.0;
                          return;
                        }
                        sure.ahead = std::min(sure.ahead, lasts(room, rate + swing, bend));
                        sure.back = std::min(sure.back, lasts(room, swing - rate, bend));
                      });
  return sure;
}

}  // namespace

template <bool any>
double meeting(const Track& track, Ticks begin, Ticks end, const Mover& mover, double required,
               double* last_clear) {
  const double finish = std::min(mover.begin + mover.duration, static_cast<double>(end));
  double t = std::max(mover.begin, static_cast<double>(begin));
  if (t > finish) return -1.0;
  const double radius = mover.body->circumradius();
  const double travel = mover.twist.length() + std::abs(mover.twist.c) * radius;
  const double own_speed = travel > 0.0 ? travel / mover.duration : 0.0;
  const double slack = step_slack(required);
  Motion self{mover.start, mover.body, {}};
  if (travel > 0.0) self.rate = Rate(*mover.body, mover.twist, mover.duration);
  const auto place = [&](double tick) {
    if (travel > 0.0) {
      self.frame = moved(mover.start, mover.twist.part((tick - mover.begin) / mover.duration));
    }
  };
  if (last_clear) *last_clear = t;
  // A look from the middle of a drive often tells for all of it.
  double clear_from = kNever, clear_to = 0.0;
  if (travel > 0.0) {
    const double middle = 0.5 * (t + finish);
    place(middle);
    const Track::Sight other = track.at(middle);
    const Outlook sure = look(self, other, required, slack);
    if (any && sure.room < -kTouching) return middle;
    if (sure.room >= 0.0) {
      clear_from = std::max(middle - sure.back, other.since);
      clear_to = std::min(middle + sure.ahead, other.until);
      if (clear_from <= t) t = std::min(clear_to, finish);
      if (clear_from <= t && clear_to >= finish) return -1.0;
    }
  }
  while (true) {
    place(t);
    if (travel == 0.0) {
      const double near =
          track.may_be_near(t, finish, self.centre(), mover.body->bound().r + required);
      if (last_clear && near > t) *last_clear = std::min(std::max(t, near - 1.0), finish);
      if (near > finish) return -1.0;
      t = near;
    }
    const Track::Sight other = track.at(t);
    const Outlook sure = look(self, other, required, slack);
    if (sure.room < -kTouching) return t;
    if (last_clear) *last_clear = t;
    if (t >= finish) return -1.0;
    double next = t + sure.ahead;
    if (next >= finish && other.until >= finish) {
      if (last_clear) *last_clear = finish;
      return -1.0;
    }
    // So that a straight approach is told to its very end.
    const double speed = own_speed + (t >= track.settled() ? 0.0 : track.speed());
    next = speed > 0.0 ? std::max(next, t + slack / speed) : finish;
    t = std::min({finish, next, other.until});
    if (t >= clear_from && t < clear_to) {
      t = std::min(clear_to, finish);
      if (clear_to >= finish) return -1.0;
    }
  }
}

template double meeting<false>(const Track&, Ticks, Ticks, const Mover&, double, double*);
template double meeting<true>(const Track&, Ticks, Ticks, const Mover&, double, double*);

Ticks clear_after(const Track& track, const Body& body, const Frame& at, Ticks from,
                  double required, Ticks limit) {
  const Circle mine = placed(body.bound(), at);
  Ticks still = 0;
  const auto missing = [&](Ticks t) {
    if (track.may_be_near(t, t, {mine.x, mine.y}, mine.r + required) > t) return 0.0;
    const Track::Sight other = track.at(t);
    still = other.still;
    return required - gap(body, at, *other.body, other.frame, required);
  };
  Ticks before = from, t = from;
  while (t <= limit && t < track.gone()) {
    const double lacking = missing(t);
    if (lacking <= kTouching) {
      for (Ticks step = (t - before) / 2; step > kMarch / 4; step /= 2) {
        if (missing(t - step) <= kTouching) t -= step;
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
