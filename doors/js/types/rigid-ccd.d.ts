/**
 * Certified continuous collision detection: when do two moving rigid bodies first touch?
 *
 * No contact happens before the reported time: the proof covers rounding errors. Lengths are in any one unit, angles
 * in radians, times in the motions' unit.
 */

/**
 * Loads the WebAssembly. Call and await it before anything else; later calls do nothing.
 *
 * If the engine has no vector instructions for WebAssembly, or `simd` is false, it loads `fallback.js` from the
 * folder of the module. The fallback gives the same answers, bit for bit, but takes longer. With `simd: true` the
 * promise rejects instead.
 */
export function init(options?: { simd?: boolean }): Promise<{ simd: boolean }>;

/**
 * The engine has ended: its memory of at most 4 GB is exhausted, or it has a fault. All bodies, movements, robots and
 * cells are lost, and each use of one throws this error. Calling `init` again loads a new engine.
 */
export class EngineError extends Error {
  private constructor();
  reason: "memory" | "fault";
}

/** Returns the size of the memory of the WebAssembly in bytes. The memory never shrinks. */
export function memoryUsage(): number;

// --- Vectors, poses and bodies

export type Vector = readonly [number, number, number];
/** A quaternion in the order x, y, z, w, as in three.js. */
export type Quaternion = readonly [x: number, y: number, z: number, w: number];
/** A vector that a function takes: a list, or an object such as a `Vector3` of three.js. */
export type GivenVector = ArrayLike<number> | { readonly x: number; readonly y: number; readonly z: number };
/** A quaternion that a function takes: a list, or an object such as a `Quaternion` of three.js. It need not be normalised, but must not be zero. */
export type GivenQuaternion = ArrayLike<number> | { readonly x: number; readonly y: number; readonly z: number; readonly w: number };

export interface Pose {
  position: Vector;
  rotation: Quaternion;
}

/** A pose that a function takes. The defaults are the origin and no rotation. */
export interface GivenPose {
  position?: GivenVector;
  rotation?: GivenQuaternion;
}

declare global {
  /** The same declarations as in TypeScript's `esnext.disposable`, for projects whose `lib` is older. */
  interface SymbolConstructor {
    readonly dispose: unique symbol;
  }
  interface Disposable {
    [Symbol.dispose](): void;
  }
}

/**
 * An object in the memory of the WebAssembly. Its memory is freed by `free`, by garbage collection, or at the end of the
 * block that declares it with `using`.
 */
declare abstract class Owned {
  free(): void;
  [Symbol.dispose](): void;
}

export interface BodyOptions {
  /**
   * The convex pieces that represent the mesh. The default is the fewest pieces that are exact. `"hull"` needs a
   * closed convex mesh, and is exact. `"outer-hull"` encloses any mesh, even an open one; `Body.excess` bounds how
   * far it extends beyond the mesh.
   */
  pieces?: "auto" | "triangles" | "patches" | "hull" | "outer-hull";
  /** Makes a closed mesh a hollow surface. An open mesh is always a surface. With this option an open mesh gives no warning. */
  surface?: boolean;
}

export interface FileOptions {
  /** A factor on all coordinates; 1 by default. */
  scale?: number;
  /**
   * The unit to convert coordinates to, before `scale`. COLLADA files state their unit, and glTF files are in metres.
   * Other files are assumed to be in the requested unit already. Without this option coordinates keep the unit
   * of the file. If that unit is known and not the metre, the console shows a warning.
   */
  unit?: "um" | "mm" | "cm" | "m" | "in" | "ft";
}

/**
 * A rigid body: a mesh, a box, a ball, a capsule, a cylinder or a cone.
 *
 * A mesh is solid if it is closed and consistently oriented. Otherwise it is a surface. A closed surface inside another
 * one bounds a cavity, whatever its orientation. A body inside a solid overlaps it; a body inside a surface does not.
 * A mesh that is not closed gives a warning in the console, unless the option `surface` is set.
 */
