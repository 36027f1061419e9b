"use strict";
/* Brings the page to life: picture, switches, keys, and one selection for all parts. */

const data = JSON.parse(document.getElementById("data").textContent);
const SWITCHES = { visual: ["Visuals", "v"], collision: ["Collisions", "c"], frame: ["Frames", "f"], mass: ["Centres of mass", "m"], inertia: ["Inertia boxes", "i"] };
const VERSIONS = { now: "Now", both: "Both", before: "Before" };

const looks = (body) => JSON.stringify(body.shapes.map(({ kind, form, mesh }) => [kind, form, mesh]));
for (const old of data.before?.bodies || []) { // the content of a mesh may have changed
  const body = data.now.bodies.find((each) => each.element === old.element);
  if (body && looks(body) !== looks(old)) data.statuses[old.element] ??= "changed";
}

/* The state of the page; tests read it. `ready` is a promise that ends with the first picture, `complete` one with all meshes. */
const page = {
  selected: null,
  layers: { visual: true, collision: false, frame: data.now.missing.length > 0 || !data.now.bodies.some((body) => body.shapes.length), mass: false, inertia: false },
  version: data.before ? "both" : "now",
  positions: startPositions(data.now),
  now: null,
  before: null,
  pose: (element) => page.now.pose(element),
  player: null,
  isLit: null,
  ready: null,
  complete: null,
};

const element = (id) => document.getElementById(id);
const stage = { renderer: null, scene: null, orbit: null, waiting: false, lamp: null, isSlow: false, isFilling: true, timer: 0 };
const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i;
const REDRAWN = 1500; // milliseconds between slow pictures while meshes come
const REST = 300; // milliseconds without a change, after which a slow picture gets all its pixels

/* Makes what draws. Without a graphics card a picture takes a second, most of it for its pixels: it gets fewer. */
function startDrawing(canvas) {
  const attributes = { alpha: true, depth: true, preserveDrawingBuffer: true }; // else the picture is not printed
  const quick = canvas.getContext("webgl2", { ...attributes, antialias: true, failIfMajorPerformanceCaveat: true });
  const context = quick || canvas.getContext("webgl2", { ...attributes, antialias: false }) || undefined;
  stage.renderer = new THREE.WebGLRenderer({ canvas, context, ...attributes });
  const info = context?.getExtension("WEBGL_debug_renderer_info");
  stage.isSlow = !quick || SOFTWARE.test(info ? context.getParameter(info.UNMASKED_RENDERER_WEBGL) : "");
  stage.renderer.outputEncoding = THREE.sRGBEncoding;
}

function draw() {
  if (!stage.renderer || stage.waiting) return;
  stage.waiting = true;
  requestAnimationFrame(() => {
    stage.waiting = false;
    if (stage.isSlow) {
      clearTimeout(stage.timer);
      if (stage.isFilling) return render(ratioOf());
      stage.timer = setTimeout(() => render(1), REST);
    }
    render(ratioOf());
  });
}

function ratioOf() {
  return stage.isSlow ? 0.4 : Math.min(devicePixelRatio, 2);
}

function render(ratio) {
  if (stage.renderer.getPixelRatio() !== ratio) stage.renderer.setPixelRatio(ratio);
  stage.lamp.position.copy(stage.orbit.camera.position);
  stage.renderer.render(stage.scene, stage.orbit.camera);
}

function move(name, position) {
  page.positions.set(name, position);
  if (page.now) {
    page.now.move(name, position);
    for (const [each, value] of page.now.positions) page.positions.set(each, value);
  } else {
    for (const hinge of data.now.hinges) {
      if (hinge.leader) page.positions.set(hinge.element, hinge.multiplier * page.positions.get(hinge.leader) + hinge.offset);
    }
  }
  page.before?.moveAll(page.positions, data.renamed);
  hideSame();
  showPositions(page.positions);
  draw();
}

/* Sets many positions at once. */
function moveAll(positions) {
  for (const view of [page.now, page.before]) view?.moveAll(positions, view === page.before ? data.renamed : {});
  for (const [name, position] of positions) page.positions.set(name, position);
  hideSame();
  showPositions(page.positions);
  draw();
}

