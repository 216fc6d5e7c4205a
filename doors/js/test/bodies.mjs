// Bodies from shapes, arrays and files; memory and errors.

/** A cube of side 2 like a `BoxGeometry` of three.js, with four corners for each face. */
function cubeOfThree() {
  const [positions, indices] = [[], []];
  for (let axis = 0; axis < 3; axis += 1) {
    for (const side of [-1, 1]) {
      const first = positions.length / 3;
      for (const [u, v] of [[-1, -1], [side, -side], [1, 1], [-side, side]]) {
        const corner = [0, 0, 0];
        [corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3]] = [side, u, v];
        positions.push(...corner);
      }
      indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
    }
  }
  return { positions: new Float32Array(positions), indices: new Uint16Array(indices) };
}

const TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/** A tetrahedron in glTF. By default its data is in a separate buffer. */
function gltf(buffer) {
  const positions = new Uint8Array(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]).buffer);
  const indices = new Uint8Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
  const data = btoa(String.fromCharCode(...positions, ...indices));
  const scene = {
    asset: { version: "2.0" },
    buffers: [{ byteLength: 60, uri: `data:application/octet-stream;base64,${data}`, ...buffer }],
    bufferViews: [{ buffer: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 12 }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: "VEC3", min: [0, 0, 0], max: [1, 1, 1] },
      { bufferView: 1, componentType: 5121, count: 12, type: "SCALAR" },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    nodes: [{ mesh: 0 }],
  };
  return new TextEncoder().encode(JSON.stringify(scene));
}

