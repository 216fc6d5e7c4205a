// Converts answers about two bodies to plain objects.

import { layout } from "./layout.js";
import { classes } from "./wasm.js";

/** The names of the kinds of answers. Indices are values of `AnswerKind` in `doors/js/src/wasm/answer.rs`. */
export const KINDS = ["free", "contact", "touching", "overlapping", "interval", "leastDistance", "unresolved"];
/** The first number of an overlap for which only a point inside both bodies is known. */
const POINT_ONLY = 1;

/** Reads an answer from `numbers`, from index `start` on. `kind` is an index in `KINDS`. */
export function answerOf(kind, numbers, start) {
  const { answer } = layout();
  const name = KINDS[kind];
  const value = (field) => numbers[start + answer[field]];
  const hit = (hitKind, field) => hitOf(hitKind, numbers, start + answer[field], value("tolerance"));
  switch (name) {
    case "free":
      return { kind: name, safeUntil: value("safeUntil"), provenGap: value("lower"), tolerance: value("tolerance") };
    case "contact":
    case "touching":
    case "overlapping":
      return hit(name, "first");
    case "interval": {
      const [first, last] = [hit(KINDS[value("firstKind")], "first"), hit(KINDS[value("lastKind")], "last")];
      return { kind: name, first, last, tolerance: value("tolerance") };
    }
    case "leastDistance":
      return { kind: name, ...boundsOf(numbers, start), ...nearestOf(numbers, start + answer.first), tolerance: value("tolerance") };
    default:
      return unresolvedOf(numbers, start);
  }
}

/** Returns the bounds of the distance in an answer. */
export function boundsOf(numbers, start) {
  const { lower, upper } = layout().answer;
  return { lower: numbers[start + lower], upper: numbers[start + upper] };
}

/** Returns the name of a limit and the advice about it, from its number. */
function limitOf(number) {
  return { limit: classes().limit_name(number), advice: classes().limit_advice(number) };
}

/** Reads a feature of a body, and returns it as `v7`, `e3-7`, `f12` or `p0`, or null if there is none. */
function featureOf(numbers, at) {
  const index = numbers[at + 1];
  switch (numbers[at]) {
    case 0:
      return `v${index}`;
    case 1:
      return `e${index}-${numbers[at + 2]}`;
    case 2:
      return `f${index}`;
    case 3:
      return `p${index}`;
    default:
      return null;
  }
}

function vectorAt(numbers, at) {
  return [numbers[at], numbers[at + 1], numbers[at + 2]];
}

function unresolvedOf(numbers, start) {
  const { answer, contact } = layout();
  const value = (field) => numbers[start + answer[field]];
  const nearest = start + answer.first;
  return {
    kind: "unresolved",
    ...limitOf(value("limit")),
    safeUntil: value("safeUntil"),
    safeFrom: value("safeFrom") === Infinity ? null : value("safeFrom"),
    ...boundsOf(numbers, start),
    nearest: numbers[nearest + contact.known] === 0 ? null : nearestOf(numbers, nearest),
    tolerance: value("tolerance"),
  };
}

function hitOf(kind, numbers, start, tolerance) {
  const { contact } = layout();
  const { time, witnessA, witnessB, normal, featureA, featureB } = nearestOf(numbers, start);
  const pointOnly = numbers[start + contact.known] === POINT_ONLY;
  return {
    kind,
    time,
    witnessA,
    witnessB,
    normal: pointOnly ? null : normal,
    distance: pointOnly ? null : [numbers[start + contact.lower], numbers[start + contact.upper]],
    featureA: pointOnly ? null : featureA,
    featureB: pointOnly ? null : featureB,
    tolerance,
  };
}

function nearestOf(numbers, start) {
  const { contact } = layout();
  return {
    time: numbers[start + contact.time],
    witnessA: vectorAt(numbers, start + contact.witnessA),
    witnessB: vectorAt(numbers, start + contact.witnessB),
    normal: vectorAt(numbers, start + contact.normal),
    featureA: featureOf(numbers, start + contact.featureA),
    featureB: featureOf(numbers, start + contact.featureB),
  };
}
