// The robots on the floor: ways ahead, marks, bodies with their ids.

const channels = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));

/** Relative luminance of a colour "#rrggbb", as WCAG defines it. */
function luminance(colour) {
  const [r, g, b] = channels(colour).map((value) => {
    const share = value / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

const inksOn = new Map();

/** White or near-black, whichever reads better on a colour. */
function inkOn(colour) {
  if (!inksOn.has(colour)) {
    const light = luminance(colour);
    const isWhite = 1.05 / (light + 0.05) > (light + 0.05) / 0.056;
    inksOn.set(colour, isWhite ? "#ffffff" : "#111418");
  }
  return inksOn.get(colour);
}

const lineColours = new Map();

/** A robot's colour for thin lines: moved away from the floor's until it stands out 3 : 1. */
function lineColour(colour, ink) {
  const key = colour + ink.floor;
  if (!lineColours.has(key)) lineColours.set(key, mixedColour(colour, ink));
  return lineColours.get(key);
}

function mixedColour(colour, ink) {
  const floor = luminance(ink.floor);
  const goal = floor > 0.2 ? 0 : 255;
  const hex = (value) => Math.round(value).toString(16).padStart(2, "0");
  let mixed = colour;
  for (let share = 0.05; share < 1; share += 0.05) {
    const [high, low] = [floor, luminance(mixed)].sort((a, b) => b - a);
    if ((high + 0.05) / (low + 0.05) >= 3) break;
    mixed = `#${channels(colour).map((v) => hex(v + share * (goal - v))).join("")}`;
  }
  return mixed;
}

/** The way to the next visit; in a plan all of the way for the chosen robot. */
function drawWay(ctx, camera, ink, robot, time, isChosen) {
  if (!hasGoal(robot, time)) return;
  const visit = robot.visits[visitAt(robot, time)];
  const until = (isChosen && !data.is_run) || !visit || visit.arrive === null ? duration : visit.arrive / 1000;
  ctx.beginPath();
  ctx.moveTo(...poseAt(robot, time));
  for (let k = sampleAt(robot, time) + 1; k < robot.t.length && robot.t[k] < until; k += 1) {
    ctx.lineTo(robot.x[k], robot.y[k]);
  }
  ctx.lineTo(...poseAt(robot, until));
  ctx.strokeStyle = lineColour(robot.colour, ink);
  ctx.globalAlpha = isChosen ? 0.9 : 0.55;
  ctx.lineWidth = (isChosen ? 2.6 : 1.8) / camera.scale;
  ctx.lineJoin = "round";
  ctx.stroke();
  ctx.globalAlpha = 1;
}

function diamond(ctx, x, y, r) {
  ctx.beginPath();
  ctx.moveTo(x, y + r);
  ctx.lineTo(x + r, y);
  ctx.lineTo(x, y - r);
  ctx.lineTo(x - r, y);
  ctx.closePath();
}

function drawMarks(ctx, camera, ink, robot, time) {
  const r = clamp(0.45, 3 / camera.scale, 7 / camera.scale);
  ctx.lineWidth = 1.5 / camera.scale;
  const line = lineColour(robot.colour, ink);
  ctx.strokeStyle = line;
  const next = visitAt(robot, time);
  const mark = (visit, isMade) => {
    diamond(ctx, visit.pose[0], visit.pose[1], 1.15 * r);
    ctx.fillStyle = isMade ? ink.floor : robot.colour;
    ctx.fill();
    ctx.strokeStyle = isMade ? line : ink.text;
    ctx.stroke();
  };
  if (data.is_run) {
    // A run has hundreds of visits: the next one only.
    if (hasGoal(robot, time) && next < robot.visits.length) mark(robot.visits[next], false);
    return;
  }
  ctx.fillStyle = ink.floor;
  ctx.beginPath();
  ctx.arc(robot.start[0], robot.start[1], r, 0, 2 * Math.PI);
  ctx.fill();
  ctx.stroke();
  robot.visits.forEach((visit, index) => mark(visit, index < next));
}

function tracePart(ctx, form) {
  ctx.beginPath();
  if (form.radius) {
    ctx.arc(0, 0, form.radius, 0, 2 * Math.PI);
    return;
  }
  for (const part of form.parts) {
    part.forEach(([u, v], i) => (i ? ctx.lineTo(u, v) : ctx.moveTo(u, v)));
    ctx.closePath();
  }
}

/** Front, back and half width of a body (m). */
function extentOf(form) {
  if (form.radius) return [form.radius, -form.radius, form.radius];
  const corners = form.parts.flat();
  const xs = corners.map((p) => p[0]);
  return [Math.max(...xs), Math.min(...xs), Math.max(...corners.map((p) => Math.abs(p[1])))];
}

function drawBody(ctx, camera, ink, robot, time, isChosen) {
  const [x, y, heading] = poseAt(robot, time);
  const loaded = isCarrying(robot, time);
  const form = loaded ? robot.shape.loaded : robot.shape.body;
  const [front, back, half] = extentOf(form);
  const pixel = 1 / camera.scale;
  ctx.save();
  ctx.translate(x, y);
  ctx.rotate(heading);
  tracePart(ctx, form);
  if (isChosen) {
    ctx.strokeStyle = ink.focus;
    ctx.lineWidth = 7 * pixel;
    ctx.stroke();
  }
  // Parts of one body overlap: outline first, then fill, leaves no inner edges.
  ctx.strokeStyle = ink.text;
  ctx.lineWidth = 2.4 * pixel;
  ctx.lineJoin = "round";
  ctx.stroke();
  ctx.fillStyle = robot.colour;
  ctx.fill("nonzero");
  const mark = inkOn(robot.colour);
  ctx.fillStyle = mark;
  const depth = Math.min(0.22 * (front - back), 0.5 * half);
  ctx.beginPath();
  ctx.moveTo(front - 0.3 * depth, 0);
  ctx.lineTo(front - 1.3 * depth, depth);
  ctx.lineTo(front - 1.3 * depth, -depth);
  ctx.closePath();
  ctx.fill();
  if (loaded && !content.showsLoad(robot, time)) {
    ctx.strokeStyle = mark;
    ctx.lineWidth = Math.max(1.5 * pixel, 0.05);
    const [near, far] = [back + 0.12 * (front - back), front - 1.6 * depth];
    ctx.strokeRect(near, -0.72 * half, far - near, 1.44 * half);
  }
  ctx.restore();
}

// Beside more bodies than these, ids would hide each other and the bodies.
const FEW_NAMES = 60;

/** The id on the body where it fits, otherwise beside it; in a plan the mode below the chosen one. */
function drawName(ctx, camera, ink, robot, time, isChosen) {
  const pose = poseAt(robot, time);
  const form = robot.shape.body;
  const [front, back, half] = extentOf(form);
  const middle = (front + back) / 2 - 0.08 * (front - back);
  const [x, y] = camera.toScreen(
    pose[0] + middle * Math.cos(pose[2]), pose[1] + middle * Math.sin(pose[2]),
  );
  const name = robot.label;
  const size = clamp(half * camera.scale * 0.9, 10, 15);
  ctx.font = `650 ${size}px ${ink.font}`;
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  const room = 1.7 * Math.min(half, (front - back) / 2) * camera.scale;
  const above = reach(form) * camera.scale;
  if (ctx.measureText(name).width < room && size < room) {
    ctx.fillStyle = inkOn(robot.colour);
    ctx.fillText(name, x, y);
  } else if (isChosen || robots.length <= FEW_NAMES) {
    haloText(ctx, ink, name, x, y - Math.min(above, 0.5 * (half * camera.scale + above)) - 8);
  }
  if (isChosen && !data.is_run) {
    ctx.font = `500 12px ${ink.font}`;
    haloText(ctx, ink, doingAt(robot, time), x, y + above + 11);
  }
}

function haloText(ctx, ink, text, x, y) {
  ctx.strokeStyle = ink.plate;
  ctx.lineWidth = 3.5;
  ctx.lineJoin = "round";
  ctx.strokeText(text, x, y);
  ctx.fillStyle = ink.text;
  ctx.fillText(text, x, y);
}

function drawRobots(ctx, camera, ink, time, chosen, ratio) {
  camera.useMetres(ctx, ratio);
  const order = robots.filter((robot) => robot !== chosen);
  if (chosen) order.push(chosen);
  for (const robot of order) drawWay(ctx, camera, ink, robot, time, robot === chosen);
  for (const robot of order) drawMarks(ctx, camera, ink, robot, time);
  for (const robot of order) drawBody(ctx, camera, ink, robot, time, robot === chosen);
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  for (const robot of order) drawName(ctx, camera, ink, robot, time, robot === chosen);
}
