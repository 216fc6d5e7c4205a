// A robot among obstacles, and questions about its paths.

import { featureOf, limitOf, vectorAt } from "./answer.js";
import { Body } from "./body.js";
import { checkNames, finiteNumber, listOfNumbers, nameOf, poseNumbers, settingNumber } from "./numbers.js";
import { innerOf, Owned } from "./owned.js";
import { pairsOf, Robot } from "./robot.js";
import { settingsOf, UnresolvedError } from "./solver.js";
import { classes } from "./wasm.js";

/** The places of the tolerance and of the pair in the numbers of an answer, as `js/src/wasm/path_answer.rs` writes them. */
const TOLERANCE = 3;
const PAIR = 4;
const CONTACT_SETTINGS = ["tolerance", "margin", "budget"];
const DISTANCE_SETTINGS = ["tolerance", "budget"];
const VERDICTS = ["kept", "violated", "unverified"];

export class Cell extends Owned {
  #joints;

  constructor(robot) {
    super(new (classes().Cell)(innerOf(robot, Robot, "robot")));
    this.#joints = robot.jointNames;
  }

  add(name, body, pose) {
    Owned.inner(this).add(nameOf(name, "name"), innerOf(body, Body, "body"), poseNumbers(pose, "pose"));
  }

  moveTo(name, pose) {
    Owned.inner(this).move_to(nameOf(name, "name"), poseNumbers(pose, "pose"));
  }

  remove(name) {
    Owned.inner(this).remove(nameOf(name, "name"));
  }

  attach(name, body, link, options) {
    checkNames(options, "options of Cell.attach", ["pose", "mayTouch"]);
    const pose = poseNumbers(options?.pose, "pose");
    const mayTouch = Array.from(options?.mayTouch ?? [], (one, k) => nameOf(one, `mayTouch[${k}]`));
    Owned.inner(this).attach(nameOf(name, "name"), innerOf(body, Body, "body"), nameOf(link, "link"), pose, mayTouch);
  }

  detach(name) {
    Owned.inner(this).detach(nameOf(name, "name"));
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
    const { kind, numbers, names } = this.#ask(classes().Question.FirstContact, path, options, CONTACT_SETTINGS);
    return contactAnswer(kind, numbers, names);
  }

  isFree(path, options) {
    const { kind, numbers, names } = this.#ask(classes().Question.AnyContact, path, options, CONTACT_SETTINGS);
    const answer = contactAnswer(kind, numbers, names);
    if (answer.kind === "unresolved") throw new UnresolvedError({ limit: answer.limit, advice: answer.advice, safeUntil: answer.safeUntil });
    return answer.kind === "free";
  }

  closestApproach(path, options) {
    const { kind, numbers, names } = this.#ask(classes().Question.ClosestApproach, path, options, DISTANCE_SETTINGS);
    const bounds = { lower: numbers[0], upper: numbers[1], tolerance: numbers[TOLERANCE] };
    const nearest = names.length === 0 ? null : pairOf(numbers, names);
    if (kind === classes().AnswerKind.LeastDistance) return { kind: "leastDistance", ...bounds, nearest };
    return { kind: "unresolved", ...limitOf(numbers[2]), ...bounds, nearest };
  }

  clearanceRanges(path, options) {
    const settings = settingsOf(options, [...CONTACT_SETTINGS, "resolution", "maxPoseError"]);
    const resolution = settingNumber(options?.resolution ?? 1 / 4096, "resolution");
    const error = settingNumber(options?.maxPoseError ?? 0, "maxPoseError");
    const numbers = Owned.inner(this).clearance_ranges(this.#numbersOf(path), settings, resolution, error);
    return Array.from({ length: numbers.length / 3 }, (_, k) => {
      const [start, end, verdict] = numbers.subarray(3 * k, 3 * k + 3);
      return { start, end, clearance: VERDICTS[verdict] };
    });
  }

  #ask(question, path, options, known) {
    const answer = Owned.inner(this).ask(question, this.#numbersOf(path), settingsOf(options, known));
    const parts = { kind: answer.kind, numbers: answer.numbers(), names: answer.names() };
    answer.free();
    return parts;
  }

  /** Returns the configurations of a path one after another. */
  #numbersOf(path) {
    if (typeof path?.length !== "number" || typeof path === "string") throw new TypeError("path: a list of configurations is needed");
    const count = this.#joints.length;
    const numbers = new Float64Array(count * path.length);
    for (let k = 0; k < path.length; k += 1) {
      const configuration = listOfNumbers(path[k], `path[${k}]`);
      if (configuration.length !== count) throw new Error(`path[${k}]: ${configuration.length} positions, but ${count} joints: ${this.#joints.join(", ")}`);
      numbers.set(configuration, count * k);
    }
    return numbers;
  }
}

function contactAnswer(kind, numbers, names) {
  const { Free, Contact } = classes().AnswerKind;
  if (kind === Free) return { kind: "free", safeUntil: numbers[0] + numbers[1] };
  if (kind === Contact) return { kind: "contact", ...pairOf(numbers, names), tolerance: numbers[TOLERANCE] };
  const [segment, share, limit] = numbers;
  return { kind: "unresolved", ...limitOf(limit), safeUntil: segment + share };
}

function pairOf(numbers, [a, b]) {
  const segment = numbers[PAIR];
  const share = numbers[PAIR + 1];
  return {
    segment,
    share,
    time: segment + share,
    a,
    b,
    witnessA: vectorAt(numbers, PAIR + 2),
    witnessB: vectorAt(numbers, PAIR + 5),
    distance: [numbers[PAIR + 8], numbers[PAIR + 9]],
    featureA: featureOf(numbers, PAIR + 10),
    featureB: featureOf(numbers, PAIR + 13),
  };
}
