// What TypeScript has to accept, and what it has to refuse.

import { Body, Cell, closestApproach, contactInterval, EngineError, firstContact, init, Motion, PosePath, readMesh, Robot, Ballistic, UnresolvedError } from "rigid-ccd";
import type { Feature, Joint, Vector } from "rigid-ccd";

export async function answers(): Promise<string> {
  const { simd }: { simd: boolean } = await init({ simd: false });
  if (simd) return "with vectors";
  const [ball, box] = [Body.sphere(1), Body.box({ x: 1, y: 2, z: 3 })];
  const hit = firstContact(ball, box, { motionA: new Ballistic({ acceleration: [0, 0, -9.81] }), tolerance: 1e-6 });
  switch (hit.kind) {
    case "free":
      return `${hit.provenGap} ${hit.safeUntil}`;
    case "contact":
    case "touching": {
      const [normal, feature]: [Vector, Feature] = [hit.normal, hit.featureA];
      return `${normal[0]} ${feature}`;
    }
    case "overlapping":
      // @ts-expect-error A point inside both bodies has no normal.
      return String(hit.normal[0]);
    case "unresolved":
      return `${hit.limit} ${hit.safeUntil}`;
    default: {
      const none: never = hit;
      return none;
    }
  }
}

/** What the types of three.js have for an attribute's array. */
type TypedArray = Int8Array | Uint8Array | Uint8ClampedArray | Int16Array | Uint16Array | Int32Array | Uint32Array | Float32Array | Float64Array;

export function units(bytes: Uint8Array, position: TypedArray): string {
  const { positions, unit } = readMesh("part.dae", bytes, { unit: "mm", scale: 2 });
  Body.fromMesh(position, null, { pieces: "outer-hull" });
  // @ts-expect-error There is no such unit.
  Body.fromFile("part.dae", bytes, { unit: "inch" });
  return `${positions.length} ${unit ?? "unknown"}`;
}

export function mechanisms(mesh: { position: Float32Array; index: Uint16Array }): number {
  using part = Body.fromMesh(mesh.position, mesh.index, { pieces: "hull" });
  const joints: Joint[] = [
    { type: "revolute", name: "a", parent: "base", child: "arm", limits: [0, 1] },
    { type: "fixed", name: "b", parent: "arm", child: "tool" },
  ];
  const cell = new Cell(new Robot({ joints, bodies: { tool: [{ body: part, pose: { position: [1, 0, 0] } }] } }));
  cell.addObstacle("wall", part);
  const closest = cell.closestApproach([[0], new Float64Array([1])]);
  if (closest.kind === "unresolved") throw new Error(closest.advice);
  return closest.lower + (closest.nearest?.fraction ?? 0) + cell.clearanceRanges([[0], [1]], { margin: 0.1 }).length;
}

export function undecided(error: unknown): number | undefined {
  return error instanceof UnresolvedError && error.limit === "budget" ? error.safeUntil : undefined;
}

export function hasEnded(error: unknown): boolean {
  return error instanceof EngineError && error.reason === "memory";
}

export function refused(ball: Body): void {
  // @ts-expect-error There is no such setting.
  firstContact(ball, ball, { tolerence: 1 });
  // @ts-expect-error The closest approach has no margin.
  closestApproach(ball, ball, { margin: 1 });
  // @ts-expect-error Nor has that on a path.
  new Cell(new Robot({})).closestApproach([[]], { margin: 1 });
  // @ts-expect-error A vector has three numbers, or x, y and z.
  new Motion({ position: { x: 1, y: 2 } });
  // @ts-expect-error Bodies are made by `Body.sphere` and its like.
  new Body();
  // @ts-expect-error A fixed joint has no limits.
  const joint: Joint = { type: "fixed", name: "a", parent: "b", child: "c", limits: [0, 1] };
  const interval = contactInterval(ball, ball, { motionA: new PosePath([0], [{}]), motionB: Motion.between({}, {}) });
  // @ts-expect-error Only an interval has a last contact.
  console.log(interval.last, joint);
}
