// Arguments are read exactly, or refused with an error that names the argument.

/** Values that are no number, no name, no list, no pose and no options. */
const NOTHING = [null, true, false, 5n, Symbol("s"), () => 1, new Map([["position", [1, 2, 3]]]), new Set([1]), new Date(0)];
/** Values that are missing, empty, or of another kind than those below. */
const OTHERS = [undefined, "", "5", "auto", [], [[[]]], NaN, 7, {}, { unknown: 1 }, new Float64Array(0)];
const HOSTILE = [...NOTHING, ...OTHERS];

/** The hostile values that an argument of each kind accepts. */
const TAKES = {
  number: (value) => value === 7,
  optionalNumber: (value) => value === 7 || value === undefined,
  vector: () => false,
  optionalVector: (value) => value === undefined,
  pose: (value) => isEmpty(value),
  optionalPose: (value) => value === undefined || isEmpty(value),
  name: (value) => typeof value === "string",
  optionalName: (value) => typeof value === "string" || value === undefined,
  numbers: (value) => value?.length === 0 && typeof value === "object",
  list: (value) => value?.length === 0 && typeof value === "object",
  optionalList: (value) => value === undefined || (value?.length === 0 && typeof value === "object"),
  options: (value) => value === undefined || isEmpty(value),
  optionalBoolean: (value) => value === undefined || typeof value === "boolean",
  indices: (value) => value === undefined || value === null || (value?.length === 0 && typeof value === "object"),
  object: () => false,
};

function isEmpty(value) {
  return typeof value === "object" && value !== null && Object.getPrototypeOf(value) === Object.prototype && Object.keys(value).length === 0;
}

