// What comes and goes on the floor of a run: shelves, obstacles, stops.

const placeBoxes = (() => {
  const boxes = new Map();
  for (const { name, kind, polygon } of data.site.zones) {
    if (kind !== "shelf" || !data.places[name]) continue;
    const xs = polygon.map((p) => p[0]);
    const ys = polygon.map((p) => p[1]);
    const [left, bottom] = [Math.min(...xs), Math.min(...ys)];
    boxes.set(name, [left, bottom, Math.max(...xs) - left, Math.max(...ys) - bottom]);
  }
  return boxes;
})();

/** Name of the shelf that stands in a place, or null. */
function shelfIn(place, time) {
  const changes = data.places[place];
  return changes[lastBefore(changes.length, (i) => changes[i][0], 1000 * time)][1];
}

function drawShelves(ctx, ink, time) {
  ctx.beginPath();
  for (const [name, [x, y, w, h]] of placeBoxes) {
    if (shelfIn(name, time) !== null) ctx.rect(x + 0.12 * w, y + 0.12 * h, 0.76 * w, 0.76 * h);
  }
  ctx.fillStyle = ink.shelf;
  ctx.fill();
}

/** The shelf on a robot's back, as a frame around the body. */
function drawCarried(ctx, camera, ink, robot, time) {
  const load = loadAt(robot, time);
  const box = load && placeBoxes.get(load[2]);
  if (!box) return;
  const [x, y, heading] = poseAt(robot, time);
  ctx.save();
  ctx.translate(x, y);
  ctx.rotate(heading);
  ctx.fillStyle = ink.shelf;
  ctx.strokeStyle = ink.text;
  ctx.lineWidth = 1 / camera.scale;
  ctx.beginPath();
  ctx.rect(-0.5 * box[2], -0.5 * box[3], box[2], box[3]);
  ctx.fill();
  ctx.stroke();
  ctx.restore();
}

const obstaclePaths = data.obstacles.map((obstacle) => ({
  ...obstacle, path: closedPath(obstacle.polygon),
}));

const obstaclesAt = (time) =>
  obstaclePaths.filter((each) => each.from <= 1000 * time && 1000 * time < each.to);

function drawObstacles(ctx, camera, ink, time) {
  for (const { path } of obstaclesAt(time)) {
    ctx.fillStyle = ink.closed;
    ctx.fill(path);
    ctx.strokeStyle = ink.fault;
    ctx.lineWidth = 2.4 / camera.scale;
    ctx.setLineDash([6 / camera.scale, 4 / camera.scale]);
    ctx.stroke(path);
    ctx.setLineDash([]);
  }
}

/** Names of obstacles, and a cross beside whoever has stopped by itself. In pixels. */
function drawFaults(ctx, camera, ink, time) {
  ctx.font = `600 12px ${ink.font}`;
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  for (const { name, polygon } of obstaclesAt(time)) {
    const [x, y] = camera.toScreen(
      (Math.min(...polygon.map((p) => p[0])) + Math.max(...polygon.map((p) => p[0]))) / 2,
      Math.max(...polygon.map((p) => p[1])),
    );
    haloText(ctx, ink, name, x, y - 9);
  }
  for (const robot of robots) {
    if (activityAt(robot, time)?.[0] !== "stop") continue;
    const [x, y] = poseAt(robot, time);
    const [px, py] = camera.toScreen(x, y);
    const r = reach(robot.shape.body) * camera.scale + 3;
    ctx.strokeStyle = ink.fault;
    ctx.lineWidth = 2.6;
    ctx.beginPath();
    ctx.arc(px, py, r, 0, 2 * Math.PI);
    ctx.moveTo(px + 0.72 * r - 4, py - 0.72 * r - 4);
    ctx.lineTo(px + 0.72 * r + 4, py - 0.72 * r + 4);
    ctx.moveTo(px + 0.72 * r + 4, py - 0.72 * r - 4);
    ctx.lineTo(px + 0.72 * r - 4, py - 0.72 * r + 4);
    ctx.stroke();
  }
}
