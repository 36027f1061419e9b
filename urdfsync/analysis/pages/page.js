"use strict";
/* Brings the page to life: picture, switches, keys, and one selection for all parts. */

const data = JSON.parse(document.getElementById("data").textContent);
const SWITCHES = {
  visual: ["Visuals", "v"], collision: ["Collisions", "c"], frame: ["Frames", "f"], label: ["Names", "n"], mass: ["Centres of mass", "m"],
  inertia: ["Inertia boxes", "i"], world: ["World axes", "w"], shadow: ["Shadow", "s"],
};
const VERSIONS = { now: "New", both: "Both", before: "Old" };
const LEGEND = { changed: "changed", renamed: "changed", added: "new", removed: "removed" };
const REDRAWN = 1500; // milliseconds between slow pictures while meshes come
const HOVER = 60; // milliseconds between looks at what is under the pointer

const looks = (body) => JSON.stringify(body.shapes.map(({ kind, form, mesh }) => [kind, form, mesh]));
for (const old of data.before?.bodies || []) { // the content of a mesh may have changed
  const body = data.now.bodies.find((each) => each.element === old.element);
  if (body && looks(body) !== looks(old)) data.statuses[old.element] ??= "changed";
}

/* The state of the page; tests read it. `ready` is a promise that ends with the first picture, `complete` one with all meshes. */
const page = {
  selected: null,
  layers: {
    visual: true, frame: data.now.missing.length > 0 || !data.now.bodies.some((body) => body.shapes.length),
    collision: false, label: false, mass: false, inertia: false, world: false, shadow: true,
  },
  version: data.before ? "both" : "now",
  now: new RobotView(data.now, data.meshes),
  before: data.before && new RobotView(data.before, data.meshes),
  get positions() { return this.now.positions; },
  pose: (element) => page.now.pose(element),
  poses: posesOf(data),
  floor: 0,
  player: null,
  ruler: null,
  light: 0,
  ready: null,
  complete: null,
};

const element = (id) => document.getElementById(id);

/* The links with findings about them, or about the joints that lead to them. */
const doubted = new Set([...data.now.hinges.filter((hinge) => data.findings[hinge.element]).map((hinge) => hinge.child), ...Object.keys(data.findings)]);

/* Moves axes, then all that depends on them. Returns whether they are there: a loop may stop them. */
function moveAxes(targets) {
  const isThere = page.now.move(targets);
  refresh();
  return isThere;
}

/* Moves an axis by hand: what plays stops. */
function move(name, position) {
  page.player?.pause();
  say(moveAxes(new Map([[name, position]])) ? "" : `A loop would open: ${nameOf(name)} stops here.`);
}

/* Takes a named pose; what plays begins anew. */
function pose(name) {
  page.player?.rewind();
  const isThere = moveAxes(page.poses.get(name)[1]());
  setGround(name === "Stance" ? -data.now.height : page.floor, page.now.size);
  say(isThere ? `Pose: ${name}` : `A loop would open: the robot stops on the way to ${name}.`);
}

/* Shows the positions of the axes everywhere. */
function refresh() {
  page.before?.put(page.positions, data.renamed);
  page.ruler?.update();
  hideSame();
  showPositions(page.positions);
  say("");
  draw();
}

/* Says something beside the picture; without words, what is measured or selected. */
function say(words) {
  const [missing, ...others] = data.notes.map((note) => note.replaceAll("`", "")), more = others.length ? ` (and ${others.length} more)` : "";
  const why = missing ? `Only frames are shown: ${missing}${more}` : `This ${data.now.noun} has no shapes: its frames are shown.`;
  const bare = data.now.bodies.some((body) => body.shapes.length) ? "" : why;
  const passed = page.now.scene.hinges.filter((hinge) => isBeyond(hinge, page.positions.get(hinge.element))).map((hinge) => nameOf(hinge.element));
  const alarm = passed.length ? `Beyond the limits: ${passed.join(", ")}` : "";
  element("told").textContent = [words || page.ruler?.words() || page.selected || bare, alarm].filter(Boolean).join(" · ");
  element("told").classList.toggle("removed", alarm !== "");
}

function select(name) {
  page.selected = name;
  markTree(name);
  markDiagram(name);
  fillDetails(element("details"), data, name, select);
  say("");
  paint();
}

