// Why a robot does what it does: the chain of causes at a moment, as `clearway explain` prints it.

const robotsById = new Map(robots.map((robot) => [robot.id, robot]));

/** Who has a place, or has it first of those to whom it is promised:
 * [promised, come, left, robot, sentence until it comes, sentence from then on]. */
function holderOf(place, time, but) {
  const ms = 1000 * time;
  let found = null;
  for (const hold of data.holds[place] ?? []) {
    const isHis = hold[0] <= ms && ms < hold[2] && hold[3] !== but.index;
    if (isHis && (!found || hold[1] < found[1])) found = hold;
  }
  return found;
}

function leadsOf(robot, causes, time) {
  const leads = [];
  for (const cause of causes) {
    const other = robotsById.get(cause);
    if (other) {
      leads.push([other, []]);
      continue;
    }
    const place = cause.slice(cause.indexOf(":") + 1);
    const hold = cause.includes(":") ? holderOf(place, time, robot) : null;
    if (!hold) continue;
    leads.push([robots[hold[3]], [hold[1] <= 1000 * time ? hold[5] : hold[4]]]);
  }
  return leads;
}

/** Links {robot, depth, state, causes, sentences, ends}: the robot, then whom it stands for. */
function chainOf(robot, time) {
  const found = [];
  const follow = (each, above, held) => {
    const [kind, , , , sentence, causes] = activityAt(each, time) ?? each.activities.at(-1);
    const trip = tripAt(each, time);
    const told = trip ? trip[4].slice(0, above.length ? 1 : undefined) : [];
    const link = {
      robot: each, depth: above.length, state: data.states[kind], causes,
      sentences: [...held, sentence, ...told],
    };
    const place = found.push(link);
    const leads = leadsOf(each, causes, time);
    const way = [...above, each];
    link.ends = leads.length ? "" : "root";
    for (const [other, words] of leads) {
      if (way.includes(other)) link.ends = "cycle";
      else if (found.some((seen) => seen.robot === other)) link.ends ||= "told";
      else follow(other, way, words);
    }
    if (link.ends === "told" && found.length > place) link.ends = "";
  };
  follow(robot, [], []);
  return found;
}

class Why {
  constructor(holder, choose) {
    [this.holder, this.choose] = [holder, choose];
    this.key = "";
  }

  show(time, robot) {
    this.holder.hidden = !robot;
    if (!robot) return;
    const chain = chainOf(robot, time);
    const key = JSON.stringify(chain.map((link) => [link.robot.id, link.sentences, link.ends]));
    if (key === this.key) return;
    this.key = key;
    this.holder.replaceChildren(
      make("h3", {}, "Why?"),
      ...chain.map((link) => this.link(link)),
    );
  }

  link({ robot, depth, state, sentences, ends }) {
    const closes = ends === "cycle"
      ? make("p", {}, "This closes a circle: they wait for each other.") : null;
    return make("div", { class: "link-of", style: `--depth:${Math.min(depth, 5)}` },
      make("p", { class: "who" }, robotName(robot, this.choose), make("span", { class: "state" }, state)),
      ...sentences.map((sentence) => make("p", {}, sentence)), closes);
  }
}
