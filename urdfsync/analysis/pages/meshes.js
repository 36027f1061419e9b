"use strict";
/* Unpacks the meshes of the page, one after the other, while the robot is already there. */

const CREASE = Math.cos(35 * Math.PI / 180); // edges that are sharper are shown as edges
const MOST_AROUND = 48; // most faces at one point that count for its normals: a fan has thousands

/* Returns a geometry of triangles with smooth normals, except at edges. Corners at one point with one normal share a vertex. */
function creased(points, faces) {
  const corners = faces.length, count = points.length / 3;
  const flat = new Float32Array(corners), areas = new Float32Array(corners / 3); // of each face: its unit normal, and twice its area
  const begin = new Uint32Array(count + 1), around = new Uint32Array(corners);
  for (let corner = 0; corner < corners; corner++) begin[faces[corner] + 1]++;
  for (let point = 1; point <= count; point++) begin[point] += begin[point - 1];
  const next = begin.slice();
  for (let corner = 0; corner < corners; corner++) around[next[faces[corner]]++] = corner / 3 | 0;
  const a = new THREE.Vector3(), b = new THREE.Vector3(), c = new THREE.Vector3();
  for (let face = 0; face < corners / 3; face++) {
    for (const [number, corner] of [a, b, c].entries()) corner.fromArray(points, 3 * faces[3 * face + number]);
    b.sub(a).cross(c.sub(a));
    areas[face] = b.length();
    b.normalize().toArray(flat, 3 * face);
  }
  const positions = [], normals = [], index = new Uint32Array(corners), previous = [];
  const last = new Int32Array(count).fill(-1); // the last vertex at each point; `previous` leads to those before it
  for (let corner = 0; corner < corners; corner++) {
    const point = faces[corner], own = 3 * (corner / 3 | 0), end = Math.min(begin[point + 1], begin[point] + MOST_AROUND);
    a.set(flat[own], flat[own + 1], flat[own + 2]).multiplyScalar(areas[own / 3]);
    for (let place = begin[point]; place < end; place++) {
      const other = 3 * around[place];
      const cosine = flat[own] * flat[other] + flat[own + 1] * flat[other + 1] + flat[own + 2] * flat[other + 2];
      if (other !== own && cosine > CREASE) a.addScaledVector(b.fromArray(flat, other), areas[other / 3]);
    }
    a.normalize();
    let vertex = last[point];
    while (vertex >= 0 && a.dot(b.fromArray(normals, 3 * vertex)) < 0.9999) vertex = previous[vertex];
    if (vertex < 0) {
      vertex = previous.push(last[point]) - 1;
      last[point] = vertex;
      positions.push(points[3 * point], points[3 * point + 1], points[3 * point + 2]);
      normals.push(a.x, a.y, a.z);
    }
    index[corner] = vertex;
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  return geometry;
}

/* Calls `fill` with the name and the geometry of each mesh; `sizes` has the numbers of its points and faces. */
async function loadMeshes(sizes, fill) {
  for (const script of document.querySelectorAll("script[data-mesh]")) {
    const packed = Uint8Array.from(atob(script.textContent), (char) => char.charCodeAt(0)), [points, faces] = sizes[script.dataset.mesh];
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const buffer = await new Response(stream).arrayBuffer();
    fill(script.dataset.mesh, creased(new Float32Array(buffer, 0, 3 * points), new Uint32Array(buffer, 12 * points, 3 * faces)));
    await new Promise((go) => setTimeout(go)); // pointer and keys come first
  }
}