/** All calls. For each argument and each of its fields: the kind, a valid value, and its name in messages. */
function calls(ccd) {
  const { Body, Cell, Motion, PosePath, Robot, Ballistic } = ccd;
  const ball = Body.sphere(1);
  const tetrahedron = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
  const corners = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];
  const file = new TextEncoder().encode("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const slider = { type: "prismatic", name: "s", parent: "a", child: "b", axis: [1, 0, 0] };
  const robot = new Robot({ joints: [slider], bodies: { a: ball, b: ball } });
  const cell = () => {
    const made = new Cell(new Robot({ joints: [slider], bodies: { b: ball } }));
    made.addObstacle("wall", ball, { position: [9, 0, 0] });
    return made;
  };
  const joint = (name) => (value) => new Robot({ joints: [{ ...slider, [name]: value }], bodies: { b: ball } });
  const asked = (ask) => (name) => (value) => ask(ball, ball, { [name]: value });
  const [first, near] = [asked(ccd.firstContact), asked(ccd.closestApproach)];
  const path = [[0], [1]];
  const two = [{}, { position: [1, 0, 0] }];
  return [
    ["radius", "number", (value) => Body.sphere(value)],
    ["halfExtents", "vector", (value) => Body.box(value)],
    ["radius", "number", (value) => Body.capsule(value, 1)],
    ["halfHeight", "number", (value) => Body.capsule(1, value)],
    ...["cylinder", "cone"].flatMap((shape) => [
      ["radius", "number", (value) => Body[shape](value, 1)],
      ["halfHeight", "number", (value) => Body[shape](1, value)],
      ["excess", "optionalNumber", (value) => Body[shape](9, 9, value)],
    ]),
    ["positions", "numbers", (value) => Body.fromMesh(value, corners)],
    ["indices", "indices", (value) => Body.fromMesh([...tetrahedron.slice(0, 9)], value)],
    ["options", "options", (value) => Body.fromMesh(tetrahedron, corners, value)],
    ["pieces", "optionalName", (value) => Body.fromMesh(tetrahedron, corners, { pieces: value })],
    ["surface", "optionalBoolean", (value) => Body.fromMesh(tetrahedron, corners, { surface: value })],
    ["name", "name", (value) => Body.fromFile(value, file)],
    ["a.obj", "object", (value) => Body.fromFile("a.obj", value)],
    ["options", "options", (value) => Body.fromFile("a.obj", file, value)],
    ["scale", "optionalNumber", (value) => Body.fromFile("a.obj", file, { scale: value })],
    ["name", "name", (value) => ccd.readMesh(value, file)],
    ["a.obj", "object", (value) => ccd.readMesh("a.obj", value)],
    ["options", "options", (value) => ccd.readMesh("a.obj", file, value)],
    ["unit", "optionalVector", (value) => ccd.readMesh("a.obj", file, { unit: value })],
    ["motion", "optionalPose", (value) => new Motion(value)],
    ...["position", "velocity", "angularVelocity", "center"].map((name) => [name, "optionalVector", (value) => new Motion({ [name]: value })]),
    ["rotation", "optionalVector", (value) => new Motion({ rotation: value })],
    ["start", "pose", (value) => Motion.between(value, {})],
    ["end", "pose", (value) => Motion.between({}, value)],
    ["options", "options", (value) => Motion.between({}, {}, value)],
    ["duration", "optionalNumber", (value) => Motion.between({}, {}, { duration: value })],
    ["center", "optionalVector", (value) => Motion.between({}, {}, { center: value })],
    ["motion", "object", (value) => new Ballistic(value)],
    ["acceleration", "vector", (value) => new Ballistic({ velocity: [1, 0, 0], acceleration: value })],
    ["velocity", "optionalVector", (value) => new Ballistic({ velocity: value, acceleration: [0, 0, 1] })],
    ["times", "numbers", (value) => new PosePath(value, two)],
    ["times[1]", "number", (value) => new PosePath([0, value], two)],
    ["poses", "list", (value) => new PosePath([0, 1], value)],
    ["poses[0]", "pose", (value) => new PosePath([0, 1], [value, {}])],
    ["poses[1].position", "optionalVector", (value) => new PosePath([0, 1], [{}, { position: value }])],
    ["options", "options", (value) => new PosePath([0, 1], two, value)],
    ["center", "optionalVector", (value) => new PosePath([0, 1], two, { center: value })],
    ["angularVelocities", "optionalList", (value) => new PosePath([0, 1], two, { angularVelocities: value })],
    ["angularVelocities[0]", "vector", (value) => new PosePath([0, 1], two, { angularVelocities: [value] })],
    ["time", "number", (value) => new Motion().pose(value)],
    ["a", "object", (value) => ccd.firstContact(value, ball)],
    ["b", "object", (value) => ccd.firstContact(ball, value)],
    ...[ccd.firstContact, ccd.anyContact, ccd.isFree, ccd.contactInterval, ccd.closestApproach, ccd.distance].map((ask) => ["options", "options", (value) => ask(ball, ball, value)]),
    ["clearance", "number", (value) => ccd.keepsClearance(ball, ball, value)],
    ["motionA", "optionalPose", first("motionA")],
    ["motionB", "optionalPose", first("motionB")],
    ["position", "optionalVector", (value) => first("motionB")({ position: value })],
    ...["duration", "tolerance", "margin", "budget"].map((name) => [name, "optionalNumber", first(name)]),
    ...["duration", "tolerance", "budget"].map((name) => [name, "optionalNumber", near(name)]),
    ["robot", "pose", (value) => new Robot(value)],
    ["joints", "optionalList", (value) => new Robot({ joints: value, bodies: { b: ball } })],
    ["joints[0]", "object", (value) => new Robot({ joints: [value] })],
    ...["type", "name", "parent", "child"].map((name) => [name, "name", joint(name)]),
    ["origin", "optionalPose", joint("origin")],
    ["axis", "optionalVector", joint("axis")],
    ["limits", "optionalVector", joint("limits")],
    ["limits[1]", "number", (value) => joint("limits")([0, value])],
    ["mimic", "optionalVector", joint("mimic")],
    ["mimic.joint", "name", (value) => joint("mimic")({ joint: value })],
    ["mimic.multiplier", "optionalNumber", (value) => joint("mimic")({ joint: "t", multiplier: value })],
    ["mimic.offset", "optionalNumber", (value) => joint("mimic")({ joint: "t", offset: value })],
    ["bodies", "optionalPose", (value) => new Robot({ joints: [slider], bodies: value })],
    ['bodies["b"]', "list", (value) => new Robot({ joints: [slider], bodies: { b: value } })],
    ['bodies["b"][0]', "object", (value) => new Robot({ joints: [slider], bodies: { b: [value] } })],
    ['bodies["b"][0].pose', "optionalPose", (value) => new Robot({ joints: [slider], bodies: { b: [{ body: ball, pose: value }] } })],
    ["mayTouch", "optionalList", (value) => new Robot({ joints: [slider], bodies: { b: ball }, mayTouch: value })],
    ["mayTouch[0]", "object", (value) => new Robot({ joints: [slider], bodies: { b: ball }, mayTouch: [value] })],
    ["mayTouch[0][1]", "name", (value) => new Robot({ joints: [slider], bodies: { b: ball }, mayTouch: [["a", value]] })],
    ["link", "name", (value) => robot.pose(value, [0])],
    ["configuration", "numbers", (value) => robot.pose("b", value)],
    ["start", "numbers", (value) => robot.linkTrajectory("b", value, [1])],
    ["end[0]", "number", (value) => robot.linkTrajectory("b", [1], [value])],
    ["options", "options", (value) => robot.linkTrajectory("b", [0], [1], value)],
    ["seenFrom", "optionalName", (value) => robot.linkTrajectory("b", [0], [1], { seenFrom: value })],
    ["robot", "object", (value) => new Cell(value)],
    ["name", "name", (value) => cell().addObstacle(value, ball)],
    ["body", "object", (value) => cell().addObstacle("x", value)],
    ["pose", "optionalPose", (value) => cell().addObstacle("x", ball, value)],
    ["name", "name", (value) => cell().moveObstacle(value, {})],
    ["pose", "pose", (value) => cell().moveObstacle("wall", value)],
    ["name", "name", (value) => cell().removeObstacle(value)],
    ["body", "object", (value) => cell().attach("x", value, "b")],
    ["link", "name", (value) => cell().attach("x", ball, value)],
    ["options", "options", (value) => cell().attach("x", ball, "b", value)],
    ["pose", "optionalPose", (value) => cell().attach("x", ball, "b", { pose: value })],
    ["mayTouch", "optionalList", (value) => cell().attach("x", ball, "b", { mayTouch: value })],
    ["mayTouch[0]", "name", (value) => cell().attach("x", ball, "b", { mayTouch: [value] })],
    ["name", "name", (value) => cell().detach(value)],
    ["link", "name", (value) => cell().setPadding(value, 0.1)],
    ["distance", "number", (value) => cell().setPadding("b", value)],
    ["a", "name", (value) => cell().setClearance(value, "wall", 0.1)],
    ["b", "name", (value) => cell().setClearance("b", value, 0.1)],
    ["distance", "number", (value) => cell().setClearance("b", "wall", value)],
    ...["firstContact", "isFree", "closestApproach", "clearanceRanges"].flatMap((ask) => [
      ["path", "list", (value) => cell()[ask](value)],
      ["path[1]", "numbers", (value) => cell()[ask]([[0], value])],
      ["path[1][0]", "number", (value) => cell()[ask]([[0], [value]])],
      ["options", "options", (value) => cell()[ask](path, value)],
      ["tolerance", "optionalNumber", (value) => cell()[ask](path, { tolerance: value })],
    ]),
    ["resolution", "optionalNumber", (value) => cell().clearanceRanges(path, { resolution: value })],
    ["maxPoseError", "optionalNumber", (value) => cell().clearanceRanges(path, { maxPoseError: value })],
  ];
}

