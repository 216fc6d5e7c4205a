// Questions about two bodies, with exactly known answers.

export default (ccd, { equal, ok, justBefore, between, throws }) => {
  const ball = ccd.Body.sphere(0.5);
  const passes = { position: [-3, 0, 0], velocity: [4, 0, 0] };
  return {
    "two balls meet at half time"() {
      const hit = ccd.firstContact(ball, ball, { motionA: passes, tolerance: 1e-6 });
      equal([hit.kind, hit.tolerance], ["contact", 1e-6]);
      justBefore(hit.time, 0.5, 1e-6);
      between(hit.witnessA[0], -0.500002, -0.499998);
      equal(hit.normal, [1, 0, 0]);
      between(hit.distance[1], 0, 1e-6);
      const free = ccd.firstContact(ball, ball, { motionB: passes, duration: 0.49 });
      equal([free.kind, free.safeUntil], ["free", 0.49]);
    },
    "a ball that is thrown lands when it should"() {
      const ground = ccd.Body.box([9, 9, 1]);
      const thrown = new ccd.Ballistic({ position: [0, 0, 3], velocity: [1, 0, 0], acceleration: [0, 0, -10] });
      const hit = ccd.firstContact(ball, ground, { motionA: thrown, tolerance: 1e-6 });
      justBefore(hit.time, Math.sqrt(0.3), 1e-5);
      between(hit.witnessA[0], hit.time - 1e-5, hit.time + 1e-5);
      equal(thrown.end, null);
    },
    "a bar that makes half a turn touches the wall at its angle"() {
      // Its corner reaches x = 1 where cos(θ) = 1/2.
      const bar = ccd.Body.capsule(0.1, 1);
      const wall = ccd.Body.box([0.5, 5, 5]);
      const turned = { position: [0, 0, 0], rotation: [0, 1, 0, 0] };
      const turns = ccd.Motion.between({}, { rotation: [0, Math.SQRT1_2, 0, Math.SQRT1_2] });
      const hit = ccd.firstContact(bar, wall, { motionA: turns, motionB: { position: [1.1, 0, 0] }, tolerance: 1e-7 });
      justBefore(hit.time, Math.asin(0.5) / (Math.PI / 2), 1e-6);
      equal(turns.pose(0), { position: [0, 0, 0], rotation: [0, 0, 0, 1] });
      equal(ccd.distance(bar, wall, { motionA: turned }).kind, "overlapping");
    },
    "a path is followed pose by pose, and gives the duration"() {
      const path = new ccd.PosePath([0, 1, 3], [{ position: [-3, 0, 0] }, { position: [-3, 2, 0] }, { position: [3, 2, 0] }]);
      equal([path.end, path.pose(2).position], [3, [0, 2, 0]]);
      const nearest = ccd.closestApproach(ball, ball, { motionA: path });
      between(1, nearest.lower, nearest.upper);
      between(nearest.time, 1.9, 2.1);
      throws(() => new ccd.PosePath([0, 0], [{}, {}]), /time of a pose/);
      throws(() => new ccd.PosePath([0], [{}, {}]), /there are 2, but 1 times/);
      const turns = new ccd.PosePath([0, 1], [{}, {}], { angularVelocities: [[0, 0, 4 * Math.PI]] });
      between(Math.abs(turns.pose(0.25).rotation[2]), 1 - 1e-9, 1);
    },
    "a motion between two poses is asked about until its end"() {
      const wall = ccd.Body.box([0.1, 5, 5]);
      const passes = ccd.Motion.between({ position: [-3, 0, 0] }, { position: [3, 0, 0] }, { duration: 4 });
      equal([passes.end, ccd.Motion.between({}, {}).end, new ccd.Motion({ velocity: [1, 0, 0] }).end], [4, 1, null]);
      for (const options of [{ motionA: passes }, { motionA: { position: [0, 0, 0] }, motionB: passes }]) {
        const [a, b] = options.motionB ? [wall, ball] : [ball, wall];
        equal(ccd.isFree(a, b, options), false);
        justBefore(ccd.firstContact(a, b, { ...options, tolerance: 1e-6 }).time, 1.6, 1e-6);
        equal(ccd.isFree(a, b, { ...options, duration: 1 }), true);
        equal(ccd.keepsClearance(a, b, 0.1, options), false);
      }
      const path = new ccd.PosePath([0, 3], [{}, {}]);
      throws(() => ccd.isFree(ball, wall, { motionA: passes, motionB: path }), /end at different times/);
    },
    "each question has its answers"() {
      const flies = { motionA: { position: [-3, 0, 0], velocity: [6, 0, 0] } };
      const { kind, first, last } = ccd.contactInterval(ball, ball, flies);
      equal([kind, first.kind], ["interval", "contact"]);
      justBefore(first.time, 1 / 3, 1e-3);
      between(last.time, 2 / 3, 2 / 3 + 1e-3);
      const over = { motionA: { position: [-3, 1.2, 0], velocity: [6, 0, 0] } };
      equal([ccd.anyContact(ball, ball, over).kind, ccd.isFree(ball, ball, over), ccd.isFree(ball, ball, flies)], ["free", true, false]);
      const approach = ccd.closestApproach(ball, ball, over);
      between(0.2, approach.lower, approach.upper);
      between(approach.time, 0.49, 0.51);
      equal([ccd.keepsClearance(ball, ball, 0.19, over), ccd.keepsClearance(ball, ball, 0.21, over)], [true, false]);
      equal(ccd.isFree(ball, ball, { ...over, margin: 0.25 }), false);
      equal(ccd.firstContact(ball, ball, { motionA: { position: [1, 0, 0] } }).kind, "touching");
      const inside = ccd.firstContact(ball, ball);
      equal([inside.kind, inside.time], ["overlapping", 0]);
    },
    "a clearance that is the distance is not told"() {
      const [cube, at] = [ccd.Body.box([0.5, 0.5, 0.5]), { motionB: { position: [3.4, 0, 0] } }];
      const error = throws(() => ccd.keepsClearance(ball, cube, 2.4, at), /^unresolved \(tolerance\): .*a smaller tolerance/);
      ok(error.lower <= 2.4 && error.upper >= 2.4, String(error));
      const round = ccd.Body.cylinder(0.5, 1, 0.1);
      throws(() => ccd.keepsClearance(ball, round, 2.41, { ...at, tolerance: 1e-5 }), /^unresolved \(excess\)/);
    },
    "a limit leaves what is proven"() {
      const cone = ccd.Body.cone(1, 1);
      const turns = { motionA: { position: [-3, 0, 0], velocity: [3, 0, 0], angularVelocity: [9, 7, 5] }, budget: 3 };
      const known = ccd.firstContact(cone, cone, turns);
      equal([known.kind, known.limit, known.safeFrom], ["unresolved", "budget", null]);
      ok(known.safeUntil < ccd.firstContact(cone, cone, { ...turns, budget: undefined }).time, "it is proven until a contact");
      const error = throws(() => ccd.isFree(cone, cone, turns), /unresolved \(budget\)/);
      ok(error instanceof ccd.UnresolvedError && error.safeUntil >= 0, String(error));
      ok(/isFree with a margin/.test(error.advice) && !/_/.test(error.message), error.message);
    },
    "a getter of the options may ask and free as it likes"() {
      const options = () => ({ motionA: { position: [-3, 0, 0], velocity: [6, 0, 0] }, tolerance: 1e-6 });
      const plain = ccd.firstContact(ball, ball, options());
      const asks = options();
      Object.defineProperty(asks, "motionB", {
        enumerable: true,
        get() {
          equal(ccd.keepsClearance(ball, ball, 3, { motionA: { position: [9, 9, 9] }, tolerance: 0.1, duration: 7 }), true);
          return {};
        },
      });
      equal(ccd.firstContact(ball, ball, asks), plain);
      const [gone, path] = [ccd.Body.sphere(1), new ccd.PosePath([0, 1], [{}, {}])];
      const frees = (what) => ({
        motionA: path,
        get motionB() {
          what.free();
          return {};
        },
      });
      throws(() => ccd.firstContact(gone, ball, frees(gone)), /this Body was freed/);
      throws(() => ccd.firstContact(ball, ball, frees(path)), /this PosePath was freed/);
      equal(ccd.firstContact(ball, ball, options()), plain);
    },
    "settings and motions that are wrong are errors"() {
      throws(() => ccd.firstContact(ball, ball, { tolerence: 1 }), /no "tolerence"/);
      throws(() => ccd.firstContact(ball, ball, { tolerance: -1 }), /tolerance/);
      throws(() => ccd.firstContact(ball, ball, { duration: -1 }), /duration/);
      throws(() => ccd.firstContact(ball, ball, { deadline: 1 }), /no "deadline"; a budget limits/);
      for (const [name, wrong] of Object.entries({ tolerance: [0, NaN, 1e13, -1], margin: [-1, NaN, Infinity], duration: [-1, NaN, Infinity], budget: [-1, 1.5, NaN] })) {
        for (const value of wrong) {
          const error = throws(() => ccd.firstContact(ball, ball, { [name]: value }), new RegExp(`^${name}: ${value} is`));
          ok(error instanceof RangeError, `${name}: ${error.name}`);
        }
        const error = throws(() => ccd.firstContact(ball, ball, { [name]: "1" }), new RegExp(`^${name}: a number is needed, not "1"`));
        ok(error instanceof TypeError, `${name}: ${error.name}`);
      }
      equal(ccd.firstContact(ball, ball, { budget: Infinity }).kind, "overlapping");
      throws(() => ccd.keepsClearance(ball, ball, -1), /^clearance: -1 is not from 0/);
      for (const ask of [ccd.closestApproach, ccd.distance, (a, b, options) => ccd.keepsClearance(a, b, 1, options)]) {
        throws(() => ask(ball, ball, { margin: 1 }), /no "margin"; there are motionA.*budget$/);
      }
      throws(() => ccd.distance(ball, ball, { duration: 1 }), /no "duration"/);
      throws(() => ccd.firstContact(ball, ball, { 'a "name"': 1 }), /no "a \\"name\\""/);
      throws(() => ccd.firstContact(ball, {}), /^b: a Body is needed/);
      throws(() => ccd.firstContact(ball, ball, { motionA: { position: [0, NaN, 0] } }), /motionA\.position/);
      throws(() => ccd.firstContact(ball, ball, { motionA: { speed: 1 } }), /motionA: there is no "speed"/);
      for (const wrong of [[NaN, 0, 0], { x: 0, y: Infinity, z: 0 }]) {
        ok(throws(() => ccd.firstContact(ball, ball, { motionA: { velocity: wrong } }), /^motionA\.velocity: .*(NaN|Infinity)/) instanceof RangeError, String(wrong));
      }
      ok(throws(() => ccd.firstContact(ball, ball, { motionA: { rotation: [0, 0, 0, 0] } }), /^motionA\.rotation: .*length zero/) instanceof RangeError, "zero");
      // Three angles in an order are not a vector.
      class Euler {
        constructor() {
          Object.assign(this, { isEuler: true, x: 1, y: 2, z: 3, order: "XYZ" });
        }
      }
      ok(throws(() => ccd.firstContact(ball, ball, { motionA: { angularVelocity: new Euler() } }), /^motionA\.angularVelocity: .*not an object of Euler/) instanceof TypeError, "angles");
      const path = (end) => new ccd.PosePath([0, end], [{}, {}]);
      throws(() => ccd.closestApproach(ball, ball, { motionA: path(1), motionB: path(2) }), /end at different times/);
      throws(() => ccd.closestApproach(ball, ball, { motionA: path(1), motionB: { angularVelocity: "fast" } }), /motionB\.angularVelocity/);
      const freed = path(1);
      freed.free();
      throws(() => ccd.closestApproach(ball, ball, { motionA: path(1), motionB: freed }), /this PosePath was freed/);
      // After an error, no movement remains for the next question.
      equal(ccd.firstContact(ball, ball, { motionA: { position: [5, 0, 0] } }).kind, "free");
    },
  };
};
