// From one speed to another along a stretch, as fast as limits on acceleration let it.
#pragma once

#include <optional>
#include <vector>

#include "clearway/motion/table.hpp"

namespace clearway {

// Speed up, hold, slow down.
class Ramp {
 public:
  // Over `length` (m) from speed `enter` to `leave`, never above `top` (m/s); nothing where the
  // stretch is too short for the change of speed.
  static std::optional<Ramp> make(double length, double enter, double leave, double top, double up,
                                  double down);

  double rising() const { return (peak_ - enter_) / up_; }     // s
  double falling() const { return (peak_ - leave_) / down_; }  // s
  double seconds() const { return rising() + holding_ + falling(); }
  double way(double t) const;  // m, after t seconds

  // One step of a drive as steps of even speed, each at most some 0.1 s long while speed changes.
  // All ends lie on the ramp, so that the mean acceleration between them is that of the ramp.
  void cut(const Step& whole, std::vector<Step>& out) const;

 private:
  double length_ = 0.0, enter_ = 0.0, leave_ = 0.0, peak_ = 0.0;
  double up_ = 1.0, down_ = 1.0, holding_ = 0.0;
};

// Speeds at the start of each step, and the last one's end, of the fastest drive that begins in
// `mode`, stops wherever the course changes and at the end. False: it cannot be driven.
bool speeds_between(const MotionTable& table, int mode, const std::vector<Step>& steps,
                    std::vector<double>& speeds);

// Seconds of that drive.
double seconds_between(const MotionTable& table, const std::vector<Step>& steps,
                       const std::vector<double>& speeds);

// That drive in steps of even speed.
std::vector<Step> cut_between(const MotionTable& table, const std::vector<Step>& steps,
                              const std::vector<double>& speeds);

}  // namespace clearway
