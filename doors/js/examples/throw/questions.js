// The questions about a throw, and the answers in words.

import { firstContact } from "rigid-ccd";

/** The duration of every throw, in seconds. */
export const DURATION = 1;
// The distance, in metres, at which parts count as touching.
const TOLERANCE = 1e-6;

/** Asks one question about the whole second. Nothing touches before the returned contact. */
export function certify({ thrown, target }, motion) {
  return firstContact(thrown.body, target.body, { motionA: motion, duration: DURATION, tolerance: TOLERANCE });
}

/** Asks about one instant at each step. Returns the time of the first step in contact, or null. Proves nothing between steps. */
export function firstStepInContact({ thrown, target }, motion, rate) {
  for (let step = 0; step <= rate * DURATION; step += 1) {
    const motionA = motion.pose(step / rate);
    const answer = firstContact(thrown.body, target.body, { motionA, duration: 0, tolerance: TOLERANCE });
    if (answer.kind !== "free") return step / rate;
  }
  return null;
}

export function certifiedText({ kind, time, safeUntil }) {
  if (kind === "contact") return `Contact at ${seconds(time)}. Nothing touches before: proven.`;
  if (kind === "free") return "Nothing touches in the whole second: proven.";
  if (kind === "unresolved") return `Not decided. Nothing touches before ${seconds(safeUntil)}: proven.`;
  return `They are ${kind} at the start.`;
}

/** Describes the result of stepping. It is wrong if it misses a contact, or finds it late by more than a millisecond. */
export function steppingText({ kind, time }, seen, rate, speed) {
  const late = seen - time;
  if (kind !== "contact") {
    return { text: seen === null ? "Sees no contact at its steps, and proves nothing between them." : `Sees a contact at ${seconds(seen)}.`, wrong: false };
  }
  if (seen === null) {
    return { text: `None of ${rate} steps sees the contact: the part passes through. It moves ${length(speed / rate)} in each step.`, wrong: true };
  }
  if (late < 1e-9) return { text: "A step falls on the contact, and sees it.", wrong: false };
  const far = length(late * speed);
  return { text: `Sees the contact at ${seconds(seen)}: ${(1000 * late).toPrecision(3)} ms late, ${far} farther on.`, wrong: late > 1e-3 };
}

// Rounds down, so that a proof up to the exact time also holds up to the displayed time.
const seconds = (time) => `${(Math.floor(1e6 * time) / 1e6).toFixed(6)} s`;
const length = (metres) => (metres < 0.01 ? `${(1000 * metres).toPrecision(3)} mm` : `${(100 * metres).toPrecision(3)} cm`);
