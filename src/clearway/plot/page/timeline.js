// One row per robot of a run: thousands of bars on a canvas, of all of it or of some minutes.

const BARS = {
  drive: "drive", turn: "turn", service: "at work", charge: "charging",
  wait: "waiting for a robot or a place", stop: "stopped by itself", refused: "without a plan",
  stand: "standing, not told why",
};
// Middle band of a row: kinds differ in height as well as in colour.
const BAR = {
  drive: 6, turn: 6, service: 14, charge: 14, wait: 12, stop: 14, refused: 14, stand: 3,
};
const SPANS = [["the whole run", Infinity], ["30 min", 1800], ["10 min", 600], ["3 min", 180], ["1 min", 60]];
const LINE = 22;
const HEAD = 24;
// Browsers draw no canvas that is taller (pixels).
const TALLEST = 16000;

class Timeline {
  constructor(holder, select, player, choose) {
    [this.holder, this.player, this.choose] = [holder, player, choose];
    this.canvas = make("canvas", {
      role: "img", tabindex: 0,
      "aria-label": `Timeline of ${robots.length} robots; the table of robots below has the sums`,
    });
    this.tip = make("div", { class: "tip", hidden: true });
    holder.replaceChildren(this.canvas, this.tip);
    this.layer = document.createElement("canvas");
    this.key = "";
    this.length = Infinity;
    for (const [name, seconds] of SPANS.filter(([, s]) => s === Infinity || s < duration)) {
      select.append(make("option", { value: seconds }, name));
    }
    select.addEventListener("change", () => {
      this.length = Number(select.value);
      player.refresh();
    });
    new ResizeObserver(() => player.refresh()).observe(holder);
    // Nobody waits for a picture that is out of sight.
    this.isSeen = true;
    new IntersectionObserver(([entry]) => {
      this.isSeen = entry.isIntersecting;
      player.refresh();
    }).observe(holder);
    this.listen();
  }

  /** First and last second shown. */
  get view() {
    const length = Math.min(this.length, duration);
    const from = clamp(this.player.time - 0.4 * length, 0, Math.max(0, duration - length));
    return [from, from + length];
  }

  xOf(seconds) {
    const [from, to] = this.frame;
    return this.left + (to > from ? (seconds - from) / (to - from) : 0) * (this.width - this.left - 12);
  }

  secondsAt(x) {
    const [from, to] = this.frame;
    return from + (x - this.left) / (this.width - this.left - 12) * (to - from);
  }

  robotAt(y) {
    return robots[Math.floor((y - HEAD) / LINE)] ?? null;
  }

