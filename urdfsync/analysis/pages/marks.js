"use strict";
/* What is drawn over the picture: names of frames, world axes, a ruler. */

/* Returns the axes of the world: x is red, y green, z blue. */
function worldAxes(length) {
  const points = [0, 0, 0, length, 0, 0, 0, 0, 0, 0, length, 0, 0, 0, 0, 0, 0, length];
  return lines(points, [.85, .15, .15, .85, .15, .15, .1, .6, .1, .1, .6, .1, .15, .35, .95, .15, .35, .95]);
}

/* Words at places of space. `panel` lies over the picture. */
class Labels {
  constructor(panel) {
    this.panel = panel;
    this.items = new Map();
  }

  /* Shows words at points by keys; a label without a point goes. */
  set(key, words, point, kind = "") {
    if (!point) {
      this.items.get(key)?.text.remove();
      this.items.delete(key);
      return;
    }
    if (!this.items.has(key)) {
      this.items.set(key, { text: make("span", { class: kind }) });
      this.panel.append(this.items.get(key).text);
    }
    const item = this.items.get(key);
    item.text.textContent = words;
    item.point = point;
  }

  /* Moves the labels to their places; one that would cover another is hidden. */
  place(project, width, height) {
    const taken = [];
    for (const { text, point } of this.items.values()) {
      const [x, y, depth] = project(point());
      const wide = 4 + 3.6 * text.textContent.length, isFree = !taken.some(([left, top, other]) => Math.abs(left - x) < wide + other && Math.abs(top - y) < 15);
      text.hidden = depth > 1 || x < 0 || y < 0 || x > width || y > height || !isFree;
      if (text.hidden) continue;
      taken.push([x, y, wide]);
      text.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
    }
  }
}

/* Measures between two points, which stay on their links. */
class Ruler {
  constructor(view, labels) {
    Object.assign(this, { view, labels, ends: [], isOn: false });
    this.line = lines([0, 0, 0, 0, 0, 0], [.9, .1, .5, .9, .1, .5]);
    this.line.frustumCulled = false;
    this.line.visible = false;
  }

  toggle() {
    this.isOn = !this.isOn;
    this.ends = [];
    this.update();
  }

  /* Sets the next end; a third one begins anew. */
  add(element, point) {
    if (this.ends.length === 2) this.ends = [];
    const local = point.clone().applyMatrix4(this.view.bodies.get(element).group.matrixWorld.clone().invert());
    this.ends.push(() => local.clone().applyMatrix4(this.view.bodies.get(element).group.matrixWorld));
    this.update();
  }

  /* Returns the vector from the first end to the second; null if one is missing. */
  get way() {
    return this.ends.length === 2 ? this.ends[1]().sub(this.ends[0]()) : null;
  }

  update() {
    const { way, ends } = this;
    this.line.visible = way !== null;
    this.labels.set("ruler 0", "×", ends[0], "ruler");
    this.labels.set("ruler 1", way ? `${way.length().toFixed(4)} m` : "", way && ends[1], "ruler");
    if (!way) return;
    this.line.geometry.attributes.position.array.set([...ends[0]().toArray(), ...ends[1]().toArray()]);
    this.line.geometry.attributes.position.needsUpdate = true;
  }

  /* Returns what it shows in words. */
  words() {
    if (!this.isOn) return "";
    const { way } = this;
    if (!way) return this.ends.length ? "Ruler: click on the second point" : "Ruler: click on the first point";
    return `${way.length().toFixed(4)} m: x ${way.x.toFixed(4)}, y ${way.y.toFixed(4)}, z ${way.z.toFixed(4)}`;
  }
}
