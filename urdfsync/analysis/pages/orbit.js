"use strict";
/* A camera that goes round the robot, by pointer, wheel and keys; a pointer on a link may move that instead. */

class Orbit {
  #pointers = new Map();
  #moved = 0;
  #held = null; // moves a link

  /* `grab` is called where a pointer goes down; it may return a function for the moves of that pointer. */
  constructor(canvas, changed, clicked, grab) {
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.target = new THREE.Vector3();
    this.canvas = canvas;
    this.changed = changed;
    Object.assign(this, { azimuth: -0.9, elevation: 0.38, distance: 3, size: 1 });
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.#pointers.set(event.pointerId, [event.clientX, event.clientY]);
      const isAlone = this.#pointers.size === 1;
      this.#moved = isAlone ? 0 : Infinity;
      this.#held = isAlone && event.button === 0 && !event.shiftKey ? grab(event) : null;
    });
    canvas.addEventListener("pointermove", (event) => this.#drag(event));
    for (const kind of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(kind, (event) => {
        if (kind === "pointerup" && this.#moved < 5) clicked(event);
        this.#pointers.delete(event.pointerId);
        this.#held = null;
      });
    }
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.#zoom(Math.exp(0.0012 * event.deltaY));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  #drag(event) {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    const x = event.clientX - before[0], y = event.clientY - before[1];
    this.#moved += Math.abs(x) + Math.abs(y);
    if (this.#held) {
      if (this.#moved >= 5) this.#held(event);
    } else if (this.#pointers.size > 1) {
      const [other] = [...this.#pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
      const apart = (place) => Math.hypot(place[0] - other[0], place[1] - other[1]) || 1;
      this.#zoom(apart(before) / apart([event.clientX, event.clientY]));
      this.#pan(x / 2, y / 2);
    } else if (event.shiftKey || event.buttons & 6) {
      this.#pan(x, y);
    } else {
      this.turn(-0.008 * x, 0.008 * y);
    }
    this.#pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  #key(event) {
    const turns = { ArrowLeft: [0.12, 0], ArrowRight: [-0.12, 0], ArrowUp: [0, 0.12], ArrowDown: [0, -0.12] };
    const zooms = { "+": 0.85, "=": 0.85, "-": 1 / 0.85 };
    if (turns[event.key]) this.turn(...turns[event.key]);
    else if (zooms[event.key]) this.#zoom(zooms[event.key]);
    else if (event.key === "Home") this.fit();
    else return;
    event.preventDefault();
  }

  turn(azimuth, elevation) {
    this.azimuth += azimuth;
    this.elevation = Math.min(Math.max(this.elevation + elevation, -1.55), 1.55);
    this.update();
  }

  #zoom(factor) {
    this.distance = Math.min(Math.max(this.distance * factor, 0.05 * this.size), 50 * this.size);
    this.update();
  }

  #pan(x, y) {
    const scale = 2 * this.distance * Math.tan(this.camera.fov * Math.PI / 360) / this.canvas.clientHeight;
    const [right, up] = [0, 1].map((column) => new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, column));
    this.target.addScaledVector(right, -scale * x).addScaledVector(up, scale * y);
    this.update();
  }

  /* Moves the camera so that a whole box is in view. */
  fit(box = this.box) {
    this.box = box;
    this.size = box.getSize(new THREE.Vector3()).length() || 1;
    box.getCenter(this.target);
    const narrow = Math.min(1, this.camera.aspect);
    this.distance = 0.56 * this.size / Math.tan(this.camera.fov * Math.PI / 360) / narrow;
    this.update();
  }

  update() {
    const { camera, target, azimuth, elevation, distance } = this;
    const flat = Math.cos(elevation);
    camera.position.set(Math.cos(azimuth) * flat, Math.sin(azimuth) * flat, Math.sin(elevation)).multiplyScalar(distance).add(target);
    camera.near = 0.01 * distance;
    camera.far = distance + 20 * this.size;
    camera.lookAt(target);
    camera.updateMatrix();
    camera.updateProjectionMatrix();
    this.changed();
  }
}
