// Converts answers about two bodies to plain objects.

import { classes } from "./wasm.js";

/** The names of the kinds of answers. Indices are values of `AnswerKind` in `doors/js/src/wasm/answer.rs`. */
export const KINDS = ["free", "contact", "touching", "overlapping", "interval", "leastDistance", "unresolved"];
/** Indices in the numbers of an answer, and in the numbers of a contact. `doors/js/src/wasm/answer.rs` writes both. */
const CONTACTS = 7;
const CONTACT_LENGTH = 21;
const POINT_ONLY = 1;

/** Reads an answer of a kind. Its numbers start at index `at`. */
export function answerOf(kind, numbers, at) {
  const name = KINDS[kind];
  const tolerance = numbers[at];
  const nearest = at + CONTACTS;
  switch (name) {
    case "free":
      return { kind: name, safeUntil: numbers[at + 3], provenGap: numbers[at + 1], tolerance };
    case "contact":
    case "touching":
    case "overlapping":
      return hitOf(name, numbers, nearest, tolerance);
    case "interval": {
      const first = hitOf(KINDS[numbers[at + 5]], numbers, nearest, tolerance);
      const last = hitOf(KINDS[numbers[at + 6]], numbers, nearest + CONTACT_LENGTH, tolerance);
      return { kind: name, first, last, tolerance };
    }
    case "leastDistance":
      return { kind: name, lower: numbers[at + 1], upper: numbers[at + 2], ...nearestOf(numbers, nearest), tolerance };
    default:
      return unresolvedOf(numbers, at, tolerance);
  }
}

/** Returns the name of a limit and the advice about it, from its number. */
function limitOf(number) {
  return { limit: classes().limit_name(number), advice: classes().limit_advice(number) };
}

/** Reads a feature of a body, and returns it as `v7`, `e3-7`, `f12` or `p0`, or null if there is none. */
function featureOf(numbers, at) {
  const one = numbers[at + 1];
  switch (numbers[at]) {
    case 0:
      return `v${one}`;
    case 1:
      return `e${one}-${numbers[at + 2]}`;
    case 2:
      return `f${one}`;
    case 3:
      return `p${one}`;
    default:
      return null;
  }
}

function vectorAt(numbers, at) {
  return [numbers[at], numbers[at + 1], numbers[at + 2]];
}

function unresolvedOf(numbers, at, tolerance) {
  const nearest = at + CONTACTS;
  const safeFrom = numbers[at + 4];
  return {
    kind: "unresolved",
    ...limitOf(numbers[at + 5]),
    safeUntil: numbers[at + 3],
    safeFrom: safeFrom === Infinity ? null : safeFrom,
    lower: numbers[at + 1],
    upper: numbers[at + 2],
    nearest: numbers[nearest] === 0 ? null : nearestOf(numbers, nearest),
    tolerance,
  };
}

function hitOf(kind, numbers, at, tolerance) {
  const pointOnly = numbers[at] === POINT_ONLY;
  return {
    kind,
    time: numbers[at + 1],
    witnessA: vectorAt(numbers, at + 2),
    witnessB: vectorAt(numbers, at + 5),
    normal: pointOnly ? null : vectorAt(numbers, at + 8),
    distance: pointOnly ? null : [numbers[at + 11], numbers[at + 12]],
    featureA: pointOnly ? null : featureOf(numbers, at + 13),
    featureB: pointOnly ? null : featureOf(numbers, at + 16),
    tolerance,
  };
}

function nearestOf(numbers, at) {
  return {
    time: numbers[at + 1],
    witnessA: vectorAt(numbers, at + 2),
    witnessB: vectorAt(numbers, at + 5),
    normal: vectorAt(numbers, at + 8),
    featureA: featureOf(numbers, at + 13),
    featureB: featureOf(numbers, at + 16),
  };
}
