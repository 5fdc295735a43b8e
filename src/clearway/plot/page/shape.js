// Bodies on the floor: where their corners are, and how far two of them are apart.

/** The body of a robot at a moment: world polygons, or a point with a radius. */
function bodyAt(robot, time) {
  const [x, y, heading] = poseAt(robot, time);
  const form = isCarrying(robot, time) ? robot.shape.loaded : robot.shape.body;
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  if (form.radius) return { parts: [[[x, y]]], radius: form.radius };
  return {
    parts: form.parts.map((part) => part.map(([u, v]) => [x + c * u - s * v, y + s * u + c * v])),
    radius: 0,
  };
}

function pointToEdge([px, py], [ax, ay], [bx, by]) {
  const [ux, uy] = [bx - ax, by - ay];
  const length = ux * ux + uy * uy;
  const share = length ? clamp(((px - ax) * ux + (py - ay) * uy) / length, 0, 1) : 0;
  return Math.hypot(px - ax - share * ux, py - ay - share * uy);
}

/** Whether an edge of counter-clockwise `a` has all of `b` on its outer side. */
function hasSeparatingEdge(a, b) {
  return a.length > 2 && a.some(([ax, ay], i) => {
    const [bx, by] = a[(i + 1) % a.length];
    return b.every(([px, py]) => (bx - ax) * (py - ay) - (by - ay) * (px - ax) < 0);
  });
}

function convexDistance(a, b) {
  const overlap = (a.length > 2 || b.length > 2) && !hasSeparatingEdge(a, b)
    && !hasSeparatingEdge(b, a);
  if (overlap) return 0;
  let least = Infinity;
  for (const [one, other] of [[a, b], [b, a]]) {
    for (const point of one) {
      other.forEach((corner, i) => {
        least = Math.min(least, pointToEdge(point, corner, other[(i + 1) % other.length]));
      });
    }
  }
  return least;
}

/** Distance between two bodies (m), 0 where they touch. */
function bodyDistance(a, b) {
  let least = Infinity;
  for (const part of a.parts) {
    for (const other of b.parts) least = Math.min(least, convexDistance(part, other));
  }
  return Math.max(0, least - a.radius - b.radius);
}

/** The robot nearest to this one, body to body: {robot, metres}; null where it is alone. */
function nearest(robot, time) {
  const body = bodyAt(robot, time);
  let found = null;
  for (const other of robots) {
    if (other === robot) continue;
    const metres = bodyDistance(body, bodyAt(other, time));
    if (!found || metres < found.metres) found = { robot: other, metres };
  }
  return found;
}

/** Largest reach of a body from its reference point (m). */
function reach(form) {
  return form.radius || Math.max(...form.parts.flat().map(([u, v]) => Math.hypot(u, v)));
}
