#include "clearway/motion/ramp.hpp"

#include <algorithm>
#include <cmath>

namespace clearway {

namespace {

constexpr Ticks kStep = 100;    // of even speed while speed changes
constexpr Ticks kShort = 20;    // shorter remainders become part of the step beside them
constexpr double kLoss = 1e-9;  // of a square of speed, by rounding

}  // namespace

std::optional<Ramp> Ramp::make(double length, double enter, double leave, double top, double up,
                               double down) {
  // Where speeding up from `enter` and slowing down to `leave` meet.
  const double meet =
      (2.0 * up * down * length + down * enter * enter + up * leave * leave) / (up + down);
  const double most = std::max(enter, leave);
  if (most > top * (1.0 + kLoss) || meet < most * most * (1.0 - kLoss)) return std::nullopt;
  Ramp ramp;
  ramp.length_ = length;
  ramp.enter_ = enter;
  ramp.leave_ = leave;
  ramp.peak_ = std::max(most, std::min(top, std::sqrt(meet)));
  ramp.up_ = up;
  ramp.down_ = down;
  const double peak = ramp.peak_ * ramp.peak_;
  const double held =
      length - 0.5 * (peak - enter * enter) / up - 0.5 * (peak - leave * leave) / down;
  ramp.holding_ = ramp.peak_ > 0.0 ? std::max(0.0, held) / ramp.peak_ : 0.0;
  return ramp;
}

double Ramp::way(double t) const {
  const double risen = rising();
  if (t < risen) return t * (enter_ + 0.5 * up_ * t);
  const double left = std::max(0.0, seconds() - t);
  if (left < falling()) return length_ - left * (leave_ + 0.5 * down_ * left);
  return risen * 0.5 * (enter_ + peak_) + (t - risen) * peak_;
}

void Ramp::cut(const Step& whole, std::vector<Step>& out) const {
  const Ticks total = std::max<Ticks>(1, to_ticks(seconds()));
  const double tick = seconds() / total;  // the whole is stretched to full ticks
  const auto risen = static_cast<Ticks>(std::lround(rising() / tick));
  const Ticks held = total - static_cast<Ticks>(std::lround(falling() / tick));
  Ticks done = 0;
  double gone = 0.0;
  const auto go = [&](Ticks until) {
    if (until <= done) return;
    const double share = until == total ? 1.0 : way(until * tick) / length_;
    out.push_back({whole.mode, whole.twist.part(share - gone), until - done, whole.top});
    done = until;
    gone = share;
  };
  for (Ticks t = kStep; t + kShort <= risen; t += kStep) go(t);
  if (risen < total) go(risen);
  if (held < total) go(held);
  // Counted from the end, where it may come to rest.
  for (Ticks left = (total - held - kShort) / kStep * kStep; left > 0; left -= kStep) {
    go(total - left);
  }
  go(total);
}

bool speeds_between(const MotionTable& table, int mode, const std::vector<Step>& steps,
                    std::vector<double>& speeds) {
  const std::size_t n = steps.size();
  speeds.assign(n + 1, 0.0);
  const auto course = [&](int of) { return table.paces[static_cast<std::size_t>(of)].course; };
  const double enter = table.speed(mode);
  if (enter > 0.0 &&
      (n == 0 || course(steps[0].mode) != course(mode) || enter > steps[0].top * (1.0 + kLoss))) {
    return false;
  }
  speeds[0] = enter;
  for (std::size_t i = 1; i < n; ++i) {
    if (course(steps[i].mode) == course(steps[i - 1].mode)) {
      speeds[i] = std::min(steps[i].top, steps[i - 1].top);
    }
  }
  const auto after = [&](double speed, double rate, std::size_t i) {
    return std::sqrt(speed * speed + 2.0 * rate * steps[i].twist.length());
  };
  for (std::size_t i = n; i-- > 0;) {
    speeds[i] = std::min(speeds[i], after(speeds[i + 1], table.deceleration, i));
  }
  if (speeds[0] < enter) return false;  // it cannot stop in time
  for (std::size_t i = 0; i < n; ++i) {
    speeds[i + 1] = std::min(speeds[i + 1], after(speeds[i], table.acceleration, i));
  }
  return true;
}

namespace {

// The ramp of one step; nothing for turning on the spot.
std::optional<Ramp> ramp_of(const MotionTable& table, const Step& step, double enter,
                            double leave) {
  const double length = step.twist.length();
  if (length == 0.0) return std::nullopt;
  return Ramp::make(length, enter, leave, step.top, table.acceleration, table.deceleration);
}

}  // namespace

double seconds_between(const MotionTable& table, const std::vector<Step>& steps,
                       const std::vector<double>& speeds) {
  double sum = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto ramp = ramp_of(table, steps[i], speeds[i], speeds[i + 1]);
    sum += ramp ? ramp->seconds() : steps[i].duration / kTicksPerSecond;
  }
  return sum;
}

std::vector<Step> cut_between(const MotionTable& table, const std::vector<Step>& steps,
                              const std::vector<double>& speeds) {
  std::vector<Step> out;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (const auto ramp = ramp_of(table, steps[i], speeds[i], speeds[i + 1])) {
      ramp->cut(steps[i], out);
    } else {
      out.push_back(steps[i]);
    }
  }
  return out;
}

double MotionTable::least_ticks(double metres, double from_speed) const {
  if (is_limited()) {
    const auto ramp = Ramp::make(metres, from_speed, 0.0, top_speed, acceleration, deceleration);
    if (ramp) return ramp->seconds() * kTicksPerSecond;
  }
  return metres / top_speed * kTicksPerSecond;
}

}  // namespace clearway
