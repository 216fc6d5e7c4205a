// Questions about two bodies.

import { answerOf } from "./answer.js";
import { Body } from "./body.js";
import { Movement } from "./movement.js";
import { checkNames, MOTION_LENGTH, settingNumber, writeMotion } from "./numbers.js";
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

/** The names of the options of a question about contacts, of one about a distance, and of one at rest. */
const OF_CONTACTS = ["motionA", "motionB", "duration", "tolerance", "margin", "budget"];
const OF_DISTANCES = OF_CONTACTS.filter((name) => name !== "margin");
const AT_REST = OF_DISTANCES.filter((name) => name !== "duration");

const PLACES = { tolerance: TOLERANCE, margin: MARGIN, budget: BUDGET, duration: DURATION };

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
  return ask(classes().Question.FirstContact, a, b, options, OF_CONTACTS);
}

export function anyContact(a, b, options) {
  return ask(classes().Question.AnyContact, a, b, options, OF_CONTACTS);
}

export function isFree(a, b, options) {
  const answer = anyContact(a, b, options);
  if (answer.kind === "unresolved") throw unresolvedContact(answer);
  return answer.kind === "free";
}

export function contactInterval(a, b, options) {
  return ask(classes().Question.ContactInterval, a, b, options, OF_CONTACTS);
}

export function closestApproach(a, b, options) {
  return ask(classes().Question.ClosestApproach, a, b, options, OF_DISTANCES);
}

export function distance(a, b, options) {
  return ask(classes().Question.ClosestApproach, a, b, options, AT_REST);
}

export function keepsClearance(a, b, clearance, options) {
  solverNumbers()[CLEARANCE] = settingNumber(clearance, "clearance");
  const answer = ask(classes().Question.KeptClearance, a, b, options, OF_DISTANCES);
  const [lower, upper] = [numbers[ANSWER + 1], numbers[ANSWER + 2]];
  if (lower >= clearance && lower > 0) return true;
  if (upper < clearance || upper <= 0) return false;
  if (answer.kind === "unresolved") throw new UnresolvedError({ limit: answer.limit, advice: answer.advice, lower, upper });
  const advice = "the bodies exceed their shapes by more than the clearance lacks; a smaller excess may tell";
  throw new UnresolvedError({ limit: "excess", advice, lower, upper });
}

/** Returns the settings of a question about a path: tolerance, margin, 0 and budget. Others than those are for the caller. */
export function settingsOf(options, known) {
  checkNames(options, "options", known);
  const settings = Float64Array.from(defaultSettings());
  for (const name of ["tolerance", "margin", "budget"]) {
    if (options?.[name] !== undefined) settings[PLACES[name]] = settingNumber(options[name], name);
  }
  return settings;
}

function unresolvedContact({ limit, advice, safeUntil }) {
  return new UnresolvedError({ limit, advice, safeUntil });
}

function ask(question, a, b, options, known) {
  const [bodyA, bodyB] = [innerOf(a, Body, "a"), innerOf(b, Body, "b")];
  writeOptions(options, known);
  const kind = solver.ask(question, bodyA, bodyB);
  return answerOf(kind, solverNumbers(), ANSWER);
}

function writeOptions(options, known) {
  const to = solverNumbers();
  const usual = defaultSettings();
  for (const place of [TOLERANCE, MARGIN, BUDGET]) to[place] = usual[place];
  to[DURATION] = NaN;
  checkNames(options, "options", known);
  for (const name in options) {
    const place = PLACES[name];
    if (place !== undefined && options[name] !== undefined) to[place] = settingNumber(options[name], name);
  }
  const moveA = movementOf(options?.motionA, 0);
  const moveB = movementOf(options?.motionB, 1);
  if (known === AT_REST) to[DURATION] = 0;
  else if (Number.isNaN(to[DURATION])) to[DURATION] = endOf(moveA, moveB);
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
