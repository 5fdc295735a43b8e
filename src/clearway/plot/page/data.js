// The plan as it came with the page, and where everything is at any moment.

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

const robots = data.robots.map((raw, index) => ({
  ...raw,
  index,
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

const DOING = { drive: "driving", turn: "turning on the spot", wait: "waiting", service: "at work" };

/** What a robot does, in words: its mode where it has modes and moves. */
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
  return DOING[activity[0]];
}

const isCarrying = (robot, time) =>
  robot.carrying.some(([from, to]) => 1000 * time >= from && (to === undefined || 1000 * time < to));

/** Index of the visit that a robot is making or heading for; the number of visits at the end. */
function visitAt(robot, time) {
  const k = robot.visits.findIndex((v) => v.leave === null || v.leave > 1000 * time);
  return k < 0 ? robot.visits.length : k;
}

function taskAt(robot, time) {
  const visit = robot.visits[visitAt(robot, time)];
  return visit && visit.task !== null ? visit.task : null;
}