export default (ccd, { equal, ok, between, throws }) => ({
  "the index of three.js makes a solid of one piece"() {
    const { positions, indices } = cubeOfThree();
    const [cube, ball] = [ccd.Body.fromMesh(positions, indices), ccd.Body.sphere(0.5)];
    equal([cube.isSolid, cube.excess], [true, 0]);
    ok(/closed|solid/.test(cube.report), cube.report);
    // A body inside a solid does not touch its surface, but overlaps it.
    equal(ccd.firstContact(ball, cube).kind, "overlapping");
    const { lower, upper } = ccd.distance(ball, cube, { motionA: { position: [3, 0, 0] } });
    between(1.5, lower, upper);
    between(upper - lower, 0, 1e-3);
    const hollow = ccd.Body.fromMesh(positions, indices, { surface: true });
    equal([hollow.isSolid, ccd.firstContact(ball, hollow).kind], [false, "free"]);
  },
  "arrays of all kinds, with indices and without, are the same mesh"() {
    const { positions, indices } = cubeOfThree();
    const loose = [...indices].flatMap((index) => [...positions.subarray(3 * index, 3 * index + 3)]);
    const cubes = [
      ccd.Body.fromMesh(positions, indices),
      ccd.Body.fromMesh(new Float64Array(positions), Uint32Array.from(indices)),
      ccd.Body.fromMesh([...positions], [...indices]),
      ccd.Body.fromMesh(new Float32Array(loose)),
    ];
    const ball = ccd.Body.sphere(0.5);
    const fall = { motionA: { position: [0.3, 0.2, 4], velocity: [0, 0, -3] } };
    const times = cubes.map((cube) => ccd.firstContact(ball, cube, fall).time);
    equal(new Set(times).size, 1);
    between(times[0], 2.5 / 3 - 1e-3, 2.5 / 3);
  },
  "files of all formats are read"() {
    const bytes = (text) => new TextEncoder().encode(text);
    const vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    const faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    const ply = `ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n${vertices}${faces}`;
    const corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const facet = (face) => `facet normal 0 0 0\nouter loop\n${face.map((k) => `vertex ${corners[k].join(" ")}\n`).join("")}endloop\nendfacet\n`;
    const stl = `solid s\n${[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(facet).join("")}endsolid s\n`;
    const dae = `<COLLADA version="1.5.0"><library_geometries><geometry><mesh><source id="s"><float_array id="a">${vertices}</float_array><technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices><triangles count="4"><input semantic="VERTEX" source="#v"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries></COLLADA>`;
    const files = { "a.obj": TETRAHEDRON, "a.off": `OFF\n4 4 0\n${vertices}${faces}`, "a.ply": ply, "a.stl": stl, "a.gltf": new TextDecoder().decode(gltf()), "a.dae": dae };
    for (const [name, text] of Object.entries(files)) {
      const body = ccd.Body.fromFile(name, bytes(text), { scale: 2 });
      const { lower, upper } = ccd.distance(body, ccd.Body.sphere(1), { motionB: { position: [0, 0, 5] } });
      equal([ccd.readMesh(name, bytes(text)).positions.length, ccd.readMesh(name, bytes(text)).indices.length], [12, 12]);
      ok(body.isSolid && lower <= 2 && upper >= 2 && upper - lower < 1e-3, `${name}: ${lower} to ${upper}`);
    }
  },
  "the unit of a file is kept, told and converted"() {
    const dae = `<COLLADA version="1.5.0"><asset><unit meter="0.001"/></asset><library_geometries><geometry><mesh><source id="s"><float_array id="a">0 0 0 1000 0 0 0 1000 0 0 0 1000</float_array><technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices><triangles count="4"><input semantic="VERTEX" source="#v"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries></COLLADA>`;
    const bytes = new TextEncoder().encode(dae);
    const read = (options) => ccd.readMesh("part.dae", bytes, options);
    for (const [options, size, unit] of [
      [undefined, 1000, "mm"],
      [{ unit: "mm" }, 1000, "mm"],
      [{ unit: "m" }, 1, "m"],
      [{ unit: "cm", scale: 2 }, 200, null],
      [{ scale: 0.001 }, 1, null],
    ]) {
      equal([Math.max(...read(options).positions), read(options).unit], [size, unit]);
      const body = ccd.Body.fromFile("part.dae", bytes, options);
      const { lower, upper } = ccd.distance(body, ccd.Body.sphere(size), { motionB: { position: [0, 0, 3 * size] } });
      ok(lower <= size && size <= upper && upper - lower <= 2e-3, `${JSON.stringify(options)}: ${lower} to ${upper}`);
    }
    equal(ccd.readMesh("part.obj", new TextEncoder().encode(TETRAHEDRON)).unit, null);
    equal(ccd.readMesh("part.gltf", gltf(), { unit: "mm" }).positions[3], 1000);
    ok(throws(() => read({ unit: "inch" }), /^unit: "inch" is not "um", .* or "ft"$/) instanceof TypeError, "units");
    throws(() => read({ size: 2 }), /options of readMesh: there is no "size"/);
  },
  "an outer hull encloses an open mesh"() {
    const { positions, indices } = cubeOfThree();
    const open = indices.slice(6);
    throws(() => ccd.Body.fromMesh(positions, open, { pieces: "hull" }), /close the mesh, or use triangles or an outer hull/);
    const hull = ccd.Body.fromMesh(positions, open, { pieces: "outer-hull" });
    equal([hull.pieceCount, ccd.firstContact(ccd.Body.sphere(0.5), hull).kind], [1, "overlapping"]);
    ok(hull.excess > 0.5, hull.report);
  },
  "a seam that is open by a rounding says what closes it"() {
    const ring = Array.from({ length: 7 }, (_, k) => [Math.sin((k * Math.PI) / 3), 0, Math.cos((k * Math.PI) / 3)]);
    const positions = new Float32Array([0, 1, 0, 0, -1, 0, ...ring.flat()]);
    const indices = Array.from({ length: 6 }, (_, k) => [0, k + 2, k + 3, 1, k + 3, k + 2]).flat();
    const open = ccd.Body.fromMesh(positions, indices);
    ok(!open.isSolid && /closed if vertices up to \d\.\de-1\d apart are joined/.test(open.report), open.report);
    equal(ccd.Body.fromMesh(positions.map((x) => Math.round(x * 1e6) / 1e6), indices).isSolid, true);
  },
  "very large and very small lengths have few digits in reports"() {
    equal([ccd.Body.sphere(1e-300).report, ccd.Body.box([1e11, 1, 0.25]).report], ["ball of radius 1e-300", "box of half extents 1e11, 1, 0.25"]);
  },
  "errors are about the type, the range or something else"() {
    const { Body, Motion, PosePath, Robot } = ccd;
    const { positions, indices } = cubeOfThree();
    const joint = { type: "revolute", name: "j", parent: "a", child: "b", limits: [-1, 1] };
    const robot = new Robot({ joints: [joint], bodies: { b: Body.sphere(1) } });
    const cell = new ccd.Cell(robot);
    cell.addObstacle("wall", Body.sphere(1), { position: [9, 0, 0] });
    const ranges = [
      () => Body.sphere(-1),
      () => Body.box([1, -1, 1]),
      () => Body.cylinder(1, 1, 0),
      () => Body.fromMesh(positions, [0, 1, 99]),
      () => Body.fromMesh([0, 0, 0, 1, 0, 1e13, 0, 1, 0], [0, 1, 2]),
      () => cell.setPadding("b", -1),
      () => cell.setClearance("b", "wall", -1),
      () => cell.isFree([[0], [2]]),
      () => robot.pose("b", [2]),
      () => robot.linkTrajectory("b", [0], [2]),
      () => robot.linkTrajectory("b", [0], [1], { duration: 0 }),
      () => new Robot({ joints: [{ ...joint, limits: [1, -1] }] }),
      () => new Robot({ joints: [{ ...joint, axis: [0, 0, 0] }] }),
      () => Motion.between({}, {}, { duration: 0 }),
      () => new PosePath([1, 0], [{}, {}]),
      () => new PosePath([], []),
      () => new Motion({ position: [NaN, 0, 0] }),
    ];
    const types = [
      () => Body.fromMesh(positions, indices, { pieces: "cubes" }),
      () => new Robot({ joints: [{ ...joint, type: "screw" }] }),
      () => new Motion({ position: ["1", 0, 0] }),
    ];
    const others = [
      () => Body.fromFile("a.obj", new TextEncoder().encode("v 1 2\n")),
      () => Body.fromMesh(positions, indices.slice(6), { pieces: "hull" }),
      () => cell.removeObstacle("door"),
      () => cell.addObstacle("wall", Body.sphere(1)),
      () => new Robot({ joints: [joint, joint] }),
    ];
    for (const [name, calls] of Object.entries({ RangeError: ranges, TypeError: types, Error: others })) {
      for (const call of calls) equal([throws(call, /./).name, String(call)], [name, String(call)]);
    }
  },
  "round shapes say by how much they are exceeded"() {
    const cylinder = ccd.Body.cylinder(1, 2, 1e-4);
    between(cylinder.excess, 1e-6, 1e-4);
    between(ccd.Body.cone(1, 2).excess, 1e-6, 1 / 4096);
    const { lower, upper } = ccd.distance(cylinder, ccd.Body.capsule(0.5, 1), { motionB: { position: { x: 3, y: 0, z: 0 } } });
    between(1.5, lower, upper);
  },
  "errors name the element"() {
    const { positions, indices } = cubeOfThree();
    throws(() => ccd.Body.fromMesh(positions, [0, 1, 99]), /99/);
    throws(() => ccd.Body.fromMesh([0, 0, 0, 1, 0, NaN, 0, 1, 0], [0, 1, 2]), /positions\[5\]/);
    throws(() => ccd.Body.fromMesh([0, 0, 0, 1, 0, 1e13, 0, 1, 0], [0, 1, 2]), /vertex 1/);
    throws(() => ccd.Body.fromMesh(positions, [0, 1]), /indices: 2 numbers/);
    throws(() => ccd.Body.fromMesh(positions, [0, 1, -2]), /indices\[2\]/);
    throws(() => ccd.Body.fromMesh(positions, indices, { peices: "hull" }), /no "peices"/);
    throws(() => ccd.Body.fromMesh(positions, indices, { pieces: "cubes" }), /^pieces: "cubes" is not "auto", .* or "outer-hull"$/);
    throws(() => ccd.Body.fromFile("a.obj", new TextEncoder().encode("v 1 2\n")), /a\.obj.*line 1/);
    throws(() => ccd.Body.fromFile("a.txt", new Uint8Array()), /txt.*; use \.gltf, \.glb, \.dae, \.obj, \.stl, \.ply or \.off$/);
    throws(() => ccd.Body.fromFile("a.fbx", new Uint8Array()), /export it as \.glb$/);
    throws(() => ccd.Body.fromFile("a.gltf", gltf({ uri: "a.bin" })), /a\.bin.*export it as a \.glb/);
    throws(() => ccd.Body.sphere(-1), /radius/);
    throws(() => ccd.Body.box([1, 2]), /halfExtents/);
    throws(() => new ccd.Body(), /Body\.fromMesh/);
  },
  "what is freed is gone, and its memory is used again"() {
    const { positions, indices } = cubeOfThree();
    const ball = ccd.Body.sphere(1);
    ball.free();
    ball.free();
    throws(() => ccd.firstContact(ball, ball), /this Body was freed/);
    const count = 3000;
    const round = () => {
      for (let k = 0; k < count; k += 1) ccd.Body.fromMesh(positions, indices).free();
    };
    round();
    const before = ccd.memoryUsage();
    round();
    equal(ccd.memoryUsage(), before);
    if (Symbol.dispose) {
      const disposed = ccd.Body.sphere(1);
      disposed[Symbol.dispose]();
      throws(() => disposed.report, /freed/);
    }
  },
});
