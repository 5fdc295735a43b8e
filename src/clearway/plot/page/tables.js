// The figures below the replay: key figures, costs and bounds, tasks, closest encounters.

const SHOWN_PAIRS = 8;

const cells = (row, tag = "td") => row.map((cell) =>
  cell instanceof Node && cell.nodeName.toLowerCase() === tag ? cell : make(tag, {}, cell));

/** A table; heads are [text, "number" | ""] pairs. */
function table(caption, heads, rows) {
  const kind = heads.map(([, k]) => k);
  const body = make("tbody", {}, ...rows.map((row) => {
    const made = cells(row);
    made.forEach((cell, i) => kind[i] && cell.classList.add(kind[i]));
    return make("tr", {}, ...made);
  }));
  return make("table", {},
    make("caption", {}, caption),
    make("thead", {}, make("tr", {},
      ...heads.map(([text, k]) => make("th", { scope: "col", class: k || null }, text)))),
    body);
}

function showFigures(list) {
  const m = data.metrics;
  const least = m.least_separation;
  const figures = [
    ["Robots", String(m.robots), null],
    ["Tasks done", `${m.tasks_done} of ${m.tasks}`, null],
    ["Makespan", `${fixed(m.makespan)} s`, "when the last robot arrives"],
    ["Sum of costs", `${fixed(m.sum_of_costs)} s`, "all arrival times added up"],
    ["Gap to the bound", m.gap === null ? "unknown" : percent(m.gap),
      m.gap === null ? "no lower bound is known" : "at most this far from the best"],
    ["Distance driven", `${fixed(m.distance)} m`, "by all robots together"],
    ["Closest encounter", least ? `${fixed(least.metres, 2)} m` : "none",
      least ? `${least.robots.join(" and ")} at ${clockText(least.time)}` : "no pair of robots"],
    ["Violations", String(m.violations), m.violations ? "found by the judge" : "the judge found nothing wrong"],
  ];
  list.append(...figures.map(([name, value, note]) => make("div", {},
    make("dt", {}, name), make("dd", { class: "value" }, value),
    note === null ? null : make("dd", { class: "note" }, note))));
}

/** A bound and what the plan costs, as two bars on one scale. */
function boundBars(name, cost, bound, unit) {
  const bar = (label, value, kind) => make("div", { class: `bound ${kind}` },
    make("span", { class: "what" }, label),
    make("span", { class: "track" },
      make("span", { style: `width:${(100 * value / Math.max(cost, bound)).toFixed(2)}%` })),
    make("span", { class: "number" }, `${fixed(value)}${unit}`));
  return make("div", { class: "bounds" }, bar("Lower bound", bound, "low"), bar(name, cost, "high"));
}

function showCost(holder) {
  const m = data.metrics;
  const say1 = `The robots\u2019 arrival times add up to ${fixed(m.sum_of_costs)} s. `;
  if (m.lower_bound === null) {
    holder.append(make("p", {}, `${say1}No lower bound is known, so this page cannot tell how far `
      + "from the best plan that is."));
  } else if (m.status !== "solved") {
    holder.append(make("p", {}, `${say1}The plan is not complete, so that cannot be held against the `
      + `lower bound for all the work, ${fixed(m.lower_bound)} s.`));
  } else {
    const words = m.gap === null || m.gap > 0.0005
      ? `so a better plan could save ${m.gap === null ? "nothing" : percent(m.gap / (1 + m.gap))} at most.`
      : "so no plan is better.";
    holder.append(
      make("p", {}, `${say1}No motion of these robots through the same visits can bring that below `
        + `${fixed(m.lower_bound)} s, ${words}`),
      boundBars("This plan", m.sum_of_costs, m.lower_bound, " s"));
    if (m.gap !== null) {
      holder.append(make("p", { class: "hint" }, `The gap is cost over bound less one: ${percent(m.gap, 2)}. `
        + "Part of it may belong to the bound, which ignores some of what robots must respect."));
    }
  }
  if (m.cost !== null) {
    const name = m.cost_name || "own objective";
    const low = m.status === "solved" ? m.cost_lower_bound : null;
    holder.append(make("h3", {}, `The system’s own cost: ${name}`));
    if (low !== null && low > 0) holder.append(boundBars("This plan", m.cost, low, ""));
    const tail = low !== null && low > 0
      ? ` with a lower bound of ${fixed(low)}: at most ${percent(m.cost / low - 1, 2)} above the best.`
      : ".";
    holder.append(make("p", {}, `This plan has ${fixed(m.cost)}${tail}`));
  }
  const graph = Object.entries(data.bound_on_graph);
  if (graph.length) {
    holder.append(make("h3", {}, "On the finite graph that was searched"), settings(graph));
  }
}

