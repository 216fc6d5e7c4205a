// Robots and mechanisms: links, joints, and the bodies that are fixed to links.

import { Body } from "./body.js";
import { LinkMotion } from "./movement.js";
import { checkNames, finiteNumber, listOfNumbers, nameOf, numberOrInfinity, poseNumbers, poseOfNumbers, settingNumber, vectorNumbers } from "./numbers.js";
import { described, innerOf, Owned, quoted } from "./owned.js";
import { classes } from "./wasm.js";

const JOINT_NAMES = ["type", "name", "parent", "child", "origin", "axis", "limits", "mimic"];

export class Robot extends Owned {
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

  pose(link, configuration) {
    return poseOfNumbers(Owned.inner(this).pose(nameOf(link, "link"), listOfNumbers(configuration, "configuration")));
  }

  motion(link, start, end, options) {
    checkNames(options, "options of Robot.motion", ["duration", "seenFrom"]);
    const duration = settingNumber(options?.duration ?? 1, "duration");
    const seenFrom = options?.seenFrom === undefined ? undefined : nameOf(options.seenFrom, "seenFrom");
    const [from, to] = [listOfNumbers(start, "start"), listOfNumbers(end, "end")];
    return new LinkMotion(Owned.inner(this).motion(nameOf(link, "link"), seenFrom, from, to, duration));
  }
}

function build(parts) {
  checkNames(parts, "a robot", ["joints", "bodies", "mayTouch"]);
  const builder = new (classes().RobotBuilder)();
  for (const joint of parts?.joints ?? []) addJoint(builder, joint);
  for (const [link, held] of Object.entries(parts?.bodies ?? {})) {
    for (const { body, pose } of Array.isArray(held) ? held : [{ body: held }]) {
      const what = `bodies[${quoted(link)}]`;
      builder.add_body(link, innerOf(body, Body, what), poseNumbers(pose, `pose of ${what}`));
    }
  }
  for (const [one, other] of parts?.mayTouch ?? []) builder.may_touch(nameOf(one, "mayTouch"), nameOf(other, "mayTouch"));
  return builder.build();
}

function addJoint(builder, joint) {
  const what = `joint ${described(joint?.name)}`;
  checkNames(joint, what, JOINT_NAMES);
  for (const name of ["type", "name", "parent", "child"]) {
    nameOf(joint[name], `${what}: ${name}`);
  }
  const [low, high] = joint.limits ?? [-Infinity, Infinity];
  const numbers = new Float64Array([
    ...poseNumbers(joint.origin, `origin of ${what}`),
    ...vectorNumbers(joint.axis ?? [0, 0, 1], `axis of ${what}`),
    numberOrInfinity(low, `limits of ${what}`),
    numberOrInfinity(high, `limits of ${what}`),
  ]);
  builder.add_joint(joint.type, joint.name, joint.parent, joint.child, numbers);
  if (joint.mimic !== undefined) {
    checkNames(joint.mimic, `mimic of ${what}`, ["joint", "multiplier", "offset"]);
    const { joint: followed, multiplier = 1, offset = 0 } = joint.mimic;
    builder.follow(nameOf(followed, `mimic of ${what}: joint`), finiteNumber(multiplier, `multiplier of ${what}`), finiteNumber(offset, `offset of ${what}`));
  }
}

export function pairsOf(list) {
  return Array.from({ length: list.length / 2 }, (_, k) => [list[2 * k], list[2 * k + 1]]);
}