export class Body extends Owned {
  private constructor();
  /**
   * Makes a body from a mesh in memory, such as the attribute `position` and the index of a `BufferGeometry` of
   * three.js.
   *
   * Without indices, every three vertices are a triangle. Vertices at exactly the same point are merged; the README
   * shows how to close seams of three.js. Positions are a Float32Array, a Float64Array or an array. An error names
   * the first invalid vertex or triangle.
   */
  static fromMesh(positions: ArrayLike<number>, indices?: ArrayLike<number> | null, options?: BodyOptions): Body;
  /**
   * Makes a body from an STL, OBJ, PLY, OFF, COLLADA or glTF file. The end of `name` tells the format. A `.gltf` must
   * contain its data, because other files cannot be fetched; a `.glb` always does.
   */
  static fromFile(name: string, bytes: Uint8Array | ArrayBuffer, options?: BodyOptions & FileOptions): Body;
  /** Makes a box about its origin. */
  static box(halfExtents: GivenVector): Body;
  /** Makes a ball about its origin. */
  static sphere(radius: number): Body;
  /** Makes a capsule along z. `halfHeight` is the distance from its middle to the center of either cap. */
  static capsule(radius: number, halfHeight: number): Body;
  /**
   * Makes a cylinder along z. It is represented by an enclosing polytope, which extends beyond it by at most
   * `excess`: by default 1/4096 of the radius.
   */
  static cylinder(radius: number, halfHeight: number, excess?: number): Body;
  /** Makes a cone along z with its apex up. It is represented by an enclosing polytope, like `cylinder`. */
  static cone(radius: number, halfHeight: number, excess?: number): Body;
  /** Whether the body is solid: another body inside it overlaps it. */
  readonly isSolid: boolean;
  /** The number of convex pieces. */
  readonly pieceCount: number;
  /** A description of the body: the shape and its lengths, or the pieces that represent the mesh, with remarks. */
  readonly report: string;
  /** The largest distance by which the body may extend beyond its shape; 0 for exact bodies. A contact may be reported early because of it, but never late. */
  readonly excess: number;
}

/**
 * Reads the triangles of a mesh file, to draw them, or to change them before making a body. The formats are the same as
 * for `Body.fromFile`. `unit` is the unit of the positions: the requested unit, or the one that the file states. It is
 * null if neither is known, or with the option `scale`.
 */
export function readMesh(
  name: string,
  bytes: Uint8Array | ArrayBuffer,
  options?: FileOptions,
): { positions: Float64Array; indices: Uint32Array; unit: FileOptions["unit"] | null };

// --- Movements of bodies

/** A motion at constant velocities: a pose at time 0, the velocity of a center, and an angular velocity about it. Defaults are 0. */
export interface MotionNumbers extends GivenPose {
  /** The velocity of the center, per unit of time. */
  velocity?: GivenVector;
  /** The angular velocity about the world's axes, in radians per unit of time. */
  angularVelocity?: GivenVector;
  /** The center of rotation in the body's frame. The default is the body's origin. */
  center?: GivenVector;
}

/** The movement of a body. */
export abstract class Movement extends Owned {
  /** The end of the movement, for a path, a link's motion or `Motion.between`; null for others. Questions end there by default. */
  readonly end: number | null;
  pose(time: number): Pose;
}

/** A motion at constant velocities. Questions also take plain `MotionNumbers`, which need no `free`. */
export class Motion extends Movement {
  constructor(motion?: MotionNumbers);
  /**
   * Makes the motion between two poses. The center moves on a straight line, and the body takes the shortest
   * rotation. The duration is 1 by default, and questions end there by default. In a longer question the motion
   * continues at the same velocities.
   */
  static between(start: GivenPose, end: GivenPose, options?: { duration?: number; center?: GivenVector }): Motion;
}

/** The movement of a thrown body: its center has a constant acceleration, and it rotates at a constant rate. */
export class Ballistic extends Movement {
  constructor(motion: MotionNumbers & { acceleration: GivenVector });
}

/**
 * A path through poses at increasing times. Between two poses the center moves on a straight line, and the body takes
 * the shortest rotation. The body is at rest before the first pose and after the last one.
 *
 * `angularVelocities` has an angular velocity from each pose to the next, for rotations of more than half a turn. The
 * rotation that it gives may differ from the next pose by at most a quarter turn. The difference is added as a second
 * rotation.
 */
export class PosePath extends Movement {
  constructor(times: ArrayLike<number>, poses: readonly GivenPose[], options?: { center?: GivenVector; angularVelocities?: readonly GivenVector[] });
}

/** The motion of a robot's link while all joints move at constant rates. `Robot.linkTrajectory` makes it. */
export class LinkTrajectory extends Movement {
  private constructor();
}

// --- Questions about two bodies

