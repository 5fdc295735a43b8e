// Which robot is looked at, and what is known about it at this moment.

class Inspector {
  constructor(list, card, tip, changed) {
    [this.list, this.card, this.tip, this.changed] = [list, card, tip, changed];
    this.chosen = null;
    this.hovered = null;
    this.entries = robots.map((robot) => this.entry(robot));
    list.append(...this.entries.map((entry) => entry.item));
    this.fields = {};
    // What a robot of a run does stands below, with the reason.
    const names = data.is_run
      ? { type: "Type", speed: "Speed", task: "Order", load: "Load", near: "Nearest robot" }
      : { type: "Type", doing: "Doing", speed: "Speed", task: "Task", load: "Load", near: "Nearest robot" };
    if (data.curves?.energy) names.energy = "Energy";
    this.heading = make("h2");
    this.hint = make("p", { class: "hint" },
      "Choose a robot here, on the floor or with [ and ] to see what it does.");
    this.facts = make("dl", { hidden: true });
    for (const [key, name] of Object.entries(names)) {
      this.fields[key] = make("dd");
      this.facts.append(make("div", {}, make("dt", {}, name), this.fields[key]));
    }
    card.append(this.heading, this.hint, this.facts);
  }

  entry(robot) {
    const doing = make("span", { class: "doing" });
    const badge = make("span", { class: "dot", style: `background:${robot.colour}` });
    const button = make("button", {
      type: "button", "aria-pressed": "false", title: robot.id,
      onclick: () => this.choose(robot === this.chosen ? null : robot),
      onmouseenter: () => this.hover(robot), onmouseleave: () => this.hover(null),
      onfocus: () => this.hover(robot), onblur: () => this.hover(null),
    }, badge, make("span", { class: "id" }, robot.id), doing);
    return { item: make("li", {}, button), button, doing };
  }

  choose(robot) {
    this.chosen = robot;
    this.entries.forEach(({ button }, index) => {
      button.setAttribute("aria-pressed", String(robots[index] === robot));
    });
    if (robot) this.reveal(this.entries[robot.index].item);
    this.changed();
  }

  /** Scroll the list, and only the list, to an entry. */
  reveal(item) {
    const { list } = this;
    const [top, left] = [item.offsetTop - list.offsetTop, item.offsetLeft - list.offsetLeft];
    if (top < list.scrollTop || top + item.offsetHeight > list.scrollTop + list.clientHeight) {
      list.scrollTop = top - list.clientHeight / 3;
    }
    if (left < list.scrollLeft || left + item.offsetWidth > list.scrollLeft + list.clientWidth) {
      list.scrollLeft = left - list.clientWidth / 3;
    }
  }

  /** Choose the next robot of the list (or with -1 the one before), round and round. */
  step(by) {
    const count = robots.length;
    const from = this.chosen ? this.chosen.index : by > 0 ? -1 : count;
    if (count) this.choose(robots[(from + by + count) % count]);
  }

  hover(robot) {
    if (robot === this.hovered) return;
    this.hovered = robot;
    this.changed();
  }

  /** The uppermost robot whose body, or ten pixels around it, holds a pixel of the canvas. */
  robotAt(camera, px, py, time) {
    const point = { parts: [[camera.toFloor(px, py)]], radius: 10 / camera.scale };
    let found = null;
    let least = Infinity;
    for (const robot of robots) {
      const metres = bodyDistance(point, bodyAt(robot, time));
      const [x, y] = poseAt(robot, time);
      const far = Math.hypot(x - point.parts[0][0][0], y - point.parts[0][0][1]);
      if (metres === 0 && far < least) [found, least] = [robot, far];
    }
    return found;
  }

  show(time, camera) {
    robots.forEach((robot, index) => say(this.entries[index].doing, doingAt(robot, time)));
    this.showCard(this.chosen, time);
    this.showTip(this.hovered, time, camera);
  }

  showCard(robot, time) {
    this.facts.hidden = !robot;
    this.hint.hidden = Boolean(robot);
    say(this.heading, robot ? robot.id : robots.length ? "No robot chosen" : "No robots");
    if (!robot) return;
    const near = nearest(robot, time);
    say(this.fields.type, robot.type);
    if (this.fields.doing) say(this.fields.doing, doingAt(robot, time));
    say(this.fields.speed, `${fixed(speedAt(robot, time), 2)} m/s`);
    say(this.fields.task, taskAt(robot, time) ?? "none");
    const load = loadAt(robot, time);
    say(this.fields.load, load ? load[2] || "carrying" : "empty");
    if (this.fields.energy) say(this.fields.energy, energyText(robot, time));
    say(this.fields.near, near ? `${fixed(near.metres, 2)} m (${near.robot.id})` : "alone");
  }

  showTip(robot, time, camera) {
    this.tip.hidden = !robot;
    if (!robot) return;
    const task = taskAt(robot, time);
    const facts = [
      doingAt(robot, time), `${fixed(speedAt(robot, time), 2)} m/s`,
      task === null ? "no task" : data.is_run ? `order ${task}` : `task ${task}`,
    ];
    const near = nearest(robot, time);
    if (near) facts.push(`${fixed(near.metres, 2)} m to ${near.robot.id}`);
    this.tip.replaceChildren(make("b", {}, robot.id), make("span", {}, facts.join(" \u00b7 ")));
    const [x, y] = camera.toScreen(...poseAt(robot, time));
    const below = y < 90 ? 26 : -(this.tip.offsetHeight + 22);
    const half = this.tip.offsetWidth / 2;
    const left = clamp(x, half + 6, Math.max(half + 6, camera.width - half - 6));
    const top = clamp(y + below, 6, Math.max(6, camera.height - this.tip.offsetHeight - 6));
    this.tip.style.transform = `translate(${(left - half).toFixed(0)}px, ${top.toFixed(0)}px)`;
  }
}
