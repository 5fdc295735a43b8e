// One function per header that is bound.
#pragma once

#include <nanobind/nanobind.h>

namespace clearway::bindings {

void bind_assign(nanobind::module_& m);
void bind_body(nanobind::module_& m);
void bind_statics(nanobind::module_& m);
void bind_motion(nanobind::module_& m);
void bind_prioritised(nanobind::module_& m);
void bind_conflict_search(nanobind::module_& m);
void bind_lanes(nanobind::module_& m);
void bind_lone_legs(nanobind::module_& m);
void bind_route_search(nanobind::module_& m);
void bind_tail_planner(nanobind::module_& m);
void bind_path_conflicts(nanobind::module_& m);

}  // namespace clearway::bindings
