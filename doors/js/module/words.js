// Writes values in messages.

/** Writes a string in messages as JavaScript does, so that it is told from all around it. */
export function quoted(text) {
  return JSON.stringify(text);
}

/** Describes a value in messages. */
export function described(value) {
  if (typeof value === "string") return quoted(value);
  if (typeof value === "bigint") return `${value}n`;
  if (typeof value === "function") return "a function";
  if (value === null || typeof value !== "object") return String(value);
  return `an object of ${nameOfClass(value) ?? "no class"}`;
}

/** Returns the name of an object's class. Bundlers shorten names in the code, and so the classes of this package have it as their tag. */
export function nameOfClass(value) {
  return value?.[Symbol.toStringTag] ?? value?.constructor?.name;
}
