// What moves a body.

import { checkNames, finiteNumber, listOfNumbers, motionNumbers, POSE_LENGTH, poseNumbers, poseOfNumbers, settingNumber, vectorNumbers } from "./numbers.js";
import { Owned } from "./owned.js";
import { classes } from "./wasm.js";

/** What moves a body: a `Motion`, a `Throw`, a `Path` or a `LinkMotion`. */
export class Movement extends Owned {
  /** Asked for each query, and never changing. */
  #end;

  constructor(inner) {
    super(inner);
    this.#end = inner.end() ?? null;
  }

  get end() {
    return this.#end;
  }

  pose(time) {
    return poseOfNumbers(Owned.inner(this).pose(finiteNumber(time, "time")));
  }
}

export class Motion extends Movement {
  constructor(motion) {
    super(motion instanceof classes().Movement ? motion : classes().Movement.from_velocities(motionNumbers(motion, "motion")));
  }

  static between(start, end, options) {
    checkNames(options, "options of Motion.between", ["duration", "center"]);
    const duration = settingNumber(options?.duration ?? 1, "duration");
    const center = vectorNumbers(options?.center, "center");
    return new Motion(classes().Movement.between(poseNumbers(start, "start"), poseNumbers(end, "end"), center, duration));
  }
}

export class Throw extends Movement {
  constructor({ acceleration, ...motion }) {
    super(classes().Movement.thrown(motionNumbers(motion, "motion"), vectorNumbers(acceleration, "acceleration")));
  }
}

export class Path extends Movement {
  constructor(times, poses, options) {
    checkNames(options, "options of Path", ["center", "spins"]);
    const at = listOfNumbers(times, "times");
    if (at.length !== poses.length) throw new TypeError(`poses: there are ${poses.length}, but ${at.length} times`);
    const numbers = new Float64Array(POSE_LENGTH * poses.length);
    poses.forEach((pose, k) => numbers.set(poseNumbers(pose, `pose ${k}`), POSE_LENGTH * k));
    super(classes().Movement.through_poses(at, numbers, vectorNumbers(options?.center, "center"), spinNumbers(options?.spins)));
  }
}

export class LinkMotion extends Movement {
  constructor(inner) {
    if (!(inner instanceof classes().Movement)) throw new TypeError("a LinkMotion is made by Robot.motion");
    super(inner);
  }
}

function spinNumbers(spins) {
  if (spins === undefined) return undefined;
  const numbers = new Float64Array(3 * spins.length);
  spins.forEach((spin, k) => numbers.set(vectorNumbers(spin, `spins[${k}]`), 3 * k));
  return numbers;
}
