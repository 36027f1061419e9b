"use strict";
/* Follows the daemon that serves the page: after a build the page is loaded anew, but keeps camera, pose and switches. */

const PLACE = `urdfsync ${location.pathname}`;
const PULSE = 1600; // milliseconds in which what changed glows once
const kept = JSON.parse(sessionStorage.getItem(PLACE)) || { build: null };

function loadAnew(build) {
  const { azimuth, elevation, distance, target, box } = stage.orbit || {};
  const view = stage.orbit && { azimuth, elevation, distance, target: target.toArray(), box: [box.min.toArray(), box.max.toArray()] };
  const theme_ = document.documentElement.dataset.theme, tab = document.querySelector("[role=tab][aria-selected=true]").id;
  const { layers, selected, positions } = page, unit = document.querySelector("#units [aria-pressed=true]").textContent;
  sessionStorage.setItem(PLACE, JSON.stringify({ build, view, layers, selected, unit, positions: [...positions], tab, theme: theme_, scroll: scrollY }));
  location.reload();
}

/* Restores camera, pose, switches and selection, as far as they still exist. */
function restore() {
  if (kept.build === null) return;
  setTheme(kept.theme);
  chooseTab(element(kept.tab));
  [...element("units").children].find((button) => button.textContent === kept.unit)?.click();
  moveAxes(new Map(kept.positions));
  for (const layer of Object.keys(SWITCHES)) if (page.layers[layer] !== kept.layers[layer]) toggle(layer);
  select([...data.now.bodies, ...data.now.hinges].some((each) => each.element === kept.selected) ? kept.selected : null);
  if (kept.view && stage.orbit) {
    const [least, most] = kept.view.box.map((corner) => new THREE.Vector3().fromArray(corner));
    stage.orbit.box.union(new THREE.Box3(least, most));
    Object.assign(stage.orbit, { azimuth: kept.view.azimuth, elevation: kept.view.elevation, distance: kept.view.distance });
    stage.orbit.target.fromArray(kept.view.target);
    stage.orbit.update();
  }
  scrollTo(0, kept.scroll);
}

/* Lets what changed glow once. */
function pulse() {
  performance.mark("pulse");
  const begin = performance.now();
  const step = (now) => {
    const share = Math.min((now - begin) / PULSE, 1);
    page.light = 0.7 * Math.sin(Math.PI * share) || 0;
    if (share === 1) page.light = 0;
    paint();
    if (share < 1) requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

function tell(words) {
  element("daemon").hidden = !words;
  element("daemon").textContent = words;
}

page.complete.then(() => { if (data.before && kept.build !== null) pulse(); });
page.ready.then(() => {
  restore();
  const source = new EventSource("events");
  source.addEventListener("message", (event) => {
    const [build, problem, others] = JSON.parse(event.data);
    tell(problem);
    element("others").replaceChildren(...Object.entries(others).flatMap(([name, href]) => [make("a", { href }, name), " "]));
    if (build !== data.build && build !== kept.build) loadAnew(build); // only once for each build: while the source is broken, the page stays the old one
  });
  source.addEventListener("error", () => tell("urdfsync watch has ended, or can't be reached: this is its last picture."));
});