/* Colours the picture: the selection glows, changed links have their colours, the older version is faint. */
function paint() {
  const colors = Object.fromEntries(["changed", "added", "removed", "accent", "selected"].map((name) => [name, themeColor(name)]));
  const hinge = data.now.hinges.find((each) => each.element === page.selected), selected = hinge ? hinge.child : page.selected;
  const compares = page.version !== "now";
  page.now.paint((name) => {
    const status = data.statuses[name] === "renamed" ? "changed" : data.statuses[name];
    const light = name === selected ? colors.selected : page.light && status ? colors[status] : null;
    return { color: compares && status && name !== selected ? colors[status] : null, opacity: 1, glow: light && light.clone().multiplyScalar(name === selected ? 0.55 : page.light) };
  });
  page.now.root.visible = page.version !== "before";
  if (page.before) {
    page.before.root.visible = compares;
    for (const mesh of page.before.shapes()) mesh.castShadow = page.version === "before";
    page.before.paint((name) => {
      const current = data.renamed[name] || name, status = data.statuses[current];
      const color = data.statuses[name] === "removed" ? colors.removed : page.version === "both" ? colors.accent : status === "changed" ? colors.changed : null;
      const faint = data.statuses[name] === "removed" ? 0.6 : status === "changed" ? 0.35 : 0.14;
      return { color, opacity: page.version === "both" ? faint : 1, glow: current === selected ? colors.selected.clone().multiplyScalar(0.3) : null };
    });
  }
  for (const layer of LAYERS) page.now.show(layer, page.layers[layer]);
  if (stage.scene) paintStage();
  hideSame();
  draw();
}

/* Shows what stands around the robot. */
function paintStage() {
  const { labels, shade, axes } = stage, isDark = document.documentElement.dataset.theme === "dark";
  stage.grid.material.color.copy(themeColor("line"));
  Object.assign(shade, { visible: page.layers.shadow });
  shade.material.opacity = isDark ? 0.5 : 0.22;
  axes.visible = page.layers.world;
  ["x", "y", "z"].forEach((name, place) => labels.set(`world ${name}`, name, axes.visible && (() => new THREE.Vector3().setComponent(place, 1.06 * axes.userData.length)), `axis-${name}`));
  const origin = (name) => () => new THREE.Vector3().setFromMatrixPosition(page.now.bodies.get(name).group.matrixWorld);
  for (const name of page.now.bodies.keys()) {
    labels.set(name, `${nameOf(name)}${doubted.has(name) ? " !" : ""}`, page.layers.label && origin(name));
    labels.set(`finding ${name}`, "!", doubted.has(name) && !page.layers.label && page.version !== "before" && origin(name), "finding");
  }
}

/* Hides the bodies of the older version, laid over the new one, that are the same and in the same place. */
function hideSame() {
  if (!page.before) return;
  const isSame = (name) => !data.statuses[data.renamed[name] || name] && page.before.coincides(name, page.now, data.renamed[name] || name);
  for (const layer of LAYERS) page.before.show(layer, page.layers[layer], page.version === "both" ? isSame : undefined);
}

function toggle(layer) {
  page.layers[layer] = !page.layers[layer];
  element(`switch-${layer}`).setAttribute("aria-pressed", String(page.layers[layer]));
  paint();
}

function chooseVersion(version) {
  page.version = version;
  for (const name of Object.keys(VERSIONS)) element(`version-${name}`)?.setAttribute("aria-pressed", String(name === version));
  element("legend").hidden = version === "now";
  paint();
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  paint();
}

function chooseTab(tab) {
  for (const each of element("tabs").children) {
    const isChosen = each === tab;
    each.setAttribute("aria-selected", String(isChosen));
    each.tabIndex = isChosen ? 0 : -1;
    element(each.getAttribute("aria-controls")).hidden = !isChosen;
  }
  markTree(page.selected);
}

/* A click measures, or selects the link there. */
function click(event) {
  const hit = hitAt(placeOf(event), page.version === "before" ? page.before : page.now);
  if (page.ruler.isOn && hit && page.version !== "before") {
    page.ruler.add(hit.element, hit.point);
    say("");
    draw();
    return;
  }
  select(hit && page.version === "before" ? data.renamed[hit.element] || hit.element : hit?.element ?? null);
}

/* Returns a function that a dragged pointer calls; null where nothing moves: then the camera turns. */
function grab(event) {
  const hit = page.version === "before" ? null : hitAt(placeOf(event), page.now), hinge = hit && jointToDrag(data.now, hit.element);
  if (!hinge) {
    if (hit && jointsAbove(data.now, hit.element).some((each) => each.motion)) say(`Loops move ${nameOf(hit.element)}: drag another link.`);
    return null;
  }
  const pull = take(page.now, hinge, hit.element, hit.point, project);
  return (moved) => {
    page.player?.pause();
    const isThere = pull(...placeOf(moved));
    refresh();
    const words = waysOf(hinge).map((way) => `${nameOf(way.name)} ${inUnits(page.positions.get(way.name), way.turns)}`);
    say(isThere ? words.join(", ") : `A loop would open: ${nameOf(hinge.element)} stops here.`);
  };
}

