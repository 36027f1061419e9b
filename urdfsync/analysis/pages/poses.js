"use strict";
/* Named poses of a robot, and the motion of its Test. */

const PERIOD = 10; // seconds of the way there and back, as in UrdfSync.Drives

/* Returns the positions of all free axes at `time` of the package's Test. */
function sweepAt(scene, time) {
  const share = (1 - Math.cos(2 * Math.PI * time / PERIOD)) / 2;
  return new Map(scene.hinges.filter((hinge) => isFree(hinge) && hinge.motion in ONE_WAY).map((hinge) => [hinge.element, hinge.start + hinge.way * share]));
}

const POSES = { // the purpose, and the position of one way of a hinge
  Zero: ["All free axes at zero", () => 0],
  Start: ["All axes where a simulation begins (r)", (hinge) => hinge.start],
  Stance: ["As at the start, on the ground", (hinge) => hinge.start],
  Middle: ["All axes in the middle of their limits", ({ lower, upper, start }) => lower === null || upper === null ? start : (lower + upper) / 2],
  Random: ["All axes anywhere between their limits", (hinge, way) => endsOfWay(hinge, way).reduce((low, high) => low + Math.random() * (high - low))],
};

/* Returns the poses of a robot, then those of its SRDF, by their names: a purpose, and a function that gives the positions of axes. */
function posesOf(data) {
  const poses = new Map(), ways = data.now.hinges.filter(isFree).flatMap((hinge) => waysOf(hinge).map((way) => [hinge, way]));
  for (const [name, [purpose, position]] of Object.entries(POSES)) {
    if (name !== "Stance" || data.now.height !== null) poses.set(name, [purpose, () => new Map(ways.map(([hinge, way]) => [way.name, position(hinge, way)]))]);
  }
  for (const [name, positions] of Object.entries(data.poses)) {
    poses.set(poses.has(name) ? `${name} (SRDF)` : name, ["Of the SRDF beside the source", () => new Map(Object.entries(positions))]);
  }
  return poses;
}
