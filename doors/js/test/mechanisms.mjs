// Robots and mechanisms with exactly known answers.

export default (ccd, { equal, justBefore, between, throws }) => {
  const slider = { type: "prismatic", name: "slider", parent: "rail", child: "carriage", axis: [1, 0, 0], limits: [-10, 10] };
  /** A ball on a rail, at the distance 2 - x from a wall. */
  function beforeWall() {
    const robot = new ccd.Robot({ joints: [slider], bodies: { carriage: ccd.Body.sphere(0.5) } });
    const cell = new ccd.Cell(robot);
    cell.addObstacle("wall", ccd.Body.box([0.5, 2, 2]), { position: [3, 0, 0] });
    return { robot, cell };
  }
  /** A door leaf of 1 by 0.1 by 2 that turns about z. */
  function door() {
    const hinge = { type: "revolute", name: "hinge", parent: "frame", child: "leaf", limits: [0, 3] };
    const leaf = [{ body: ccd.Body.box([0.5, 0.05, 1]), pose: { position: [0.5, 0, 0] } }];
    return new ccd.Robot({ joints: [hinge], bodies: { leaf } });
  }
  return {
    "a mechanism of links and joints"() {
      const elbow = { type: "revolute", name: "elbow", parent: "carriage", child: "hand", origin: { position: [0, 0, 1] }, mimic: { joint: "slider", multiplier: 2 } };
      const tool = { type: "fixed", name: "flange", parent: "hand", child: "tool", origin: { position: [1, 0, 0] } };
      const held = [{ body: ccd.Body.sphere(0.1), pose: { position: [0, 1, 0] } }];
      const robot = new ccd.Robot({ joints: [slider, elbow, tool], bodies: { tool: held, rail: ccd.Body.box([1, 1, 0.1]) } });
      equal([robot.jointNames, robot.linkNames], [["slider"], ["rail", "carriage", "hand", "tool"]]);
      equal([robot.limits, robot.checkedPairs], [[[-10, 10]], [["rail", "tool"]]]);
      equal(new ccd.Robot({ joints: [slider, elbow, tool], bodies: { tool: held, rail: held[0].body }, mayTouch: [["rail", "tool"]] }).checkedPairs, []);
      const { position } = robot.pose("tool", [Math.PI / 4]);
      between(Math.hypot(position[0] - Math.PI / 4, position[1] - 1, position[2] - 1), 0, 1e-12);
    },
    "the first contact on a path, and what is free"() {
      const { cell } = beforeWall();
      equal([cell.isFree([[0], [1.9]]), cell.isFree([[0], [3]])], [true, false]);
      const hit = cell.firstContact([[0], [1], [3]], { tolerance: 1e-6 });
      equal([hit.kind, hit.segment, hit.a, hit.b], ["contact", 1, "carriage", "wall"]);
      justBefore(hit.fraction, 0.5, 1e-6);
      equal(hit.time, 1 + hit.fraction);
      between(hit.witnessA[0], 2.499, 2.501);
      cell.moveObstacle("wall", { position: [9, 0, 0] });
      equal(cell.firstContact([[0], [3], [0]]), { kind: "free", safeUntil: 2 });
      cell.attach("stick", ccd.Body.capsule(0.1, 2), "carriage", { pose: { position: [3, 0, 0] } });
      equal(cell.firstContact([[0], [6]]).a, "stick");
      cell.detach("stick");
      equal(cell.isFree([new Float64Array([0]), new Float64Array([6])]), true);
    },
    "a cell of which nothing is compared answers nothing"() {
      const { cell } = beforeWall();
      cell.removeObstacle("wall");
      throws(() => cell.isFree([[0], [9]]), /nothing is compared in this cell: 2 links, 1 without bodies.*0 obstacles/);
      throws(() => cell.closestApproach([[0], [9]]), /nothing is compared/);
      throws(() => cell.clearanceRanges([[0], [9]]), /nothing is compared/);
    },
    "what is not checked is remarked upon"() {
      const { robot, cell } = beforeWall();
      equal(robot.remarks, [{ kind: "remark", text: "1 link without bodies, compared with nothing: rail" }]);
      // A pair of links that is not checked may touch without permission.
      cell.allowContact("carriage", "rail");
      equal(cell.remarks, robot.remarks);
      cell.allowContact("carriage", "wall");
      equal(cell.remarks[1], { kind: "remark", text: "1 contact allowed: carriage and wall" });
      const joints = ["a", "b", "c"].map((name, k) => ({ type: "revolute", name: `to ${name}`, parent: k === 0 ? "base" : "_abc"[k], child: name, origin: { position: [1, 0, 0] } }));
      const bare = new ccd.Robot({ joints, bodies: { c: ccd.Body.sphere(0.1) } });
      equal(bare.remarks[0].kind, "warning");
      equal(bare.remarks[0].text.includes("2 of 3 moving links have no bodies: a, b"), true);
    },
    "what is probably a mistake is a warning, and what is usual is none"() {
      const { robot, cell } = beforeWall();
      const kinds = (one) => one.remarks.map(({ kind }) => kind);
      equal([kinds(robot), kinds(cell)], [["remark"], ["remark"]]);
      cell.addObstacle("desk", ccd.Body.box([1200, 800, 750]), { position: [9000, 0, 0] });
      equal(kinds(cell), ["warning", "remark"]);
      equal(cell.remarks[0].text.includes("desk is 2400 long, and the robot 1"), true);
      const joints = [{ type: "revolute", name: "hinge", parent: "frame", child: "leaf" }];
      const door = new ccd.Cell(new ccd.Robot({ joints, bodies: { leaf: ccd.Body.box([0.4, 0.02, 1]) } }));
      door.addObstacle("floor", ccd.Body.box([200, 200, 0.1]), { position: [0, 0, -3] });
      door.attach("handle", ccd.Body.capsule(0.01, 0.05), "leaf", { pose: { position: [0.3, 0.03, 0] } });
      equal(kinds(door), ["remark"]);
    },
    "a can is lifted from a table"() {
      const lift = { ...slider, axis: [0, 0, 1] };
      const cell = new ccd.Cell(new ccd.Robot({ joints: [lift], bodies: {} }));
      cell.addObstacle("table", ccd.Body.box([1, 1, 0.1]), { position: [0, 0, -0.1] });
      cell.addObstacle("shelf", ccd.Body.box([1, 1, 0.01]), { position: [0, 0, 0.923] });
      const can = () => cell.attach("can", ccd.Body.box([0.03, 0.03, 0.06]), "carriage", { pose: { position: [0, 0, 0.06] } });
      can();
      const path = [[0], [1]];
      equal(cell.firstContact(path).time, 0);
      const hit = cell.firstContact(path, { start: "leave", tolerance: 1e-6 });
      equal([hit.kind, hit.a, hit.b], ["contact", "can", "shelf"]);
      justBefore(hit.fraction, 0.793, 1e-6);
      equal([cell.isFree([[0], [0.7]], { start: "leave" }), cell.isFree([[0], [-0.1]], { start: "leave" })], [true, false]);
      throws(() => cell.closestApproach(path, { start: "leave" }), /no "start"/);
      throws(() => cell.isFree(path, { start: "go" }), /^start: "go" is not "report" or "leave"$/);
      cell.allowContact("can", "table");
      justBefore(cell.firstContact(path, { tolerance: 1e-6 }).fraction, 0.793, 1e-6);
      cell.forbidContact("can", "table");
      equal(cell.firstContact(path).time, 0);
      cell.detach("can");
      cell.attach("can", ccd.Body.box([0.03, 0.03, 0.06]), "carriage", { pose: { position: [0, 0, 0.06] }, mayTouch: ["table"] });
      justBefore(cell.firstContact(path, { tolerance: 1e-6 }).fraction, 0.793, 1e-6);
      throws(() => cell.setClearance("can", "table", -0.01), /start policy/);
      throws(() => cell.allowContact("table", "shelf"), /never compared/);
    },
    "the closest approach, and where a clearance is kept"() {
      const { cell } = beforeWall();
      const closest = cell.closestApproach([[0], [1.25]], { tolerance: 1e-6 });
      equal([closest.kind, closest.nearest.a, closest.nearest.b], ["leastDistance", "carriage", "wall"]);
      between(closest.nearest.fraction, 1 - 1e-6, 1);
      between(0.75, closest.lower, closest.upper);
      between(closest.upper - closest.lower, 0, 1.01e-6);
      const ranges = cell.clearanceRanges([[0], [2]], { margin: 1 });
      equal(ranges.map(({ clearance }) => clearance), ["kept", "unverified", "violated"]);
      const [kept, open, violated] = ranges;
      equal([kept.start, kept.end, open.end, violated.end], [0, open.start, violated.start, 1]);
      between(0.5, kept.end, violated.start);
      between(violated.start - kept.end, 0, 1e-3);
      cell.setPadding("carriage", 0.5);
      between(cell.clearanceRanges([[0], [2]], { margin: 1 })[0].end, 0.24, 0.25);
    },
    "a clearance adds its pair to those that are checked"() {
      const { robot, cell } = beforeWall();
      const held = { carriage: ccd.Body.sphere(0.5), rail: ccd.Body.box([0.5, 0.1, 0.1]) };
      const neighbours = new ccd.Cell(new ccd.Robot({ joints: [slider], bodies: held }));
      equal([neighbours.checkedPairs, cell.checkedPairs], [[], robot.checkedPairs]);
      neighbours.setClearance("rail", "carriage", 0.5);
      equal(neighbours.checkedPairs, [["rail", "carriage"]]);
      equal([neighbours.isFree([[2], [3]]), neighbours.isFree([[1], [3]])], [true, false]);
    },
    "a door swings against a post"() {
      const cell = new ccd.Cell(door());
      cell.addObstacle("post", ccd.Body.sphere(0.2), { position: [0, 0.75, 0] });
      const hit = cell.firstContact([[0], [3]], { tolerance: 1e-6 });
      // The ball's middle is 0.25 from the middle plane of the leaf.
      justBefore(3 * hit.fraction, Math.acos(0.25 / 0.75), 1e-5);
    },
    "the motion of a link answers as any other"() {
      const leaf = door().linkTrajectory("leaf", [0], [3], { duration: 2 });
      const options = { motionA: leaf, motionB: { position: [0, 0.75, 0] }, tolerance: 1e-6 };
      const bar = ccd.Body.box([1, 0.05, 1]);
      const hit = ccd.firstContact(bar, ccd.Body.sphere(0.2), options);
      justBefore(1.5 * hit.time, Math.acos(0.25 / 0.75), 1e-5);
      throws(() => ccd.firstContact(bar, bar, { ...options, duration: 2.1 }), /2\.1 is later than 2/);
    },
    "errors name the joint, the link or the configuration"() {
      const { robot, cell } = beforeWall();
      throws(() => new ccd.Robot({ joints: [{ ...slider, type: "screw" }] }), /^joint "slider": type: "screw" is not "revolute", "prismatic" or "fixed"$/);
      throws(() => new ccd.Robot({ joints: [{ ...slider, type: "continuous" }] }), /a revolute one without limits/);
      throws(() => new ccd.Robot({ joints: [slider], bodies: { cariage: ccd.Body.sphere(1) } }), /link `cariage` has no joint/);
      throws(() => new ccd.Robot({ joints: [{ ...slider, mimic: { joint: "slidder" } }] }), /follows `slidder`, but there is no such joint/);
      throws(() => cell.addObstacle("", ccd.Body.sphere(1)), /needs a name that is not empty/);
      throws(() => cell.attach("", ccd.Body.sphere(1), "carriage"), /needs a name that is not empty/);
      throws(() => new ccd.Robot({ joints: [{ ...slider, limits: [1, 0] }] }), /slider/);
      throws(() => new ccd.Robot({ joints: [{ ...slider, axis: [0, 0, 0] }] }), /joint "slider"/);
      throws(() => new ccd.Robot({ joints: [{ ...slider, child: undefined }] }), /joint "slider": child: a string is needed, not undefined/);
      throws(() => robot.pose("arm", [0]), /arm/);
      throws(() => robot.linkTrajectory("carriage", [0], [11]), /end: .*slider/);
      throws(() => cell.isFree([[0], [1, 2]]), /path\[1\]: 2 positions, but 1 joints: slider/);
      throws(() => cell.isFree([[0], [11]]), /slider/);
      throws(() => cell.isFree([[0], [1]], { clearance: 1 }), /no "clearance"/);
      throws(() => cell.closestApproach([[0], [1]], { margin: 1 }), /no "margin"; there are tolerance, budget$/);
      throws(() => cell.isFree([[0], [1]], { budget: -1 }), /^budget: -1 is not at least 0/);
      throws(() => cell.clearanceRanges([[0], [1]], { resolution: 0 }), /^resolution: 0 is not/);
      throws(() => cell.clearanceRanges([[0], [1]], { maxPoseError: NaN }), /^maxPoseError: NaN is not/);
      throws(() => cell.addObstacle(undefined, ccd.Body.sphere(1)), /^name: a string is needed, not undefined/);
      throws(() => cell.setClearance("wall", 5, 1), /^b: a string is needed, not 5/);
      throws(() => cell.addObstacle("wall", ccd.Body.sphere(1)), /wall/);
      // The cell answers as before.
      equal(cell.isFree([[0], [1.9]]), true);
    },
  };
};
