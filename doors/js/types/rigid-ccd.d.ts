/**
 * Certified continuous collision detection: when do two moving rigid bodies first touch?
 *
 * No answer is ever late, in floating point too. Lengths are in any one unit, angles in radians, times in the motions' unit.
 */

/**
 * Loads the WebAssembly. It comes before everything else, and again costs nothing.
 *
 * Where the engine has no vector instructions for WebAssembly, or `simd` is false, it fetches `fallback.js`, which lies beside the
 * module. Its answers are the same, to the bit, and take longer. With `simd: true` it rejects instead.
 */
export function init(options?: { simd?: boolean }): Promise<{ simd: boolean }>;

/**
 * The engine has ended: its memory is at its end, of 4 GB at most, or it has a fault. All bodies, movements, robots and cells are lost,
 * and each use of one throws this error. Another `init` loads the engine anew.
 */
export class EngineError extends Error {
  private constructor();
  reason: "memory" | "fault";
}

/** Returns how many bytes of memory the WebAssembly has. It grows, and never shrinks. */
export function memoryUsage(): number;

// --- Vectors, poses and bodies

export type Vector = readonly [number, number, number];
/** In the order of three.js. The Python package has w first. */
export type Quaternion = readonly [x: number, y: number, z: number, w: number];
/** A list, or an object such as a `Vector3` of three.js. */
export type GivenVector = ArrayLike<number> | { readonly x: number; readonly y: number; readonly z: number };
/** Of any length but 0; a list, or an object such as a `Quaternion` of three.js. */
export type GivenQuaternion = ArrayLike<number> | { readonly x: number; readonly y: number; readonly z: number; readonly w: number };

export interface Pose {
  position: Vector;
  rotation: Quaternion;
}

/** A pose; what is left out is the origin, and no rotation. */
export interface GivenPose {
  position?: GivenVector;
  rotation?: GivenQuaternion;
}

declare global {
  /** Of ES2026, as TypeScript's `esnext.disposable` and the types of Node declare it: older libraries have none. */
  interface SymbolConstructor {
    readonly dispose: unique symbol;
  }
  interface Disposable {
    [Symbol.dispose](): void;
  }
}

/** Something in the memory of the WebAssembly. It ends with `free`, with a block that has it by `using`, or when it is collected as garbage. */
declare abstract class Owned {
  free(): void;
  [Symbol.dispose](): void;
}

export interface BodyOptions {
  /**
   * The convex pieces to make: the fewest that are exact by default. A `"hull"` is that of a closed convex mesh, and exact. An
   * `"outer-hull"` encloses any mesh, open ones too; `excess` says by how much.
   */
  pieces?: "auto" | "triangles" | "patches" | "hull" | "outer-hull";
  /** Whether a closed mesh is a hollow surface, too. An open one is a surface anyway, and is not remarked upon with it. */
  surface?: boolean;
}

export interface FileOptions {
  /** A factor on all coordinates; 1 by default. */
  scale?: number;
  /**
   * The unit to convert coordinates to, before `scale`. A COLLADA states its unit, and a glTF is in metres; the numbers of other files are
   * taken to be in the unit. Without it coordinates are those of the file, and a unit that is not the metre is a line in the console.
   */
  unit?: "um" | "mm" | "cm" | "m" | "in" | "ft";
}

/**
 * A rigid body: a mesh, a box, a ball, a capsule, a cylinder or a cone.
 *
 * A mesh is a solid when it is closed and consistently oriented. Otherwise it is a surface. A closed shell inside another one bounds a
 * cavity, however it is turned. A body inside a solid overlaps it; a body
 * inside a surface does not. A mesh that is not closed is a line in the console, unless it is to be a `surface`.
 */
