#!/usr/bin/env python3
"""A second checker of proofs that moving meshes stay apart, written from proofs/ccd-check/README.md alone.

It computes with intervals of integers of any size, in multiples of 2^-128 of the units of a proof. The projection of
a node onto a direction is exact: the minimum over the balls of its corners. The search for it skips a node if its
bounding box cannot have the minimum. The distance of a node from a point is the distance of its bounding boxes. Only
the lemmas limit the length of an interval of time."""
import argparse, functools, hashlib, heapq, itertools, operator, pathlib, struct, sys
from fractions import Fraction
from math import isfinite, isqrt
F, ONE, ZERO, ZERO3 = 128, 1 << 128, [Fraction(0)] * 3, [(0, 0)] * 3   # an integer i stands for i / 2^128
MAX_ANGLE, MAX_CHAIN, MAX_UNIT = 512, 200, 1200   # radians at the start, and of the motion; links; exponents of units
# ---- intervals: (lo, hi) contains all numbers from lo / 2^128 to hi / 2^128 ----
def fix(x): return (x.numerator << F) // x.denominator, -((-x.numerator << F) // x.denominator)   # around x
def mul(a, b):
    four = a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]
    return min(four) >> F, -(-max(four) >> F)
def mul_up(a, b): return -(-a * b >> F)                      # for upper bounds
def shift_down(x, s): return x >> s if s >= 0 else x << -s   # floor(x / 2^s)
def shift_up(x, s): return -shift_down(-x, s)
def add(a, b): return a[0] + b[0], a[1] + b[1]
def sub(a, b): return a[0] - b[1], a[1] - b[0]
def vadd(u, v): return [add(a, b) for a, b in zip(u, v)]
def vsub(u, v): return [sub(a, b) for a, b in zip(u, v)]
def scale(v, a): return [mul(x, a) for x in v]
def dot(u, v): return functools.reduce(add, map(mul, u, v))
def matvec(m, v): return [dot(row, v) for row in m]
def transpose(m): return [list(row) for row in zip(*m)]
def cross(u, v): return [sub(mul(u[i], v[j]), mul(u[j], v[i])) for i, j in ((1, 2), (2, 0), (0, 1))]
def root_up(n): return isqrt(n - 1) + 1 if n > 0 else 0      # the least integer whose square is >= n
def length_up(v): return root_up(sum(max(-a[0], a[1]) ** 2 for a in v))   # the largest length of a vector in the box v
def plus(u, v, factor=1): return [a + factor * b for a, b in zip(u, v)]   # for fractions

