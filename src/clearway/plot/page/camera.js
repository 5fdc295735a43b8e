// The view onto the floor: which metre lies on which pixel.

class Camera {
  constructor(points) {
    const [xs, ys] = [points.map((p) => p[0]), points.map((p) => p[1])];
    this.box = {
      left: Math.min(...xs), right: Math.max(...xs),
      bottom: Math.min(...ys), top: Math.max(...ys),
    };
    [this.width, this.height] = [1, 1];
    this.fit();
  }

  get aspect() {
    return (this.box.right - this.box.left) / (this.box.top - this.box.bottom);
  }

  get fitScale() {
    // The strips above and below leave room for the scale.
    const [side, strip] = [Math.min(14, 0.03 * this.width), 24];
    return Math.max(1e-3, Math.min(
      (this.width - 2 * side) / (this.box.right - this.box.left),
      (this.height - 2 * strip) / (this.box.top - this.box.bottom),
    ));
  }

  get isFitted() {
    return this.scale <= 1.001 * this.fitScale;
  }

  resize(width, height) {
    const zoom = this.scale / this.fitScale;
    [this.width, this.height] = [width, height];
    this.scale = zoom * this.fitScale;
    this.settle();
  }

  fit() {
    this.scale = this.fitScale;
    this.x = (this.box.left + this.box.right) / 2;
    this.y = (this.box.bottom + this.box.top) / 2;
  }

  /** Keep the zoom within reason and the site in sight. */
  settle() {
    this.scale = clamp(this.scale, this.fitScale, Math.max(200, 40 * this.fitScale));
    if (this.isFitted) this.fit();
    this.x = clamp(this.x, this.box.left, this.box.right);
    this.y = clamp(this.y, this.box.bottom, this.box.top);
  }

  /** Zoom by a factor; the floor under the pixel (px, py) stays there. */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [wx, wy] = this.toFloor(px, py);
    this.scale = clamp(factor * this.scale, this.fitScale, Math.max(200, 40 * this.fitScale));
    this.x = wx - (px - this.width / 2) / this.scale;
    this.y = wy + (py - this.height / 2) / this.scale;
    this.settle();
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.settle();
  }

  look(x, y) {
    [this.x, this.y] = [x, y];
    this.settle();
  }

  toScreen(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }

  toFloor(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }

  /** Let the context draw in metres, y up, from here on. */
  useMetres(ctx, ratio) {
    const k = this.scale * ratio;
    ctx.setTransform(
      k, 0, 0, -k,
      ratio * this.width / 2 - k * this.x, ratio * this.height / 2 + k * this.y,
    );
  }
}