  listen() {
    const { canvas } = this;
    const place = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    const seek = (x) => this.player.seek(clamp(this.secondsAt(x), ...this.frame));
    let isDragged = false;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      const [x, y] = place(event);
      const robot = this.robotAt(y);
      if (robot) this.choose(robot);
      if (x < this.left - 4) return;
      isDragged = true;
      canvas.setPointerCapture(event.pointerId);
      this.player.pause();
      seek(x);
    });
    canvas.addEventListener("pointermove", (event) => {
      const [x, y] = place(event);
      // Some minutes move with the time shown: there a drag would run away.
      if (isDragged && this.length >= duration) seek(x);
      this.showTip(x, y);
    });
    for (const name of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(name, () => { isDragged = false; });
    }
    canvas.addEventListener("pointerleave", () => { this.tip.hidden = true; });
  }

  showTip(x, y) {
    const robot = x > this.left ? this.robotAt(y) : null;
    const bar = robot && activityAt(robot, clamp(this.secondsAt(x), 0, duration));
    this.tip.hidden = !bar;
    if (!bar) return;
    const [kind, from, to, label] = bar;
    const what = kind === "wait" ? `waiting for ${label}` : `${DOING[kind]}${label ? `, ${label}` : ""}`;
    const trip = tripAt(robot, clamp(this.secondsAt(x), 0, duration));
    const errand = trip && trip[2] ? make("div", {}, `${trip[2]}${trip[3] ? `, order ${trip[3]}` : ""}`) : "";
    this.tip.replaceChildren(make("b", {}, robot.id), make("div", {},
      `${what}: ${clockText(from / 1000)} to ${clockText(to / 1000)} (${fixed((to - from) / 1000)} s)`), errand);
    const wide = this.tip.offsetWidth;
    const below = y + 18 + this.tip.offsetHeight < this.height ? y + 18 : y - this.tip.offsetHeight - 8;
    this.tip.style.transform = `translate(${clamp(x + 12, 0, Math.max(0, this.width - wide - 4))}px, ${Math.max(0, below)}px)`;
  }

  show(time, chosen, ink) {
    const width = this.holder.clientWidth;
    if (!width) return;
    this.frame = this.view;
    if (this.key && !this.isSeen) return;
    [this.width, this.height] = [width, HEAD + LINE * robots.length + 4];
    const sharp = Math.min(3, window.devicePixelRatio || 1, TALLEST / this.height);
    const longest = Math.max(...robots.map((robot) => robot.id.length), 3);
    this.letters = clamp(longest, 3, width < 600 ? 8 : 16);
    this.left = 24 + 7.6 * this.letters;
    const key = [width, sharp, ink.floor, chosen && chosen.index, ...this.frame].join();
    if (key !== this.key) {
      this.key = key;
      for (const canvas of [this.canvas, this.layer]) {
        [canvas.width, canvas.height] = [Math.round(width * sharp), Math.round(this.height * sharp)];
      }
      this.canvas.style.height = `${this.height}px`;
      const own = this.layer.getContext("2d");
      own.setTransform(sharp, 0, 0, sharp, 0, 0);
      this.draw(own, chosen, ink);
    }
    const pen = this.canvas.getContext("2d");
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    pen.drawImage(this.layer, 0, 0);
    pen.setTransform(sharp, 0, 0, sharp, 0, 0);
    const x = this.xOf(time);
    pen.fillStyle = ink.cursor;
    pen.fillRect(x - 0.75, 10, 1.5, this.height);
    pen.beginPath();
    for (const [dx, y] of [[-5, 0], [5, 0], [5, 8], [0, 14], [-5, 8]]) pen.lineTo(x + dx, y);
    pen.fill();
  }

  draw(pen, chosen, ink) {
    pen.clearRect(0, 0, this.width, this.height);
    if (chosen) {
      pen.fillStyle = ink.chosen;
      pen.fillRect(0, HEAD + LINE * chosen.index, this.width, LINE);
    }
    this.drawAxis(pen, ink);
    pen.font = `620 12px ${ink.font}`;
    pen.textBaseline = "middle";
    for (const robot of robots) {
      const middle = HEAD + LINE * (robot.index + 0.5);
      pen.textAlign = "left";
      pen.fillStyle = robot.colour;
      pen.fillRect(2, middle - 5, 10, 10);
      pen.fillStyle = ink.text;
      pen.fillText(shorten(robot.id, this.letters), 18, middle);
      this.drawRow(pen, robot, middle, ink);
    }
  }

  drawAxis(pen, ink) {
    const [from, to] = this.frame;
    const room = Math.max(1, (this.width - this.left) / 76);
    const steps = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400, 36000];
    const step = steps.find((s) => (to - from) / s <= room) ?? (to - from) / room;
    pen.font = `400 11.5px ${ink.font}`;
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    for (let t = Math.ceil(from / step) * step; step > 0 && t <= to; t += step) {
      const x = this.xOf(t);
      pen.fillStyle = ink.line;
      pen.fillRect(x - 0.5, HEAD - 5, 1, this.height);
      pen.fillStyle = ink.muted;
      if (x < this.width - 18) pen.fillText(clockText(t, 0), x, HEAD - 13);
    }
  }

  /** A thin line below the bars where something is on board. */
  drawLoads(pen, robot, middle, ink) {
    const [from, to] = this.frame;
    const spans = robot.carrying;
    pen.fillStyle = ink.load;
    for (let k = Math.max(0, lastBefore(spans.length, (i) => spans[i][0], 1000 * from));
      k < spans.length && spans[k][0] < 1000 * to; k += 1) {
      const x = Math.max(this.left, this.xOf(spans[k][0] / 1000));
      const end = this.xOf(Math.min(to, spans[k][1] / 1000));
      if (end > x) pen.fillRect(x, middle + 8, end - x, 2.4);
    }
  }

  drawRow(pen, robot, middle, ink) {
    this.drawLoads(pen, robot, middle, ink);
    const [from, to] = this.frame;
    const bars = robot.activities;
    const colour = { ...ink, wait: ink.waiting, stop: ink.fault, refused: ink.fault, stand: ink.wait };
    let k = Math.max(0, lastBefore(bars.length, (i) => bars[i][1], 1000 * from));
    pen.font = `620 11px ${ink.font}`;
    pen.textAlign = "center";
    for (; k < bars.length && bars[k][1] < 1000 * to; k += 1) {
      const [kind, begin, end, label] = bars[k];
      const height = BAR[kind];
      if (!height) continue;
      const x = Math.max(this.left, this.xOf(begin / 1000));
      const wide = Math.max(0.6, this.xOf(Math.min(to, end / 1000)) - x);
      pen.fillStyle = colour[kind];
      if (kind === "wait" && wide > 6) {
        // Waiting is stripes, seen without colour too.
        for (let s = 0; s < wide; s += 4) {
          pen.fillRect(x + s, middle - height / 2, Math.min(2.4, wide - s), height);
        }
        continue;
      }
      pen.fillRect(x, middle - height / 2, wide, height);
      if ((kind === "service" || kind === "charge") && label && 6.6 * label.length + 6 < wide) {
        pen.fillStyle = ink.onService;
        pen.fillText(label, x + wide / 2, middle + 0.5);
      }
    }
  }
}

function showBars(list) {
  for (const [kind, name] of Object.entries(BARS)) {
    const shown = robots.some((robot) => robot.activities.some((each) => each[0] === kind));
    if (!shown) continue;
    const height = BAR[kind];
    const box = (x, width) => makeSvg("rect", { x, y: (18 - height) / 2, width, height, class: `bar-${kind}` });
    list.append(make("li", {},
      makeSvg("svg", { viewBox: "0 0 24 18", class: "wide legend" },
        ...(kind === "wait" ? [0, 4, 8, 12, 16, 20].map((x) => box(x, 2)) : [box(0.5, 23)])),
      name));
  }
  if (!robots.some((robot) => robot.carrying.length)) return;
  list.append(make("li", {}, makeSvg("svg", { viewBox: "0 0 24 18", class: "wide legend" },
    makeSvg("rect", { x: 0.5, y: 8, width: 23, height: 2.4, class: "bar-load" })), "with a load"));
}
