"use strict";
/* Named poses of a robot, and the motion of its Test. */

const PERIOD = 10; // seconds of the way there and back, as in UrdfSync.Drives

/* Returns the positions of all free axes at `time` of the package's Test. */
function sweepAt(scene, time) {
  const share = (1 - Math.cos(2 * Math.PI * time / PERIOD)) / 2;
  return new Map(scene.hinges.filter((hinge) => isFree(hinge) && hinge.motion in ONE_WAY).map((hinge) => [hinge.element, hinge.start + hinge.way * share]));
}

const POSITIONS = { // of one way of a hinge
  Zero: () => 0,
  Start: (hinge) => hinge.start,
  Stance: (hinge) => hinge.start,
  Middle: (hinge) => hinge.lower === null || hinge.upper === null ? hinge.start : (hinge.lower + hinge.upper) / 2,
  Random: (hinge, way) => endsOfWay(hinge, way).reduce((low, high) => low + Math.random() * (high - low)),
};
const PURPOSES = {
  Zero: "All free axes at zero", Start: "All axes where a simulation begins (r)", Stance: "As at the start, on the ground",
  Middle: "All axes in the middle of their limits", Random: "All axes anywhere between their limits",
};

/* Returns the names of the poses: those of any robot, then those of its SRDF. A pose of Test stands on the ground. */
function poseNames(data) {
  return [...Object.keys(POSITIONS).filter((name) => name !== "Stance" || data.now.height !== null), ...Object.keys(data.poses)];
}

/* Returns the positions of the axes that a pose moves. */
function posed(data, name) {
  if (!(name in POSITIONS)) return new Map(Object.entries(data.poses[name]));
  return new Map(data.now.hinges.filter(isFree).flatMap((hinge) => waysOf(hinge).map((way) => [way.name, POSITIONS[name](hinge, way)])));
}

/* Fills in a button for each pose. */
function fillPoses(place, data, take) {
  const button = (name) => make("button", { type: "button", "data-pose": name, title: PURPOSES[name] || `${name}, of the SRDF beside the source` }, name, { click: () => take(name) });
  place.append(...poseNames(data).map(button));
}
