"use strict";
/* Builds, moves and colours a robot of the page's data in three.js. Metres and radians; z is up. */

const LAYERS = ["visual", "collision", "frame", "mass", "inertia"];
const NO_EDGE = 1e-12; // square of an edge, in m², that counts as no edge: rounding gives those of thin bodies either sign

const BEYOND = 1e-6; // in rad or m: less is a loop's rounding
const ONE_WAY = { rotational: true, translational: false }; // whether the motion turns
const ALONG = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

/* Returns the ways in which a hinge moves, one after the other: each has a name, an axis, and turns about it or slides. */
function waysOf(hinge) {
  const way = (label, axis, turns) => ({ name: label ? `${hinge.element}: ${label}` : hinge.element, label, axis, turns });
  if (hinge.motion in ONE_WAY) return [way("", hinge.axis, ONE_WAY[hinge.motion])];
  if (hinge.motion === "floating" || hinge.motion === "ball") {
    const turns = { yaw: "z", pitch: "y", roll: "x" }; // in this order, each about an axis that the ones before have turned
    const slides = hinge.motion === "ball" ? [] : Object.entries(ALONG).map(([label, axis]) => way(label, axis, false));
    return [...slides, ...Object.entries(turns).map(([label, axis]) => way(label, ALONG[axis], true))];
  }
  if (hinge.motion !== "planar") return [];
  const normal = new THREE.Vector3().fromArray(hinge.axis); // as UrdfSync.Functions.normalTo in the package
  const x = new THREE.Vector3().fromArray(Math.abs(normal.x) < 0.9 ? ALONG.x : ALONG.y).projectOnPlane(normal).normalize();
  return [way("x", x.toArray(), false), way("y", normal.clone().cross(x).toArray(), false), way("turn", hinge.axis, true)];
}

/* Returns whether an axis moves by itself: it follows no other, neither directly nor through loops. */
function isFree(hinge) {
  return Boolean(hinge.motion) && !hinge.leader && !hinge.is_dependent;
}

/* Returns whether a position is beyond the limits of a hinge. */
function isBeyond({ lower, upper }, position) {
  return lower !== null && position < lower - BEYOND || upper !== null && position > upper + BEYOND;
}

/* Returns the ends of a way; without limits those that a slider has. */
function endsOfWay(hinge, way) {
  const reach = way.turns ? Math.PI : 1;
  return [hinge.lower ?? Math.min(-reach, hinge.start), hinge.upper ?? Math.max(reach, hinge.start)];
}

function startPositions(scene) {
  return new Map(scene.hinges.flatMap((hinge) => [{ name: hinge.element }, ...waysOf(hinge)].map(({ name }) => [name, hinge.start])));
}

/* Returns the colour of the page's style sheet by its name. */
function themeColor(name) {
  return new THREE.Color(getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim()).convertSRGBToLinear();
}

/* Returns the homogeneous box that has the mass and inertia of a body: its edges, and its axes in the body's `center`. Null if there is none. */
function boxOf({ mass, inertia: [xx, xy, xz, yy, yz, zz] }) {
  let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < 10; sweep++) { // Jacobi's method: a turn about one axis makes the product of the two others 0
    for (const [one, other] of [[0, 1], [0, 2], [1, 2]]) {
      const angle = Math.atan(2 * tensor[one][other] / (tensor[other][other] - tensor[one][one])) / 2 || 0;
      const turn = (rows) => {
        const pairs = rows[one].map((part, column) => [part, rows[other][column]]);
        rows[one] = pairs.map(([a, b]) => Math.cos(angle) * a - Math.sin(angle) * b);
        rows[other] = pairs.map(([a, b]) => Math.sin(angle) * a + Math.cos(angle) * b);
      };
      turn(axes);
      turn(tensor);
      tensor = tensor.map((_, column) => tensor.map((row) => row[column])); // turn its columns like its rows
      turn(tensor);
    }
  }
  const moments = tensor.map((row, axis) => row[axis]), sum = moments[0] + moments[1] + moments[2];
  const squares = moments.map((moment) => 6 / mass * (sum - 2 * moment));
  if (![xx, xy, xz, yy, yz, zz, ...squares].every(Number.isFinite)) return null;
  if (Math.min(...squares) <= -NO_EDGE || Math.max(...squares) <= NO_EDGE) return null;
  const edges = squares.map((square) => Math.sqrt(Math.max(square, 0)));
  return { edges, axes: new THREE.Matrix4().makeBasis(...axes.map((axis) => new THREE.Vector3().fromArray(axis))) };
}

