// Questions about two bodies.

import { answerOf, boundsOf } from "./answer.js";
import { bodyOf } from "./body.js";
import { Movement } from "./movement.js";
import { checkNames, choiceOf, settingNumber } from "./numbers.js";
import { layout } from "./layout.js";
import { Owned } from "./owned.js";
import { writeMotion, writeRest } from "./places.js";
import { classes, engine, numbersAt } from "./wasm.js";

/** The names of the options of questions about contacts, about distances, and about time 0 only. */
const OF_CONTACTS = ["motionA", "motionB", "duration", "tolerance", "margin", "budget"];
const OF_DISTANCES = OF_CONTACTS.filter((name) => name !== "margin");
const AT_REST = OF_DISTANCES.filter((name) => name !== "duration");

const startOf = choiceOf(["report", "leave"]);
/** The names of the options that are numbers. */
const NUMBERS = ["tolerance", "margin", "budget", "duration"];

/** The engine that the solver belongs to. */
let home = null;
let solver = null;
let numbers = null;
let defaults = null;

/** The error of a yes-or-no question that could not be decided. */
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
  const answer = ask(classes().Question.KeptClearance, a, b, options, OF_DISTANCES, settingNumber(clearance, "clearance"));
  const { lower, upper } = boundsOf(numbers, layout().solver.answer);
  if (lower >= clearance && lower > 0) return true;
  if (upper < clearance || upper <= 0) return false;
  if (answer.kind === "unresolved") throw new UnresolvedError({ limit: answer.limit, advice: answer.advice, lower, upper });
  const excess = a.excess + b.excess;
  const known =
    upper - excess < clearance
      ? { limit: "excess", advice: "the bodies exceed their shapes by more than the clearance lacks; a smaller excess may tell" }
      : { limit: "tolerance", advice: "the distance is the clearance, to within the tolerance; a smaller tolerance may tell, but not of equal ones" };
  throw new UnresolvedError({ ...known, lower, upper });
}

/** Returns the settings of a question about a path. The caller reads the other options. */
export function settingsOf(options, known) {
  if (options !== undefined) checkNames(options, "options", known);
  const { solver: at } = layout();
  const value = (name) => (known.includes(name) && options?.[name] !== undefined ? settingNumber(options[name], name) : defaultSettings()[at[name]]);
  const [tolerance, margin, budget] = ["tolerance", "margin", "budget"].map(value);
  const leaves = options?.start !== undefined && startOf(options.start, "start") === "leave";
  return new (classes().PathSettings)(tolerance, margin, budget, leaves);
}

function unresolvedContact({ limit, advice, safeUntil }) {
  return new UnresolvedError({ limit, advice, safeUntil });
}

function ask(question, a, b, options, known, clearance = 0) {
  for (const [body, what] of [[a, "a"], [b, "b"]]) bodyOf(body, what);
  const { given, moveA, moveB } = readOptions(options, known);
  given[layout().solver.clearance] = clearance;
  // From here on no getter of the caller runs. A getter could ask other questions or free objects.
  solverNumbers().set(given);
  const moves = [moveA, moveB].map((move) => move && Owned.inner(move));
  const [bodyA, bodyB] = [bodyOf(a, "a"), bodyOf(b, "b")];
  moves.forEach((move, k) => move && solver.move_by(k, move));
  const kind = solver.ask(question, bodyA, bodyB);
  return answerOf(kind, solverNumbers(), layout().solver.answer);
}

/** Reads the options of a question about two bodies. Returns the numbers that the solver takes, and the movements of the bodies. */
function readOptions(options, known) {
  const { solver: at } = layout();
  const given = new Float64Array(at.answer);
  given.set(defaultSettings());
  given[at.duration] = NaN;
  if (options !== undefined) checkNames(options, "options", known);
  for (const name of known) {
    const value = NUMBERS.includes(name) ? options?.[name] : undefined;
    if (value !== undefined) given[at[name]] = settingNumber(value, name);
  }
  const moveA = movementOf(options?.motionA, "motionA", given, at.motionA);
  const moveB = movementOf(options?.motionB, "motionB", given, at.motionB);
  if (known === AT_REST) given[at.duration] = 0;
  else if (Number.isNaN(given[at.duration])) given[at.duration] = endOf(moveA, moveB);
  return { given, moveA, moveB };
}

/** Returns the movement of a body. For a motion given by numbers, writes the numbers and returns null. */
function movementOf(moved, what, given, at) {
  if (moved instanceof Movement) return moved;
  if (moved === undefined) writeRest(given, at);
  else writeMotion(moved, what, given, at);
  return null;
}

/** Returns the default end of a question: the end of the movements, or 1 if neither ends. */
function endOf(moveA, moveB) {
  const a = moveA?.end ?? null;
  const b = moveB?.end ?? null;
  if (a !== null && b !== null && a !== b) throw new Error("duration: the two bodies' motions end at different times; give one");
  return a ?? b ?? 1;
}

/** Returns a view of the numbers of the solver. Growth of the memory detaches the view; then makes a new one. */
function solverNumbers() {
  if (home !== engine()) {
    solver = new (classes().Solver)();
    [home, numbers] = [engine(), null];
  }
  if (numbers === null || numbers.length === 0) numbers = numbersAt(solver.numbers_address(), solver.number_count());
  return numbers;
}

function defaultSettings() {
  defaults ??= solverNumbers().slice(0, layout().solver.duration);
  return defaults;
}
