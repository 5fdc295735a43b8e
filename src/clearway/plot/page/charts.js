// How the run goes over time: small curves with a cursor that follows the replay.

const CHART = { width: 520, height: 150, left: 46, right: 12, top: 12, bottom: 24 };

function chartsOf() {
  const { curves } = data;
  const share = (value) => percent(value, 0);
  const charts = [
    { title: "Orders done an hour", note: "in the minutes before", format: (v) => fixed(v, 0),
      lines: [["orders an hour", curves.throughput, "drive"]] },
    { title: "Waiting and working", note: "share of the fleet", format: share, top: 1,
      lines: [["driving or at work", curves.working, "service"], ["waiting", curves.waiting, "waiting"]] },
    { title: "Orders open", note: "released and not done", format: (v) => fixed(v, 0),
      lines: [["open", curves.open, "drive"]] },
  ];
  if (curves.energy) {
    charts.push({ title: "Energy", note: "level of the batteries", format: share, top: 1,
      lines: [["mean of the fleet", curves.energy, "service"], ["lowest", curves.least_energy, "fault"]] });
  }
  return charts;
}

class Chart {
  constructor(holder, chart, player) {
    Object.assign(this, chart);
    const { width, height, left, right, top, bottom } = CHART;
    const highest = this.lines.map(([, values]) => Math.max(...values, 0));
    this.most = chart.top ?? roundStep(Math.max(...highest, 1));
    this.cursor = makeSvg("line", { class: "now", y1: top, y2: height - bottom });
    const svg = makeSvg("svg", {
      viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${this.title}, ${this.note}`,
    }, ...this.axes(), ...this.lines.map((line) => this.line(line)), this.cursor);
    svg.addEventListener("click", (event) => {
      const box = svg.getBoundingClientRect();
      const x = (event.clientX - box.left) / box.width * width;
      player.seek((x - left) / (width - left - right) * duration);
    });
    this.values = this.lines.map(([name, , colour]) => [make("b"), name, colour]);
    holder.append(make("figure", { class: "chart" },
      make("figcaption", {}, make("h3", {}, this.title), make("span", { class: "hint" }, this.note)),
      svg,
      make("p", { class: "key" }, ...this.values.map(([value, name, colour]) => make("span", {},
        make("span", { class: "swatch", style: `background:var(--${colour})` }), `${name} `, value)))));
  }

  xOf(seconds) {
    return CHART.left + (duration ? seconds / duration : 0) * (CHART.width - CHART.left - CHART.right);
  }

  yOf(value) {
    const { height, top, bottom } = CHART;
    return height - bottom - value / this.most * (height - top - bottom);
  }

  axes() {
    const { width, height, right, bottom, left } = CHART;
    const rows = [0, 0.5, 1].map((part) => part * this.most).flatMap((value) => [
      makeSvg("line", { class: "rule", x1: left, x2: width - right, y1: this.yOf(value), y2: this.yOf(value) }),
      makeSvg("text", { x: left - 6, y: this.yOf(value) + 4, "text-anchor": "end" }, this.format(value)),
    ]);
    const times = [0, 0.25, 0.5, 0.75, 1].map((part) => makeSvg("text", {
      x: this.xOf(part * duration), y: height - bottom + 16,
      "text-anchor": part === 1 ? "end" : part ? "middle" : "start",
    }, clockText(part * duration, 0)));
    return [...rows, ...times];
  }

  line([, values, colour]) {
    const points = data.curves.t.map((t, i) => `${this.xOf(t).toFixed(1)} ${this.yOf(values[i]).toFixed(1)}`);
    return makeSvg("path", { class: "curve", d: `M${points.join("L")}`, style: `stroke:var(--${colour})` });
  }

  show(time) {
    const x = this.xOf(time).toFixed(1);
    if (this.at === x) return;
    this.at = x;
    this.cursor.setAttribute("x1", x);
    this.cursor.setAttribute("x2", x);
    const k = clamp(lastBefore(data.curves.t.length, (i) => data.curves.t[i], time), 0, data.curves.t.length - 1);
    this.values.forEach(([holder], i) => say(holder, this.format(this.lines[i][1][k])));
  }
}