/* Returns the geometry of a shape; for a mesh, until it has come, its box. Null for a mesh that can't be shown. */
function shapeGeometry(shape, meshes) {
  const [x, y, z] = shape.size;
  switch (shape.form) {
    case "box": return new THREE.BoxGeometry(...shape.size);
    case "sphere": return new THREE.SphereGeometry(x, 32, 20);
    case "ellipsoid": return new THREE.SphereGeometry(1, 32, 20).scale(x, y, z);
    case "cylinder": return new THREE.CylinderGeometry(x, x, y, 40).rotateX(Math.PI / 2);
    case "capsule": return new THREE.CapsuleGeometry(x, y, 12, 32).rotateX(Math.PI / 2);
    default: return meshes[shape.mesh] ? boxGeometry(meshes[shape.mesh].slice(2)) : null;
  }
}

function boxGeometry([left, front, bottom, right, back, top]) {
  const geometry = new THREE.BoxGeometry(right - left, back - front, top - bottom);
  return geometry.translate((left + right) / 2, (front + back) / 2, (bottom + top) / 2);
}

/* Returns lines that stay visible in front of all shapes. */
function lines(points, colors, opacity = 1) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
  const material = new THREE.LineBasicMaterial({ vertexColors: true, depthTest: false, transparent: true, opacity });
  const object = new THREE.LineSegments(geometry, material);
  object.renderOrder = 2;
  return object;
}

/* One version of the robot. `root` is its root frame; `bodies` and `hinges` are maps by element. */
class RobotView {
  constructor(scene, meshes) {
    this.scene = scene;
    this.root = new THREE.Group();
    this.bodies = new Map();
    this.hinges = new Map(scene.hinges.map((hinge) => [hinge.element, hinge]));
    this.positions = startPositions(scene);
    for (const body of scene.bodies) this.bodies.set(body.element, this.#body(body, meshes));
    const children = new Set();
    for (const hinge of scene.hinges) {
      this.bodies.get(hinge.parent).group.add(this.bodies.get(hinge.child).group);
      children.add(hinge.child);
    }
    for (const [element, body] of this.bodies) if (!children.has(element)) this.root.add(body.group);
    this.place();
    this.size = this.#measure();
    for (const body of this.bodies.values()) this.#mark(body);
  }

  #body(data, meshes) {
    const body = { data, group: new THREE.Group(), layers: Object.fromEntries(LAYERS.map((layer) => [layer, []])) };
    body.group.matrixAutoUpdate = false;
    for (const shape of data.shapes) {
      const geometry = shapeGeometry(shape, meshes);
      if (!geometry) continue; // a mesh that can't be shown
      const [red, green, blue, opacity] = shape.color;
      const color = new THREE.Color(red, green, blue).convertSRGBToLinear();
      const material = new THREE.MeshStandardMaterial({ color, roughness: 0.65, metalness: 0.1, opacity, transparent: opacity < 1, side: THREE.DoubleSide });
      const mesh = new THREE.Mesh(geometry, material);
      mesh.matrixAutoUpdate = false;
      mesh.castShadow = shape.kind === "visual";
      mesh.matrix.fromArray(shape.pose);
      mesh.userData = { element: data.element, color, opacity, name: shape.mesh };
      this.#add(body, shape.kind, mesh);
    }
    return body;
  }