function settings(pairs) {
  return make("dl", { class: "settings" }, ...pairs.map(([name, value]) =>
    make("div", {}, make("dt", {}, name), make("dd", {}, value))));
}

function robotName(robot, choose) {
  return make("button", { type: "button", class: "link", onclick: () => choose(robot) },
    make("span", { class: "dot", style: `background:${robot.colour}` }), robot.id);
}

function showApart(holder, go) {
  const pairs = data.metrics.separations;
  if (!pairs.length) {
    holder.append(make("p", {}, "No distances between robots were measured."));
    return;
  }
  const byName = new Map(robots.map((robot) => [robot.id, robot]));
  const widest = (shown) => Math.max(...shown.map((pair) => pair.metres), 1e-9);
  const draw = (shown) => table(
    "Least distance between the bodies of each pair of robots, the closest first",
    [["Robots", ""], ["Least distance", "number"], ["", "gauge"], ["At", "number"]],
    shown.map((pair) => [
      make("span", { class: "ids" }, pair.robots.join(" \u2013 ")),
      `${fixed(pair.metres, 2)} m`,
      make("span", { class: "track", "aria-hidden": "true" },
        make("span", { style: `width:${(100 * Math.max(0, pair.metres) / widest(shown)).toFixed(1)}%` })),
      make("button", {
        type: "button", class: "link", "aria-label": `See ${pair.robots.join(" and ")} at ${clockText(pair.time)}`,
        onclick: () => go(pair.time, byName.get(pair.robots[0]) || null),
      }, clockText(pair.time)),
    ]));
  const place = make("div", { class: "scroll" }, draw(pairs.slice(0, SHOWN_PAIRS)));
  holder.append(place);
  if (pairs.length <= SHOWN_PAIRS) return;
  const more = make("button", {
    type: "button", "aria-expanded": "false",
    onclick: () => {
      const isOpen = more.getAttribute("aria-expanded") === "true";
      more.setAttribute("aria-expanded", String(!isOpen));
      say(more, isOpen ? `Show all ${pairs.length} pairs` : `Show the closest ${SHOWN_PAIRS} only`);
      place.replaceChildren(draw(isOpen ? pairs.slice(0, SHOWN_PAIRS) : pairs));
    },
  }, `Show all ${pairs.length} pairs`);
  holder.append(more);
}

function showWork(holder, choose, go) {
  const share = (robot) => data.metrics.per_robot[robot.id];
  const tasks = (robot) => {
    const list = make("ol", { class: "tasks" });
    for (const task of share(robot).tasks) {
      const visit = robot.visits.find((v) => v.task === task);
      const isMade = robot.visits.every((v) => v.task !== task || v.leave !== null);
      list.append(make("li", {}, visit && visit.arrive !== null
        ? make("button", { type: "button", class: "chip", onclick: () => go(visit.arrive / 1000, robot) }, task)
        : make("span", { class: "chip open" }, isMade ? task : `${task} (open)`)));
    }
    return list.childElementCount ? list : "none";
  };
  const seconds = (value) => fixed(value);
  holder.append(table(
    "Tasks and use of time of each robot",
    [["Robot", ""], ["Tasks in order", "wide"], ["Arrives, s", "number"], ["Distance, m", "number"],
      ["Driving, s", "number"], ["Turning, s", "number"], ["Waiting, s", "number"],
      ["At work, s", "number"], ["Used", "number"]],
    robots.map((robot) => {
      const m = share(robot);
      return [robotName(robot, choose), tasks(robot), seconds(m.arrival), fixed(m.distance),
        seconds(m.driving), seconds(m.turning), seconds(m.waiting), seconds(m.service),
        percent(m.utilisation, 0)];
    })));
}
