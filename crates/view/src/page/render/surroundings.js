// Where the content of the scene is, for depth, shadows and the ground. Looked at now and then only: it costs a pass over all objects.

const PAUSE = 500; // milliseconds

export class Surroundings {
  /** @param {import('./scene_view.js').SceneView} view */
  constructor(view) {
    this.view = view;
    this.sphere = { centre: [0, 0, 0], radius: 1 };
    this.floor = false; // whether a shape covers the ground
    this.version = -1;
    this.time = -Infinity;
  }

  /** Whether it is time to look again. @param {number} now milliseconds */
  outdated(now) {
    return this.view.version !== this.version && now - this.time >= PAUSE;
  }

  /** @param {number} now milliseconds */
  update(now) {
    if (!this.outdated(now)) return;
    this.version = this.view.version;
    this.time = now;
    this.floor = this.view.hasFloor();
    const bounds = this.view.contentBounds();
    const fresh = bounds.empty ? { centre: [0, 0, 0], radius: 1 } : { centre: bounds.centre, radius: Math.max(bounds.radius, 0.05) };
    if (!this._holds(fresh)) this.sphere = fresh;
  }

  /** A sphere that is still right stays, so that shadows do not flicker. */
  _holds({ centre, radius }) {
    const away = Math.hypot(...centre.map((x, i) => x - this.sphere.centre[i]));
    return away + radius <= this.sphere.radius * 1.1 && radius > 0.6 * this.sphere.radius;
  }
}
