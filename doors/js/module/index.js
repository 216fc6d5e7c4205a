// The exports of the package.

import { Body, readMesh } from "./body.js";
import { Cell } from "./cell.js";
import { LinkTrajectory, Motion, Movement, PosePath, Ballistic } from "./movement.js";
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
  LinkTrajectory,
  memoryUsage,
  Motion,
  Movement,
  PosePath,
  readMesh,
  Robot,
  Ballistic,
  UnresolvedError,
};
