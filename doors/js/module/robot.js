// Robots and mechanisms: links, joints, and the bodies fixed to links.

import { Body, bodyOf } from "./body.js";
import { LinkTrajectory } from "./movement.js";
import { choiceOf, fieldsOf, finiteNumber, isPlain, listOf, listOfNumbers, nameOf, numberOrInfinity, optionsOf, settingNumber, tupleOf } from "./numbers.js";
import { Owned } from "./owned.js";
import { IDENTITY, poseNumbers, poseOfNumbers, vectorNumbers } from "./places.js";
import { classes } from "./wasm.js";
import { described, quoted } from "./words.js";

const jointType = choiceOf(["revolute", "prismatic", "fixed"], { continuous: "a continuous joint is a revolute one without limits" });
/** The fields of every joint. */
const FIXED_FIELDS = { type: [jointType], name: [nameOf], parent: [nameOf], child: [nameOf], origin: [poseNumbers, IDENTITY] };
/** The fields of a joint with a position. */
const MOVING_FIELDS = { ...FIXED_FIELDS, axis: [vectorNumbers, [0, 0, 1]], limits: [limitsOf, [-Infinity, Infinity]], mimic: [mimicOf, undefined] };

export class Robot extends Owned {
  get [Symbol.toStringTag]() {
    return "Robot";
  }

  constructor(parts) {
    super(build(parts));
  }

  get jointNames() {
    return Owned.inner(this).joint_names();
  }

  get linkNames() {
    return Owned.inner(this).link_names();
  }

  get limits() {
    return pairsOf([...Owned.inner(this).limits()]);
  }

  get checkedPairs() {
    return pairsOf(Owned.inner(this).checked_pairs());
  }

  get remarks() {
    return remarksOf(Owned.inner(this).remarks());
  }

  pose(link, configuration) {
    return poseOfNumbers(Owned.inner(this).pose(nameOf(link, "link"), configurationOf(configuration, "configuration", this.jointNames)));
  }

  linkTrajectory(link, start, end, options) {
    const { duration, seenFrom } = optionsOf(options, "Robot.linkTrajectory", { duration: [settingNumber, 1], seenFrom: [nameOf, undefined] });
    const names = this.jointNames;
    const [from, to] = [configurationOf(start, "start", names), configurationOf(end, "end", names)];
    return new LinkTrajectory(Owned.inner(this).link_trajectory(nameOf(link, "link"), seenFrom, from, to, duration));
  }
}

/** Reads a configuration: one position for each of the joints in `names`. */
export function configurationOf(value, argumentName, names) {
  const configuration = listOfNumbers(value, argumentName);
  if (configuration.length !== names.length) throw new TypeError(`${argumentName}: ${configuration.length} positions, but ${names.length} joints: ${names.join(", ")}`);
  return configuration;
}

function build(parts) {
  const { joints, bodies, mayTouch } = fieldsOf(parts, "a robot", { joints: [jointsOf, []], bodies: [bodiesOf, []], mayTouch: [pairsOfNames, []] });
  const builder = new (classes().RobotBuilder)();
  for (const joint of joints) addJoint(builder, joint);
  for (const { link, body, pose } of bodies) builder.add_body(link, body, pose);
  for (const [a, b] of mayTouch) builder.may_touch(a, b);
  return builder.build();
}

function addJoint(builder, { type, name, parent, child, origin, axis = [0, 0, 1], limits = [-Infinity, Infinity], mimic }) {
  builder.add_joint(type, name, parent, child, new Float64Array([...origin, ...axis, ...limits]));
  if (mimic !== undefined) builder.follow(mimic.joint, mimic.multiplier, mimic.offset);
}

function jointsOf(value, argumentName) {
  return listOf(value, argumentName, (joint, elementName) => {
    const name = typeof joint === "object" && typeof joint?.name === "string" ? `joint ${quoted(joint.name)}` : elementName;
    return fieldsOf(joint, name, joint?.type === "fixed" ? FIXED_FIELDS : MOVING_FIELDS, `${name}: `);
  });
}

function limitsOf(value, argumentName) {
  return tupleOf(value, argumentName, 2, numberOrInfinity);
}

function mimicOf(value, argumentName) {
  return fieldsOf(value, argumentName, { joint: [nameOf], multiplier: [finiteNumber, 1], offset: [finiteNumber, 0] }, `${argumentName}.`);
}

/** Reads the bodies of all links. Each link has one body, or a list of bodies at poses. */
function bodiesOf(value, argumentName) {
  if (!isPlain(value)) throw new TypeError(`${argumentName}: an object with a body for each link is needed, not ${described(value)}`);
  return Object.entries(value).flatMap(([link, bodies]) => {
    const linkName = `${argumentName}[${quoted(nameOf(link, argumentName))}]`;
    if (bodies instanceof Body || typeof bodies?.length !== "number") return [{ link, body: bodyOf(bodies, linkName), pose: IDENTITY }];
    return listOf(bodies, linkName, (body, bodyName) => ({ link, ...fieldsOf(body, bodyName, { body: [bodyOf], pose: [poseNumbers, IDENTITY] }, `${bodyName}.`) }));
  });
}

function pairsOfNames(value, argumentName) {
  return listOf(value, argumentName, (pair, pairName) => tupleOf(pair, pairName, 2, nameOf));
}

export function pairsOf(list) {
  return Array.from({ length: list.length / 2 }, (_, k) => [list[2 * k], list[2 * k + 1]]);
}

/** Returns remarks from a list of alternating kinds and texts. */
export function remarksOf(list) {
  return pairsOf(list).map(([kind, text]) => ({ kind, text }));
}