const show = (value) => (typeof value === "object" && value !== null ? `${value.constructor?.name} ${Object.keys(value)}` : String(value));

/** Arrays of numbers of all kinds: for each, a function that makes it from integers from 0 to 100, and whether it is accepted. */
const ARRAYS = {
  Array: (numbers) => numbers,
  ...Object.fromEntries(
    [Int8Array, Uint8Array, Uint8ClampedArray, Int16Array, Uint16Array, Int32Array, Uint32Array, Float32Array, Float64Array].map((type) => [type.name, (numbers) => type.from(numbers)]),
  ),
  "a view with an offset": (numbers) => Float64Array.from([9, 9, ...numbers, 9]).subarray(2, 2 + numbers.length),
  "a view of every byte": (numbers) => {
    const bytes = new ArrayBuffer(8 + 2 * numbers.length);
    const view = new Int16Array(bytes, 6, numbers.length);
    view.set(numbers);
    return view;
  },
  "an object like a list": (numbers) => ({ ...numbers, length: numbers.length }),
  "a proxy": (numbers) => new Proxy(numbers, {}),
  "a list of another class": (numbers) => Object.assign(new (class extends Array {})(), numbers),
};
if (typeof SharedArrayBuffer !== "undefined") {
  ARRAYS["shared memory"] = (numbers) => {
    const shared = new Float64Array(new SharedArrayBuffer(8 * numbers.length));
    shared.set(numbers);
    return shared;
  };
}

