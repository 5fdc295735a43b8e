// Put the page together.

const canvas = byId("floor");
const ctx = canvas.getContext("2d");
const camera = new Camera(data.site.bounds);
const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
const [floorLayer, nameLayer] = [new Layer(drawSite), new Layer(drawZoneNames)];
let ink = {};
let ratio = 1;
let isFollowing = false;

const player = new Player((time) => show(time));
const inspector = new Inspector(byId("fleet"), byId("card"), byId("tip"), () => player.refresh());
const transport = new Transport(player);
const content = makeContent(player, (robot) => inspector.choose(robot), go);

function readInk() {
  const style = getComputedStyle(document.documentElement);
  const names = ["floor", "outside", "grid", "edge", "zone", "zone-shelf", "zone-charger",
    "zone-edge", "zone-text", "closed", "obstacle", "obstacle-edge", "text", "muted", "plate", "focus",
    "surface", "line", "chosen", "shelf", "fault", "drive", "turn", "wait", "service", "on-service",
    "charge", "waiting", "load", "cursor"];
  ink = { font: style.getPropertyValue("--font") };
  for (const name of names) {
    const key = name.replace(/-(\w)/, (_, letter) => letter.toUpperCase());
    ink[key] = style.getPropertyValue(`--${name}`).trim();
  }
}

function show(time) {
  const { chosen } = inspector;
  if (isFollowing && chosen) camera.look(...poseAt(chosen, time));
  floorLayer.drawOn(ctx, camera, ink, ratio);
  camera.useMetres(ctx, ratio);
  content.drawUnder(ctx, camera, ink, time);
  nameLayer.drawOn(ctx, camera, ink, ratio);
  drawRobots(ctx, camera, ink, time, chosen, ratio);
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  content.drawOver(ctx, camera, ink, time);
  drawScale(ctx, camera, ink);
  canvas.style.touchAction = camera.isFitted ? "pan-y" : "none";
  transport.show(time);
  inspector.show(time, camera);
  content.show(time, chosen, ink);
  byId("follow").disabled = !chosen;
  byId("follow").setAttribute("aria-pressed", String(isFollowing && Boolean(chosen)));
  byId("fit").disabled = byId("zoom-out").disabled = camera.isFitted;
}

function resize() {
  const box = canvas.getBoundingClientRect();
  ratio = Math.min(3, window.devicePixelRatio || 1);
  [canvas.width, canvas.height] = [Math.round(box.width * ratio), Math.round(box.height * ratio)];
  camera.resize(box.width, box.height);
  show(player.time);
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  const other = theme === "dark" ? "light" : "dark";
  byId("theme").setAttribute("aria-label", `Switch to ${other} colours`);
  byId("theme").title = `Switch to ${other} colours`;
  readInk();
  player.refresh();
}

function follow(wanted) {
  isFollowing = wanted && Boolean(inspector.chosen);
  if (isFollowing && camera.scale < 3 * camera.fitScale) camera.zoom(3 * camera.fitScale / camera.scale);
  player.refresh();
}

/** Show one moment, and one robot, on the floor. */
function go(time, robot) {
  player.pause();
  player.seek(time);
  inspector.choose(robot);
  byId("replay").scrollIntoView({ behavior: isStill ? "auto" : "smooth", block: "start" });
}

const zoomBy = (factor) => {
  camera.zoom(factor);
  player.refresh();
};
const fit = () => {
  isFollowing = false;
  camera.fit();
  player.refresh();
};
const stepBy = (seconds) => {
  player.pause();
  player.seek(player.time + seconds);
};

byId("zoom-in").addEventListener("click", () => zoomBy(1.5));
byId("zoom-out").addEventListener("click", () => zoomBy(1 / 1.5));
byId("fit").addEventListener("click", fit);
byId("follow").addEventListener("click", () => follow(!isFollowing));
byId("theme").addEventListener("click", () =>
  setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) =>
  setTheme(event.matches ? "dark" : "light"));

listenToFloor(canvas, camera, player, inspector, (isPanned) => {
  if (isPanned) isFollowing = false;
  player.refresh();
});
listenToKeys({
  " ": () => player.toggle(),
  ArrowLeft: (event) => stepBy(event.shiftKey ? -10 : -1),
  ArrowRight: (event) => stepBy(event.shiftKey ? 10 : 1),
  ",": () => stepBy(-0.1),
  ".": () => stepBy(0.1),
  "<": () => player.shiftSpeed(-1),
  ">": () => player.shiftSpeed(1),
  Home: () => player.seek(0),
  End: () => player.seek(duration),
  "+": () => zoomBy(1.5),
  "=": () => zoomBy(1.5),
  "-": () => zoomBy(1 / 1.5),
  0: fit,
  "[": () => inspector.step(-1),
  "]": () => inspector.step(1),
  f: () => follow(!isFollowing),
  Escape: () => {
    isFollowing = false;
    inspector.choose(null);
  },
});

canvas.setAttribute("aria-label",
  `The site from above with ${robots.length} robots; a table of what they do follows below`);
document.documentElement.style.setProperty("--aspect", clamp(camera.aspect, 0.6, 3).toFixed(4));
byId("run").append(settings(Object.entries(data.run)));
setTheme(document.documentElement.dataset.theme);
new ResizeObserver(resize).observe(canvas);
if (!isStill) player.play();

window.clearway = {
  play: () => player.play(),
  pause: () => player.pause(),
  seek: (time) => player.seek(time),
  time: () => player.time,
  /** Poses [x, y, heading] (m, m, rad) of all robots at the moment shown. */
  poses: () => Object.fromEntries(robots.map((robot) => [robot.id, poseAt(robot, player.time)])),
  /** Choose a robot by its id; null chooses none. */
  choose: (id) => inspector.choose(robots.find((robot) => robot.id === id) || null),
  ...content.api,
  /** The replay as it is shown. */
  view: () => ({
    speed: player.speed, playing: player.isPlaying, duration, zoom: camera.scale / camera.fitScale,
    x: camera.x, y: camera.y, chosen: inspector.chosen ? inspector.chosen.id : null,
  }),
};
