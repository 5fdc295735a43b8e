#include "bind.hpp"

NB_MODULE(_core, m) {
  m.doc() =
      "Native search core: geometry, motion tables, space, search, multi-robot search, assignment.";
  // Parameters may live in globals, which Python need not clear before it ends.
  nanobind::set_leak_warnings(false);
  clearway::bindings::bind_body(m);
  clearway::bindings::bind_statics(m);
  clearway::bindings::bind_motion(m);
  clearway::bindings::bind_prioritised(m);
  clearway::bindings::bind_conflict_search(m);
  clearway::bindings::bind_lanes(m);
  clearway::bindings::bind_lone_legs(m);
  clearway::bindings::bind_route_search(m);
  clearway::bindings::bind_tail_planner(m);
  clearway::bindings::bind_path_conflicts(m);
  clearway::bindings::bind_assign(m);
}