function select(name) {
  page.selected = name;
  markTree(name);
  markDiagram(name);
  fillDetails(element("details"), data, name, select);
  element("told").textContent = name || "";
  paint();
}

/* Colours the picture: the selection glows, changed links have their colours, the older version is faint. */
function paint() {
  if (!page.now) return;
  const colors = Object.fromEntries(["changed", "added", "removed", "accent"].map((name) => [name, themeColor(name)]));
  const hinge = data.now.hinges.find((each) => each.element === page.selected), selected = hinge ? hinge.child : page.selected;
  const compares = page.version !== "now";
  page.now.paint((name) => {
    const status = data.statuses[name] === "renamed" ? "changed" : data.statuses[name];
    const light = name === selected ? colors.accent : page.isLit && status ? colors[status] : null;
    return { color: compares && status ? colors[status] : null, opacity: 1, glow: light && light.clone().multiplyScalar(0.55) };
  });
  page.now.root.visible = page.version !== "before";
  if (page.before) {
    page.before.root.visible = compares;
    page.before.paint((name) => {
      const current = data.renamed[name] || name, status = data.statuses[current];
      const color = data.statuses[name] === "removed" ? colors.removed : page.version === "both" ? colors.accent : status === "changed" ? colors.changed : null;
      const faint = data.statuses[name] === "removed" ? 0.6 : status === "changed" ? 0.35 : 0.14;
      return { color, opacity: page.version === "both" ? faint : 1, glow: current === selected ? colors.accent.clone().multiplyScalar(0.3) : null };
    });
  }
  for (const layer of LAYERS) page.now.show(layer, page.layers[layer]);
  hideSame();
  draw();
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
  paint();
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  if (stage.scene) {
    stage.grid.material.color.copy(themeColor("line"));
  }
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

function pick(event) {
  const { left, top, width, height } = stage.renderer.domElement.getBoundingClientRect();
  const ray = new THREE.Raycaster();
  ray.setFromCamera(new THREE.Vector2(2 * (event.clientX - left) / width - 1, 1 - 2 * (event.clientY - top) / height), stage.orbit.camera);
  const view = page.version === "before" ? page.before : page.now;
  const shapes = [...view.bodies.values()].flatMap((body) => [...body.layers.visual, ...body.layers.collision]).filter((mesh) => mesh.visible);
  const [hit] = ray.intersectObjects(shapes, false);
  const name = hit ? hit.object.userData.element : null;
  select(name && page.version === "before" ? data.renamed[name] || name : name);
}

function resize() {
  const { clientWidth: width, clientHeight: height } = element("stage");
  if (!stage.renderer || width === 0 || height === 0) return;
  stage.renderer.setSize(width, height, false);
  stage.orbit.camera.aspect = width / height;
  stage.orbit.update();
}

/* Sets up the simulation, if the page has one: it moves the robot. An axis that is moved by hand stays there until the simulation goes on. */
function setUpMotion() {
  const { motion } = data;
  if (!motion || motion.series.time.length < 2) return;
  const moveCursors = fillCharts(element("charts"), motion, (time) => page.player.seek(time), select);
  const button = make("button", { type: "button", id: "play", title: "Play or pause (space)" }, "▶", { click: () => page.player.toggle() });
  const slider = make("input", { type: "range", step: "any", min: motion.series.time[0], max: motion.series.time[motion.series.time.length - 1], "aria-label": "Time" }, [], { input: () => page.player.seek(Number(slider.value)) });
  const told = make("output", {}, "");
  element("player").append(button, slider, told);
  element("player").hidden = false;
  page.player = new Player(motion, (player) => {
    button.textContent = player.isPlaying ? "⏸" : "▶";
    slider.value = player.time;
    told.textContent = `${player.time.toFixed(2)} s`;
    moveCursors(player.time);
    moveAll(positionsAt(motion, player.time));
  });
  page.player.seek(page.player.begin);
}

async function show() {
  const canvas = element("view");
  try {
    startDrawing(canvas);
  } catch (error) {
    throw new Error("This browser shows no 3D: WebGL is not there, or switched off. All else on the page works.", { cause: error });
  }
  page.now = new RobotView(data.now, data.meshes);
  stage.scene = new THREE.Scene();
  stage.lamp = new THREE.DirectionalLight(0xffffff, 0.55);
  stage.scene.add(page.now.root, new THREE.HemisphereLight(0xffffff, 0x8a8f99, 0.75), stage.lamp);
  const box = page.now.bounds();
  if (data.before) {
    page.before = new RobotView(data.before, data.meshes);
    stage.scene.add(page.before.root);
    box.union(page.before.bounds());
  }
  const decade = 10 ** Math.floor(Math.log10(page.now.size / 8)), cell = decade * [5, 2, 1].find((step) => step * decade <= page.now.size / 8);
  stage.grid = new THREE.GridHelper(20 * cell, 20, 0xffffff, 0xffffff);
  Object.assign(stage.grid.material, { transparent: true, opacity: 0.9, vertexColors: false });
  stage.grid.rotateX(Math.PI / 2);
  stage.grid.position.z = Math.min(0, box.min.z) - 1e-4 * page.now.size;
  stage.scene.add(stage.grid);
  stage.orbit = new Orbit(canvas, draw, pick);
  new ResizeObserver(resize).observe(element("stage"));
  resize();
  stage.orbit.fit(box);
  setTheme(document.documentElement.dataset.theme);
  setUpMotion();
  render(ratioOf());
  performance.mark("first picture");
}

/* Fills in the meshes, once all of the page is there. A slow picture is drawn anew about once a second. */
async function fillIn() {
  if (document.readyState === "loading") await new Promise((go) => addEventListener("DOMContentLoaded", go, { once: true }));
  let drawn = 0;
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
const showPositions = fillAxes(element("axes"), data, move, select);
const markTree = fillTree(element("tree"), data, select);
let markDiagram = () => {}; // its layout takes as long as the picture
showPositions(page.positions);
if (page.positions.size) element("axes").prepend(make("button", { type: "button", id: "reset", title: "All axes as they start (r)" }, "Reset", { click: reset }));

function reset() {
  moveAll(startPositions(data.now));
}

for (const [layer, [label, key]] of Object.entries(SWITCHES)) {
  element("switches").append(make("button", { type: "button", id: `switch-${layer}`, "aria-pressed": String(page.layers[layer]), title: `${label} (${key})` }, label, { click: () => toggle(layer) }));
}
if (data.before) {
  element("versions").hidden = false;
  for (const [name, label] of Object.entries(VERSIONS)) {
    const title = name === "before" ? data.against : name === "both" ? "Both over each other (b)" : "The source as it is";
    element("versions").append(make("button", { type: "button", id: `version-${name}`, "aria-pressed": String(name === page.version), title }, label, { click: () => chooseVersion(name) }));
  }
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
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("input, select")) return;
  const layer = Object.keys(SWITCHES).find((name) => SWITCHES[name][1] === event.key);
  const versions = Object.keys(VERSIONS);
  if (layer) toggle(layer);
  else if (event.key === "b" && data.before) chooseVersion(versions[(versions.indexOf(page.version) + 1) % versions.length]);
  else if (event.key === "r") reset();
  else if (event.key === " " && page.player && !event.target.matches("button, a, summary, [role=treeitem]")) {
    page.player.toggle();
    event.preventDefault();
  }
  else if (event.key === "d") element("theme").click();
  else if (event.key === "Escape") select(null);
});

setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
page.ready = show().catch((error) => {
  element("trouble").hidden = false;
  element("trouble").textContent = error.message;
});
page.complete = page.ready.then(async () => {
  await new Promise((go) => setTimeout(go)); // the first picture is shown
  markDiagram = drawDiagram(element("drawing"), data, select);
  markDiagram(page.selected);
  if (page.now) await fillIn();
});
