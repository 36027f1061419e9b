"use strict";
/* Loops: the joints that follow others through loops keep these closed, by Newton's method. */

const CLOSED = 1e-9, SHIFT = 1e-6; // gap of a closed loop in m, and the step for numerical derivatives
const FARTHEST = 0.05; // longest step of an axis, in rad or m: a longer one may assemble the robot in another way
const MOST_STEPS = 1000;

/* Returns the errors of the equations of all loops. */
function gapsOf(view) {
  view.place();
  const vector = (parts) => new THREE.Vector3().fromArray(parts);
  return view.scene.loops.flatMap((loop) => {
    const [parent, child] = loop.ends.map(({ body, pose }) => new THREE.Matrix4().fromArray(view.pose(body)).multiply(new THREE.Matrix4().fromArray(pose)));
    const relative = parent.invert().multiply(child), place = new THREE.Vector3().setFromMatrixPosition(relative);
    return [
      ...loop.translations.map((along) => place.dot(vector(along))),
      ...loop.rotations.map(([u, v]) => vector(v).transformDirection(relative).dot(vector(u))),
    ];
  });
}

/* Returns x of A·x = b by Gauss's elimination; each row is one of A, then its number of b. If A is singular, x is not finite. */
function solved(rows) {
  rows.forEach((_, k) => {
    const largest = rows.reduce((best, row, at) => at > k && Math.abs(row[k]) > Math.abs(rows[best][k]) ? at : best, k);
    [rows[k], rows[largest]] = [rows[largest], rows[k]];
    rows = rows.map((row, at) => at === k ? row : row.map((value, column) => value - row[k] / rows[k][k] * rows[k][column]));
  });
  return rows.map((row, k) => row.at(-1) / row[k]);
}

/* Moves dependent joints until all loops are closed; returns whether they are. */
function close(view) {
  const names = view.scene.hinges.filter((hinge) => hinge.is_dependent && !hinge.leader).map((hinge) => hinge.element);
  const shift = (name, way) => view.positions.set(name, view.positions.get(name) + way);
  for (let round = 0; round < 20; round++) {
    const gaps = gapsOf(view);
    if (gaps.every((gap) => Math.abs(gap) < CLOSED)) return true;
    const columns = names.map((name) => {
      shift(name, SHIFT);
      const moved = gapsOf(view);
      shift(name, -SHIFT);
      return moved.map((gap, k) => (gap - gaps[k]) / SHIFT);
    });
    const steps = solved(gaps.map((gap, k) => [...columns.map((column) => column[k]), gap]));
    if (!steps.every((step) => Math.abs(step) < 1)) return false;
    steps.forEach((step, k) => shift(names[k], -step));
  }
  return false;
}

/* Moves axes towards their positions, all at once, as far as all loops stay closed on the way. Returns whether they are there. */
function moveClosed(view, targets) {
  const ways = [...targets].map(([name, position]) => [name, position, position - view.positions.get(name)]);
  const count = Math.min(Math.ceil(Math.max(FARTHEST, ...ways.map(([, , way]) => Math.abs(way))) / FARTHEST), MOST_STEPS);
  for (let rest = count - 1; rest >= 0; rest--) {
    const before = new Map(view.positions);
    for (const [name, position, way] of ways) view.positions.set(name, position - way * rest / count);
    if (close(view)) continue;
    view.positions = before;
    return false;
  }
  return true;
}
