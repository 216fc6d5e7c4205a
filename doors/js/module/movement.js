// Movements of bodies.

import { finiteNumber, joined, listOf, listOfNumbers, optionsOf, settingNumber } from "./numbers.js";
import { Owned } from "./owned.js";
import { MOTION_LENGTH, motionNumbers, ORIGIN, poseNumbers, poseOfNumbers, throwNumbers, vectorNumbers } from "./places.js";
import { classes } from "./wasm.js";

/** The movement of a body: a `Motion`, a `Ballistic`, a `PosePath` or a `LinkTrajectory`. */
export class Movement extends Owned {
  /** A cache: each query needs the end, which never changes. */
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
  get [Symbol.toStringTag]() {
    return "Motion";
  }

  constructor(motion = {}) {
    super(motion instanceof classes().Movement ? motion : classes().Movement.from_velocities(motionNumbers(motion, "motion")));
  }

  static between(start, end, options) {
    const { duration, center } = optionsOf(options, "Motion.between", { duration: [settingNumber, 1], center: [vectorNumbers, ORIGIN] });
    return new Motion(classes().Movement.between(poseNumbers(start, "start"), poseNumbers(end, "end"), center, duration));
  }
}

export class Ballistic extends Movement {
  get [Symbol.toStringTag]() {
    return "Ballistic";
  }

  constructor(motion) {
    const numbers = throwNumbers(motion, "motion");
    super(classes().Movement.ballistic(numbers.subarray(0, MOTION_LENGTH), numbers.subarray(MOTION_LENGTH)));
  }
}

export class PosePath extends Movement {
  get [Symbol.toStringTag]() {
    return "PosePath";
  }

  constructor(times, poses, options) {
    const { center, angularVelocities } = optionsOf(options, "PosePath", { center: [vectorNumbers, ORIGIN], angularVelocities: [vectorsOf, undefined] });
    const [timeNumbers, poseList] = [listOfNumbers(times, "times"), listOf(poses, "poses", poseNumbers)];
    if (timeNumbers.length !== poseList.length) throw new TypeError(`poses: there are ${poseList.length}, but ${timeNumbers.length} times`);
    super(classes().Movement.pose_path(timeNumbers, joined(poseList), center, angularVelocities));
  }
}

export class LinkTrajectory extends Movement {
  get [Symbol.toStringTag]() {
    return "LinkTrajectory";
  }

  constructor(inner) {
    if (!(inner instanceof classes().Movement)) throw new TypeError("a LinkTrajectory is made by Robot.linkTrajectory");
    super(inner);
  }
}

function vectorsOf(value, argumentName) {
  return joined(listOf(value, argumentName, vectorNumbers));
}