export interface Settings {
  /** The accuracy of contacts: a contact is reported at a distance of at most margin + tolerance. The default is 0.001. */
  tolerance?: number;
  /**
   * The largest amount of work of a question, a whole number or infinity. A million takes about a second. Along a
   * `PosePath` the budget is for each segment between two poses. In a cell it is for each query of two bodies, and a
   * question takes at most 8 budgets for each segment of the path.
   */
  budget?: number;
}

export interface ContactSettings extends Settings {
  /** The distance at which bodies count as touching; 0 by default. */
  margin?: number;
}

export interface Movements {
  /** The movement of `a`. Without it, `a` is static at the world's origin. */
  motionA?: Movement | MotionNumbers;
  /** The movement of `b`. Without it, `b` is static at the world's origin. */
  motionB?: Movement | MotionNumbers;
}

export interface Moving extends Movements {
  /**
   * The end of the question, which starts at time 0. The default is the end of the movements, or 1 if neither has an end.
   * It is required if the movements end at different times.
   */
  duration?: number;
}

/** A vertex, an edge, a face or a piece of a body. Indices refer to its mesh, from 0. */
export type Feature = `v${number}` | `e${number}-${number}` | `f${number}` | `p${number}`;

/** The bodies stay apart. */
export interface Free {
  kind: "free";
  /** The duration of the question. Nothing touches until then. */
  safeUntil: number;
  /** A proven lower bound of the distance: margin + half the tolerance. The bodies may be farther apart. */
  provenGap: number;
  tolerance: number;
}

interface Touch {
  /** The time of the contact. Nothing touches before a first contact. */
  time: number;
  /** The point of `a` nearest to `b`, in world coordinates at that time. */
  witnessA: Vector;
  witnessB: Vector;
  /** The unit normal from `a` to `b`. */
  normal: Vector;
  /** Bounds of the distance at that time. */
  distance: readonly [lower: number, upper: number];
  featureA: Feature;
  featureB: Feature;
  /**
   * The largest distance beyond the margin at which a contact is reported. It is the tolerance of the options, or larger
   * if rounding requires it.
   */
  tolerance: number;
}

/** The bodies come within margin + tolerance. */
export interface Contact extends Touch {
  kind: "contact";
}

/** The bodies are within margin + tolerance at the start. */
export interface Touching extends Touch {
  kind: "touching";
}

/** The bodies overlap. If only a point inside both bodies is known, the normal, the distance and the features are null. */
export interface Overlapping extends Pick<Touch, "time" | "witnessA" | "witnessB" | "tolerance"> {
  kind: "overlapping";
  normal: Vector | null;
  distance: readonly [lower: number, upper: number] | null;
  featureA: Feature | null;
  featureB: Feature | null;
}

/** The first and the last contact. The bodies do not touch before the first or after the last one. They may separate in between. */
export interface Interval {
  kind: "interval";
  first: Contact | Touching | Overlapping;
  last: Contact | Touching | Overlapping;
  tolerance: number;
}

/** The nearest points of two bodies among all measured times. */
export type Nearest = Pick<Touch, "time" | "witnessA" | "witnessB" | "normal" | "featureA" | "featureB">;

/**
 * Bounds of the least distance: it is at least `lower`, and at `time` it is at most `upper`. `upper` includes the
 * excess of bodies over their shapes.
 */
export interface LeastDistance extends Nearest {
  kind: "leastDistance";
  lower: number;
  upper: number;
  tolerance: number;
}

export interface Limit {
  limit: "budget" | "stalled" | "undecided" | "oracle gave up" | (string & {});
  /** What the caller can do to avoid the limit. */
  advice: string;
}

/** A limit was reached before the answer was known. The times and bounds are proven. */
export interface Unresolved extends Limit {
  kind: "unresolved";
  /** No contact happens before this time; 0 for questions about a distance. */
  safeUntil: number;
  /** No contact happens after this time; null unless the question is about the last contact. */
  safeFrom: number | null;
  /** Bounds of the requested distance. They are 0 and infinity if none are known. */
  lower: number;
  upper: number;
  /** The nearest points at the smallest distance that was measured, or null. */
  nearest: Nearest | null;
  tolerance: number;
}