def series(q, k):
    """Returns an interval that contains the sum over j of (-q)^j / (2j + k)!. For q = x^2 it is sin x / x if k = 1,
    and (1 - cos x) / x^2 if k = 2. A term is at most e^x < 2^(2x), so it has 2x more bits. Terms decrease from the
    first one with q < d."""
    bits = F + 32 + 2 * root_up(-(-q.numerator // q.denominator))
    q_lo, q_hi = (q.numerator << bits) // q.denominator, -(-(q.numerator << bits) // q.denominator)
    total, j, d, low, high = (0, 0), 0, 0, *[(1 << bits) // k] * 2   # low and high bound the absolute value of a term
    while high > 2 or q_hi >= d << bits:
        total = (sub if j & 1 else add)(total, (low, high))
        j, d = j + 1, (2 * j + k + 1) * (2 * j + k + 2)
        low, high = low * q_lo // (d << bits), -(-high * q_hi // (d << bits))
    return (total[0] - high) >> (bits - F), -(-(total[1] + high) >> (bits - F))
# ---- files ----
class Fails(Exception): """Ends a check with (verdict, reason)."""

class Reader:
    def __init__(self, path, signature=b""):
        self.path, self.pos, self.data = path, len(signature), pathlib.Path(path).read_bytes()
        self.require(self.data.startswith(signature), 0, "the file is of another kind")
    def require(self, condition, pos, reason, verdict="broken"):
        if not condition: raise Fails(verdict, f"byte {pos} of {self.path}: {reason}")
    def take(self, layout):
        """Reads the next values. `layout` is a format string of the module struct."""
        size = struct.calcsize("<" + layout)
        self.require(self.pos + size <= len(self.data), self.pos, "the file ends too early")
        self.pos += size
        return struct.unpack_from("<" + layout, self.data, self.pos - size)
    def numbers(self, count):
        """Reads binary64 numbers as exact fractions."""
        out = self.take(f"{count}d")
        self.require(all(map(isfinite, out)), self.pos - 8 * count, "a number is not finite", "unverifiable")
        return [Fraction(x) for x in out]
    def at_least_0(self, name):
        x, = self.numbers(1)
        self.require(x >= 0, self.pos - 8, f"the {name} is negative")
        return x
    def one_of(self, choices, name):
        i, = self.take("I")
        self.require(i < len(choices), self.pos - 4, f"there is no such {name}")
        return choices[i]

class Tree:
    """A mesh and its tree. A vertex is x, y, z and its radius, as exact integers in multiples of 2^-bits. The triangles
    are in the order of the tree. A node is given by its index in the file. Its triangles are a range of this order."""
    def __init__(self, mesh, tree):
        r = Reader(mesh)
        digest, (vertices, count) = hashlib.sha256(r.data).digest(), r.take("II")
        r.require(len(r.data) == 8 + 32 * vertices + 12 * count > 8 + 32 * vertices, 0, "the counts are wrong")
        numbers, corners = r.numbers(4 * vertices), r.take(f"{3 * count}I")
        r.require(max(corners) < vertices, 8 + 32 * vertices, "a corner of a triangle is no vertex")
        r.require(min(numbers[3::4]) >= 0, 8, "the radius of a vertex is negative")
        self.bits = max(x.denominator.bit_length() - 1 for x in numbers)
        self.vertices = list(zip(*[(int(x * (1 << self.bits)) for x in numbers)] * 4))
        r = Reader(tree, b"CCDBODY1")
        r.require(r.take("32s")[0] == digest, 8, "this is the certificate of another mesh")
        order, self.ranges, self.children, stack = [], [], [], [count]   # the numbers of triangles of nodes to read
        while stack:
            size, (number,), node = stack.pop(), r.take("I"), len(self.ranges)
            r.require(size == 1 or 0 < number < size, r.pos - 4, "a node has no triangle")
            self.ranges.append((len(order), len(order) + size))
            self.children.append((node + 1, node + 2 * number) if size > 1 else ())   # k triangles have 2 k - 1 nodes
            if size > 1: stack += [size - number, number]
            else: order.append(number)
        r.require(sorted(order) == list(range(count)), 40, "the tree does not have each triangle once")
        self.triangles = [corners[3 * t:3 * t + 3] for t in order]
        r.require(r.pos == len(r.data), r.pos, "bytes follow the end")
# ---- links and bodies ----
class Link:
    """A link and its motion relative to its parent `up`, in exact fractions. In the frame of the parent, at time t, the
    vector from the center of the parent to the center of the link is position + t rate. The rotation of the link is R0,
    followed by the rotation vector rotation_start + t rotation_rate."""
    center = position = rate = rotation_start = rotation_rate = ZERO     # the values of the world
    columns = [[(ONE * (i == j),) * 2 for i in range(3)] for j in range(3)]   # the columns of R0
    def __init__(self, up=None):
        self.up, self.chain = up, (up.chain if up else []) + [self]   # from the world to this link
    def read(self, r, length, time):
        r.require(len(self.chain) <= MAX_CHAIN, r.pos, "the chain is too long", "unverifiable")
        p, q = r.numbers(3), r.numbers(4)
        r.require(abs(sum(c * c for c in q) - 1) <= Fraction(1, 1 << 20), r.pos - 32, "the quaternion is not 1 long")
        (x, y, z, w), s = q, 2 / sum(c * c for c in q)   # the rotation of q / |q|, exactly
        rows = [[1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
                [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
                [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)]]
        self.columns = [[fix(entry) for entry in column] for column in zip(*rows)]
        def rotate(v): return [sum(a * b for a, b in zip(row, v)) for row in rows]
        self.center, (axes,), v, a, (alpha, beta) = r.numbers(3), r.take("I"), *map(r.numbers, (3, 3, 2))
        r.require(axes < 2, r.pos - 68, "there are no such axes")
        if axes: v, a = rotate(v), rotate(a)
        position = plus(plus(plus(p, rotate(self.center)), v, alpha), self.up.center, -1)
        self.position, self.rate = plus(ZERO, position, 1 / length), plus(ZERO, v, beta * time / length)
        self.rotation_start, self.rotation_rate = plus(ZERO, a, alpha), plus(ZERO, a, beta * time)
        return self
    @functools.lru_cache(1 << 14)
    def pose(self, t):
        """Returns, in the coordinates of the world at time t: the columns of the rotation, the vector from the center
        of the parent to the center of the link, the rate of that vector, and the rotation rate of the joint. The
        rotation vector a rotates a column v of R0 to v + sin|a| / |a| a x v + (1 - cos|a|) / |a|^2 a x (a x v)."""
        a = plus(self.rotation_start, self.rotation_rate, t)
        up = transpose(self.up.pose(t)[0]) if self.up else self.columns
        q, a = sum(x * x for x in a), [fix(x) for x in a]
        s, c = series(q, 1), series(q, 2)
        columns = [vadd(x, vadd(scale(cross(a, x), s), scale(cross(a, cross(a, x)), c))) for x in self.columns]
        vectors = plus(self.position, self.rate, t), self.rate, self.rotation_rate
        return [matvec(up, x) for x in columns], *[matvec(up, [fix(x) for x in v]) for v in vectors]
class Body:
    """A tree on a link. Corners are relative to the center of the link, z = y - c, as exact integers in multiples of
    2^-bits. The unit of length, 2^exponent, is 2^shift of these, with a shift >= 0. The extent of a node is the
    least x, y, z, the greatest x, y, z, the greatest |z|^2, and the greatest radius of its corners."""
    def __init__(self, tree, link, exponent):
        self.link, self.bits = link, max([tree.bits, -exponent] + [c.denominator.bit_length() - 1 for c in link.center])
        up, center = self.bits - tree.bits, [int(c * (1 << self.bits)) for c in (*link.center, Fraction(0))]
        vertices = [[(x << up) - c for x, c in zip(v, center)] for v in tree.vertices]
        self.corners, self.shift = [[vertices[c] for c in t] for t in tree.triangles], self.bits + exponent
        self.ranges, self.children, self.extent = tree.ranges, tree.children, functools.cache(self.extent)
    def extent(self, node):
        extents = [self.extent(child) for child in self.children[node]] or [
            (x, y, z, x, y, z, x * x + y * y + z * z, ball) for x, y, z, ball in self.corners[self.ranges[node][0]]]
        return [f(v) for f, v in zip([min] * 3 + [max] * 5, zip(*extents))]
    @functools.lru_cache(1)                         # without a rotation both ends of an interval have one direction
    def lowest(self, node, mx, my, mz):
        """Returns the exact minimum of m . z - |ball| over the corners of a node, in multiples of 2^-(128 + bits). The
        length of the normal n is at most 1, so a ball is at most its radius below its center. The search splits the
        node with the least bound, until it is a single triangle. The bound of a triangle is exact."""
        lowest_of_box = operator.itemgetter(*(i if c >= 0 else i + 3 for i, c in enumerate((mx, my, mz))), 7)
        def bound(p):
            corners = [lowest_of_box(self.extent(p))] if self.children[p] else self.corners[self.ranges[p][0]]
            return min(mx * x + my * y + mz * z - (ball << F) for x, y, z, ball in corners), p
        heap = [bound(node)]
        while self.children[heap[0][1]]:
            for p in self.children[heapq.heappop(heap)[1]]:
                heapq.heappush(heap, bound(p))
        return heap[0][0]
    def is_beyond(self, node, point, limit):
        """Returns whether all boxes of a node are farther than the limit from the point, in 2^-(128 + bits)."""
        *box, _, ball = self.extent(node)
        gaps = [max((low << F) - hi, lo - (high << F), 0) for low, high, (lo, hi) in zip(box, box[3:], point)]
        return sum(gap * gap for gap in gaps) > (limit + (ball << F)) ** 2 or (
            self.children[node] != () and all(self.is_beyond(p, point, limit) for p in self.children[node]))
# ---- the lemmas ----
@functools.lru_cache(1 << 14)
def motion(frame, link, t, h):
    """Returns P, P', Omega, K and K' of the lemmas for a link relative to `frame`. The interval of time has the
    middle t and the half-length h. The bounds K and K' are rounded up. Joints on the way up have the opposite sign."""
    up, down, common = frame.chain, link.chain, sum(a is b for a, b in zip(frame.chain, link.chain))
    position, velocity, omega, theta, k = ZERO3, ZERO3, ZERO3, 0, 0
    for move, x in [(vsub, x) for x in up[:common - 1:-1]] + [(vadd, x) for x in down[common:]]:
        _, offset, rate, joint = x.pose(t)
        rate, joint = scale(rate, h), scale(joint, h)
        # The offset rotates with the parent: on the way up the joint comes before the offset, on the way down after it.
        before, after = (joint, ZERO3) if move is vsub else (ZERO3, joint)
        omega, theta = vsub(omega, before), theta + length_up(before)
        position, velocity = move(position, offset), move(velocity, vadd(cross(omega, offset), rate))
        m = length_up(rate)
        k += mul_up(mul_up(theta, theta), length_up(offset) + m) + 2 * mul_up(theta, m)
        omega, theta = vadd(omega, after), theta + length_up(after)
    return position, velocity, omega, k, mul_up(theta, theta)
def distance_bound(body, node, frame, t, h, n, d):
    """Returns a lower bound of h of Lemma 1 for all balls of a node over the interval of time. The plane n . x = d
    rotates with the link `frame`, and x is relative to the center of that link."""
    extent, (position, velocity, omega, k, factor) = body.extent(node), motion(frame, body.link, t, h)
    r = root_up(shift_up(extent[6], 2 * (body.shift - F)))   # an upper bound of |z|
    # In the coordinates of the mesh, n + s n x Omega is an integer vector m with an error of at most e in each
    # coordinate, for s = 1 and s = -1. So its product with z is at least m . z minus the sum of e |z|.
    back, center_term, velocity, ends = body.link.pose(t)[0], dot(n, position), dot(n, velocity), []
    w, tilt = matvec(back, n), matvec(back, cross(n, omega))
    for v, rise in (vadd(w, tilt), velocity[0]), (vsub(w, tilt), -velocity[1]):
        m = [lo + hi >> 1 for lo, hi in v]
        error = sum((v[i][1] - m[i]) * max(-extent[i], extent[i + 3]) for i in range(3))
        ends.append(rise + shift_down(body.lowest(node, *m) - error, body.shift))
    return center_term[0] - d + min(ends) - (k + mul_up(factor, r) + 1 >> 1)
def is_beyond_ball(body, node, other, other_node, t, h, margin):
    """Returns whether the bounding ball of a node stays farther than the margin from another node (README, Balls)."""
    extent, (position, velocity, omega, k, factor) = body.extent(node), motion(other.link, body.link, t, h)
    twice, s = [low + high for low, high in zip(extent, extent[3:6])], body.shift + 1 - F   # for lengths in 2^-bits
    corners = itertools.chain(*body.corners[slice(*body.ranges[node])])
    max_square = max(sum((2 * x - c) ** 2 for x, c in zip(v, twice)) for v in corners)
    r = root_up(shift_up(max_square, 2 * s)) + shift_up(extent[7], s - 1)
    z = matvec(transpose(body.link.pose(t)[0]), [(shift_down(c, s), shift_up(c, s)) for c in twice])
    m = length_up(vadd(velocity, cross(omega, z))) + (k + mul_up(factor, length_up(z)) + 1 >> 1)
    point = [(lo << other.shift, hi << other.shift) for lo, hi in matvec(other.link.pose(t)[0], vadd(position, z))]
    return other.is_beyond(other_node, point, r + m + margin << other.shift)
# ---- a proof ----
def check(path, tree_of):
    """Returns a summary of a proof that holds, or raises Fails. `tree_of` finds the tree of a digest."""
    r = Reader(path, b"CCDPROF1")
    *units, link_count, body_count, pair_count = r.take("iiIII")
    r.require(max(map(abs, units)) <= MAX_UNIT, 8, "a unit is out of range", "unverifiable")
    (length, time), links = (Fraction(2) ** e for e in units), [Link()]
    for _ in range(link_count):
        links.append(Link(r.one_of(links, "link before this one")).read(r, length, time))
    bodies = [Body(tree_of(*r.take("32s")), r.one_of(links, "link"), units[0]) for _ in range(body_count)]
    pairs = [([r.one_of(bodies, "body") for _ in "AB"], r.at_least_0("margin") / length) for _ in range(pair_count)]
    def require_range(t):                           # t is the latest time of the statement
        r.require(t <= 1, r.pos - 8, "the unit of time is less than the time", "unverifiable")
        for v, f in [vf for x in links for vf in ((x.rotation_start, 1), (x.rotation_rate, t))]:
            is_in_range = sum((f * x) ** 2 for x in v) <= MAX_ANGLE ** 2
            r.require(is_in_range, r.pos - 8, "a link rotates too far", "unverifiable")
    until = r.at_least_0("time") / time
    require_range(until)
    (witnesses,), leaves = r.take("I"), 0
    r.require(witnesses < 2, r.pos - 4, "there is more than one witness")
    for _ in range(witnesses):
        (pair_bodies, max_distance), t = r.one_of(pairs, "pair"), r.at_least_0("time of the witness") / time
        pos = r.pos - 8
        require_range(t)
        max_distance += r.at_least_0("tolerance") / length
        gap = motion(pair_bodies[0].link, pair_bodies[1].link, t, (0, 0))[0]
        for body, move in zip(pair_bodies, (vsub, vadd)):   # the gap is between centers, so its limit has the radii
            corners = r.one_of(body.corners, "triangle")
            weights = [int.from_bytes(x, "little") for x in r.take("7s7s7s")]
            r.require(sum(weights) == 1 << 55, r.pos - 21, "the weights do not add up to 1")
            *z, ball = [sum(map(int.__mul__, weights, c)) / (length * (1 << 55 + body.bits)) for c in zip(*corners)]
            gap = move(gap, matvec(transpose(body.link.pose(t)[0]), [fix(x) for x in z]))
            max_distance += ball
        r.require(length_up(gap) <= fix(max_distance)[0], pos, "the witnesses are too far apart")
    for number, (pair_bodies, margin) in enumerate(pairs):
        half, stack = fix(margin / 2)[1], [((0, 0), 0, int(until * (1 << 60)) + 1)]   # the last entry is next
        while stack:
            (nodes, t0, t1), pos = stack.pop(), r.pos
            r.require(pos < len(r.data), pos, f"the file ends, and {len(stack) + 1} entries are not proven")
            step, = r.take("B")
            r.require(step <= 7, pos, "there is no such step")
            middle = (t0 + t1) // 2                 # in multiples of 2^-60 of the unit of time
            t, h, leaves = Fraction(middle, 1 << 60), (t1 - middle << F - 60,) * 2, leaves + (step > 2)
            if step < 2:
                r.require(split := pair_bodies[step].children[nodes[step]], pos, "a triangle cannot be split")
                stack += [((nodes[0], p) if step else (p, nodes[1]), t0, t1) for p in reversed(split)]
            elif step == 2:
                r.require(t0 < middle, pos, "a time is too short to be split")
                stack += [(nodes, middle, t1), (nodes, t0, middle)]
            elif step < 6:
                *n, d = [int.from_bytes(x, "little", signed=True) for x in r.take("7s7s7s7s")]
                frame = (links[0], pair_bodies[0].link, pair_bodies[1].link)[step - 3]
                bounds = [distance_bound(body, node, frame, t, h, [(side * x << F - 50,) * 2 for x in n], side * d << F)
                           for body, node, side in zip(pair_bodies, nodes, (-1, 1))]   # A has -n and -d
                proves = sum(x * x for x in n) <= 1 << 100 and min(bounds) > half   # n is at most 1 long
                r.require(proves, pos, f"the plane does not prove the nodes of pair {number} apart")
            else:
                ball_node, other = [(pair_bodies[i], nodes[i]) for i in (step - 6, 7 - step)]
                is_far = is_beyond_ball(*ball_node, *other, t, h, 2 * half)
                r.require(is_far, pos, f"the ball around {'AB'[step - 6]} of pair {number} is too near the other node")
    r.require(r.pos == len(r.data), r.pos, "bytes follow the end")
    return f"pairs: {len(pairs)}, leaves: {leaves}, witnesses: {witnesses}"
def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mesh", nargs=2, action="append", default=[], metavar=("MESH", "BODY_CERTIFICATE"))
    parser.add_argument("proofs", nargs="+", metavar="PROOF")
    arguments, all_hold = parser.parse_args(argv), True
    @functools.cache
    def tree_of(digest):
        for mesh, tree in arguments.mesh:
            if hashlib.sha256(Reader(mesh).data).digest() == digest:
                return Tree(mesh, tree)
        raise Fails("unverifiable", f"no mesh with the digest {digest.hex()} is among the arguments")
    for path in arguments.proofs:
        try: verdict, reason = "holds", check(path, tree_of)
        except Fails as e: verdict, reason = e.args
        except OSError as e: verdict, reason = "unverifiable", f"{e.filename}: {e.strerror}"
        except RecursionError: verdict, reason = "unverifiable", "a tree is too deep"
        print(f"{path}: {verdict}: {reason}", flush=True)
        all_hold = all_hold and verdict == "holds"
    return 0 if all_hold else 1
if __name__ == "__main__": sys.exit(main())
