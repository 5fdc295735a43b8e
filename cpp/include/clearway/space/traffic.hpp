// What moves: planned trajectories, found by tiles of space and time.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "clearway/geometry/body.hpp"
#include "clearway/motion/table.hpp"
#include "clearway/space/statics.hpp"

namespace clearway {

// A stretch of a trajectory; standing is a piece without motion (mode -1).
struct TimedPiece {
  Ticks begin = 0, end = 0;
  Pose start;
  Twist twist;
  int mode = -1;
  int body = 0;  // index into the robot's bodies: 0 empty, 1 loaded
};

// Append a piece; one that goes on as the last one did becomes part of it.
void join(std::vector<TimedPiece>& pieces, const TimedPiece& next);

// How a body moves under a constant twist: the velocity of its bounding circle's centre in the
// body frame and its amount (m per tick), and how fast it turns (rad per tick).
struct Rate {
  Point velocity;
  double speed = 0.0, turn = 0.0;

  Rate() = default;
  Rate(const Body& body, const Twist& twist, double duration);
};

// A body as it moves at some moment.
struct Motion {
  Frame frame;
  const Body* body = nullptr;
  Rate rate;

  Point centre() const { return frame.to_world({body->bound().x, body->bound().y}); }
  Point velocity() const {
    return {frame.c * rate.velocity.x - frame.s * rate.velocity.y,
            frame.s * rate.velocity.x + frame.c * rate.velocity.y};
  }
};

// One robot's motion, gap-free from its first tick; afterwards it stands until it is `gone`.
class Track {
 public:
  // `from`: nobody asks what it does before.
  Track(const std::vector<Body>* bodies, const Pose& start, std::vector<TimedPiece> pieces,
        Ticks gone = kNever, Ticks from = 0);

  struct Sight : Motion {
    double since, until;  // it moves like this at least from here to here
    Ticks still;          // it stands at least to this tick
  };
  Sight at(double tick) const;
  // First tick within [from, to] at which its bounding circle may come within `apart` of a point;
  // later than `to` if never.
  double may_be_near(double from, double to, Point p, double apart) const;

  const std::vector<TimedPiece>& pieces() const { return pieces_; }
  // From here on nothing about it changes any more.
  Ticks settled() const { return pieces_.empty() ? from_ : pieces_.back().end; }
  Ticks gone() const { return gone_; }
  double speed() const { return speed_; }                // of its fastest body point, m per tick
  double centre_speed() const { return centre_speed_; }  // of its bounding circle's centre
  double circumradius() const { return circumradius_; }
  // A circle that holds the body during [begin, end], without trigonometry.
  Circle around(double begin, double end) const {
    const double middle = 0.5 * (begin + end);
    const auto nearest = static_cast<std::size_t>(std::max(0.0, middle - from_) / kSlot + 0.5);
    Circle c = nearest < centres_.size() ? centres_[nearest] : rest_;
    if (begin < settled() || nearest < centres_.size())
      c.r += 0.5 * (end - begin + kSlot) * centre_speed_;
    return c;
  }

 private:
  static constexpr Ticks kSlot = 256;

  const std::vector<Body>* bodies_;
  std::vector<TimedPiece> pieces_;
  std::vector<Rate> rates_;         // of each piece
  std::vector<Frame> frames_;       // at each piece's start, and the last one's end
  std::vector<std::int32_t> slot_;  // first piece of each slot of time, counted from `from_`
  std::vector<Circle> centres_;     // bounding circle at the start of each slot
  Circle rest_;                     // and for good
  Ticks gone_, from_;
  double speed_ = 0.0, centre_speed_ = 0.0;
  double circumradius_ = 0.0;
  bool changes_shape_ = false;
};

// A body in motion (or at rest) during [begin, begin + duration].
struct Mover {
  const Body* body;
  Frame start;
  Twist twist;
  double begin = 0.0;
  double duration = 0.0;

  // A circle that holds the body all along.
  Circle around() const;
};

// First tick within [begin, end] at which a mover's gap to a track falls below `required`, or a
// negative value; with `any`, any such tick will do, which is found sooner. `last_clear` becomes
// the last tick known to be clear before that.
template <bool any>
double meeting(const Track& track, Ticks begin, Ticks end, const Mover& mover, double required,
               double* last_clear = nullptr);

// First tick from `from` on at which a body at rest is clear of a track it now conflicts with;
// one later than `limit` may be returned as soon as it is known to be.
Ticks clear_after(const Track& track, const Body& body, const Frame& at, Ticks from,
                  double required, Ticks limit = kNever);

class Traffic {
 public:
  struct Presence {
    std::int32_t track;
    Ticks begin, end;
  };

  // `radius`: largest circumradius of any body; `reach`: how far a mover may get from its start
  // within one question; `gap`: the largest gap that will be required.
  Traffic(const Box& box, double radius, double reach, double gap);

  double reach() const { return reach_; }
  void insert(int id, std::shared_ptr<const Track> track);
  void remove(int id);
  bool has(int id) const {
    return static_cast<std::size_t>(id) < tracks_.size() && tracks_[static_cast<std::size_t>(id)];
  }
  bool empty() const { return count_ == 0; }

  // Everything that may come near a mover starting at (x, y), in no order.
  const std::vector<Presence>& near(double x, double y) const;

  // Whether circles around both tell that they keep `required` apart all the time.
  bool surely_clear(int track, const Circle& mover, double begin, double end,
                    double required) const {
    const Circle other = tracks_[static_cast<std::size_t>(track)]->around(begin, end);
    const double dx = mover.x - other.x, dy = mover.y - other.y;
    const double apart = mover.r + other.r + required;
    return dx * dx + dy * dy > apart * apart;
  }

  // See meeting().
  double first_conflict(const Presence& who, const Mover& mover, double required,
                        double* last_clear = nullptr) const {
    return meeting<false>(track(who.track), who.begin, who.end, mover, required, last_clear);
  }
  double any_conflict(const Presence& who, const Mover& mover, double required) const {
    return meeting<true>(track(who.track), who.begin, who.end, mover, required);
  }
  Ticks clear_after(int id, const Body& body, const Frame& at, Ticks from, double required,
                    Ticks limit = kNever) const {
    return clearway::clear_after(track(id), body, at, from, required, limit);
  }
  const Track& track(int id) const { return *tracks_[static_cast<std::size_t>(id)]; }
  std::shared_ptr<const Track> share(int id) const { return tracks_[static_cast<std::size_t>(id)]; }

 private:
  std::size_t tile(double x, double y) const;

  Box box_;
  double radius_, reach_, gap_;
  int width_ = 0, height_ = 0;
  int count_ = 0;
  std::vector<std::vector<Presence>> tiles_;
  std::vector<std::shared_ptr<const Track>> tracks_;
  std::vector<std::vector<std::int32_t>> where_;  // tiles of each track
};

// How far a conservative step may overshoot: half of it can be lost of the required gap.
// Below a gap of 0 (poses that legally overlap by up to 1 mm) next to nothing may be lost.
inline double step_slack(double required) {
  if (required < 0.0) return std::clamp(2.0 * (required + 0.001), 1e-5, 0.0008);
  return std::clamp(required, 0.0008, 0.05);
}

}  // namespace clearway
