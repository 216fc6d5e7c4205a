// Questions about two bodies.

import { answerOf } from "./answer.js";
import { Body } from "./body.js";
import { Movement } from "./movement.js";
import { finiteNumber, MOTION_LENGTH, numberOrInfinity, unknownName, writeMotion } from "./numbers.js";
import { innerOf, Owned } from "./owned.js";
import { classes, numbersAt } from "./wasm.js";

/** Places in the memory of the solver; `js/src/wasm/solver.rs` has the same. */
const TOLERANCE = 0;
const MARGIN = 1;
const CLEARANCE = 2;
const BUDGET = 3;
const DURATION = 4;
const MOTIONS = 5;
const ANSWER = MOTIONS + 2 * MOTION_LENGTH;

const NAMES = "motionA, motionB, duration, tolerance, margin, budget";

let solver = null;
let numbers = null;
let defaults = null;

/** The error of a question that has to be answered by yes or no, and is not. */
export class UnresolvedError extends Error {
  constructor(known) {
    const proven = known.safeUntil === undefined ? `the distance is at least ${known.lower}` : `no contact before ${known.safeUntil}`;
    super(`unresolved (${known.limit}): ${proven}, not known more; ${known.advice}`);
    this.name = "UnresolvedError";
    Object.assign(this, known);
  }
}

export function firstContact(a, b, options) {
  return ask(classes().Question.FirstContact, a, b, options);
}

export function anyContact(a, b, options) {
  return ask(classes().Question.AnyContact, a, b, options);
}

export function isFree(a, b, options) {
  const answer = anyContact(a, b, options);
  if (answer.kind === "unresolved") throw unresolvedContact(answer);
  return answer.kind === "free";
}

export function contactInterval(a, b, options) {
  return ask(classes().Question.ContactInterval, a, b, options);
}

export function closestApproach(a, b, options) {
  return ask(classes().Question.ClosestApproach, a, b, options);
}

export function distance(a, b, options) {
  if (options?.duration !== undefined) throw unknownName("options", "duration", "motionA, motionB, tolerance, budget");
  return ask(classes().Question.ClosestApproach, a, b, { ...options, duration: 0 });
}

export function keepsClearance(a, b, clearance, options) {
  solverNumbers()[CLEARANCE] = finiteNumber(clearance, "clearance");
  const answer = ask(classes().Question.KeptClearance, a, b, options);
  const [lower, upper] = [numbers[ANSWER + 1], numbers[ANSWER + 2]];
  if (lower >= clearance && lower > 0) return true;
  if (upper < clearance || upper <= 0) return false;
  if (answer.kind === "unresolved") throw new UnresolvedError({ limit: answer.limit, advice: answer.advice, lower, upper });
  const advice = "the bodies exceed their shapes by more than the clearance lacks; a smaller excess may tell";
  throw new UnresolvedError({ limit: "excess", advice, lower, upper });
}

/** Returns the settings of a question about a path: tolerance, margin, 0 and budget. */
export function settingsOf(options, what, others) {
  const settings = Float64Array.from(defaultSettings());
  for (const name in options) {
    const value = options[name];
    if (value === undefined || others.includes(name)) continue;
    if (name === "tolerance") settings[TOLERANCE] = finiteNumber(value, name);
    else if (name === "margin") settings[MARGIN] = finiteNumber(value, name);
    else if (name === "budget") settings[BUDGET] = numberOrInfinity(value, name);
    else throw unknownName(what, name, ["tolerance", "margin", "budget", ...others].join(", "));
  }
  return settings;
}

function unresolvedContact({ limit, advice, safeUntil }) {
  return new UnresolvedError({ limit, advice, safeUntil });
}

function ask(question, a, b, options) {
  const [bodyA, bodyB] = [innerOf(a, Body, "a"), innerOf(b, Body, "b")];
  writeOptions(options);
  const kind = solver.ask(question, bodyA, bodyB);
  return answerOf(kind, solverNumbers(), ANSWER);
}

function writeOptions(options) {
  const to = solverNumbers();
  const usual = defaultSettings();
  for (const place of [TOLERANCE, MARGIN, BUDGET]) to[place] = usual[place];
  let duration;
  for (const name in options) {
    const value = options[name];
    if (value === undefined) continue;
    if (name === "motionA" || name === "motionB") continue;
    else if (name === "duration") duration = finiteNumber(value, name);
    else if (name === "tolerance") to[TOLERANCE] = finiteNumber(value, name);
    else if (name === "margin") to[MARGIN] = finiteNumber(value, name);
    else if (name === "budget") to[BUDGET] = numberOrInfinity(value, name);
    else throw unknownName("options", name, NAMES);
  }
  const moveA = movementOf(options?.motionA, 0);
  const moveB = movementOf(options?.motionB, 1);
  to[DURATION] = duration ?? endOf(moveA, moveB);
  // Last, because an error before would leave a movement to the next question.
  const innerA = moveA && Owned.inner(moveA);
  const innerB = moveB && Owned.inner(moveB);
  if (innerA) solver.move_by(0, innerA);
  if (innerB) solver.move_by(1, innerB);
}

/** Returns the movement of body 0 or 1; null if it has a motion, whose numbers are written. */
function movementOf(moved, body) {
  if (moved instanceof Movement) return moved;
  writeMotion(moved, body === 0 ? "motionA" : "motionB", numbers, MOTIONS + body * MOTION_LENGTH);
  return null;
}

/** Returns the end of paths and links; 1 if neither body moves by one. */
function endOf(moveA, moveB) {
  const a = moveA?.end ?? null;
  const b = moveB?.end ?? null;
  if (a !== null && b !== null && a !== b) throw new Error("duration: the two bodies' motions end at different times; give one");
  return a ?? b ?? 1;
}

/** Returns the numbers of the solver. They are taken anew after the memory has grown, which empties them. */
function solverNumbers() {
  solver ??= new (classes().Solver)();
  if (numbers === null || numbers.length === 0) numbers = numbersAt(solver.numbers_address(), solver.number_count());
  return numbers;
}

function defaultSettings() {
  defaults ??= solverNumbers().slice(0, DURATION);
  return defaults;
}