export class Body extends Owned {
  private constructor();
  /**
   * Makes a body of a mesh in memory, such as the attribute `position` and the index of a `BufferGeometry` of three.js.
   *
   * Without indices each three vertices are a triangle. Vertices at exactly the same point are one; the README says what closes seams
   * of three.js. Positions are a Float32Array, a Float64Array or an array. An error names the first vertex or triangle that is not valid.
   */
  static fromMesh(positions: ArrayLike<number>, indices?: ArrayLike<number> | null, options?: BodyOptions): Body;
  /**
   * Reads an STL, OBJ, PLY, OFF, COLLADA or glTF; the end of the name tells which. A glTF is a `.glb`, or a `.gltf` that holds its data:
   * other files cannot be fetched.
   */
  static fromFile(name: string, bytes: Uint8Array | ArrayBuffer, options?: BodyOptions & FileOptions): Body;
  /** Makes a box about its origin. */
  static box(halfExtents: GivenVector): Body;
  /** Makes a ball about its origin. */
  static sphere(radius: number): Body;
  /** Makes a capsule along z; `halfHeight` is the distance from its middle to the centre of either cap. */
  static capsule(radius: number, halfHeight: number): Body;
  /** Makes a cylinder along z, as a polytope around it that exceeds it by at most `excess`: by default 1/4096 of the radius. */
  static cylinder(radius: number, halfHeight: number, excess?: number): Body;
  /** Makes a cone along z with its apex up, as a polytope around it, like `cylinder`. */
  static cone(radius: number, halfHeight: number, excess?: number): Body;
  /** Whether the body fills its inside, so that another body inside it overlaps it. */
  readonly isSolid: boolean;
  /** The number of convex pieces. */
  readonly pieces: number;
  /** The shape and its lengths in words, or the pieces made of the mesh, with remarks about it. */
  readonly report: string;
  /** How far the body may exceed its shape. Contacts may be early because of it, never late. 0 for exact bodies. */
  readonly excess: number;
}

/**
 * Reads the triangles of a file that `Body.fromFile` reads, to be drawn, or changed before they become a body. `unit` is that of the
 * positions: the one asked for, or the one that the file states; null if neither is known, or with a `scale`.
 */
export function readMesh(
  name: string,
  bytes: Uint8Array | ArrayBuffer,
  options?: FileOptions,
): { positions: Float64Array; indices: Uint32Array; unit: FileOptions["unit"] | null };

// --- What moves a body

/** A pose at time 0, the constant velocity of a center, and a constant angular velocity about it. What is left out is 0. */
export interface MotionNumbers extends GivenPose {
  /** Of the center, per unit of time. */
  velocity?: GivenVector;
  /** The angular velocity about the world's axes, in radians per unit of time. */
  spin?: GivenVector;
  /** The center of rotation in the body's frame; its origin by default. */
  center?: GivenVector;
}

/** What moves a body. */
export abstract class Movement extends Owned {
  /** When the movement ends, of a path, a link's motion and `Motion.between`: there a question about it ends, too. Null if it goes on. */
  readonly end: number | null;
  pose(time: number): Pose;
}

/** A motion at constant velocities. Questions take its numbers as well, which need no `free`. */
export class Motion extends Movement {
  constructor(motion?: MotionNumbers);
  /**
   * Makes the motion between two poses: the center moves straight, and the body turns the shortest way. The duration is 1 by default, and
   * questions end there. One that is asked for longer goes on at the same velocities.
   */
  static between(start: GivenPose, end: GivenPose, options?: { duration?: number; center?: GivenVector }): Motion;
}

/** A body that is thrown: its center has a constant acceleration, and it turns at a constant rate. */
export class Throw extends Movement {
  constructor(motion: MotionNumbers & { acceleration: GivenVector });
}

/**
 * A path through poses at times that increase. Between two of them the center moves straight, and the body turns the shortest way; it
 * rests before the first and after the last.
 *
 * `spins` are angular velocities from each pose to the next, for more than half a turn. What one leaves over, a quarter turn at most, is
 * turned beside it.
 */
export class Path extends Movement {
  constructor(times: ArrayLike<number>, poses: readonly GivenPose[], options?: { center?: GivenVector; spins?: readonly GivenVector[] });
}

