// Questions about two bodies.

import { answerOf, boundsOf } from "./answer.js";
import { bodyOf } from "./body.js";
import { Movement } from "./movement.js";
import { checkNames, choiceOf, settingNumber } from "./numbers.js";
import { layout } from "./layout.js";
import { Owned } from "./owned.js";
import { writeMotion, writeRest } from "./places.js";
import { classes, engine, numbersAt } from "./wasm.js";

/** The options that each kind of question takes: about contacts, about distances, and about the distance at time 0. */
const CONTACT_OPTIONS = ["motionA", "motionB", "duration", "tolerance", "margin", "budget"];
const DISTANCE_OPTIONS = CONTACT_OPTIONS.filter((name) => name !== "margin");
const STATIC_OPTIONS = DISTANCE_OPTIONS.filter((name) => name !== "duration");

const startPolicyOf = choiceOf(["report", "leave"]);
/** The names of the options that are numbers. */
const NUMBER_OPTIONS = ["tolerance", "margin", "budget", "duration"];

/** The engine whose memory holds the solver. */
let solverEngine = null;
let solver = null;
let numbers = null;
let defaults = null;

/** The error of a yes-or-no question that could not be decided. */
export class UnresolvedError extends Error {
  constructor(known) {
    const proven = known.safeUntil === undefined ? `the distance is at least ${known.lower}` : `no contact before ${known.safeUntil}`;
    super(`unresolved (${known.limit}): ${proven}, and no more is proven; ${known.advice}`);
    this.name = "UnresolvedError";
    Object.assign(this, known);
  }
}

export function firstContact(a, b, options) {
  return ask(classes().Question.FirstContact, a, b, options, CONTACT_OPTIONS);
}

export function anyContact(a, b, options) {
  return ask(classes().Question.AnyContact, a, b, options, CONTACT_OPTIONS);
}

export function isFree(a, b, options) {
  const answer = anyContact(a, b, options);
  if (answer.kind === "unresolved") throw unresolvedContact(answer);
  return answer.kind === "free";
}

export function contactInterval(a, b, options) {
  return ask(classes().Question.ContactInterval, a, b, options, CONTACT_OPTIONS);
}

export function closestApproach(a, b, options) {
  return ask(classes().Question.ClosestApproach, a, b, options, DISTANCE_OPTIONS);
}

export function distance(a, b, options) {
  return ask(classes().Question.ClosestApproach, a, b, options, STATIC_OPTIONS);
}

export function keepsClearance(a, b, clearance, options) {
  const answer = ask(classes().Question.KeptClearance, a, b, options, DISTANCE_OPTIONS, settingNumber(clearance, "clearance"));
  const { lower, upper } = boundsOf(numbers, layout().solver.answer);
  if (lower >= clearance && lower > 0) return true;
  if (upper < clearance || upper <= 0) return false;
  if (answer.kind === "unresolved") throw new UnresolvedError({ limit: answer.limit, advice: answer.advice, lower, upper });
  const excess = a.excess + b.excess;
  const known =
    upper - excess < clearance
      ? { limit: "excess", advice: "the bodies extend too far beyond their shapes; bodies with a smaller excess may decide" }
      : { limit: "tolerance", advice: "the distance differs from the clearance by less than the tolerance; a smaller tolerance may decide, unless both are equal" };
  throw new UnresolvedError({ ...known, lower, upper });
}

/** Returns the settings of a question about a path. `known` has the names of its options. */
export function settingsOf(options, known) {
  if (options !== undefined) checkNames(options, "options", known);
  const { solver: at } = layout();
  const value = (name) => (known.includes(name) && options?.[name] !== undefined ? settingNumber(options[name], name) : defaultSettings()[at[name]]);
  const [tolerance, margin, budget] = ["tolerance", "margin", "budget"].map(value);
  const leaves = options?.start !== undefined && startPolicyOf(options.start, "start") === "leave";
  return new (classes().PathSettings)(tolerance, margin, budget, leaves);
}

function unresolvedContact({ limit, advice, safeUntil }) {
  return new UnresolvedError({ limit, advice, safeUntil });
}

function ask(question, a, b, options, known, clearance = 0) {
  for (const [body, argumentName] of [[a, "a"], [b, "b"]]) bodyOf(body, argumentName);
  const { questionNumbers, moveA, moveB } = readOptions(options, known);
  questionNumbers[layout().solver.clearance] = clearance;
  // From here on no getter of the caller runs. A getter could ask other questions or free objects.
  solverNumbers().set(questionNumbers);
  const moves = [moveA, moveB].map((move) => move && Owned.inner(move));
  const [bodyA, bodyB] = [bodyOf(a, "a"), bodyOf(b, "b")];
  moves.forEach((move, k) => move && solver.move_by(k, move));
  const kind = solver.ask(question, bodyA, bodyB);
  return answerOf(kind, solverNumbers(), layout().solver.answer);
}

/** Reads the options of a question about two bodies. Returns the numbers that the solver takes, and the movements of the bodies. */
function readOptions(options, known) {
  const { solver: at } = layout();
  const questionNumbers = new Float64Array(at.answer);
  questionNumbers.set(defaultSettings());
  questionNumbers[at.duration] = NaN;
  if (options !== undefined) checkNames(options, "options", known);
  for (const name of known) {
    const value = NUMBER_OPTIONS.includes(name) ? options?.[name] : undefined;
    if (value !== undefined) questionNumbers[at[name]] = settingNumber(value, name);
  }
  const moveA = movementOf(options?.motionA, "motionA", questionNumbers, at.motionA);
  const moveB = movementOf(options?.motionB, "motionB", questionNumbers, at.motionB);
  if (known === STATIC_OPTIONS) questionNumbers[at.duration] = 0;
  else if (Number.isNaN(questionNumbers[at.duration])) questionNumbers[at.duration] = endOf(moveA, moveB);
  return { questionNumbers, moveA, moveB };
}

/** Returns the movement of a body. For a motion questionNumbers by numbers, writes the numbers and returns null. */
function movementOf(motion, argumentName, questionNumbers, at) {
  if (motion instanceof Movement) return motion;
  if (motion === undefined) writeRest(questionNumbers, at);
  else writeMotion(motion, argumentName, questionNumbers, at);
  return null;
}

/** Returns the default end of a question: the end of the movements, or 1 if neither ends. */
function endOf(moveA, moveB) {
  const a = moveA?.end ?? null;
  const b = moveB?.end ?? null;
  if (a !== null && b !== null && a !== b) throw new Error("duration: the motions of the two bodies end at different times; pass a duration");
  return a ?? b ?? 1;
}

/** Returns a view of the numbers of the solver. When the memory has grown, the old view is detached, and this makes a new one. */
function solverNumbers() {
  if (solverEngine !== engine()) {
    solver = new (classes().Solver)();
    [solverEngine, numbers] = [engine(), null];
  }
  if (numbers === null || numbers.length === 0) numbers = numbersAt(solver.numbers_address(), solver.number_count());
  return numbers;
}

function defaultSettings() {
  defaults ??= solverNumbers().slice(0, layout().solver.duration);
  return defaults;
}