/* Returns a position in words. */
function inUnits(position, turns) {
  return turns ? `${(position * DEGREES).toFixed(1)}° (${position.toFixed(3)} rad)` : `${(1000 * position).toFixed(1)} mm`;
}

/* Shows by the pointer's shape whether a link can be dragged. */
function hover(event) {
  const now = performance.now();
  if (event.buttons || now < hover.next) return;
  hover.next = now + HOVER;
  const hit = hitAt(placeOf(event), page.now);
  element("view").style.cursor = page.ruler.isOn ? "crosshair" : hit && jointToDrag(data.now, hit.element) ? "grab" : "";
}
hover.next = 0;

function measure() {
  page.ruler.toggle();
  element("ruler").setAttribute("aria-pressed", String(page.ruler.isOn));
  say("");
  draw();
}

/* Sets up what plays: the simulation, if the page has one, else the motion of Test. An axis that is moved by hand stops it. */
function setUpMotion() {
  const isSimulation = data.motion?.series.time.length > 1;
  if (!isSimulation && !data.now.hinges.some((hinge) => hinge.way)) return;
  const { time: times } = isSimulation ? data.motion.series : { time: [0, PERIOD] };
  const moveCursors = isSimulation ? fillCharts(element("charts"), data.motion, (time) => page.player.seek(time), select) : () => {};
  const words = isSimulation ? "the simulation" : "the motion of Test: each driven joint goes towards the roomier end of its range, and back";
  const button = make("button", { type: "button", id: "play", title: `Play ${words} (space)` }, "▶ Play", { click: () => page.player.toggle() });
  const slider = make("input", { type: "range", step: "any", min: times[0], max: times[times.length - 1], value: times[0], "aria-label": "Time" }, [], { input: () => page.player.seek(Number(slider.value)) });
  const told = make("output", {}, "0.00 s");
  element("player").append(button, slider, told);
  element("player").hidden = false;
  page.player = new Player(times, (player, isMoved) => {
    button.textContent = player.isPlaying ? "⏸ Pause" : "▶ Play";
    slider.value = player.time;
    told.textContent = `${player.time.toFixed(2)} s`;
    moveCursors(player.time);
    if (!isMoved) return;
    if (!isSimulation) return void moveAxes(sweepAt(data.now, player.time));
    page.now.put(positionsAt(data.motion, player.time), {});
    refresh();
  });
  if (isSimulation) page.player.seek(page.player.begin);
}

/* Shows the first picture, in which meshes are boxes. */
function show() {
  const canvas = element("view"), box = page.now.bounds(), views = [page.now, ...(page.before ? [page.before] : [])];
  if (page.before) box.union(page.before.bounds());
  page.floor = Math.min(0, box.min.z);
  try {
    startDrawing(canvas);
  } catch (error) {
    throw new Error("This browser cannot draw in 3D: WebGL is missing, or switched off. Switch on its hardware acceleration, or open the page in another browser. The rest of the page works.", { cause: error });
  }
  stage.labels = new Labels(element("labels"));
  page.ruler = new Ruler(page.now, stage.labels);
  setStage(views.map((view) => view.root), box, page.now.size, new Orbit(canvas, () => draw(false), click, grab));
  stage.axes = worldAxes(0.25 * page.now.size);
  stage.axes.userData.length = 0.25 * page.now.size;
  stage.scene.add(stage.axes, page.ruler.line);
  canvas.addEventListener("pointermove", hover);
  new ResizeObserver(resize).observe(canvas);
  resize();
  stage.orbit.fit(box);
  paint();
  render(stage.isSlow ? COARSE : Math.min(devicePixelRatio, 2));
  performance.mark("first picture");
}

/* Fills in the meshes, once all of the page is there. A slow picture is drawn anew only now and then. */
async function fillIn() {
  if (document.readyState === "loading") await new Promise((go) => addEventListener("DOMContentLoaded", go, { once: true }));
  let drawn = performance.now();
  await loadMeshes(data.meshes, (name, geometry) => {
    const isSeen = [page.now, page.before].filter((view) => view?.fill(name, geometry)).length > 0;
    if (!isSeen || performance.now() < drawn + (stage.isSlow ? REDRAWN : 0)) return;
    drawn = performance.now();
    draw();
  });
  stage.isFilling = false;
  draw();
}

