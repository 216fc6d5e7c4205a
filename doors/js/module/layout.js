// The layout of the numbers of a question and of its answer in the memory of the engine.

import { classes } from "./wasm.js";

let known = null;

/** Returns the indices of numbers by name: in a solver, relative to the start of an answer, and relative to the start of a contact. */
export function layout() {
  known ??= layoutOf(classes().Solver.layout());
  return known;
}

/** Reads lines such as `contact.witness_a 2`. */
function layoutOf(text) {
  const groups = { solver: {}, answer: {}, contact: {} };
  for (const line of text.split("\n")) {
    const [, group, name, index] = line.match(/^(\w+)\.(\w+) (\d+)$/);
    groups[group][name.replace(/_(.)/g, (_, letter) => letter.toUpperCase())] = Number(index);
  }
  return groups;
}
