// One row per robot: what it does when, with a cursor that follows the replay.

const KINDS = {
  drive: "drive", turn: "turn on the spot", wait: "wait", service: "work (service)",
};
const ROW = 26;
const AXIS = 24;
// Middle band of a row: kinds differ in height and pattern as well as in colour.
const BAND = { drive: 9, turn: 9, wait: 9, service: 17 };

function patterns() {
  return makeSvg("defs", {},
    makeSvg("pattern", {
      id: "p-turn", width: 5, height: 5, patternUnits: "userSpaceOnUse",
      patternTransform: "rotate(45)",
    },
    makeSvg("rect", { width: 5, height: 5, class: "turn-base" }),
    makeSvg("rect", { width: 2, height: 5, class: "turn-stripe" })),
    makeSvg("pattern", { id: "p-wait", width: 5, height: 9, patternUnits: "userSpaceOnUse" },
      makeSvg("circle", { cx: 2.5, cy: 4.5, r: 1.2, class: "wait-dot" })));
}

class Gantt {
  constructor(holder, player, choose) {
    [this.holder, this.player, this.choose] = [holder, player, choose];
    this.cursor = null;
    this.width = 0;
    new ResizeObserver(() => this.build()).observe(holder);
    this.build();
  }

  xOf(seconds) {
    return this.left + (duration ? seconds / duration : 0) * (this.width - this.left - 12);
  }

  build() {
    const width = this.holder.clientWidth;
    if (!width || width === this.width) return;
    this.width = width;
    const longest = Math.max(...robots.map((robot) => robot.id.length), 3);
    this.letters = clamp(longest, 3, width < 600 ? 7 : 16);
    this.left = 24 + 7.6 * this.letters;
    const height = AXIS + ROW * robots.length + 4;
    const svg = makeSvg("svg", {
      width, height, viewBox: `0 0 ${width} ${height}`, role: "img",
      "aria-label": `Timeline of ${robots.length} robots over ${clockText(duration)} minutes`,
    }, patterns(), this.axis(height), ...robots.map((robot) => this.row(robot)));
    this.cursor = makeSvg("g", { class: "cursor" },
      makeSvg("path", { d: "M-5 0h10v8l-5 6-5-6z" }),
      makeSvg("line", { y1: 10, y2: height }));
    svg.append(this.cursor);
    svg.addEventListener("pointerdown", (event) => this.press(event, svg));
    this.holder.replaceChildren(svg);
    this.show(this.player.time);
  }

  axis(height) {
    const room = Math.max(1, (this.width - this.left) / 76);
    const steps = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200];
    const step = steps.find((s) => duration / s <= room) || duration / room;
    const group = makeSvg("g", { class: "axis" });
    for (let t = 0; t <= duration; t += step) {
      const x = this.xOf(t);
      group.append(makeSvg("line", { x1: x, x2: x, y1: AXIS - 5, y2: height }));
      // The last name would stick out of the picture.
      if (x < this.width - 18) {
        group.append(makeSvg("text", { x, y: AXIS - 9, "text-anchor": "middle" }, clockText(t, 0)));
      }
      if (duration <= 0) break;
    }
    return group;
  }

  row(robot) {
    const y = AXIS + ROW * robot.index;
    const group = makeSvg("g", { class: "row", transform: `translate(0 ${y})` },
      makeSvg("rect", { class: "back", width: this.width, height: ROW }),
      makeSvg("g", { class: "name", onclick: () => this.choose(robot) },
        makeSvg("title", {}, robot.id),
        makeSvg("rect", { class: "hit", width: this.left, height: ROW }),
        makeSvg("rect", { class: "dot", x: 2, y: ROW / 2 - 5, width: 10, height: 10, rx: 2.5, fill: robot.colour }),
        makeSvg("text", { x: 18, y: ROW / 2 + 4 }, shorten(robot.id, this.letters))));
    for (const [kind, start, end, label] of robot.activities) {
      group.append(this.bar(kind, start / 1000, end / 1000, label));
    }
    robot.row = group;
    return group;
  }

  bar(kind, start, end, label) {
    const [x, width] = [this.xOf(start), Math.max(1, this.xOf(end) - this.xOf(start))];
    const height = BAND[kind];
    const what = `${KINDS[kind]}${label ? `, ${label}` : ""}: `
      + `${clockText(start)} to ${clockText(end)} (${fixed(end - start)} s)`;
    const group = makeSvg("g", { class: kind, transform: `translate(0 ${(ROW - height) / 2})` },
      makeSvg("title", {}, what),
      makeSvg("rect", { x, width, height, rx: Math.min(2, width / 3) }));
    if (kind === "service" && label && 6.8 * label.length + 8 < width) {
      group.append(makeSvg("text", { x: x + width / 2, y: height / 2 + 4, "text-anchor": "middle" }, label));
    }
    return group;
  }

  press(event, svg) {
    const seek = (e) => {
      const share = (e.clientX - svg.getBoundingClientRect().left - this.left)
        / (this.width - this.left - 12);
      this.player.seek(share * duration);
    };
    if (event.button || event.clientX - svg.getBoundingClientRect().left < this.left - 4) return;
    seek(event);
    svg.setPointerCapture(event.pointerId);
    const stop = () => {
      svg.removeEventListener("pointermove", seek);
      svg.removeEventListener("pointerup", stop);
      svg.removeEventListener("pointercancel", stop);
    };
    svg.addEventListener("pointermove", seek);
    svg.addEventListener("pointerup", stop);
    svg.addEventListener("pointercancel", stop);
  }

  show(time, chosen = null) {
    if (!this.cursor) return;
    this.cursor.setAttribute("transform", `translate(${this.xOf(time).toFixed(1)} 0)`);
    for (const robot of robots) robot.row.classList.toggle("chosen", robot === chosen);
  }
}

function showLegend(list) {
  for (const [kind, name] of Object.entries(KINDS)) {
    const height = BAND[kind];
    list.append(make("li", {},
      makeSvg("svg", { viewBox: "0 0 24 18", class: "wide legend" },
        makeSvg("g", { class: kind, transform: `translate(0 ${(18 - height) / 2})` },
          makeSvg("rect", { x: 0.5, width: 23, height, rx: 2 }))),
      name));
  }
}
