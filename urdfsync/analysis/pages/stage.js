"use strict";
/* The picture: what draws it, its lights, its ground, and which place of the window is which point of space. */

const stage = { renderer: null, scene: null, orbit: null, ground: null, shade: null, labels: null, isWaiting: false, isSlow: false, isFilling: true, isMoved: true, timer: 0 };
const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i;
const COARSE = 0.4; // share of the pixels, along each side, of a slow picture that moves
const REST = 300; // milliseconds without a change, after which a slow picture gets all its pixels and its shadow

/* Returns whether no graphics card draws: then a picture takes a second, most of it for its pixels. */
function isDrawnBySoftware() {
  const context = document.createElement("canvas").getContext("webgl"), info = context?.getExtension("WEBGL_debug_renderer_info");
  return Boolean(info) && SOFTWARE.test(context.getParameter(info.UNMASKED_RENDERER_WEBGL));
}

function startDrawing(canvas) {
  stage.isSlow = isDrawnBySoftware();
  stage.renderer = new THREE.WebGLRenderer({ canvas, antialias: !stage.isSlow, alpha: true, preserveDrawingBuffer: true }); // else the picture is not printed
  stage.renderer.outputEncoding = THREE.sRGBEncoding;
  Object.assign(stage.renderer.shadowMap, { enabled: true, autoUpdate: false, type: THREE.PCFSoftShadowMap });
}

/* Sets up lights and ground for robots of a size in a box; `orbit` has the camera. */
function setStage(roots, box, size, orbit) {
  stage.scene = new THREE.Scene();
  stage.orbit = orbit;
  stage.lamp = new THREE.DirectionalLight(0xffffff, 0.45);
  const sun = new THREE.DirectionalLight(0xffffff, 0.2), middle = box.getCenter(new THREE.Vector3());
  sun.castShadow = true;
  sun.target.position.copy(middle);
  sun.position.set(0.25, -0.35, 1).multiplyScalar(3 * size).add(middle);
  Object.assign(sun.shadow.camera, { left: -size, right: size, top: size, bottom: -size, near: 0.1 * size, far: 7 * size });
  sun.shadow.mapSize.set(1024, 1024);
  sun.shadow.radius = 4;
  const decade = 10 ** Math.floor(Math.log10(size / 8)), cell = decade * [5, 2, 1].find((step) => step * decade <= size / 8);
  stage.grid = new THREE.GridHelper(20 * cell, 20, 0xffffff, 0xffffff).rotateX(Math.PI / 2);
  Object.assign(stage.grid.material, { transparent: true, opacity: 0.9, vertexColors: false });
  stage.shade = new THREE.Mesh(new THREE.PlaneGeometry(20 * cell, 20 * cell), new THREE.ShadowMaterial({ opacity: 0.25, depthWrite: false }));
  stage.shade.receiveShadow = true;
  stage.ground = new THREE.Group().add(stage.grid, stage.shade);
  stage.scene.add(...roots, new THREE.HemisphereLight(0xffffff, 0x8a8f99, 0.7), stage.lamp, sun, sun.target, stage.ground);
  setGround(Math.min(0, box.min.z), size);
}

/* Puts the ground at a height, just below what stands there. */
function setGround(height, size) {
  if (stage.ground) stage.ground.position.z = height - 1e-4 * size;
}

/* Draws soon; `isMoved` tells that the shadow is another one. */
function draw(isMoved = true) {
  stage.isMoved ||= isMoved;
  if (!stage.renderer || stage.isWaiting) return;
  stage.isWaiting = true;
  requestAnimationFrame(() => {
    stage.isWaiting = false;
    clearTimeout(stage.timer);
    if (stage.isSlow && !stage.isFilling) stage.timer = setTimeout(() => render(1), REST);
    render(stage.isSlow ? COARSE : Math.min(devicePixelRatio, 2));
  });
}

function render(ratio) {
  const { renderer, orbit } = stage;
  if (renderer.getPixelRatio() !== ratio) renderer.setPixelRatio(ratio);
  if (stage.isMoved && (!stage.isSlow || ratio === 1)) {
    renderer.shadowMap.needsUpdate = true;
    stage.isMoved = false;
  }
  stage.lamp.position.copy(orbit.camera.position);
  renderer.render(stage.scene, orbit.camera);
  stage.labels.place(project, orbit.canvas.clientWidth, orbit.canvas.clientHeight);
}

function resize() {
  const { clientWidth: width, clientHeight: height } = stage.orbit.canvas;
  if (width === 0 || height === 0) return;
  stage.renderer.setSize(width, height, false);
  stage.orbit.camera.aspect = width / height;
  stage.orbit.update();
}

/* Returns the place of a point in the picture, in pixels, and its depth: more than 1 if it is not in front of the camera. */
function project(point) {
  const { camera, canvas } = stage.orbit, { x, y, z } = point.project(camera);
  return [(x + 1) / 2 * canvas.clientWidth, (1 - y) / 2 * canvas.clientHeight, z];
}

/* Returns the place of a pointer in the picture. */
function placeOf(event) {
  const { left, top } = stage.orbit.canvas.getBoundingClientRect();
  return [event.clientX - left, event.clientY - top];
}

/* Returns what is at a place of the picture: an element of the robot, and the point there. Null if there is nothing. */
function hitAt([x, y], view) {
  const { camera, canvas } = stage.orbit, ray = new THREE.Raycaster();
  ray.setFromCamera(new THREE.Vector2(2 * x / canvas.clientWidth - 1, 1 - 2 * y / canvas.clientHeight), camera);
  const [hit] = ray.intersectObjects(view.shapes().filter((mesh) => mesh.visible), false);
  return hit ? { element: hit.object.userData.element, point: hit.point } : null;
}
