"use strict";
/* A simulation that plays: positions over time move the robot, and stand in charts beside their limits. */

const QUANTITIES = ["position", "speed", "effort"];
const CHART = { width: 300, height: 80 };
const NEAR = 0.5; // limits farther away than this share of the range would flatten a curve

/* Returns the index of the last time that is not after `time`, and the share of the way to the next one. */
function placeInTime(times, time) {
  let low = 0, high = times.length - 1;
  while (low < high - 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle; else high = middle;
  }
  const span = times[high] - times[low];
  return [low, high, span > 0 ? Math.min(Math.max((time - times[low]) / span, 0), 1) : 0];
}

/* Returns the positions of all axes at a time, by their elements. */
function positionsAt(motion, time) {
  const [low, high, share] = placeInTime(motion.times, time), positions = new Map();
  for (const { element, position } of motion.joints) {
    if (!position) continue;
    const [before, after] = [position.values[low], position.values[high]];
    if (before !== null && after !== null) positions.set(element, before + share * (after - before));
  }
  return positions;
}

function svg(tag, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

/* Returns a chart of a quantity with its limits, and the line that stands at the present time. */
function chart(motion, quantity, label) {
  const values = quantity.values.filter((value) => value !== null);
  let low = values.reduce((least, value) => Math.min(least, value), Infinity), high = values.reduce((most, value) => Math.max(most, value), -Infinity);
  const reach = NEAR * (high - low) || 1, limits = [quantity.lower, quantity.upper].filter((limit) => limit !== null);
  const near = limits.filter((limit) => limit >= low - reach && limit <= high + reach);
  [low, high] = [Math.min(low, ...near), Math.max(high, ...near)];
  const margin = 0.06 * (high - low) || 0.5, begin = motion.times[0], end = motion.times[motion.times.length - 1];
  const x = (time) => CHART.width * (time - begin) / (end - begin || 1);
  const y = (value) => CHART.height * (high + margin - value) / (high - low + 2 * margin);
  const picture = svg("svg", { viewBox: `0 0 ${CHART.width} ${CHART.height}`, preserveAspectRatio: "none", class: "chart", role: "img", "aria-label": label });
  for (const limit of near) picture.append(svg("line", { class: "limit", x1: 0, x2: CHART.width, y1: y(limit), y2: y(limit) }));
  const points = quantity.values.map((value, place) => value === null ? "" : `${x(motion.times[place]).toFixed(1)},${y(value).toFixed(2)}`);
  picture.append(svg("polyline", { class: "curve", points: points.join(" ") }));
  const cursor = svg("line", { class: "cursor", x1: 0, x2: 0, y1: 0, y2: CHART.height });
  picture.append(cursor);
  return [picture, (time) => { cursor.setAttribute("x1", x(time)); cursor.setAttribute("x2", x(time)); }];
}

/* Fills the place of charts, a row for each joint. `seek` is called with a time. Returns what moves all cursors. */
function fillCharts(place, motion, seek, select) {
  const cursors = [], end = motion.times[motion.times.length - 1], begin = motion.times[0];
  for (const joint of motion.joints) {
    const row = make("div", { class: "charts" }, make("button", { type: "button", class: "name" }, nameOf(joint.element), { click: () => select(joint.element) }));
    for (const name of QUANTITIES) {
      const quantity = joint[name], cell = make("figure", {});
      row.append(cell);
      if (!quantity) continue;
      const limits = [quantity.lower, quantity.upper].map((limit) => limit === null ? "–" : rounded(limit)).join(" … ");
      const nothing = 1e-4 * (quantity.greatest - quantity.least); // what the integration leaves of 0
      const [least, greatest] = [quantity.least, quantity.greatest].map((value) => Number((Math.abs(value) < nothing ? 0 : value).toPrecision(4)));
      const words = `${name} ${least} … ${greatest} ${quantity.unit}`;
      const [picture, move] = chart(motion, quantity, `${nameOf(joint.element)}: ${words}, limits ${limits}`);
      picture.addEventListener("click", (event) => {
        const box = picture.getBoundingClientRect();
        seek(begin + (end - begin) * (event.clientX - box.left) / box.width);
      });
      cursors.push(move);
      const passed = joint.passed.includes(name);
      cell.append(picture, make("figcaption", { class: passed ? "removed" : "" }, `${words}${limits === "– … –" ? "" : `, limits ${limits}`}${passed ? ": passed" : ""}`));
    }
    place.append(row);
  }
  return (time) => { for (const move of cursors) move(time); };
}

/* Plays from the present time on, in real time, until the end; `show` is called with each time. */
class Player {
  constructor(motion, show) {
    this.begin = motion.times[0];
    this.end = motion.times[motion.times.length - 1];
    this.time = this.begin;
    this.isPlaying = false;
    this.show = show;
  }

  seek(time) {
    this.time = Math.min(Math.max(time, this.begin), this.end);
    this.show(this);
  }

  toggle() {
    this.isPlaying = !this.isPlaying;
    if (this.isPlaying && this.time >= this.end) this.time = this.begin;
    let before = performance.now();
    const step = (now) => {
      if (!this.isPlaying) return;
      const time = this.time + (now - before) / 1000;
      before = now;
      if (time >= this.end) this.isPlaying = false;
      this.seek(time);
      requestAnimationFrame(step);
    };
    if (this.isPlaying) requestAnimationFrame(step);
    this.show(this);
  }
}