if (data.curves.length) fillCurves(element("curves"), data.curves, select);
const showPositions = fillAxes(element("axes"), element("units"), data, move, select);
const markTree = fillTree(element("tree"), data, select);
let markDiagram = () => {}; // its layout takes as long as the picture
showPositions(page.positions);
fillDetails(element("details"), data, null, select);
say("");
if (data.now.hinges.some((hinge) => hinge.motion)) {
  for (const [name, [purpose]] of page.poses) {
    element("pose-list").append(make("button", { type: "button", "data-pose": name, title: purpose }, name, { click: () => pose(name) }));
  }
  element("poses").hidden = false;
  element("poses").open = innerWidth > 860;
} else if (data.now.hinges.length) chooseTab(element("tab-tree"));

for (const [layer, [label, key]] of Object.entries(SWITCHES)) {
  element("switches").append(make("button", { type: "button", id: `switch-${layer}`, "aria-pressed": String(page.layers[layer]), title: `${label} (${key})` }, label, { click: () => toggle(layer) }));
}
element("ruler").addEventListener("click", measure);
addEventListener("pointerdown", (event) => { // a click elsewhere closes the menu
  const menu = document.querySelector("#tools details");
  if (!menu.contains(event.target)) menu.open = false;
});
if (data.before) {
  for (const id of ["versions", "legend"]) element(id).hidden = false;
  const { noun } = data.now;
  const titles = { before: `Only the old ${noun}: ${data.against}`, both: `Old and new ${noun} in one picture (b)`, now: `Only the new ${noun}` };
  for (const [name, label] of Object.entries(VERSIONS)) {
    element("versions").append(make("button", { type: "button", id: `version-${name}`, "aria-pressed": String(name === page.version), title: titles[name] }, label, { click: () => chooseVersion(name) }));
  }
  const links = [...data.now.bodies, ...data.before.bodies].map((body) => data.statuses[body.element]);
  for (const words of new Set(Object.keys(LEGEND).filter((status) => links.includes(status)).map((status) => LEGEND[status]))) {
    element("legend").append(make("li", { class: { new: "added" }[words] || words }, words));
  }
  element("legend").append(make("li", { class: "old" }, "old place"));
}
for (const tab of element("tabs").children) tab.addEventListener("click", () => chooseTab(tab));
element("tabs").addEventListener("keydown", (event) => {
  if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
  const other = event.target.nextElementSibling || event.target.previousElementSibling;
  other.focus();
  chooseTab(other);
});
for (const button of document.querySelectorAll("[data-element]")) button.addEventListener("click", () => select(button.dataset.element));
element("theme").addEventListener("click", () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
let theme = "light"; // before printing, for which it is light
addEventListener("beforeprint", () => {
  theme = document.documentElement.dataset.theme;
  setTheme("light");
  if (stage.renderer) render(1); // a frame would come too late
});
addEventListener("afterprint", () => setTheme(theme));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) => setTheme(event.matches ? "dark" : "light"));

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("[type=search]")) return;
  const layer = Object.keys(SWITCHES).find((name) => SWITCHES[name][1] === event.key);
  const versions = Object.keys(VERSIONS);
  if (layer) toggle(layer);
  else if (event.key === "b" && data.before) chooseVersion(versions[(versions.indexOf(page.version) + 1) % versions.length]);
  else if (event.key === "r") pose("Start");
  else if (event.key === "u" && page.ruler) measure();
  else if (event.key === " " && page.player) { if (!event.repeat) page.player.toggle(); }
  else if (event.key === "d") element("theme").click();
  else if (event.key === "Escape") {
    if (page.ruler?.isOn) measure();
    select(null);
  }
  else return;
  event.preventDefault(); // a number's input would take it
});

document.addEventListener("keyup", (event) => { // some browsers press a focused button only now
  if (event.key === " " && page.player && !event.target.matches("[type=search]")) event.preventDefault();
});

setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
page.ready = new Promise((go) => go(show())).catch((error) => {
  for (const id of ["tools", "versions", "legend"]) element(id).hidden = true;
  element("trouble").hidden = false;
  element("trouble").textContent = error.message;
}).then(setUpMotion);
page.complete = page.ready.then(async () => {
  await new Promise((go) => setTimeout(go)); // the first picture is shown
  markDiagram = drawDiagram(element("drawing"), data, select);
  markDiagram(page.selected);
  if (stage.scene) await fillIn();
});
