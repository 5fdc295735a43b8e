// The clock of the replay.

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8, 16, 32];

class Player {
  /** `show` is called with the time whenever something may look different. */
  constructor(show) {
    this.show = show;
    this.time = 0;
    this.isPlaying = false;
    // Slow enough to follow, fast enough that nobody waits longer than three quarters of a minute.
    this.speed = SPEEDS.find((speed) => speed >= 1 && duration / speed <= 45) || 32;
    this.isDue = false;
    this.last = 0;
  }

  play() {
    if (this.isPlaying || duration <= 0) return;
    if (this.time >= duration) this.time = 0;
    this.isPlaying = true;
    this.last = performance.now();
    this.refresh();
  }

  pause() {
    this.isPlaying = false;
    this.refresh();
  }

  toggle() {
    if (this.isPlaying) this.pause();
    else this.play();
  }

  seek(time) {
    this.time = Number.isFinite(time) ? clamp(time, 0, duration) : this.time;
    this.refresh();
  }

  setSpeed(speed) {
    this.speed = speed;
    this.refresh();
  }

  /** Go one step along the list of speeds. */
  shiftSpeed(step) {
    const index = SPEEDS.indexOf(this.speed) + step;
    this.setSpeed(SPEEDS[clamp(index, 0, SPEEDS.length - 1)]);
  }

  /** Draw with the next frame; a page at rest draws nothing. */
  refresh() {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame((now) => this.frame(now));
  }

  frame(now) {
    this.isDue = false;
    if (this.isPlaying) {
      // A tab that slept does not jump.
      const passed = clamp(now - this.last, 0, 250) / 1000;
      this.last = now;
      this.time = Math.min(duration, this.time + passed * this.speed);
      if (this.time >= duration) this.isPlaying = false;
      else this.refresh();
    }
    this.show(this.time);
  }
}
