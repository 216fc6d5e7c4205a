// A robot among obstacles, and questions about its paths.

import { KINDS } from "./answer.js";
import { bodyOf } from "./body.js";
import { finiteNumber, joined, listOf, nameOf, optionsOf, settingNumber } from "./numbers.js";
import { innerOf, Owned } from "./owned.js";
import { IDENTITY, poseNumbers } from "./places.js";
import { configurationOf, pairsOf, remarksOf, Robot } from "./robot.js";
import { settingsOf, UnresolvedError } from "./solver.js";
import { classes } from "./wasm.js";

const RANGE_CONTACT_SETTINGS = ["tolerance", "margin", "budget"];
const CONTACT_SETTINGS = [...RANGE_CONTACT_SETTINGS, "start"];
const DISTANCE_SETTINGS = ["tolerance", "budget"];
const RANGE_SETTINGS = {
  ...Object.fromEntries(RANGE_CONTACT_SETTINGS.map((name) => [name, [settingNumber, undefined]])),
  resolution: [settingNumber, 1 / 4096],
  maxPoseError: [settingNumber, 0],
};
const VERDICTS = ["kept", "violated", "unverified"];

export class Cell extends Owned {
  #joints;

  get [Symbol.toStringTag]() {
    return "Cell";
  }

  constructor(robot) {
    super(new (classes().Cell)(innerOf(robot, Robot, "robot")));
    this.#joints = robot.jointNames;
  }

  addObstacle(name, body, pose = {}) {
    Owned.inner(this).add_obstacle(nameOf(name, "name"), bodyOf(body, "body"), poseNumbers(pose, "pose"));
  }

  moveObstacle(name, pose) {
    Owned.inner(this).move_obstacle(nameOf(name, "name"), poseNumbers(pose, "pose"));
  }

  removeObstacle(name) {
    Owned.inner(this).remove_obstacle(nameOf(name, "name"));
  }

  attach(name, body, link, options) {
    const { pose, mayTouch } = optionsOf(options, "Cell.attach", { pose: [poseNumbers, IDENTITY], mayTouch: [namesOf, []] });
    Owned.inner(this).attach(nameOf(name, "name"), bodyOf(body, "body"), nameOf(link, "link"), pose, mayTouch);
  }

  detach(name) {
    Owned.inner(this).detach(nameOf(name, "name"));
  }

  allowContact(a, b) {
    Owned.inner(this).allow_contact(nameOf(a, "a"), nameOf(b, "b"));
  }

  forbidContact(a, b) {
    Owned.inner(this).forbid_contact(nameOf(a, "a"), nameOf(b, "b"));
  }

  get remarks() {
    return remarksOf(Owned.inner(this).remarks());
  }

  setPadding(link, distance) {
    Owned.inner(this).set_padding(nameOf(link, "link"), finiteNumber(distance, "distance"));
  }

  setClearance(a, b, distance) {
    Owned.inner(this).set_clearance(nameOf(a, "a"), nameOf(b, "b"), finiteNumber(distance, "distance"));
  }

  get checkedPairs() {
    return pairsOf(Owned.inner(this).checked_pairs());
  }

  firstContact(path, options) {
    return contactAnswer(this.#ask(classes().Question.FirstContact, path, options, CONTACT_SETTINGS));
  }

  isFree(path, options) {
    const answer = this.#ask(classes().Question.AnyContact, path, options, CONTACT_SETTINGS);
    if (answer.kind === "unresolved") throw new UnresolvedError({ limit: answer.limit, advice: answer.advice, safeUntil: answer.safeUntil });
    return answer.kind === "free";
  }

  closestApproach(path, options) {
    const { kind, limit, advice, lower, upper, tolerance, nearest } = this.#ask(classes().Question.ClosestApproach, path, options, DISTANCE_SETTINGS);
    const bounds = { lower, upper, tolerance, nearest };
    return kind === "unresolved" ? { kind, limit, advice, ...bounds } : { kind, ...bounds };
  }

  clearanceRanges(path, options) {
    const { resolution, maxPoseError, ...contactSettings } = optionsOf(options, "Cell.clearanceRanges", RANGE_SETTINGS);
    const numbers = Owned.inner(this).clearance_ranges(this.#numbersOf(path), path.length, settingsOf(contactSettings, RANGE_CONTACT_SETTINGS), resolution, maxPoseError);
    return Array.from({ length: numbers.length / 3 }, (_, k) => {
      const [start, end, verdict] = numbers.subarray(3 * k, 3 * k + 3);
      return { start, end, clearance: VERDICTS[verdict] };
    });
  }

  #ask(question, path, options, known) {
    return answerOfPath(Owned.inner(this).ask(question, this.#numbersOf(path), path.length, settingsOf(options, known)));
  }

  /** Returns the configurations of a path as one array of numbers. */
  #numbersOf(path) {
    return joined(listOf(path, "path", (value, argumentName) => configurationOf(value, argumentName, this.#joints)));
  }
}

function namesOf(value, argumentName) {
  return listOf(value, argumentName, nameOf);
}

function contactAnswer({ kind, limit, advice, safeUntil, tolerance, nearest }) {
  if (kind === "contact") return { kind, ...nearest, tolerance };
  return kind === "unresolved" ? { kind, limit, advice, safeUntil } : { kind, safeUntil };
}

/** Converts an answer of the engine to a plain object, and frees it. */
function answerOfPath(answer) {
  const { kind, safe_until: safeUntil, lower, upper, tolerance, limit, advice } = answer;
  const object = { kind: KINDS[kind], limit, advice, safeUntil, lower, upper, tolerance, nearest: contactOfPath(answer.nearest) };
  answer.free();
  return object;
}

/** Converts the pair of an answer to a plain object, and frees it. Returns null if there is no pair. */
function contactOfPath(pair) {
  if (pair === undefined) return null;
  const { segment, fraction, time, a, b, lower, upper, witness_a: witnessA, witness_b: witnessB, feature_a: featureA = null, feature_b: featureB = null } = pair;
  pair.free();
  return { segment, fraction, time, a, b, witnessA: [...witnessA], witnessB: [...witnessB], distance: [lower, upper], featureA, featureB };
}
