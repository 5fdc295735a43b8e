// The plan or the run as it came with the page, and where everything is at any moment.

const data = JSON.parse(byId("data").textContent);
const duration = data.duration;

/** First value and differences in thousandths -> values. */
function unpack(steps) {
  const values = new Float64Array(steps.length);
  let sum = 0;
  for (let i = 0; i < steps.length; i += 1) {
    sum += steps[i];
    values[i] = sum / 1000;
  }
  return values;
}

/** What all names begin with up to the last sign between words; names on the floor go without. */
const samePrefix = (() => {
  const [first = "", ...others] = data.robots.map((robot) => robot.id);
  let prefix = first.replace(/[^-_ .:]*$/, "");
  while (others.some((id) => !id.startsWith(prefix))) {
    prefix = prefix.slice(0, -1).replace(/[^-_ .:]*$/, "");
  }
  return others.length ? prefix : "";
})();

const robots = data.robots.map((raw, index) => ({
  ...raw,
  index,
  label: shorten(raw.id.slice(samePrefix.length) || raw.id, 14),
  shape: data.types[raw.type],
  t: unpack(raw.track.t),
  x: unpack(raw.track.x),
  y: unpack(raw.track.y),
  theta: unpack(raw.track.theta),
}));

const wrap = (angle) => {
  const turned = angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
  return turned === -Math.PI ? Math.PI : turned;
};

/** Last index whose key is not after the wanted one; -1 before the first. */
function lastBefore(length, keyAt, wanted) {
  let low = -1;
  let high = length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (keyAt(middle) <= wanted) low = middle;
    else high = middle;
  }
  return low;
}

const sampleAt = (robot, time) => Math.max(0, lastBefore(robot.t.length, (i) => robot.t[i], time));

/** Pose [x, y, heading] of a robot; it stands before its first and after its last sample. */
function poseAt(robot, time) {
  const { t, x, y, theta } = robot;
  const k = sampleAt(robot, time);
  if (k + 1 >= t.length || time <= t[k]) return [x[k], y[k], wrap(theta[k])];
  const share = (time - t[k]) / (t[k + 1] - t[k]);
  return [
    x[k] + share * (x[k + 1] - x[k]),
    y[k] + share * (y[k + 1] - y[k]),
    wrap(theta[k] + share * (theta[k + 1] - theta[k])),
  ];
}

/** Mean speed over the fifth of a second around a moment (m/s); creeping counts as rest. */
function speedAt(robot, time) {
  const [from, to] = [Math.max(0, time - 0.1), Math.min(duration, time + 0.1)];
  if (to <= from) return 0;
  const [a, b] = [poseAt(robot, from), poseAt(robot, to)];
  const speed = Math.hypot(b[0] - a[0], b[1] - a[1]) / (to - from);
  return speed < 0.02 ? 0 : speed;
}

function activityAt(robot, time) {
  const ms = 1000 * time;
  const k = lastBefore(robot.activities.length, (i) => robot.activities[i][1], ms);
  return k >= 0 && ms < robot.activities[k][2] ? robot.activities[k] : null;
}

const DOING = {
  drive: "driving", turn: "turning on the spot", wait: "waiting", service: "at work",
  charge: "charging", stop: "stopped by itself", refused: "without a plan",
  idle: "nothing to do", stand: "standing",
};

/** What a robot does, in words: its mode where it has modes and moves, in a run for whom it waits. */
function doingAt(robot, time) {
  const activity = activityAt(robot, time);
  if (!activity) {
    if (!robot.visits.length) return "idle";
    return robot.visits.some((v) => v.leave === null) ? "standing, work open" : "done";
  }
  if (activity[0] === "drive" || activity[0] === "turn") {
    const k = lastBefore(robot.modes.length, (i) => robot.modes[i][0], 1000 * time);
    const mode = k >= 0 ? robot.modes[k][1] : null;
    if (mode && mode !== "stop") return mode;
  }
  const whom = data.is_run && activity[0] === "wait" ? ` for ${activity[3]}` : "";
  return DOING[activity[0]] + whom;
}

/** The span [from, to, names] with a load on board, or null. */
function loadAt(robot, time) {
  const ms = 1000 * time;
  const span = robot.carrying[lastBefore(robot.carrying.length, (i) => robot.carrying[i][0], ms)];
  return span && (span[1] === undefined || ms < span[1]) ? span : null;
}

const isCarrying = (robot, time) => loadAt(robot, time) !== null;

/** Index of the visit that a robot is making or heading for; the number of visits at the end. */
function visitAt(robot, time) {
  // Visits that are not made come last.
  return 1 + lastBefore(robot.visits.length, (i) => robot.visits[i].leave ?? Infinity, 1000 * time);
}

/** The trip of a run [from, to, purpose, order, sentences], or the time between two. */
function tripAt(robot, time) {
  const ms = 1000 * time;
  const trip = robot.trips[lastBefore(robot.trips.length, (i) => robot.trips[i][0], ms)];
  return trip && ms < trip[1] ? trip : null;
}

/** Whether a robot has somewhere to go; in a run before a trip is decided it has not. */
const hasGoal = (robot, time) => !data.is_run || Boolean(tripAt(robot, time)?.[2]);

/** The task that a robot is at, or heading for; in a run its order. */
function taskAt(robot, time) {
  if (data.is_run) return tripAt(robot, time)?.[3] ?? null;
  const visit = robot.visits[visitAt(robot, time)];
  return visit && visit.task !== null ? visit.task : null;
}

/** Level of a robot's battery when last told. */
function energyText(robot, time) {
  const [times, levels] = robot.energy;
  const k = lastBefore(times.length, (i) => times[i], 1000 * time);
  return k < 0 ? "not told" : percent(levels[k], 0);
}