/** When do two bodies first touch? */
export function firstContact(a: Body, b: Body, options?: Moving & ContactSettings): Free | Contact | Touching | Overlapping | Unresolved;
/** Do two bodies touch at all? The contact may not be the first one. */
export function anyContact(a: Body, b: Body, options?: Moving & ContactSettings): Free | Contact | Touching | Overlapping | Unresolved;
/** Do two bodies always stay farther apart than the margin? Throws an `UnresolvedError` if a limit is reached. */
export function isFree(a: Body, b: Body, options?: Moving & ContactSettings): boolean;
/** When do two bodies first touch, and when last? */
export function contactInterval(a: Body, b: Body, options?: Moving & ContactSettings): Free | Interval | Unresolved;
/** How near do two bodies come, to within the tolerance? There is no option `margin`. */
export function closestApproach(a: Body, b: Body, options?: Moving & Settings): LeastDistance | Overlapping | Unresolved;
/** How far apart are two bodies at time 0? */
export function distance(a: Body, b: Body, options?: Movements & Settings): LeastDistance | Overlapping | Unresolved;
/**
 * Are two bodies always at least `clearance` apart? Throws an `UnresolvedError` if the bounds of the distance do not
 * decide, for instance because the distance equals the clearance.
 */
export function keepsClearance(a: Body, b: Body, clearance: number, options?: Moving & Settings): boolean;

/** A yes-or-no question was not decided. Questions about contacts set `safeUntil`, and `keepsClearance` sets the bounds. */
export class UnresolvedError extends Error implements Limit {
  private constructor();
  limit: Limit["limit"] | "excess" | "tolerance";
  advice: string;
  safeUntil?: number;
  lower?: number;
  upper?: number;
}

// --- Robots and mechanisms

interface JointBetween {
  /** The name of the joint, unique in the robot. */
  name: string;
  /** The link that carries the joint. */
  parent: string;
  /** The link that the joint moves. */
  child: string;
  /** The pose of the joint in the frame of the parent. */
  origin?: GivenPose;
}

export interface FixedJoint extends JointBetween {
  type: "fixed";
}

/** A joint with a position: an angle for a revolute joint, and a length for a prismatic joint. */
export interface MovingJoint extends JointBetween {
  /** For a continuous joint of URDF, use a revolute joint without limits. */
  type: "revolute" | "prismatic";
  /** The axis in the joint's frame. It need not be normalised. The default is z. */
  axis?: GivenVector;
  /** The least and the greatest position. There are no limits by default. */
  limits?: readonly [low: number, high: number];
  /**
   * The joint that this joint follows. The position of this joint is `multiplier` times the position of the other,
   * plus `offset`. The defaults are 1 and 0.
   */
  mimic?: { joint: string; multiplier?: number; offset?: number };
}

export type Joint = FixedJoint | MovingJoint;

export interface RobotParts {
  /** The joints, in the order of positions in configurations. */
  joints?: readonly Joint[];
  /** The bodies that are fixed to each link. */
  bodies?: { readonly [link: string]: Body | readonly { body: Body; pose?: GivenPose }[] };
  /** Pairs of links that are not checked. Links that are connected by a joint are never checked. */
  mayTouch?: readonly (readonly [string, string])[];
}

/** A remark about a probable mistake, or about something that is not checked. It changes no answer. */
export interface Remark {
  /** A warning is about a probable mistake, or about a robot that is mostly not checked. */
  kind: "remark" | "warning";
  text: string;
}

/** One position for each of `jointNames`, in that order. */
export type Configuration = ArrayLike<number>;

/** A robot or a mechanism: a tree of links and joints, and the pairs of links that are checked. */
export class Robot extends Owned {
  constructor(parts: RobotParts);
  /** The names of the independent joints: all except fixed joints and joints that follow another one. */
  readonly jointNames: string[];
  readonly linkNames: string[];
  readonly limits: [low: number, high: number][];
  /** The pairs of links that are checked. A cell copies the list, and `Cell.setClearance` may add pairs to the copy. */
  readonly checkedPairs: [string, string][];
  /** Remarks on probable mistakes, then on what is not checked: links without bodies, and pairs of links by reason. */
  readonly remarks: Remark[];
  /** Returns the pose of a link in the frame of the base. */
  pose(link: string, configuration: Configuration): Pose;
  /** Returns the motion of a link in the frame of the base, or of the link `seenFrom`. The duration is 1 by default. */
  linkTrajectory(link: string, start: Configuration, end: Configuration, options?: { duration?: number; seenFrom?: string }): LinkTrajectory;
}