/** The motion of a robot's link while all joints move at constant rates; `Robot.motion` makes it. */
export class LinkMotion extends Movement {
  private constructor();
}

// --- Questions about two bodies

export interface Settings {
  /** A contact is reported at a distance of at most margin + tolerance; 0.001 by default. */
  tolerance?: number;
  /** The work after which a question is given up, a whole number or infinity; a million takes about a second. For a path it is that between two poses; in a cell that of two bodies, and a question takes at most 8 budgets for each segment of the path. */
  budget?: number;
}

export interface ContactSettings extends Settings {
  /** A distance to keep; 0 by default. */
  margin?: number;
}

export interface Movements {
  /** What moves `a`; without it `a` rests at the world's origin. */
  motionA?: Movement | MotionNumbers;
  /** What moves `b`. */
  motionB?: Movement | MotionNumbers;
}

export interface Moving extends Movements {
  /** The end of the question, which starts at time 0. By default the end of what moves the bodies, else 1. Two that end at different times need it. */
  duration?: number;
}

/** A vertex, an edge, a face or a piece, numbered from 0 as in the body's mesh. */
export type Feature = `v${number}` | `e${number}-${number}` | `f${number}` | `p${number}`;

/** The bodies stay apart. */
export interface Free {
  kind: "free";
  /** Nothing touches until this time: the duration. */
  safeUntil: number;
  /** They are never nearer than this: the margin and half the tolerance, even if they are farther apart. */
  provenGap: number;
  tolerance: number;
}

interface Touch {
  /** Nothing touches before a first contact. */
  time: number;
  /** The point of `a` nearest to `b`, in the world at that time. */
  witnessA: Vector;
  witnessB: Vector;
  /** The unit vector from `a` to `b`. */
  normal: Vector;
  /** Bounds of the distance at that time. */
  distance: readonly [lower: number, upper: number];
  featureA: Feature;
  featureB: Feature;
  /** The distance beyond the margin within which a contact is reported: the given one, or more if only that can be certified. */
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

/** The bodies overlap. What a point inside both does not tell is null. */
export interface Overlapping extends Pick<Touch, "time" | "witnessA" | "witnessB" | "tolerance"> {
  kind: "overlapping";
  normal: Vector | null;
  distance: readonly [lower: number, upper: number] | null;
  featureA: Feature | null;
  featureB: Feature | null;
}

/** The first and the last contact. The bodies may part in between; they do not touch before the first or after the last. */
export interface Interval {
  kind: "interval";
  first: Contact | Touching | Overlapping;
  last: Contact | Touching | Overlapping;
  tolerance: number;
}

/** Where two bodies are nearest, as far as was measured. */
export type Nearest = Pick<Touch, "time" | "witnessA" | "witnessB" | "normal" | "featureA" | "featureB">;

/** Bounds of the least distance: never less than `lower`, and at `time` at most `upper`. What bodies exceed their shapes by is in `upper`. */
export interface LeastDistance extends Nearest {
  kind: "leastDistance";
  lower: number;
  upper: number;
  tolerance: number;
}

export interface Limit {
  limit: "budget" | "stalled" | "undecided" | "oracle gave up" | (string & {});
  /** What can be done about it. */
  advice: string;
}

/** A limit was reached before the answer was known. All that is told is proven. */
export interface Unresolved extends Limit {
  kind: "unresolved";
  /** No contact happens before this time; 0 for questions about a distance. */
  safeUntil: number;
  /** No contact happens after this time; null unless the question is about the last contact. */
  safeFrom: number | null;
  /** Bounds of the distance asked for; 0 and infinity if none are known. */
  lower: number;
  upper: number;
  /** The smallest distance that was measured. */
  nearest: Nearest | null;
  tolerance: number;
}

/** When do they first touch? */
export function firstContact(a: Body, b: Body, options?: Moving & ContactSettings): Free | Contact | Touching | Overlapping | Unresolved;
/** Do they touch at all? The contact may not be the first. */
export function anyContact(a: Body, b: Body, options?: Moving & ContactSettings): Free | Contact | Touching | Overlapping | Unresolved;
/** Do they stay apart by more than the margin? Throws an `UnresolvedError` if a limit is reached. */
export function isFree(a: Body, b: Body, options?: Moving & ContactSettings): boolean;
/** When do they first touch, and when last? */
export function contactInterval(a: Body, b: Body, options?: Moving & ContactSettings): Free | Interval | Unresolved;
/** How near do they come, to within the tolerance? It has no margin. */
export function closestApproach(a: Body, b: Body, options?: Moving & Settings): LeastDistance | Overlapping | Unresolved;
/** How far apart are they at time 0? */
export function distance(a: Body, b: Body, options?: Movements & Settings): LeastDistance | Overlapping | Unresolved;
/** Are they at least `clearance` apart all the time? Throws an `UnresolvedError` if the bounds do not tell, as for a distance that is the clearance exactly. */
export function keepsClearance(a: Body, b: Body, clearance: number, options?: Moving & Settings): boolean;

/** A question that wants yes or no was not decided. Which bounds are proven depends on the question. */
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
  /** No other joint of the robot has this name. */
  name: string;
  /** The link that holds the joint, and the link that it moves. */
  parent: string;
  child: string;
  /** The pose of the joint in the frame of the parent. */
  origin?: GivenPose;
}

