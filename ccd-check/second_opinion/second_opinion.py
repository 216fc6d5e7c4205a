#!/usr/bin/env python3
"""A second checker of proofs that two moving meshes stay apart, written from ccd-check/README.md alone.

Its numbers are intervals of integers in 2^-96, lengths in a power of two of its own choice, times in parts
of the whole time. So it reads the units in the header of a proof and does not use them. The height of a node
is the exact least height of the corners below it; boxes along the axes of the mesh only say which corners
need no look. So it reads the axes of the nodes and does not use them.
"""
import argparse, functools, hashlib, heapq, struct, sys
from fractions import Fraction
from math import isqrt
F, ONE = 96, 1 << 96         # an integer i stands for i / 2^96
ZERO3 = [(0, 0)] * 3
MAX_TURN = 512               # radians in the whole time
MAX_DEPTH = 64
MAX_QUATERNION_ERROR = Fraction(1, 1 << 20)   # of |q|^2
# ---- intervals: (lo, hi) is all numbers from lo / 2^96 to hi / 2^96 ----
def fix(x):   # the least interval around a fraction
    n = x.numerator << F
    return n // x.denominator, -(-n // x.denominator)

def mul(a, b):
    four = a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]
    return min(four) >> F, -(-max(four) >> F)

def mul_up(a, b): return -(-a * b >> F)                      # of bounds that are no intervals
def shift_down(x, s): return x >> s if s >= 0 else x << -s   # floor(x / 2^s)
def add(a, b): return a[0] + b[0], a[1] + b[1]
def sub(a, b): return a[0] - b[1], a[1] - b[0]
def vadd(u, v): return [add(a, b) for a, b in zip(u, v)]
def vsub(u, v): return [sub(a, b) for a, b in zip(u, v)]
def scale(v, a): return [mul(x, a) for x in v]
def dot(u, v): return functools.reduce(add, map(mul, u, v))
def matvec(m, v): return [dot(row, v) for row in m]
def transpose(m): return [list(row) for row in zip(*m)]
def cross(u, v): return [sub(mul(u[i], v[j]), mul(u[j], v[i])) for i, j in ((1, 2), (2, 0), (0, 1))]
def root_up(n): return isqrt(n - 1) + 1 if n > 0 else 0      # the least integer with a square >= n
def length_up(v): return root_up(sum(max(-a[0], a[1]) ** 2 for a in v))   # no vector in the box v is longer
# ---- rotations ----
def series(q, k):
    """An interval around the sum over j of (-q)^j / (2j + k)!; for q = x^2 and k = 1, 2 it is
    sin x / x and (1 - cos x) / x^2. No term is more than e^x < 2^(2x), and that many more bits are kept.
    The signs alternate. Once q is less than the divisor d the terms get smaller, so what is left out is
    no more than its first term."""
    bits = F + 32 + 2 * root_up(-(-q.numerator // q.denominator))
    q_lo, q_hi = (q.numerator << bits) // q.denominator, -(-(q.numerator << bits) // q.denominator)
    low = high = (1 << bits) // k                   # the bounds of a term without its sign
    total, j, d = (0, 0), 0, 0
    while high > 2 or q_hi >= d << bits:
        total = (sub if j & 1 else add)(total, (low, high))
        j, d = j + 1, (2 * j + k + 1) * (2 * j + k + 2)
        low, high = low * q_lo // (d << bits), -(-high * q_hi // (d << bits))
    return (total[0] - high) >> (bits - F), -(-(total[1] + high) >> (bits - F))

def start_rotation(q):
    """Intervals around the rows of R0, the rotation of q / |q|."""
    (x, y, z, w), s = q, 2 / sum(c * c for c in q)
    rows = [[1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
            [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
            [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)]]
    return [[fix(entry) for entry in row] for row in rows]
# ---- files ----
class Fails(Exception):
    """Ends a check: (verdict, reason)."""

class Reader:
    def __init__(self, path, magic=b""):
        self.path, self.pos = path, 0
        with open(path, "rb") as f:
            self.data = f.read()
        self.require(self.data.startswith(magic), 0, "the file is of another kind")
        self.pos = len(magic)

    def require(self, condition, pos, reason, verdict="broken"):
        if not condition:
            raise Fails(verdict, f"byte {pos} of {self.path}: {reason}")

    def take(self, form):
        """The next values; `form` is in the letters of struct."""
        size = struct.calcsize("<" + form)
        self.require(self.pos + size <= len(self.data), self.pos, "the file ends too early")
        self.pos += size
        return struct.unpack_from("<" + form, self.data, self.pos - size)

    def numbers(self, count):
        """The next binary64, each as the fraction it is."""
        out = []
        for i, b in enumerate(self.take(f"{count}Q")):
            exponent, m = b >> 52 & 2047, b & (1 << 52) - 1
            self.require(exponent < 2047, self.pos - 8 * (count - i), "a number is not finite", "unverifiable")
            m, e = (m | 1 << 52 if exponent else m), max(exponent, 1) - 1075
            out.append(Fraction((-m if b >> 63 else m) << max(e, 0), 1 << max(-e, 0)))
        return out

class Mesh:
    """Vertices as exact integers in 2^-bits, and triangles."""
    def __init__(self, path):
        r = Reader(path)
        self.digest, (vertices, triangles) = hashlib.sha256(r.data).digest(), r.take("II")
        r.require(len(r.data) == 8 + 24 * vertices + 12 * triangles > 8 + 24 * vertices, 0, "the counts are wrong")
        flat = r.numbers(3 * vertices)
        self.bits = max([0] + [x.denominator.bit_length() - 1 for x in flat])
        flat, corners = [int(x * (1 << self.bits)) for x in flat], r.take(f"{3 * triangles}I")
        r.require(max(corners) < vertices, 8 + 24 * vertices, "a corner of a triangle is no vertex")
        self.vertices = list(zip(flat[0::3], flat[1::3], flat[2::3]))
        self.triangles = list(zip(corners[0::3], corners[1::3], corners[2::3]))

class Tree:
    """The nodes of a body. A part is a node i >= 0, or ~place < 0 of a triangle in the order."""
    def __init__(self, path, mesh):
        self.mesh, r, count = mesh, Reader(path, b"CCDBODY1"), len(mesh.triangles)
        r.require(r.take("32s")[0] == mesh.digest, 8, "this is the certificate of another mesh")
        self.order = r.take(f"{count}I")
        r.require(sorted(self.order) == list(range(count)), 40, "the order does not have each triangle once")
        children, own, parents, used = [], [], [(-1, 1)], 0   # parents: of each node still to be read, and its level
        while parents:
            below, triangles = r.take("BB9h")[:2]
            r.require((below == 0) != (triangles == 0), r.pos - 20, "the node has both or neither of children and triangles")
            r.require(used + triangles <= count, r.pos - 20, "the nodes have more triangles than the mesh")
            node, (parent, level) = len(children), parents.pop()
            r.require(level <= MAX_DEPTH, r.pos - 20, "the tree has too many levels")
            if parent >= 0:
                children[parent].append(node)
            children.append([])
            own.append([~i for i in range(used, used + triangles)])
            used += triangles
            parents += [(node, level + 1)] * below
        r.require(used == count, r.pos, "some triangles are in no node")
        r.require(r.pos == len(r.data), r.pos, "bytes follow the end")
        self.parts = [c + o for c, o in zip(children, own)]   # one of both is empty

@functools.lru_cache(2)
class Body:
    """Corners as seen from the centre of rotation, z = y - c, exact in 2^-bits. The size of a part is
    a box, least x y z and greatest x y z, and the greatest |z|^2."""
    def __init__(self, tree, centre):
        mesh, self.parts, self.sizes = tree.mesh, tree.parts, {}
        self.bits = max([mesh.bits] + [c.denominator.bit_length() - 1 for c in centre])
        up, (cx, cy, cz) = self.bits - mesh.bits, [int(c * (1 << self.bits)) for c in centre]
        seen = [((x << up) - cx, (y << up) - cy, (z << up) - cz) for x, y, z in mesh.vertices]
        self.corners = [[seen[c] for c in mesh.triangles[t]] for t in tree.order]
        for i, c in enumerate(self.corners):
            self.sizes[~i] = [f(v) for f in (min, max) for v in zip(*c)], max(x * x + y * y + z * z for x, y, z in c)
        for node in reversed(range(len(self.parts))):   # children have greater numbers
            boxes, far = zip(*[self.sizes[p] for p in self.parts[node]])
            self.sizes[node] = [f(v) for f, v in zip([min] * 3 + [max] * 3, zip(*boxes))], max(far)

    def lowest(self, part, m):
        """The least m . z of the corners z below the part, exactly. The part of the lowest bound is
        opened, until that is a triangle, whose bound is its height."""
        mx, my, mz = m
        ix, iy, iz = (i if c >= 0 else i + 3 for i, c in enumerate(m))   # the lowest corner of any box
        def bound(p):
            if p < 0:
                return min(mx * x + my * y + mz * z for x, y, z in self.corners[~p]), p
            box = self.sizes[p][0]
            return mx * box[ix] + my * box[iy] + mz * box[iz], p
        heap = [bound(part)]
        while heap[0][1] >= 0:
            for p in self.parts[heapq.heappop(heap)[1]]:
                heapq.heappush(heap, bound(p))
        return heap[0][0]
# ---- the lemma ----
class Moving:
    """A body and its motion. Lengths are in 2^exponent, times in the whole time `end`."""
    def __init__(self, body, motion, end, exponent):
        (p, q, v, w, c), unit = motion, Fraction(2) ** exponent
        self.body, self.shift, self.backs, self.omega = body, body.bits + exponent, {}, [x * end for x in w]
        start = start_rotation(q)
        self.w, self.v, self.columns = [fix(x) for x in self.omega], [fix(x * end / unit) for x in v], transpose(start)
        self.centre = vadd([fix(x / unit) for x in p], matvec(start, [fix(x / unit) for x in c]))

    def back(self, time):
        """The transpose of R = exp([a]x) R0 at time / 2^96 of the whole, a = time w. Its rows are the
        columns x of R0, turned: x + sin|a| / |a| a x x + (1 - cos|a|) / |a|^2 a x (a x x)."""
        if time not in self.backs:
            a = [x * Fraction(time, ONE) for x in self.omega]
            q, a = sum(x * x for x in a), [fix(x) for x in a]
            s, c = series(q, 1), series(q, 2)
            self.backs[time] = [vadd(x, vadd(scale(cross(a, x), s), scale(cross(a, cross(a, x)), c)))
                                for x in self.columns]
        return self.backs[time]

    def heights(self, part, time, h, n, delta):
        """Lower bounds of (n + s n x delta) . z(0) for all z of the part, at s = h and at s = -h. In the
        coordinates of the mesh the direction is an integer vector m and an error of at most e in each
        coordinate. So the height is no less than m . z - the sum of e |z|."""
        back, box, out = self.back(time), self.body.sizes[part][0], []
        w, tilt = matvec(back, n), matvec(back, scale(cross(n, delta), (h, h)))
        for v in [w] if tilt == ZERO3 else [vadd(w, tilt), vsub(w, tilt)]:
            m = [lo + hi >> 1 for lo, hi in v]
            error = sum((v[i][1] - m[i]) * max(-box[i], box[i + 3]) for i in range(3))
            out.append(shift_down(self.body.lowest(part, m) - error, self.shift))
        return out[0], out[-1]

def leaf(a, b, margin, pa, pb, t0, t1, axis, frame):
    """Whether the lemma proves parts pa and pb farther apart than the margin from t0 to t1."""
    time, h = (t0 + t1) // 2, (t1 - t0) // 2        # exact, as t0 and t1 are even
    n, d, phi = [(x, x) for x in axis], vsub(b.v, a.v), frame.w if frame else ZERO3
    p, step = vadd(vsub(b.centre, a.centre), scale(d, (time, time))), scale(d, (h, h))
    # P moves straight, so |P| is greatest at an end of the stretch.
    far, f = max(length_up(vadd(p, step)), length_up(vsub(p, step))), length_up(phi)
    k = mul_up(mul_up(f, f), far) + 2 * mul_up(f, length_up(d))
    start, slope = dot(n, p), mul((h, h), add(dot(cross(phi, n), p), dot(n, d)))
    ends = [start[0] + slope[0], start[0] - slope[1]]
    for x, part, side in ((a, pa, vsub(ZERO3, n)), (b, pb, n)):
        delta = ZERO3 if x is frame else vsub(x.w, phi)   # exactly 0 for the body the axis turns with
        # The radius of the part is rounded up; 64 more bits make the root fine enough for whole numbers.
        r = -shift_down(-root_up(x.body.sizes[part][1] << 128), x.shift + 64 - F)
        k += mul_up(mul_up(length_up(delta), f + length_up(x.w)), r)
        ends = [e + low for e, low in zip(ends, x.heights(part, time, h, side, delta))]
    return min(ends) + (-mul_up(h, h) * k >> F + 1) > margin
# ---- a proof ----
def check(path, trees):
    """Returns what holds, or raises Fails."""
    r = Reader(path, b"CCDPROOF")
    r.take("ii")                                    # the units of the first checker
    for name, tree in zip("AB", trees):
        r.require(r.take("32s")[0] == tree.mesh.digest, r.pos - 32, f"the mesh of {name} is another one")
    motions = [[r.numbers(c) for c in (3, 4, 3, 3, 3)] for _ in trees]
    end, margin = r.numbers(2)
    r.require(end >= 0 and margin >= 0, r.pos - 16, "the time or the margin is negative")
    claim, witnesses = r.take("B")[0], []
    r.require(claim < 2, r.pos - 1, "there is no such claim")
    if claim == 1:
        tolerance, = r.numbers(1)
        for tree in trees:
            place, *weights = r.take("3I")
            weights.append((1 << 31) - sum(weights))
            r.require(place < len(tree.order), r.pos - 12, "there is no such triangle")
            r.require(weights[2] >= 0, r.pos - 8, "the weights add to more than one")
            witnesses.append((place, weights))
    bodies = [Body(tree, tuple(m[4])) for tree, m in zip(trees, motions)]
    largest = max([abs(x) for m in motions for x in m[0] + m[4] + [y * end for y in m[2]]] +
                  [Fraction(abs(x), 1 << y.bits) for y in bodies for x in y.sizes[0][0]])
    exponent = largest.numerator.bit_length() - largest.denominator.bit_length() + 1
    for i, (_, q, _, w, _) in enumerate(motions):
        r.require(abs(sum(x * x for x in q) - 1) <= MAX_QUATERNION_ERROR, 104 + 128 * i, "the quaternion is not 1 long")
        r.require(sum((x * end) ** 2 for x in w) <= MAX_TURN ** 2, 160 + 128 * i, "it turns too far", "unverifiable")
    unit, (a, b) = Fraction(2) ** exponent, [Moving(y, m, end, exponent) for y, m in zip(bodies, motions)]
    if claim == 1:
        gap = vadd(vsub(b.centre, a.centre), vsub(b.v, a.v))
        for x, (place, weights), sign in zip((a, b), witnesses, (vsub, vadd)):
            z = [sum(w * c for w, c in zip(weights, three)) for three in zip(*x.body.corners[place])]
            z = [fix(Fraction(c, 1 << 31 + x.body.bits) / unit) for c in z]
            gap = sign(gap, matvec(transpose(x.back(ONE)), z))
        r.require(length_up(gap) <= fix((margin + tolerance) / unit)[0], r.pos - 32, "the witnesses are too far apart")
    todo, leaves = [(0, 0, 0, ONE)], 0              # the last one is the next one: depth first
    while todo:
        (pa, pb, t0, t1), at = todo.pop(), r.pos
        r.require(at < len(r.data), at, f"the file ends, and {len(todo) + 1} parts are not proven")
        step, = r.take("B")
        r.require(step <= 8, at, "there is no such step")
        if step < 2:
            r.require((pa, pb)[step] >= 0, at, "a triangle can not be split")
            below = reversed(trees[step].parts[(pa, pb)[step]])
            todo += [(pa, q, t0, t1) if step else (q, pb, t0, t1) for q in below]
        elif step == 2:
            middle = t0 + ((t1 - t0) * r.take("H")[0] >> 17 << 1)   # even; both parts have this very time
            r.require(t0 < middle < t1, at, "a part of the time is empty")
            todo += [(pa, pb, middle, t1), (pa, pb, t0, middle)]
        else:
            form, bits = ("3h", 14) if step < 6 else ("3i", 30)
            axis, frame = r.take(form), (None, a, b)[(step - 3) % 3]
            r.require(sum(x * x for x in axis) <= 1 << 2 * bits, at, "the axis is longer than 1")
            r.require(leaf(a, b, fix(margin / unit)[1], pa, pb, t0, t1, [x << F - bits for x in axis], frame),
                      at, "the axis does not prove the parts apart")
            leaves += 1
    r.require(r.pos == len(r.data), r.pos, "bytes follow the end")
    return f"{('free', 'contact')[claim]}, {leaves} leaves"

def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("--a", "--b"):
        parser.add_argument(name, nargs=2, required=True, metavar=("MESH", "BODY_CERTIFICATE"))
    parser.add_argument("proofs", nargs="+", metavar="PROOF")
    arguments, all_hold = parser.parse_args(argv), True
    load = functools.cache(lambda mesh, tree: Tree(tree, Mesh(mesh)))
    for path in arguments.proofs:
        try:
            verdict, reason = "holds", check(path, [load(*arguments.a), load(*arguments.b)])
        except Fails as e:
            verdict, reason = e.args
        except OSError as e:
            verdict, reason = "unverifiable", f"{e.filename}: {e.strerror}"
        print(f"{path}: {verdict}: {reason}", flush=True)
        all_hold = all_hold and verdict == "holds"
    return 0 if all_hold else 1

if __name__ == "__main__":
    sys.exit(main())
