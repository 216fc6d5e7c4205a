// A robot among obstacles, and questions about its paths.

import { featureOf, limitOf, vectorAt } from "./answer.js";
import { bodyOf } from "./body.js";
import { finiteNumber, joined, listOf, nameOf, optionsOf, settingNumber } from "./numbers.js";
import { innerOf, Owned } from "./owned.js";
import { NO_OFFSET, poseNumbers } from "./places.js";
import { configurationOf, pairsOf, remarksOf, Robot } from "./robot.js";
import { settingsOf, UnresolvedError } from "./solver.js";
import { classes } from "./wasm.js";

/** The places of the tolerance and of the pair in the numbers of an answer, as `js/src/wasm/path_answer.rs` writes them. */
const MET_TOLERANCE = 3;
const PAIR = 4;
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

  add(name, body, pose = {}) {
    Owned.inner(this).add(nameOf(name, "name"), bodyOf(body, "body"), poseNumbers(pose, "pose"));
  }

  moveTo(name, pose) {
    Owned.inner(this).move_to(nameOf(name, "name"), poseNumbers(pose, "pose"));
  }

  remove(name) {
    Owned.inner(this).remove(nameOf(name, "name"));
  }

  attach(name, body, link, options) {
    const { pose, mayTouch } = optionsOf(options, "Cell.attach", { pose: [poseNumbers, NO_OFFSET], mayTouch: [namesOf, []] });
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
    const bounds = { lower: numbers[0], upper: numbers[1], tolerance: numbers[MET_TOLERANCE] };
    const nearest = names.length === 0 ? null : pairOf(numbers, names);
    if (kind === classes().AnswerKind.LeastDistance) return { kind: "leastDistance", ...bounds, nearest };
    return { kind: "unresolved", ...limitOf(numbers[2]), ...bounds, nearest };
  }

  clearanceRanges(path, options) {
    const { resolution, maxPoseError, ...rest } = optionsOf(options, "Cell.clearanceRanges", RANGE_SETTINGS);
    const numbers = Owned.inner(this).clearance_ranges(this.#numbersOf(path), path.length, settingsOf(rest, RANGE_CONTACT_SETTINGS), resolution, maxPoseError);
    return Array.from({ length: numbers.length / 3 }, (_, k) => {
      const [start, end, verdict] = numbers.subarray(3 * k, 3 * k + 3);
      return { start, end, clearance: VERDICTS[verdict] };
    });
  }

  #ask(question, path, options, known) {
    const answer = Owned.inner(this).ask(question, this.#numbersOf(path), path.length, settingsOf(options, known));
    const parts = { kind: answer.kind, numbers: answer.numbers(), names: answer.names() };
    answer.free();
    return parts;
  }

  /** Returns the configurations of a path one after another. */
  #numbersOf(path) {
    return joined(listOf(path, "path", (value, what) => configurationOf(value, what, this.#joints)));
  }
}

function namesOf(value, what) {
  return listOf(value, what, nameOf);
}

function contactAnswer(kind, numbers, names) {
  const { Free, Contact } = classes().AnswerKind;
  if (kind === Free) return { kind: "free", safeUntil: numbers[0] + numbers[1] };
  if (kind === Contact) return { kind: "contact", ...pairOf(numbers, names), tolerance: numbers[MET_TOLERANCE] };
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