export interface FixedJoint extends JointBetween {
  type: "fixed";
}

/** A joint with a position: an angle, or a length for one that slides. */
export interface MovingJoint extends JointBetween {
  /** A continuous joint of URDF is a revolute one without limits. */
  type: "revolute" | "prismatic";
  /** In the joint's frame, of any length; z by default. */
  axis?: GivenVector;
  /** The least and the greatest position; any by default. */
  limits?: readonly [low: number, high: number];
  /** The joint that this one follows: its position is `multiplier` times that, which is 1 by default, plus `offset`. */
  mimic?: { joint: string; multiplier?: number; offset?: number };
}

export type Joint = FixedJoint | MovingJoint;

export interface RobotParts {
  /** In the order in which configurations have positions. */
  joints?: readonly Joint[];
  /** What is fixed to each link. */
  bodies?: { readonly [link: string]: Body | readonly { body: Body; pose?: GivenPose }[] };
  /** Pairs of links that are not checked, besides neighbours. */
  mayTouch?: readonly (readonly [string, string])[];
}

/** What is probably a mistake, or what is not checked. It changes no answer. */
export interface Remark {
  /** A warning tells what is probably a mistake, or that most of a robot is not checked. */
  kind: "remark" | "warning";
  text: string;
}

/** One position for each of `jointNames`, in that order. */
export type Configuration = ArrayLike<number>;

/** A robot or a mechanism: a tree of links and joints, and the pairs of links that are checked. */
export class Robot extends Owned {
  constructor(parts: RobotParts);
  /** The names of the joints that have a position of their own. */
  readonly jointNames: string[];
  readonly linkNames: string[];
  readonly limits: [low: number, high: number][];
  /** The pairs of links that are checked. A cell has a list of its own, to which `Cell.setClearance` may add. */
  readonly checkedPairs: [string, string][];
  /** What is probably a mistake, then what is not checked: links without bodies, and pairs of links by reason. */
  readonly remarks: Remark[];
  /** Returns the pose of a link in the frame of the base. */
  pose(link: string, configuration: Configuration): Pose;
  /** Returns the motion of a link in the frame of the base, or of the link `seenFrom`. The duration is 1 by default. */
  motion(link: string, start: Configuration, end: Configuration, options?: { duration?: number; seenFrom?: string }): LinkMotion;
}

