// The exports of the package.

import { Body, readMesh } from "./body.js";
import { Cell } from "./cell.js";
import { LinkMotion, Motion, Movement, Path, Throw } from "./movement.js";
import { Robot } from "./robot.js";
import { anyContact, closestApproach, contactInterval, distance, firstContact, isFree, keepsClearance, UnresolvedError } from "./solver.js";
import { EngineError, init, memoryUsage } from "./wasm.js";

export {
  anyContact,
  Body,
  Cell,
  closestApproach,
  contactInterval,
  distance,
  EngineError,
  firstContact,
  init,
  isFree,
  keepsClearance,
  LinkMotion,
  memoryUsage,
  Motion,
  Movement,
  Path,
  readMesh,
  Robot,
  Throw,
  UnresolvedError,
};
