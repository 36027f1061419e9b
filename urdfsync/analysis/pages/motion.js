"use strict";
/* Plays a simulation: its positions over time move the robot; charts show them with their limits. */

const QUANTITIES = ["position", "speed", "effort"];
const CHART = { width: 300, height: 80 };
const NEAR = 0.5; // limits farther away than this share of the range would flatten a curve

/* Returns the indices of the times before and after `time`, and its share of the way between them. */
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
  const { series } = motion, [low, high, share] = placeInTime(series.time, time), positions = new Map();
  for (const { element, position } of motion.joints) {
    if (!position) continue;
    const [before, after] = [low, high].map((place) => series[position.variable][place]);
    if (before !== null && after !== null) positions.set(element, before + share * (after - before));
  }
  return positions;
}

function svg(tag, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

/* Returns the least and the greatest of some values, without those that are null. */
function rangeOf(values) {
  return values.reduce(([least, most], value) => value === null ? [least, most] : [Math.min(least, value), Math.max(most, value)], [Infinity, -Infinity]);
}

/* Returns a chart of curves over time, and a function that moves its line to a time. A curve is a pair of its class and
   its values, with a gap where a value is null. Only limits near the curves are drawn. */
function chart(times, curves, limits, label) {
  let [low, high] = rangeOf(curves.flatMap(([, values]) => values));
  const reach = NEAR * (high - low) || 1, near = limits.filter((limit) => limit !== null && limit >= low - reach && limit <= high + reach);
  [low, high] = [Math.min(low, ...near), Math.max(high, ...near)];
  const margin = 0.06 * (high - low) || 0.5, begin = times[0], end = times[times.length - 1];
  const x = (time) => CHART.width * (time - begin) / (end - begin || 1);
  const y = (value) => CHART.height * (high + margin - value) / (high - low + 2 * margin);
  const picture = svg("svg", { viewBox: `0 0 ${CHART.width} ${CHART.height}`, preserveAspectRatio: "none", class: "chart", role: "img", "aria-label": label });
  for (const limit of near) picture.append(svg("line", { class: "limit", x1: 0, x2: CHART.width, y1: y(limit), y2: y(limit) }));
  for (const [kind, values] of curves) {
    const points = values.map((value, place) => value === null ? "" : `${(values[place - 1] ?? null) === null ? "M" : "L"}${x(times[place]).toFixed(1)},${y(value).toFixed(2)} h0`); // h0: one value alone is a dot
    picture.append(svg("path", { class: kind, d: points.join("") }));
  }
  const cursor = svg("line", { class: "cursor", x1: 0, x2: 0, y1: 0, y2: CHART.height });
  picture.append(cursor);
  return [picture, (time) => { cursor.setAttribute("x1", x(time)); cursor.setAttribute("x2", x(time)); }];
}

/* Fills the charts, a row for each joint. A click calls `seek` with its time. Returns a function that moves all cursors. */
function fillCharts(place, motion, seek, select) {
  const cursors = [], times = motion.series.time, begin = times[0], end = times[times.length - 1];
  for (const joint of motion.joints) {
    const row = make("div", { class: "charts" }, make("button", { type: "button", class: "name" }, nameOf(joint.element), { click: () => select(joint.element) }));
    for (const name of QUANTITIES) {
      const quantity = joint[name], cell = make("figure", {});
      row.append(cell);
      if (!quantity) continue;
      const limits = [quantity.lower, quantity.upper].map((limit) => limit === null ? "–" : rounded(limit)).join(" … ");
      const values = motion.series[quantity.variable], ends = rangeOf(values);
      const nothing = 1e-4 * (ends[1] - ends[0]); // smaller values are 0 with an error of the integration
      const [least, greatest] = ends.map((value) => Number((Math.abs(value) < nothing ? 0 : value).toPrecision(4)));
      const words = `${name} ${least} … ${greatest} ${quantity.unit}`;
      const former = motion.former[quantity.variable];
      const curves = [...(former ? [["reference", former]] : []), ["curve", values]];
      const [picture, move] = chart(times, curves, [quantity.lower, quantity.upper], `${nameOf(joint.element)}: ${words}, limits ${limits}`);
      picture.addEventListener("click", (event) => {
        const box = picture.getBoundingClientRect();
        seek(begin + (end - begin) * (event.clientX - box.left) / box.width);
      });
      cursors.push(move);
      const passed = joint.passed.some((limit) => limit.quantity === name);
      cell.append(picture, make("figcaption", { class: passed ? "removed" : "" }, `${words}${limits === "– … –" ? "" : `, limits ${limits}`}${passed ? ": passed" : ""}`));
    }
    place.append(row);
  }
  return (time) => { for (const move of cursors) move(time); };
}

/* Fills the curves of a check: the effort of each joint, and the position and axes of each link, with the reference; then the error on a log scale. */
function fillCurves(place, curves, select) {
  const LEAST = 1e-17, rows = new Map();
  const error = ({ values, expected }) => values.reduce((worst, own, part) => own.map((value, time) =>
    Math.max(worst[time] ?? LEAST, Math.abs(value - expected[part][time]) || LEAST)), []).map(Math.log10);
  for (const curve of curves) rows.set(curve.element, [...rows.get(curve.element) || [], curve]);
  for (const [element, every] of rows) {
    const row = make("div", { class: "charts" }, make("button", { type: "button", class: "name" }, nameOf(element), { click: () => select(element) }));
    const words = every.map(({ quantity, unit }) => `${quantity}${unit && ` in ${unit}`}`), { times } = every[0], span = `${times[0]} … ${times[times.length - 1]} s`;
    const pictures = every.map(({ values, expected }, at) => {
      const [least, greatest] = rangeOf(expected.flat()).map((value) => Number(value.toPrecision(3)));
      return [[...expected.map((part) => ["reference", part]), ...values.map((part) => ["curve", part])], `${words[at]}, ${least} … ${greatest}, ${span}`];
    });
    const errors = every.map((curve, at) => [at ? "curve second" : "curve", error(curve)]), ends = rangeOf(errors.flatMap(([, values]) => values)).map(Math.round);
    pictures.push([errors, `error of ${words.join(" and, in green, ")}, 10^${ends.join(" … 10^")} on a log scale`]);
    for (const [lines, caption] of pictures) {
      const [picture] = chart(times, lines, [], `${nameOf(element)}: ${caption}`);
      row.append(make("figure", {}, [picture, make("figcaption", {}, caption)]));
    }
    place.append(row);
  }
}

/* Plays from the present time on, in real time, until the end; `show` is called with each state, and whether its time is another one. */
class Player {
  constructor(times, show) {
    this.begin = times[0];
    this.end = times[times.length - 1];
    this.time = this.begin;
    this.isPlaying = false;
    this.show = show;
  }

  seek(time) {
    this.time = Math.min(Math.max(time, this.begin), this.end);
    this.show(this, true);
  }

  pause() {
    if (this.isPlaying) this.toggle();
  }

  /* Goes back to the beginning; nothing moves. */
  rewind() {
    this.isPlaying = false;
    this.time = this.begin;
    this.show(this, false);
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
    this.show(this, false);
  }
}