/** A pair of a cell on a path. Witnesses are in the frame of the robot's base. */
export interface Pair {
  /** The segment between two configurations, from 0, and the share of it that is passed. */
  segment: number;
  share: number;
  /** Both together: 1.5 is the middle of the second segment. */
  time: number;
  /** A link, or a body that is attached to one. */
  a: string;
  /** Another one, or an obstacle. */
  b: string;
  witnessA: Vector;
  witnessB: Vector;
  distance: readonly [lower: number, upper: number];
  /** Null for a convex body, and if one body is inside the other. */
  featureA: Feature | null;
  featureB: Feature | null;
}

/**
 * A free path is safe until its end, which is the number of its segments. A contact is within margin + tolerance: that of the
 * options, unless the rounding of positions allows only a larger one.
 */
export type PathContact = { kind: "free"; safeUntil: number } | ({ kind: "contact"; tolerance: number } & Pair) | ({ kind: "unresolved"; safeUntil: number } & Limit);

/** Bounds of the least distance on a path, to within the tolerance, and the nearest pair that was measured. */
export type PathDistance = { lower: number; upper: number; tolerance: number; nearest: Pair | null } & ({ kind: "leastDistance" } | ({ kind: "unresolved" } & Limit));

/** Whether all pairs keep their distance everywhere in a range, or one is nearer everywhere in it, or neither is proven. */
export interface PathRange {
  start: number;
  end: number;
  clearance: "kept" | "violated" | "unverified";
}

export interface PathSettings extends ContactSettings {
  /** With "leave", pairs in contact at the start may part or slide, but not come nearer; "report" by default. */
  start?: "report" | "leave";
}

/** A robot among obstacles that rest in the frame of its base. A path is a list of configurations, between which joints move at constant rates. */
export class Cell extends Owned {
  constructor(robot: Robot);
  /** Adds an obstacle. */
  add(name: string, body: Body, pose?: GivenPose): void;
  moveTo(name: string, pose: GivenPose): void;
  remove(name: string): void;
  /** Attaches a body to a link, at a pose in its frame. It may touch that link, and the links, attached bodies and obstacles that are named. */
  attach(name: string, body: Body, link: string, options?: { pose?: GivenPose; mayTouch?: readonly string[] }): void;
  detach(name: string): void;
  /** Allows two items to touch, also if they have a clearance: two links, or a link, an attached body and an obstacle. What is removed takes this away, and so do `forbidContact` and `setClearance`. */
  allowContact(a: string, b: string): void;
  /** Compares two items again that were allowed to touch, or two links that were not checked. */
  forbidContact(a: string, b: string): void;
  /** The remarks on the robot, obstacles and attached bodies of an unlikely size, and which contacts are allowed. */
  readonly remarks: Remark[];
  /** Sets the distance that obstacles have to keep from a link, in addition to the margin. */
  setPadding(link: string, distance: number): void;
  /** The pairs of links that are checked: those of the robot, and those that `setClearance` has added. */
  readonly checkedPairs: [string, string][];
  /** Sets the distance at which a pair counts as touching. A pair of links that was not checked is checked from then on, and so is a pair that was allowed to touch. */
  setClearance(a: string, b: string, distance: number): void;
  /** What touches first on a path? Nothing touches before. A cell of which nothing is compared is an error for all questions. */
  firstContact(path: ArrayLike<Configuration>, options?: PathSettings): PathContact;
  /** Does nothing touch on a path? Throws an `UnresolvedError` if a limit is reached. */
  isFree(path: ArrayLike<Configuration>, options?: PathSettings): boolean;
  /** How near does anything come on a path? It has no margin. */
  closestApproach(path: ArrayLike<Configuration>, options?: Settings): PathDistance;
  /**
   * Where on a path do all pairs keep the margin, or the clearance that is set for them?
   *
   * `resolution` is the length of the shortest ranges that are examined, in segments: 1/4096 by default. `maxPoseError` is how far points
   * of links may be from where the path places them, as between the configurations of a closed loop of joints.
   */
  clearanceRanges(path: ArrayLike<Configuration>, options?: ContactSettings & { resolution?: number; maxPoseError?: number }): PathRange[];
}