/** A pair of items of a cell, at a point of a path. Witness points are in the frame of the robot's base. */
export interface Pair {
  /** The index, from 0, of the segment between two configurations. */
  segment: number;
  /** The position within the segment, from 0 to 1. */
  fraction: number;
  /** The sum of `segment` and `fraction`: 1.5 is the middle of the second segment. */
  time: number;
  /** The name of the first item: a link, or an attached body. */
  a: string;
  /** The name of the second item: a link, an attached body or an obstacle. */
  b: string;
  witnessA: Vector;
  witnessB: Vector;
  distance: readonly [lower: number, upper: number];
  /** The feature of `a` at its witness point. Null for a convex body, and if one body is inside the other. */
  featureA: Feature | null;
  featureB: Feature | null;
}

/**
 * An answer about contacts on a path. If the path is free, `safeUntil` is its number of segments. A contact is within
 * margin + tolerance. The tolerance is the one in the options, or larger if rounding of positions requires it.
 */
export type PathContact = { kind: "free"; safeUntil: number } | ({ kind: "contact"; tolerance: number } & Pair) | ({ kind: "unresolved"; safeUntil: number } & Limit);

/** Bounds of the least distance on a path, to within the tolerance, and the nearest pair found. */
export type PathDistance = { lower: number; upper: number; tolerance: number; nearest: Pair | null } & ({ kind: "leastDistance" } | ({ kind: "unresolved" } & Limit));

/**
 * A range of a path. "kept": all pairs keep their required distance everywhere in it. "violated": everywhere in it
 * some pair is nearer. "unverified": neither is proven.
 */
export interface PathRange {
  start: number;
  end: number;
  clearance: "kept" | "violated" | "unverified";
}

export interface PathSettings extends ContactSettings {
  /** With "leave", pairs in contact at the start may separate or slide, but not come nearer. The default is "report". */
  start?: "report" | "leave";
}

/**
 * A cell (planning scene): a robot among obstacles that are static in the frame of its base. A path is a list of
 * configurations. Between them joints move at constant rates.
 */
export class Cell extends Owned {
  constructor(robot: Robot);
  /** Adds an obstacle at a pose in the frame of the robot's base. */
  addObstacle(name: string, body: Body, pose?: GivenPose): void;
  moveObstacle(name: string, pose: GivenPose): void;
  removeObstacle(name: string): void;
  /**
   * Attaches a body to a link, at a pose in the link's frame. The body may touch that link, and the items named in
   * `mayTouch`: links, attached bodies and obstacles.
   */
  attach(name: string, body: Body, link: string, options?: { pose?: GivenPose; mayTouch?: readonly string[] }): void;
  detach(name: string): void;
  /**
   * Allows two items to touch, even if they have a clearance. An item is a link, an attached body or an obstacle. The
   * permission lasts until one of them is removed, or until `forbidContact` or `setClearance` is called for them.
   */
  allowContact(a: string, b: string): void;
  /** Revokes the permission of two items to touch. For two links that are not checked, adds them to the checked pairs. */
  forbidContact(a: string, b: string): void;
  /** The remarks on the robot, on obstacles and attached bodies of an improbable size, and on allowed contacts. */
  readonly remarks: Remark[];
  /** Sets the padding of a link: a distance that obstacles must keep from it, in addition to the margin. */
  setPadding(link: string, distance: number): void;
  /** The pairs of links that are checked: the pairs of the robot, and pairs that `setClearance` added. */
  readonly checkedPairs: [string, string][];
  /**
   * Sets the distance at which a pair counts as touching. The pair is checked from then on, even if it was not
   * checked or was allowed to touch.
   */
  setClearance(a: string, b: string, distance: number): void;
  /** What touches first on a path? Nothing touches before the answer's time. All questions throw an `Error` if the cell has no pair to check. */
  firstContact(path: ArrayLike<Configuration>, options?: PathSettings): PathContact;
  /** Is a path free of contact? Throws an `UnresolvedError` if a limit is reached. */
  isFree(path: ArrayLike<Configuration>, options?: PathSettings): boolean;
  /** How near does any pair come on a path? There is no option `margin`. */
  closestApproach(path: ArrayLike<Configuration>, options?: Settings): PathDistance;
  /**
   * Where on a path do all pairs keep the margin, or the clearance that is set for the pair?
   *
   * `resolution` is the length of the shortest ranges that are examined, in segments: 1/4096 by default.
   * `maxPoseError` is an upper bound of the distance between a point of a link and its position on the path. Use it for a
   * closed loop of joints, because the path is inexact between its configurations.
   */
  clearanceRanges(path: ArrayLike<Configuration>, options?: ContactSettings & { resolution?: number; maxPoseError?: number }): PathRange[];
}
