// Whom a robot meets, standing or driving, and when it would meet nobody.
#pragma once

#include <cstdint>
#include <vector>

#include "clearway/motion/table.hpp"
#include "clearway/space/traffic.hpp"

namespace clearway {

// Steps driven one after another.
struct Drive {
  const Step* steps;
  std::size_t size;
  Ticks duration;
};

// Head of a list of tracks that a way runs into anyway: they do not count any more.
using HitList = std::int32_t;
constexpr HitList kNobody = -1;

class Encounters {
 public:
  // `required`: gap to keep to each track. Without traffic nobody is ever met.
  Encounters(const Traffic* traffic, const std::vector<double>* required)
      : traffic_(traffic), required_(required) {}

  bool is_hit(HitList list, int track) const;
  HitList add(int track, HitList list) {
    hits_.push_back({track, list});
    return static_cast<HitList>(hits_.size()) - 1;
  }
  int track(HitList list) const { return hits_[static_cast<std::size_t>(list)].track; }
  HitList next(HitList list) const { return hits_[static_cast<std::size_t>(list)].next; }
  std::size_t size() const { return hits_.size(); }

  // Last tick to which a body standing from `from` on is safe; kNever if for ever. `met` becomes
  // the tick at which it is in the way, a little later.
  Ticks safe_until(const Body& body, const Frame& at, Ticks from, HitList hits, Ticks* met) const;

  // First tick from `from` on at which a body could stand there; kNever if none.
  Ticks next_free(const Body& body, const Frame& at, Ticks from, HitList hits) const;

  // Whether driving from `departure` on runs into anybody; if so, whom, and the first departure
  // (no later than just past `last_departure`) at which the place of that conflict is free of him.
  bool conflict(const Body& body, const Frame& from, const Drive& edge, Ticks departure,
                HitList hits, int* track, Ticks last_departure = 0,
                Ticks* free_departure = nullptr) const;

  // The list, longer by all that a drive or a stand runs into.
  HitList collect(const Body& body, const Frame& from, const Drive& edge, Ticks departure,
                  HitList hits);
  HitList collect_standing(const Body& body, const Frame& at, Ticks from, Ticks until,
                           HitList hits);

 private:
  struct Hit {
    int track;
    HitList next;
  };

  double required(int track) const { return (*required_)[static_cast<std::size_t>(track)]; }

  const Traffic* traffic_;
  const std::vector<double>* required_;
  std::vector<Hit> hits_;
};

}  // namespace clearway