/** Functions that make an invalid value from a list of finite numbers. */
const REFUSED = {
  BigInt64Array: (numbers) => BigInt64Array.from(numbers, BigInt),
  BigUint64Array: (numbers) => BigUint64Array.from(numbers, BigInt),
  DataView: (numbers) => new DataView(Float64Array.from(numbers).buffer),
  ArrayBuffer: (numbers) => Float64Array.from(numbers).buffer,
  Set: (numbers) => new Set(numbers),
  "a text": (numbers) => numbers.join(","),
  "a list with a hole": (numbers) => numbers.map((one) => one).fill(0) && Object.assign(new Array(numbers.length), numbers.slice(1)),
  "a list of texts": (numbers) => numbers.map(String),
  "a list of lists": (numbers) => numbers.map((one) => [one]),
  "a list of bigints": (numbers) => numbers.map(BigInt),
  "a list with NaN": (numbers) => [NaN, ...numbers.slice(1)],
  "numbers with NaN": (numbers) => Float64Array.from([NaN, ...numbers.slice(1)]),
  "a list with null": (numbers) => [...numbers.slice(1), null],
  "one number less": (numbers) => numbers.slice(1),
  "one number more": (numbers) => [...numbers, 1],
  "memory that was passed on": (numbers) => {
    const gone = Float64Array.from(numbers);
    structuredClone(gone.buffer, { transfer: [gone.buffer] });
    return gone;
  },
};
if (ArrayBuffer.prototype.resize) {
  REFUSED["memory that has shrunk"] = (numbers) => {
    const memory = new ArrayBuffer(8 * numbers.length, { maxByteLength: 8 * numbers.length });
    const view = new Float64Array(memory, 0, numbers.length);
    view.set(numbers);
    memory.resize(8);
    return view;
  };
}

/** All arguments that are lists of three numbers: for each, the name in messages, and a function that returns the numbers read. */
function entries(ccd) {
  const { Body, PosePath, Robot } = ccd;
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const joints = axes.map((axis, k) => ({ type: "prismatic", name: `j${k}`, parent: `l${k}`, child: `l${k + 1}`, axis }));
  const robot = new Robot({ joints, bodies: { l3: Body.sphere(1) } });
  const cell = new ccd.Cell(robot);
  cell.addObstacle("far", Body.sphere(1), { position: [0, 0, 1000] });
  return {
    "position": (list) => new PosePath([0, 1], [{ position: list }, {}]).pose(0).position,
    "velocity": (list) => new ccd.Motion({ velocity: list }).pose(1).position,
    "acceleration": (list) => new ccd.Ballistic({ acceleration: list }).pose(2).position.map((one) => one / 2),
    "configuration": (list) => robot.pose("l3", list).position,
    "path[0]": (list) => {
      const { lower, upper } = cell.closestApproach([list], { tolerance: 1e-6 });
      const found = copied(list);
      const distance = Math.hypot(found[0], found[1], found[2] - 1000) - 2;
      return lower <= distance + 1e-9 && distance <= upper + 1e-9 && upper - lower < 1e-5 ? found : [lower, upper];
    },
    "times": (list) => {
      const path = new PosePath(list, axes.map((_, k) => ({ position: [k, 0, 0] })));
      const found = copied(list);
      const at = found.map((time) => path.pose(time).position[0]);
      return path.end === found[2] && Math.hypot(at[0], at[1] - 1, at[2] - 2) < 1e-9 ? found : [path.end, ...at];
    },
    // Computes a corner of a triangle from its distances from three balls.
    "positions": (list) => {
      if (!Array.isArray(list) && !/^Float/.test(list[Symbol.toStringTag])) throw new TypeError("positions: see the types");
      const [x, y, z] = copied(list);
      const more = list.length === 3 && typeof x === "number" ? [x + 1, y, z, x, y + 1, z] : [];
      const completed = () => (Array.isArray(list) ? [...list, ...more] : list.constructor.from([...list, ...more]));
      const corner = Body.fromMesh(more.length > 0 ? completed() : list, [0, 1, 2]);
      const from = (axis) => ccd.distance(corner, Body.sphere(0.25), { motionB: { position: axis.map((one, k) => list[k] - one) }, tolerance: 1e-6 });
      const holds = axes.map(from).every(({ lower, upper }) => lower <= 0.75 && 0.75 <= upper && upper - lower < 1e-5);
      return holds ? [x, y, z] : [];
    },
  };
}

function copied(list) {
  return Array.from({ length: list.length }, (_, k) => list[k]);
}

