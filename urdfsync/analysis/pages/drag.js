"use strict";
/* A link that is dragged turns its joint: the place where it was taken stays under the pointer. */

const TRIED = 1e-5; // step of an axis for derivatives, in rad or m
const ROUNDS = 8; // of Newton's method for one move of the pointer
const LEAST_STEP = 1e-7;
const LONGEST = 0.2; // step of an axis in one round, in rad, or in sizes of the robot

/* Returns the joints from a link to the root. */
function jointsAbove(scene, element) {
  const above = [];
  for (let link = element, hinge; (hinge = scene.hinges.find((each) => each.child === link)); link = hinge.parent) above.push(hinge);
  return above;
}

/* Returns the nearest joint above a link that moves by itself; a follower stands for its leader. Undefined if there is none. */
function jointToDrag(scene, element) {
  const leaderOf = (hinge) => hinge.leader ? leaderOf(scene.hinges.find((each) => each.element === hinge.leader)) : hinge;
  return jointsAbove(scene, element).map(leaderOf).find(isFree);
}

/* Returns the steps of the axes by which a point comes nearer: the least ones, and shorter where the point hardly moves. */
function stepsTo(columns, [x, y]) {
  const sum = (row, column) => columns.reduce((total, each) => total + each[row] * each[column], row === column ? 1 : 0);
  const [a, b, c] = [sum(0, 0), sum(0, 1), sum(1, 1)], whole = a * c - b * b;
  const [u, v] = [(c * x - b * y) / whole, (a * y - b * x) / whole];
  return columns.map(([across, along]) => across * u + along * v);
}

/* Takes a link at a point of space. Returns a function that moves the joint until the point is at a place of the window, in pixels;
   it returns whether the joint could follow. `project` gives the place of a point. */
function take(view, hinge, element, point, project) {
  const { matrixWorld } = view.bodies.get(element).group, local = point.clone().applyMatrix4(matrixWorld.clone().invert());
  const place = () => project(local.clone().applyMatrix4(matrixWorld));
  const ways = waysOf(hinge);
  return (x, y) => {
    for (let round = 0; round < ROUNDS; round++) {
      const before = new Map(view.positions), here = place(), gap = [x - here[0], y - here[1]];
      if (Math.hypot(...gap) < 0.05) break;
      const columns = ways.map(({ name }) => {
        view.move(new Map([[name, before.get(name) + TRIED]]));
        const there = place();
        view.positions = new Map(before);
        view.place();
        return [(there[0] - here[0]) / TRIED, (there[1] - here[1]) / TRIED];
      });
      const steps = stepsTo(columns, gap);
      if (steps.every((step) => Math.abs(step) < LEAST_STEP)) break; // it is as near as it comes
      const targets = new Map(ways.map((way, k) => {
        const most = LONGEST * (way.turns ? 1 : view.size), [low, high] = [hinge.lower ?? -Infinity, hinge.upper ?? Infinity];
        const position = before.get(way.name) + Math.min(Math.max(steps[k], -most), most);
        return [way.name, Math.min(Math.max(position, Math.min(low, before.get(way.name))), Math.max(high, before.get(way.name)))];
      }));
      if (!view.move(targets)) return false;
    }
    return true;
  };
}
