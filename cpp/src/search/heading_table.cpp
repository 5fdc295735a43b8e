#include "clearway/search/heading_table.hpp"

#include <algorithm>
#include <cmath>

namespace clearway {

namespace {

constexpr double kDiscSpacing = 0.5;  // travel between the discs that cover a motion (m)

}  // namespace

HeadingTable::HeadingTable(const MotionTable& table, const std::vector<Body>& bodies, double theta)
    : headings_(table.headings),
      num_primitives_(table.primitives.size()),
      step_(kTau / table.headings) {
  base_ = theta - step_ * std::floor(theta / step_ + 1e-9);
  for (int k = 0; k < headings_; ++k) {
    cosine_.push_back(std::cos(base_ + step_ * k));
    sine_.push_back(std::sin(base_ + step_ * k));
  }
  for (int k = 0; k < headings_; ++k) {
    const Frame f = frame(0.0, 0.0, k);
    for (const Primitive& p : table.primitives) {
      const Frame end = moved(f, p.twist);
      landings_.push_back({end.x, end.y, ((k + p.turn_steps) % headings_ + headings_) % headings_});
    }
  }
  first_disc_.push_back(0);
  for (const Body& body : bodies) {
    for (int k = 0; k < headings_; ++k) {
      const Frame f = frame(0.0, 0.0, k);
      for (const Primitive& p : table.primitives) {
        const double travel = p.twist.length() + std::abs(p.twist.c) * body.circumradius();
        const int count = std::max(1, static_cast<int>(std::ceil(travel / kDiscSpacing)));
        for (int i = count - 1; i >= 0; --i) {  // the far end is most likely to be blocked
          const Frame g = moved(f, p.twist.part((i + 0.5) / count));
          for (const Circle& c : body.cover()) {
            const Point at = g.to_world({c.x, c.y});
            discs_.push_back({at.x, at.y, c.r + 0.5 * travel / count});
          }
        }
        first_disc_.push_back(static_cast<std::uint32_t>(discs_.size()));
      }
    }
  }
}

int HeadingTable::index(double theta) const {
  const long k = std::lround((theta - base_) / step_) % headings_;
  return static_cast<int>(k < 0 ? k + headings_ : k);
}

ConnectTable::ConnectTable(const MotionTable& table, const Objective& objective)
    : table_(&table), objective_(objective) {
  double radius = 1.0;
  for (const Connection& c : table.connections) {
    radius = std::max(radius, c.radius);
    reversible_ = reversible_ && c.forward_speed == c.reverse_speed &&
                  c.forward_arc_speed == c.reverse_arc_speed;
  }
  cell_ = radius / 4.0;
  half_ = 28;  // cells on each side of the goal: 7 radii
  value_.assign(static_cast<std::size_t>(2 * half_ * half_ * kHeadings), -1.0F);
}

double ConnectTable::operator()(double x, double y, double turn) {
  if (y < 0.0) {  // mirrored curves cost the same
    y = -y;
    turn = -turn;
  }
  if (reversible_ && x < 0.0) {  // and so do curves driven backwards
    x = -x;
    turn = -turn;
  }
  const int ix = static_cast<int>(std::floor(x / cell_)) + half_;
  const int iy = static_cast<int>(y / cell_);
  if (ix < 0 || ix >= 2 * half_ || iy >= half_) return -1.0;
  int it = static_cast<int>(std::lround(turn * kHeadings / kTau)) % kHeadings;
  if (it < 0) it += kHeadings;
  float& value = value_[static_cast<std::size_t>((it * half_ + iy) * 2 * half_ + ix)];
  if (value < 0.0F) {
    const Pose from{(ix - half_ + 0.5) * cell_, (iy + 0.5) * cell_, it * kTau / kHeadings};
    connect(*table_, objective_, from, Pose{}, 1, scratch_);
    value = scratch_.empty() ? 0.0F : static_cast<float>(scratch_.front().cost);
  }
  return value;
}

}  // namespace clearway