export default (ccd, { equal, ok, randomNumbers }) => ({
  "no value of another kind enters by any argument"() {
    for (const [argument, kind, call] of calls(ccd)) {
      for (const value of HOSTILE) {
        const what = `${argument} = ${show(value)} in ${call}`;
        let error = null;
        try {
          call(value);
        } catch (caught) {
          error = caught;
        }
        if (TAKES[kind](value)) {
          ok(error === null || error instanceof Error, what);
          ok(!(error instanceof ccd.EngineError), `${what}: ${error}`);
          continue;
        }
        ok(error !== null, `${what}: taken`);
        ok(error instanceof TypeError || error instanceof RangeError, `${what}: ${error.name}: ${error.message}`);
        ok(error.message.includes(argument), `${what}: "${error.message}" does not name it`);
      }
    }
  },
  "lists of numbers of all kinds are read exactly"() {
    const random = randomNumbers(5);
    for (const [argument, enter] of Object.entries(entries(ccd))) {
      for (const [kind, made] of Object.entries(ARRAYS)) {
        if (argument === "positions" && !/^Array$|Float|offset|shared|proxy|class/.test(kind)) continue;
        for (let k = 0; k < 8; k += 1) {
          const start = Math.floor(random(0, 50));
          const numbers = [start, start + 1 + Math.floor(random(0, 20)), start + 30 + Math.floor(random(0, 20))];
          equal(enter(made(numbers)), numbers);
        }
      }
    }
    equal(Object.is(new ccd.Motion({ position: [-0, 0, 5e-324] }).pose(0).position[2], 5e-324), true);
  },
  "what is no list of so many numbers is refused by its name"() {
    for (const [argument, enter] of Object.entries(entries(ccd))) {
      for (const [kind, made] of Object.entries(REFUSED)) {
        let error = null;
        try {
          enter(made([1, 2, 3]));
        } catch (caught) {
          error = caught;
        }
        const what = `${argument} as ${kind}`;
        const word = argument === "times" && /one number/.test(kind) ? "times" : argument;
        ok(error !== null, `${what}: taken`);
        ok(error instanceof Error && !(error instanceof ccd.EngineError) && error.message.includes(word), `${what}: ${error.name}: ${error.message}`);
      }
    }
  },
  "surplus elements and fields are refused"() {
    const { Body, Robot } = ccd;
    const ball = Body.sphere(1);
    const joint = { type: "prismatic", name: "s", parent: "a", child: "b" };
    const robot = (parts) => () => new Robot({ joints: [joint], bodies: { b: ball }, ...parts });
    const refused = [
      [robot({ mayTouch: [["a", "b", "c"]] }), /mayTouch\[0\]: 2 elements are needed, not 3/],
      [robot({ joints: [{ ...joint, limits: [0, 1, 2] }] }), /joint "s": limits: 2 elements are needed, not 3/],
      [robot({ joints: [{ ...joint, type: "fixed", limits: [0, 1] }] }), /joint "s": there is no "limits"/],
      [robot({ joints: [{ ...joint, axsi: [0, 0, 1] }] }), /joint "s": there is no "axsi"/],
      [robot({ bodies: { b: [{ body: ball, psoe: {} }] } }), /bodies\["b"\]\[0\]: there is no "psoe"/],
      [() => new ccd.Motion({ position: { x: 1, y: 2, z: 3, w: 4 } }), /motion\.position/],
      [() => new ccd.Motion({ position: { x: 1, y: 2, z: 3, t: 4 } }), /motion\.position/],
      [() => new ccd.Motion({ rotation: [0, 0, 0, 1, 0] }), /motion\.rotation/],
      [() => new ccd.PosePath([0, 1], [{ velocity: [1, 0, 0] }, {}]), /poses\[0\]: there is no "velocity"/],
      [() => Body.fromMesh([0, 0, 0, 1, 0, 0, 0, 1, 0, 5], [0, 1, 2]), /positions: 10 numbers/],
      [() => new ccd.Cell(robot({})()).addObstacle("a\ud800", ball), /name: .* half of a surrogate pair/],
    ];
    for (const [call, pattern] of refused) {
      let error = null;
      try {
        call();
      } catch (caught) {
        error = caught;
      }
      ok(error instanceof TypeError && pattern.test(error.message), `${call}: ${error}`);
    }
    // Objects of a class may have other properties than their coordinates.
    class Vector3 {
      constructor(x, y, z) {
        Object.assign(this, { x, y, z, isVector3: true });
      }
      length() {
        return Math.hypot(this.x, this.y, this.z);
      }
    }
    equal(new ccd.Motion({ position: new Vector3(1, 2, 3) }).pose(0).position, [1, 2, 3]);
    class Place {
      get position() {
        return [1, 2, 3];
      }
    }
    equal(new ccd.Motion(new Place()).pose(0).position, [1, 2, 3]);
  },
});
