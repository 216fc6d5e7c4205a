// Formats values for messages.

/** Quotes a string as JavaScript does, so that its ends are visible in a message. */
export function quoted(text) {
  return JSON.stringify(text);
}

/** Describes a value for a message. */
export function described(value) {
  if (typeof value === "string") return quoted(value);
  if (typeof value === "bigint") return `${value}n`;
  if (typeof value === "function") return "a function";
  if (value === null || typeof value !== "object") return String(value);
  return `an object of ${nameOfClass(value) ?? "no class"}`;
}

/** Returns the name of an object's class. Classes of this package store their name in a tag, because bundlers shorten names in code. */
export function nameOfClass(value) {
  return value?.[Symbol.toStringTag] ?? value?.constructor?.name;
}
