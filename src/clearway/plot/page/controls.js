// Buttons, slider, pointer and keys.

/** Mouse and touch on the floor: drag to pan, wheel or pinch to zoom, tap to choose.
 * `moved` is called with whether the view went elsewhere, not only nearer. */
function listenToFloor(canvas, camera, player, inspector, moved) {
  const fingers = new Map();
  let travelled = 0;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return { gap: Math.hypot(a[0] - b[0], a[1] - b[1]), x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2 };
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    fingers.set(event.pointerId, place(event));
    travelled = fingers.size > 1 ? Infinity : 0;
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = place(event);
    const before = fingers.get(event.pointerId);
    if (!before) {
      inspector.hover(inspector.robotAt(camera, ...now, player.time));
      return;
    }
    const pinch = fingers.size === 2 ? spread() : null;
    fingers.set(event.pointerId, now);
    travelled += Math.hypot(now[0] - before[0], now[1] - before[1]);
    if (pinch) {
      const then = spread();
      camera.pan(then.x - pinch.x, then.y - pinch.y);
      camera.zoom(then.gap / Math.max(1, pinch.gap), then.x, then.y);
      moved(true);
    } else if (travelled > 4) {
      camera.pan(now[0] - before[0], now[1] - before[1]);
      moved(true);
    }
  });
  const lift = (event) => {
    if (!fingers.delete(event.pointerId) || event.type === "pointercancel") return;
    if (travelled <= 4) {
      const found = inspector.robotAt(camera, ...place(event), player.time);
      inspector.choose(found);
    }
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("pointerleave", () => inspector.hover(null));
  canvas.addEventListener("wheel", (event) => {
    // Turned away from a site that is wholly in view, the wheel goes on scrolling the page.
    if (event.deltaY > 0 && camera.isFitted) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 18 : 1;
    camera.zoom(Math.exp(-clamp(lines * event.deltaY, -120, 120) / 400), ...place(event));
    moved(false);
  }, { passive: false });
}

function listenToKeys(keys) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const tag = event.target.tagName;
    if (tag === "SELECT" || tag === "TEXTAREA") return;
    const presses = tag === "BUTTON" || tag === "SUMMARY" || tag === "A";
    if (event.key === " " && presses) return;
    const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    event.preventDefault();
    act(event);
  });
}

const PLAY = "M5 3.2v13.6L16.5 10z";
const PAUSE = "M4.5 3.5h3.8v13H4.5zM11.7 3.5h3.8v13h-3.8z";

class Transport {
  constructor(player) {
    this.player = player;
    this.play = byId("play");
    this.scrub = byId("scrub");
    this.speed = byId("speed");
    this.speed.append(...SPEEDS.map((value) => make("option", { value }, `${value}\u00d7`)));
    this.scrub.max = duration;
    this.scrub.disabled = this.play.disabled = duration <= 0;
    say(byId("length"), `/ ${clockText(duration)}`);
    this.play.addEventListener("click", () => player.toggle());
    this.scrub.addEventListener("input", () => player.seek(Number(this.scrub.value)));
    this.speed.addEventListener("change", () => player.setSpeed(Number(this.speed.value)));
  }

  show(time) {
    const { isPlaying, speed } = this.player;
    say(byId("now"), clockText(time));
    this.scrub.value = time;
    this.scrub.style.setProperty("--done", `${duration ? 100 * time / duration : 0}%`);
    this.scrub.setAttribute("aria-valuetext", `${clockText(time)} of ${clockText(duration)} minutes`);
    this.speed.value = String(speed);
    const label = isPlaying ? "Pause" : "Play";
    if (this.play.getAttribute("aria-label") !== label) this.play.setAttribute("aria-label", label);
    this.play.querySelector("path").setAttribute("d", isPlaying ? PAUSE : PLAY);
  }
}
