// The orders of a run, each with its way through time; the first ones until asked for more.

const SHOWN_ORDERS = 20;
const ORDER_SHOWS = {
  all: () => true,
  open: (order) => order.ended === null,
  late: (order) => order.due !== null && (order.ended ?? 1000 * duration) > order.due,
  failed: (order) => order.state === "failed" || order.state === "cancelled",
};

function showOrders(holder, choose, go) {
  const time = (ms) => (ms === null || ms === undefined ? "\u2013" : clockText(ms / 1000));
  const row = (order) => {
    const robot = order.robot === null ? null : robots[order.robot];
    const from = order.started ?? order.assigned ?? order.released ?? 0;
    const late = order.due === null ? null : ((order.ended ?? 1000 * duration) - order.due) / 1000;
    const state = order.reason ? `${order.state}: ${order.reason}` : order.state;
    return [
      make("button", { type: "button", class: "link", onclick: () => go(from / 1000, robot) }, order.id),
      state, robot ? robotName(robot, choose) : "\u2013", time(order.released), time(order.started),
      time(order.ended),
      order.ended === null || order.released === null ? "\u2013" : `${fixed((order.ended - order.released) / 1000)} s`,
      late === null ? "\u2013" : late > 0 ? make("b", { class: "late" }, `${fixed(late)} s late`) : time(order.due),
    ];
  };
  const place = make("div", { class: "scroll" });
  const count = make("span", { class: "hint", role: "status" });
  const more = make("button", { type: "button", onclick: () => { shown = Infinity; draw(); } });
  const find = make("input", { type: "search", placeholder: "Order, robot or shelf", "aria-label": "Find orders" });
  const kind = make("select", { "aria-label": "Which orders" }, ...Object.keys(ORDER_SHOWS)
    .map((name) => make("option", { value: name }, `${name} (${data.orders.filter(ORDER_SHOWS[name]).length})`)));
  let shown = SHOWN_ORDERS;
  const draw = () => {
    const words = find.value.trim().toLowerCase();
    const isFound = (order) => !words || [order.id, order.fetches, robots[order.robot]?.id]
      .some((text) => text && text.toLowerCase().includes(words));
    const found = data.orders.filter((order) => ORDER_SHOWS[kind.value](order) && isFound(order));
    place.replaceChildren(table("Orders in the order of their release",
      [["Order", ""], ["State", ""], ["Robot", ""], ["Released", "number"], ["Started", "number"],
        ["Ended", "number"], ["Took", "number"], ["Due", "number"]],
      found.slice(0, shown).map(row)));
    more.hidden = found.length <= shown;
    say(more, `Show all ${found.length}`);
    say(count, `${Math.min(shown, found.length)} of ${found.length} shown`);
  };
  for (const input of [find, kind]) {
    input.addEventListener("input", () => {
      shown = SHOWN_ORDERS;
      draw();
    });
  }
  holder.append(make("div", { class: "filter" }, kind, find, count), place, more);
  draw();
}

/** The sums of each robot: where its time went. */
function showUse(holder, choose) {
  const sums = (robot, kinds) => robot.activities
    .reduce((sum, [kind, from, to]) => sum + (kinds.includes(kind) ? to - from : 0), 0) / 1000;
  const columns = [
    ["Driving", ["drive", "turn"]], ["At work", ["service"]], ["Waiting", ["wait", "refused", "stand"]],
    ["Stopped", ["stop"]], ["Charging", ["charge"]], ["Idle", ["idle"]],
  ];
  holder.append(table("Where each robot\u2019s time went, in seconds",
    [["Robot", ""], ["Orders", "number"], ["Distance, m", "number"],
      ...columns.map(([name]) => [`${name}, s`, "number"])],
    robots.map((robot) => {
      let metres = 0;
      for (let k = 1; k < robot.t.length; k += 1) {
        metres += Math.hypot(robot.x[k] - robot.x[k - 1], robot.y[k] - robot.y[k - 1]);
      }
      const done = data.orders.filter((o) => o.robot === robot.index && o.state === "done").length;
      return [robotName(robot, choose), String(done), fixed(metres, 0),
        ...columns.map(([, kinds]) => fixed(sums(robot, kinds), 0))];
    })));
}
