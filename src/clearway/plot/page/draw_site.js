// The floor: bounds, zones, obstacles, a grid and a scale.

function closedPath(points) {
  const path = new Path2D();
  points.forEach(([x, y], i) => (i ? path.lineTo(x, y) : path.moveTo(x, y)));
  path.closePath();
  return path;
}

const ZONE_COLOURS = { closed: "closed", shelf: "zoneShelf", charger: "zoneCharger" };

const sitePaths = (() => {
  const everyone = { solid: new Path2D(), wall: new Path2D() };
  const some = { solid: new Path2D(), wall: new Path2D() };
  for (const { polygon, disc, wall, blocks } of data.site.obstacles) {
    const group = blocks.length ? some : everyone;
    if (polygon) group.solid.addPath(closedPath(polygon));
    if (disc) {
      const [x, y, radius] = disc;
      group.solid.moveTo(x + radius, y);
      group.solid.arc(x, y, radius, 0, 2 * Math.PI);
    }
    if (wall) {
      group.wall.moveTo(...wall[0]);
      group.wall.lineTo(...wall[1]);
    }
  }
  // Hundreds of zones are drawn as one path for each colour.
  const zones = new Map();
  for (const { kind, polygon } of data.site.zones) {
    const colour = ZONE_COLOURS[kind] ?? "zone";
    if (!zones.has(colour)) zones.set(colour, new Path2D());
    zones.get(colour).addPath(closedPath(polygon));
  }
  return { bounds: closedPath(data.site.bounds), everyone, some, zones };
})();

/** 1, 2 or 5 times a power of ten, at least `least`. */
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find((k) => k * power >= least);
}

function drawGrid(ctx, camera, ink) {
  const step = roundStep(48 / camera.scale);
  const { left, right, bottom, top } = camera.box;
  ctx.beginPath();
  for (let x = Math.ceil(left / step) * step; x <= right; x += step) {
    ctx.moveTo(x, bottom);
    ctx.lineTo(x, top);
  }
  for (let y = Math.ceil(bottom / step) * step; y <= top; y += step) {
    ctx.moveTo(left, y);
    ctx.lineTo(right, y);
  }
  ctx.strokeStyle = ink.grid;
  ctx.lineWidth = 1 / camera.scale;
  ctx.stroke();
}

function drawSite(ctx, camera, ink, ratio) {
  ctx.setTransform(1, 0, 0, 1, 0, 0);
  ctx.fillStyle = ink.outside;
  ctx.fillRect(0, 0, ctx.canvas.width, ctx.canvas.height);
  camera.useMetres(ctx, ratio);
  const pixel = 1 / camera.scale;

  ctx.fillStyle = ink.floor;
  ctx.fill(sitePaths.bounds);
  ctx.save();
  ctx.clip(sitePaths.bounds);
  drawGrid(ctx, camera, ink);
  ctx.restore();

  ctx.setLineDash([5 * pixel, 4 * pixel]);
  ctx.lineWidth = 1.2 * pixel;
  for (const [colour, path] of sitePaths.zones) {
    ctx.fillStyle = ink[colour];
    ctx.fill(path);
    ctx.strokeStyle = ink.zoneEdge;
    ctx.stroke(path);
  }
  ctx.setLineDash([]);

  ctx.fillStyle = ink.obstacle;
  ctx.fill(sitePaths.everyone.solid);
  ctx.strokeStyle = ink.obstacleEdge;
  ctx.lineWidth = pixel;
  ctx.stroke(sitePaths.everyone.solid);
  ctx.lineWidth = 2.5 * pixel;
  ctx.stroke(sitePaths.everyone.wall);
  // What only some robots must avoid is dashed and lets the floor shine through.
  ctx.setLineDash([3 * pixel, 3 * pixel]);
  ctx.globalAlpha = 0.4;
  ctx.fill(sitePaths.some.solid);
  ctx.globalAlpha = 1;
  ctx.lineWidth = 1.2 * pixel;
  ctx.stroke(sitePaths.some.solid);
  ctx.stroke(sitePaths.some.wall);
  ctx.setLineDash([]);

  ctx.strokeStyle = ink.edge;
  ctx.lineWidth = 1.6 * pixel;
  ctx.stroke(sitePaths.bounds);
}

/** Beyond these many of one kind, all their names are shown or none. */
const FEW_ZONES = 12;

/** Names of zones where they fit, in small letters if need be. */
function drawZoneNames(ctx, camera, ink, ratio) {
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  ctx.fillStyle = ink.zoneText;
  const font = (pixels) => `500 ${pixels}px ${ink.font}`;
  const kinds = new Map();
  for (const { name, kind, polygon } of data.site.zones) {
    const xs = polygon.map((p) => p[0]);
    const ys = polygon.map((p) => p[1]);
    const [left, top] = camera.toScreen(Math.min(...xs), Math.max(...ys));
    const [right, bottom] = camera.toScreen(Math.max(...xs), Math.min(...ys));
    const isSeen = right > 0 && left < camera.width && bottom > 0 && top < camera.height;
    const size = [11, 9].find((pixels) => {
      ctx.font = font(pixels);
      return Math.min(bottom - top, right - left) > pixels + 3
        && ctx.measureText(name).width < right - left - (pixels - 7);
    }) ?? 0;
    if (!kinds.has(kind)) kinds.set(kind, []);
    kinds.get(kind).push({ name, size, isSeen, x: (left + right) / 2, y: (top + bottom) / 2 });
  }
  for (const zones of kinds.values()) {
    const least = zones.length > FEW_ZONES ? Math.min(...zones.map((zone) => zone.size)) : null;
    for (const { name, size, isSeen, x, y } of zones) {
      if (!isSeen || !(least ?? size)) continue;
      ctx.font = font(least ?? size);
      ctx.fillText(name, x, y);
    }
  }
}

/** A scale below the site, in the strip that the camera leaves free. */
function drawScale(ctx, camera, ink) {
  const metres = roundStep(36 / camera.scale);
  const [x, y] = [14, camera.height - 9];
  const right = x + metres * camera.scale;
  ctx.font = `500 11px ${ink.font}`;
  ctx.textAlign = "left";
  ctx.textBaseline = "middle";
  ctx.beginPath();
  ctx.moveTo(x, y - 6);
  ctx.lineTo(x, y);
  ctx.lineTo(right, y);
  ctx.lineTo(right, y - 6);
  ctx.strokeStyle = ink.plate;
  ctx.lineWidth = 4.5;
  ctx.stroke();
  ctx.strokeStyle = ink.text;
  ctx.lineWidth = 1.5;
  ctx.stroke();
  haloText(ctx, ink, `${metres} m`, right + 7, y - 3);
}

/** A picture that is drawn again only where the view or the colours have changed. */
class Layer {
  constructor(draw) {
    this.draw = draw;
    this.canvas = document.createElement("canvas");
    this.key = "";
  }

  drawOn(ctx, camera, ink, ratio) {
    const { width, height } = ctx.canvas;
    if (!width || !height) return;
    const key = [camera.x, camera.y, camera.scale, width, height, ratio, ink.floor].join();
    if (key !== this.key) {
      this.key = key;
      [this.canvas.width, this.canvas.height] = [width, height];
      this.draw(this.canvas.getContext("2d"), camera, ink, ratio);
    }
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.drawImage(this.canvas, 0, 0);
  }
}