  #add(body, layer, object) {
    object.visible = false;
    body.layers[layer].push(object);
    body.group.add(object);
  }

  shapes() {
    return [...this.bodies.values()].flatMap(({ layers }) => [...layers.visual, ...layers.collision]);
  }

  /* Gives all shapes of a mesh their geometry. Returns whether one of them is to be seen. */
  fill(name, geometry) {
    const meshes = this.shapes().filter(({ userData }) => userData.name === name);
    for (const mesh of meshes) mesh.geometry = geometry;
    return meshes.some((mesh) => mesh.visible);
  }

  /* Adds the frame, the centre of mass and the inertia box of a body. The size of the first two depends on the robot's. */
  #mark(body) {
    const { data } = body, length = 0.05 * this.size;
    const hinge = this.scene.hinges.find((each) => each.child === data.element && (each.motion in ONE_WAY || each.motion === "planar"));
    const points = [0, 0, 0, length, 0, 0, 0, 0, 0, 0, length, 0, 0, 0, 0, 0, 0, length];
    const colors = [.9, .1, .1, .9, .1, .1, .1, .65, .1, .1, .65, .1, .15, .3, 1, .15, .3, 1];
    if (hinge) {
      const end = hinge.axis.map((part) => 1.8 * length * part);
      points.push(...end.map((part) => -part), ...end);
      colors.push(.95, .55, 0, .95, .55, 0);
    }
    const ends = [...this.scene.hinges.map(({ parent, pose }) => ({ body: parent, pose })), ...this.scene.loops.flatMap((loop) => loop.ends)];
    for (const { body: owner, pose } of ends) { // lines ("bones") to the frames of the next bodies and of loops
      if (owner !== data.element) continue;
      points.push(0, 0, 0, ...pose.slice(12, 15));
      colors.push(.5, .5, .55, .5, .5, .55);
    }
    this.#add(body, "frame", lines(points, colors));
    if (!data.center) return;
    const heaviest = Math.max(...this.scene.bodies.map((each) => each.mass));
    const ball = new THREE.Mesh(
      new THREE.SphereGeometry(0.006 * this.size * (1 + 2 * Math.cbrt(data.mass / heaviest)), 20, 14),
      new THREE.MeshBasicMaterial({ color: 0xe0a100, depthTest: false, transparent: true, opacity: 0.9 }));
    ball.renderOrder = 3;
    const center = new THREE.Matrix4().fromArray(data.center), equal = boxOf(data);
    ball.position.setFromMatrixPosition(center);
    this.#add(body, "mass", ball);
    if (!equal) return;
    const geometry = new THREE.BoxGeometry(...equal.edges.map((edge) => Math.max(edge, 1e-6)));
    const box = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: 0x8f4bd6, transparent: true, opacity: 0.25, depthWrite: false }));
    box.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry), new THREE.LineBasicMaterial({ color: 0x8f4bd6 })));
    box.matrixAutoUpdate = false;
    box.matrix.multiplyMatrices(center, equal.axes);
    this.#add(body, "inertia", box);
  }

  /* Returns the diagonal of all shapes, or of all frames if there are none. */
  #measure() {
    return this.bounds().getSize(new THREE.Vector3()).length() || 1;
  }

  bounds() {
    const box = new THREE.Box3();
    this.root.updateMatrixWorld(true);
    for (const body of this.bodies.values()) {
      box.expandByPoint(new THREE.Vector3().setFromMatrixPosition(body.group.matrixWorld));
      for (const mesh of [...body.layers.visual, ...body.layers.collision]) {
        if (!mesh.geometry.boundingBox) mesh.geometry.computeBoundingBox();
        box.union(mesh.geometry.boundingBox.clone().applyMatrix4(mesh.matrixWorld));
      }
    }
    return box;
  }

  /* Moves axes; those that follow them move, too. Returns whether all are at their positions: a loop may stop them. */
  move(targets) {
    const known = [...targets].filter(([name]) => this.positions.has(name));
    const isThere = !this.scene.loops.length || moveClosed(this, known);
    if (!this.scene.loops.length) for (const [name, position] of known) this.positions.set(name, position);
    this.place();
    return isThere;
  }

  /* Sets all positions, loops as they are; `renamed` has the new names of joints. */
  put(positions, renamed) {
    for (const hinge of this.scene.hinges) for (const { name } of waysOf(hinge)) {
      const position = positions.get(name.replace(hinge.element, renamed[hinge.element] || hinge.element));
      if (position !== undefined) this.positions.set(name, position);
    }
    this.place();
  }

  place() {
    const turn = new THREE.Matrix4(), axis = new THREE.Vector3();
    for (const hinge of this.scene.hinges) { // leaders come first
      if (hinge.leader) this.positions.set(hinge.element, hinge.multiplier * this.positions.get(hinge.leader) + hinge.offset);
      const { group } = this.bodies.get(hinge.child);
      group.matrix.fromArray(hinge.pose);
      for (const way of waysOf(hinge)) {
        const position = this.positions.get(way.name);
        axis.fromArray(way.axis);
        group.matrix.multiply(way.turns ? turn.makeRotationAxis(axis, position) : turn.makeTranslation(...axis.multiplyScalar(position).toArray()));
      }
    }
    this.root.updateMatrixWorld(true);
  }

  /* Returns the pose of a body in the root frame: 16 numbers, column after column. */
  pose(element) {
    return this.bodies.get(element).group.matrixWorld.toArray();
  }

  /* Shows a layer of all bodies, except those for which `isHidden` is true. */
  show(layer, isShown, isHidden = () => false) {
    for (const [element, body] of this.bodies) for (const object of body.layers[layer]) object.visible = isShown && !isHidden(element);
  }

  /* Returns whether a body has the same pose as the body `name` of another version. */
  coincides(element, other, name) {
    if (!other.bodies.has(name)) return false;
    const pose = other.pose(name);
    return this.pose(element).every((part, place) => Math.abs(part - pose[place]) < 1e-6);
  }

  /* Colours shapes: `look` returns a colour or null, and an opacity, for a body's element. */
  paint(look) {
    for (const [element, body] of this.bodies) {
      const { color, opacity, glow } = look(element);
      for (const mesh of [...body.layers.visual, ...body.layers.collision]) {
        const { material, userData } = mesh;
        material.color.copy(color || userData.color);
        material.opacity = opacity * userData.opacity;
        const isTransparent = material.opacity < 1;
        if (material.transparent !== isTransparent) material.needsUpdate = true;
        material.transparent = isTransparent;
        material.depthWrite = material.opacity > 0.5;
        material.emissive.copy(glow || new THREE.Color(0));
      }
      body.layers.frame[0].material.opacity = glow ? 1 : 0.75;
    }
  }
}
