#!/usr/bin/env python3
"""Tests of second_opinion.py. They build meshes, certificates and proofs by the format in the README.

Binary64 is only used to build inputs and to sample motions. The tested code does not use it.
"""
import collections, contextlib, hashlib, io, itertools, math, os, random, struct, tempfile, unittest, unittest.mock
from fractions import Fraction
import second_opinion as so

ONE = 1 << 50   # the scale of the coordinates of a normal
X, Y, Z = (ONE, 0, 0), (0, ONE, 0), (0, 0, ONE)
UNIT3 = (1, 0, 0), (0, 1, 0), (0, 0, 1)
TICKS = (-40, 60)   # units for which times are integers: ticks of 2^-60 of 2^60
WHOLE = 1 << 55   # the scale of weights
ZERO = 0, 0, 0
AUTO = -0x5eed0ff5   # an offset that Case.fit replaces by the middle between the projections of the nodes
# ---- files ----
def minus(axis): return tuple(-c for c in axis)


def mesh(vertices, triangles):
    return (struct.pack("<II", len(vertices), len(triangles))
            + b"".join(struct.pack("<4d", *v, *[0.0] * (4 - len(v))) for v in vertices)   # the default radius is 0
            + b"".join(struct.pack("<3I", *t) for t in triangles))


def points(*vertices):
    """Returns a mesh whose triangles are single points."""
    return mesh(vertices, [(i, i, i) for i in range(len(vertices))])


def with_radii(mesh_bytes, *radii):
    """Returns the mesh with other radii: one for each vertex, or one for all."""
    count, = struct.unpack_from("<I", mesh_bytes)
    out = bytearray(mesh_bytes)
    for i in range(count):
        struct.pack_into("<d", out, 32 + 32 * i, radii[i % len(radii)])
    return bytes(out)


def balanced(order):
    """Returns a balanced tree: the first child of a node with n triangles has n // 2. The triangles have this order. A
    tree is the index of a triangle, or a pair of trees."""
    order = list(order)
    half = len(order) // 2
    return (balanced(order[:half]), balanced(order[half:])) if half else order[0]


def one_sided_numbers(n, to):
    """Returns the numbers of a tree whose first (to = 0) or second (to = 1) children are single triangles."""
    if to == 0:
        return [x for i in range(n - 1) for x in (1, i)] + [n - 1]
    return [*range(n - 1, 0, -1), *range(n)]


def random_tree(rng, order):
    """Returns a random tree whose triangles have this order."""
    if len(order) == 1:
        return order[0]
    first = rng.randrange(1, len(order))
    return random_tree(rng, order[:first]), random_tree(rng, order[first:])


def triangles_of(tree):
    """Returns the triangles of each node, in preorder."""
    if isinstance(tree, int):
        return [[tree]]
    first, second = map(triangles_of, tree)
    return [first[0] + second[0], *first, *second]


def numbers_in_preorder(tree):
    """Returns the numbers of the nodes in a certificate."""
    if isinstance(tree, int):
        return [tree]
    first, second = tree
    return [len(triangles_of(first)[0]), *numbers_in_preorder(first), *numbers_in_preorder(second)]


def certificate(mesh_bytes, order=None, tree=None, numbers=None):
    """Returns the certificate of a tree, of a balanced tree with this order, or with any numbers, valid or not."""
    if numbers is None:
        count, = struct.unpack_from("<I", mesh_bytes, 4)
        numbers = numbers_in_preorder(balanced(range(count) if order is None else order) if tree is None else tree)
    return b"CCDBODY1" + hashlib.sha256(mesh_bytes).digest() + struct.pack(f"<{len(numbers)}I", *numbers)


Link = collections.namedtuple("Link", "on p q c axes v a alpha beta")


def moving_link(v=ZERO, a=ZERO, alpha=0.0, beta=0.0, axes=0, p=ZERO, q=(0, 0, 0, 1), c=ZERO, on=0):
    return Link(on, p, q, c, axes, v, a, alpha, beta)


def free(p=ZERO, q=(0, 0, 0, 1), v=ZERO, w=ZERO, c=ZERO, on=0): return moving_link(v, w, 0.0, 1.0, 0, p, q, c, on)
def revolute(a=(0, 0, 1), alpha=0.0, beta=0.0, p=ZERO, q=(0, 0, 0, 1), on=0):
    return moving_link(ZERO, a, alpha, beta, 1, p, q, ZERO, on)


def prismatic(v=(0, 0, 1), alpha=0.0, beta=0.0, p=ZERO, q=(0, 0, 0, 1), on=0):
    return moving_link(v, ZERO, alpha, beta, 1, p, q, ZERO, on)


def link_bytes(x): return struct.pack("<I10dI8d", x.on, *x.p, *x.q, *x.c, x.axes, *x.v, *x.a, x.alpha, x.beta)
def int56(x): return x.to_bytes(7, "little", signed=True)
def leaf(axis, frame=0, d=AUTO): return bytes([3 + frame]) + b"".join(map(int56, (*axis, d)))
def along(*v): return tuple(math.trunc(c * (1 - 1e-9) * ONE) for c in v)   # slightly less than 1 long
AROUND_A, AROUND_B = b"\6", b"\7"
def split_time(first, second): return b"\2" + first + second


def split_evenly(depth, make, t0=0.0, t1=1.0):
    """Returns steps that split the time into 2^depth equal intervals. make(middle) returns the leaf of an interval."""
    if depth == 0:
        return make((t0 + t1) / 2)
    m = (t0 + t1) / 2
    return split_time(split_evenly(depth - 1, make, t0, m), split_evenly(depth - 1, make, m, t1))


def until(t, first, second, t0=0.0, t1=1.0):
    """Returns the steps with the leaf `first` until t and the leaf `second` after t, with the fewest splits of time."""
    if not t0 < t < t1:
        return first if t1 <= t else second
    m = (t0 + t1) / 2
    return split_time(until(t, first, second, t0, m), until(t, first, second, m, t1))


def proof(links, bodies, pairs, steps, duration=1.0, witness=None, units=None):
    """Returns a proof. bodies: (mesh, link); pairs: (body, body, margin);
    witness = (pair, time, tolerance, (triangle, weights) of A, of B), weights in 2^-55."""
    units = units or (-40, max(-60, math.frexp(max(duration, witness[1] if witness else 0.0))[1]))
    out = b"CCDPROF1" + struct.pack("<iiIII", *units, len(links), len(bodies), len(pairs))
    out += b"".join(map(link_bytes, links))
    for m, link in bodies:
        out += hashlib.sha256(m).digest() + struct.pack("<I", link)
    for pair in pairs:
        out += struct.pack("<IId", *pair)
    out += struct.pack("<d", duration)
    if witness is None:
        return out + bytes(4) + steps
    out += struct.pack("<IIdd", 1, *witness[:3])
    for place, weights in witness[3:]:
        out += struct.pack("<I", place) + b"".join(w.to_bytes(7, "little") for w in weights)
    return out + steps


def two(a, b, la, lb, steps, margin=0.0, contact=None, **more):
    """Returns a proof about two bodies, each on its own link."""
    witness = contact and (0, *contact)
    return proof([la, lb], [(a, 1), (b, 2)], [(0, 1, margin)], steps, witness=witness, **more)


LINK = 4 + 80 + 4 + 64
HEADER = 8 + 8 + 12 + 2 * LINK + 2 * 36 + 16 + 8   # bytes before the number of witnesses, for two bodies and links
FLAT = mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
FLAT_TREE = certificate(FLAT)
POINT = points((0, 0, 0))
POINT_TREE = certificate(POINT)


def rod(x0=0.0, x1=1.0): return mesh([(x0, 0, 0), (x1, 0, 0), (x0, -0.125, 0)], [(0, 1, 2)])
# ---- motions in binary64 ----
def fadd(*vs): return [sum(c) for c in zip(*vs)]
def fscale(f, v): return [f * c for c in v]
def fsub(u, v): return [a - b for a, b in zip(u, v)]
def fdot(u, v): return sum(a * b for a, b in zip(u, v))
def fcross(u, v): return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
def flength(v): return math.sqrt(fdot(v, v))


def turn_by(a, v):
    """Returns exp([a]x) v, from the components of v along and across a."""
    angle = flength(a)
    if angle == 0:
        return list(v)
    e = fscale(1 / angle, a)
    along = fscale(fdot(e, v), e)
    return fadd(along, fscale(math.cos(angle), fsub(v, along)), fscale(math.sin(angle), fcross(e, v)))


def rotate(q, v):
    """Rotates v by q / |q|, as q v q* / |q|^2."""
    u, w = q[:3], q[3]
    t = fadd(fscale(w, v), fcross(u, v))                    # q v = (-u.v, t)
    r = fadd(fscale(fdot(u, v), u), fscale(w, t), fcross(u, t))
    return fscale(1 / (fdot(u, u) + w * w), r)


def to_parent(x, y, t):
    """Transforms a point from the frame of a link to that of its parent, by the formula of the README."""
    s = x.alpha + t * x.beta
    v, a = (rotate(x.q, u) if x.axes else u for u in (x.v, x.a))
    return fadd(x.p, rotate(x.q, x.c), fscale(s, v), turn_by(fscale(s, a), rotate(x.q, fsub(y, x.c))))


def in_world(links, i, y, t):
    while i:
        y, i = to_parent(links[i - 1], y, t), links[i - 1].on
    return y


def direction(links, i, u, t): return fsub(in_world(links, i, u, t), in_world(links, i, ZERO, t))


def axis_at(links, frame, n, middle, t):
    """Returns the direction at time t of an axis that rotates with a link. At the middle of the interval it is n."""
    return fadd(*[fscale(fdot(n, direction(links, frame, e, middle)), direction(links, frame, e, t)) for e in UNIT3])


def center(links, i): return links[i - 1].c if i else ZERO


def least_distance(links, end, corners, side, n, d, frame, t0, t1, samples):
    """Returns the least sampled signed distance of the balls from the plane. If the side is -1,
    the distance is positive below the plane."""
    least = math.inf
    for i in range(samples + 1):
        t = t0 + (t1 - t0) * i / samples
        ns, origin = axis_at(links, frame, n, (t0 + t1) / 2, t), in_world(links, frame, center(links, frame), t)
        w = [fdot(ns, direction(links, end, e, t)) for e in UNIT3]
        start = fdot(ns, fsub(in_world(links, end, (0, 0, 0), t), origin)) - d
        least = min(least, min(side * (start + fdot(w, y)) - flength(n) * ball for *y, ball in corners))
    return least


def middle_and_half(t0, t1):
    """Returns the middle and the half-length of an interval of ticks, as the checker computes them."""
    middle = (t0 + t1) // 2
    return Fraction(middle, 1 << 60), (t1 - middle << so.F - 60,) * 2


def random_link(rng, on, speed=1.0):
    """Returns a free link, a revolute or prismatic joint, or a general motion along any axes."""
    def vec(s): return tuple(rng.uniform(-s, s) for _ in range(3))
    p, q, kind = vec(1), tuple(rng.gauss(0, 1) for _ in range(4)), rng.randrange(4)
    q = tuple(fscale(1 / flength(q), q))
    if kind == 0:
        return free(p, q, vec(speed), vec(speed), vec(0.5), on)
    if rng.random() < 0.15:
        speed = 0
    alpha, beta = rng.uniform(-2, 2), rng.uniform(-2, 2) * speed
    if kind == 3:
        return moving_link(vec(1), vec(1), alpha, beta, rng.randrange(2), p, q, vec(0.5), on)
    return (revolute, prismatic)[kind - 1](vec(1), alpha, beta, p, q, on)


def random_links(rng, count, speed=1.0):
    """Returns random links in a tree. For half of them the parent is the previous link."""
    return [random_link(rng, i if rng.random() < 0.5 else rng.randint(0, i), speed) for i in range(count)]
# ---- tests ----
class Case(unittest.TestCase):
    def files(self, *data):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        paths = [os.path.join(folder.name, str(i)) for i in range(len(data))]
        for path, d in zip(paths, data):
            with open(path, "wb") as f:
                f.write(d)
        return paths

    def fit(self, meshes, made):
        """Replaces each AUTO in a proof by the best offset. A patched checker returns the signed distances for it."""
        if int56(AUTO) not in made:
            return made
        original, bounds, found = so.distance_bound, [], []
        def record_bound(*call):
            d = call[-1] >> so.F
            if abs(d) != -AUTO:
                return original(*call)
            bounds.append(original(*call[:-1], 0))
            if d < 0:                   # the plane of B, as that of A comes before it
                below, above = bounds[-2:]
                found.append(round(Fraction(above - below, 2 << so.F)))
            return 1 << 4096
        so.distance_bound = record_bound
        try:
            paths = self.files(*meshes, made)
            self.run_checker(paths[:-1], paths[-1:])
        finally:
            so.distance_bound = original
        limit = (1 << 55) - 1
        for d in found:
            made = made.replace(int56(AUTO), int56(max(-limit, min(limit, d))), 1)
        return made

    def run_checker(self, meshes, proofs):
        out, options = io.StringIO(), []
        for i in range(0, len(meshes), 2):
            options += ["--mesh", *meshes[i:i + 2]]
        with contextlib.redirect_stdout(out):
            status = so.main([*options, *proofs])
        return status, [line.split(": ", 2)[1:] for line in out.getvalue().splitlines()]

    def run_files(self, meshes, *proofs):
        """Returns the verdicts and reasons that the command prints. `meshes` lists each mesh before its certificate."""
        paths = self.files(*meshes, *(self.fit(meshes, made) for made in proofs))
        status, lines = self.run_checker(paths[:len(meshes)], paths[len(meshes):])
        self.assertEqual(len(lines), len(proofs))
        self.assertEqual(status, 0 if all(v == "holds" for v, _ in lines) else 1)
        return lines

    def holds(self, meshes, *proofs):
        for line in self.run_files(meshes, *proofs):
            self.assertEqual(line[0], "holds", line)

    def fails(self, reason, meshes, *proofs, verdict="broken"):
        for line in self.run_files(meshes, *proofs):
            self.assertEqual(line[0], verdict, line)
            self.assertIn(reason, line[1])

    def exact_links(self, links):
        """Returns the links as the checker reads them. Both units are 1."""
        reader, out = so.Reader(*self.files(b"".join(map(link_bytes, links)))), [so.Link()]
        for _ in links:
            out.append(so.Link(reader.one_of(out, "link")).read(reader, Fraction(1), Fraction(1)))
        return out


class Free(Case):
    M = FLAT, FLAT_TREE

    def flat(self, steps, la=free(), lb=free(p=(0, 0, 1)), **more):
        return two(FLAT, FLAT, la, lb, steps, **more)

    def test_at_rest(self):
        for frame in range(3):
            self.holds(self.M, self.flat(leaf(Z, frame), margin=0.99))

    def test_margin_is_strict(self):
        self.fails("does not prove", self.M, self.flat(leaf(Z), margin=1.0))
        self.holds(self.M, self.flat(leaf(Z), margin=math.nextafter(1.0, 0)))

    def test_radii_count(self):
        for radii in ((0.25, 0.25), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)):
            files, make = self.rounded_pair(radii)
            if sum(radii) < 1:
                self.holds(files, make(leaf(Z), margin=0.4999))
            self.fails("does not prove", files, make(leaf(Z), margin=0.5 if sum(radii) < 1 else 0.0))

    def rounded_pair(self, radii, la=free(), lb=free(p=(0, 0, 1))):
        """Returns the files of two triangles with these radii, and a function that makes proofs of them."""
        a, b = (with_radii(FLAT, r) for r in radii)
        return (a, certificate(a), b, certificate(b)), lambda steps, **more: two(a, b, la, lb, steps, **more)

    def test_each_radius_counts(self):
        # Each radius only counts at its own corner. The corners are at z = 0, 0.5 and 0.75.
        for radii, least in (((0, 0, 0), 0), ((0.25, 0.25, 0.25), -0.25), ((0, 0.75, 0), -0.25), ((0, 0, 0.5), 0),
                             ((0, 0.5, 0.875), -0.125), ((0.0625, 0.25, 0.75), -0.0625)):
            b = mesh([(0, 0, 0, radii[0]), (1, 0, 0.5, radii[1]), (0, 1, 0.75, radii[2])], [(0, 1, 2)])
            files = *self.M, b, certificate(b)
            for q, p, axis in (((0, 0, 0, 1), 1, Z), ((1, 0, 0, 0), -1, minus(Z))):   # upright, and turned over
                def make(margin): return two(FLAT, b, free(), free((0, 0, p), q), leaf(axis), margin)
                self.holds(files, make(math.nextafter(1 + least, 0)))
                self.fails("does not prove", files, make(1.0 + least))
        # A motion lowers the gap as for flat triangles: by rate / 2, and by half of the square of half of the angle.
        for rate in (0.0, 0.5):
            lb = free(p=(0, 0, 1), w=(0, 0, rate), v=(0, 0, -rate / 2))
            files, make = self.rounded_pair((0.125, 0.25), lb=lb)
            self.holds(files, make(leaf(Z), margin=0.6249 - rate / 2 - rate ** 2 / 8))
            self.fails("does not prove", files, make(leaf(Z), margin=0.6251 - rate / 2 - rate ** 2 / 8))

    def test_radii_of_parts(self):
        # A small ball is below a large one. Their common box reaches lower than either ball.
        b = points((0, 0, 1, 0.125), (0, 0, 2, 0.75), (0, 0, 3, 2.0))
        files = *self.M, b, certificate(b, (2, 0, 1))
        def make(margin): return two(FLAT, b, free(), free(), leaf(Z), margin)
        self.holds(files, make(math.nextafter(0.875, 0)))
        self.fails("does not prove", files, make(0.875))
        b = points((0, 0, 1, 0.125), (0, 0, 2, 0.75), (0, 0, 3, math.nextafter(2.125, 3)))
        self.fails("does not prove", (*self.M, b, certificate(b, (2, 0, 1))), make(math.nextafter(0.875, 0)))

    def test_offset(self):
        # B is 1 above A. The plane needs half of the margin on either side.
        half = 1 << 39                              # 1/2, in units of 2^-40
        for frame in (0, 1, 2):
            below = half - (frame == 2) * 2 * half   # relative to A or the world, or to B
            for d, max_margin in ((0, 1.0), (half // 2, 0.5), (-half // 2, 0.5), (half - 1, 2.0 ** -39), (half, 0.0),
                            (1 - half, 2.0 ** -39), (-half, 0.0), (2 * half, 0.0), (-8 * half, 0.0),
                            (2 ** 55 - 1 - half, 0.0), (half - 2 ** 55, 0.0)):
                step = leaf(Z, frame, below + d)
                if max_margin > 0:
                    self.holds(self.M, self.flat(step, margin=math.nextafter(max_margin, 0)))
                self.fails("does not prove", self.M, self.flat(step, margin=max_margin))

    def test_offset_is_from_the_center(self):
        # A and B are 10 and 11 above the origin, with centers elsewhere.
        la, lb = free(p=(0, 0, 10), c=(0, 0, 4)), free(p=(0, 0, 11), c=(0, 0, -7))
        for frame, origin in ((0, 0), (1, 14), (2, 4)):
            def make(d):
                return self.flat(leaf(Z, frame, int((d - origin) * 2 ** 40)), la, lb, margin=0.75)
            self.holds(self.M, make(10.5), make(10.4), make(10.6))
            self.fails("does not prove", self.M, make(10.3), make(10.7), make(0), make(-10.5))
        # The plane moves with the center of a body that does not rotate.
        la, lb = free(v=(0, 0, 9)), free(p=(0, 0, 1), v=(0, 0, 9))
        for frame, d in ((1, 1 << 39), (2, -1 << 39)):
            self.holds(self.M, self.flat(leaf(Z, frame, d), la, lb, margin=0.99))
        self.fails("does not prove", self.M, self.flat(leaf(Z), la, lb))

    def test_unit_of_offset(self):
        for e in (-60, -40, -10, 0, 3):             # B is 2^(e + 21) above A, and the plane is halfway
            lb = free(p=(0, 0, 2.0 ** (e + 21)))
            def make(margin): return self.flat(leaf(Z, 0, 1 << 20), lb=lb, margin=margin, units=(e, 0))
            self.holds(self.M, make(math.nextafter(2.0 ** (e + 21), 0)))
            self.fails("does not prove", self.M, make(2.0 ** (e + 21)))

    def test_no_duration(self):
        self.holds(self.M, self.flat(leaf(Z), duration=0.0))
        self.fails("too short to be split", self.M, self.flat(split_time(leaf(Z), leaf(Z)), duration=0.0))

    def test_moves(self):
        lb = free(p=(0, 0, 1), v=(5, 0, -0.75))
        self.holds(self.M, self.flat(leaf(Z), lb=lb, margin=0.24))
        self.holds(self.M, self.flat(split_time(leaf(Z), split_time(leaf(Z), leaf(Z))), lb=lb, margin=0.24))
        self.fails("does not prove", self.M, self.flat(leaf(Z), lb=lb, margin=0.26))
        self.fails("does not prove", self.M, self.flat(split_time(leaf(Z), leaf(Z)), lb=lb, margin=0.26))
        self.fails("does not prove", self.M, self.flat(leaf(Z), lb=lb, duration=1.5))

    def test_part_of_time(self):
        # B moves down beside A. It is above A until 0.25, and beside A from 0.125 on.
        lb, units = free(p=(0, 0, 0.5), v=(8, 0, -2)), (-40, 0)
        for more in ({}, {"units": units}):
            self.holds(self.M, self.flat(until(0.1875, leaf(Z), leaf(X)), lb=lb, margin=0.1, **more))
        for t in (0.5, 1 - 0.1875, 0.125, 0.25):
            self.fails("does not prove", self.M, self.flat(until(t, leaf(Z), leaf(X)), lb=lb, margin=0.1))
        self.fails("does not prove", self.M, self.flat(until(0.1875, leaf(X), leaf(Z)), lb=lb, margin=0.1))

    def test_the_time_is_counted_in_the_unit(self):
        down = free(p=(0, 0, 1), v=(0, 0, -0.75))
        # The first interval ends at the next tick, when the gap is 0.25.
        for duration in (0.0, 0.25, 0.5):
            self.holds(self.M, self.flat(leaf(Z), lb=down, margin=0.24, duration=duration, units=TICKS))
            made = self.flat(leaf(Z), lb=down, margin=0.26, duration=duration, units=TICKS)
            self.fails("does not prove", self.M, made)
        # An interval can be split if it has at least two ticks.
        once = split_time(leaf(Z), leaf(Z))
        left, right = split_time(once, leaf(Z)), split_time(leaf(Z), once)
        proofs = [self.flat(steps, units=TICKS, duration=duration)
                    for duration in (0.0, 1.5, 2.0, 3.5) for steps in (leaf(Z), once, left, right)]
        for made, can in zip(proofs, (1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 1, 1, 1, 1, 1)):
            if can:
                self.holds(self.M, made)
            else:
                self.fails("too short to be split", self.M, made)
        # The middle is rounded down. B is beside A from 1.5 ticks before the middle, and above A until 0.5 ticks after
        # it. That is enough, as the second half may be checked from one tick before. With only one of both it is not.
        for duration, middle in ((2.0, 1), (3.0, 1), (4.0, 2), (5.0, 2), (8.0, 4)):
            for above, beside in ((middle + 0.5, middle - 1.5), (middle - 0.5, middle - 1.5),
                                  (middle + 0.5, middle + 0.5)):
                link = free(p=(1 - beside, 0, above / 4), v=(1, 0, -0.25))
                both, ticks = split_time(leaf(Z), leaf(X)), {"duration": duration - 0.5, "units": TICKS}
                made = self.flat(both, lb=link, margin=0.01, **ticks)
                if beside < middle < above:
                    self.holds(self.M, made)
                else:
                    self.fails("does not prove", self.M, made)
        self.fails("less than the time", self.M, self.flat(leaf(Z), units=(-40, -1)), verdict="unverifiable")
        self.fails("out of range", self.M, self.flat(leaf(Z), units=(-40, 1 << 30)),
                   self.flat(leaf(Z), units=(-1 << 31, 0)), verdict="unverifiable")

    def test_axis(self):
        self.fails("does not prove", self.M, self.flat(leaf(minus(Z))))
        self.fails("does not prove", self.M, self.flat(leaf((0, 0, 0))))
        self.fails("does not prove", self.M, self.flat(leaf(Y)))
        for axis in ((0, 0, ONE + 1), (1, 0, ONE), (0, 0, -2 * ONE), (32 * ONE - 1, 0, 0), (0, -32 * ONE, 0)):
            self.fails("does not prove", self.M, self.flat(leaf(axis, 0, 1 << 39)))
        # A normal of length 1 is accepted. A slightly longer one is refused, however far B is.
        lb, half = free(p=(0, 0, 100)), 1 << 45
        self.holds(self.M, self.flat(leaf(Z, 0, half), lb=lb), self.flat(leaf((0, 0, ONE - 1), 0, half), lb=lb))
        for axis in ((0, 0, ONE + 1), (1, 0, ONE)):
            self.fails("does not prove", self.M, self.flat(leaf(axis, 0, half), lb=lb))
        # An oblique axis shows a smaller gap: 0.8 minus 0.6 of the extent along x.
        oblique = along(0.6, 0, 0.8)
        self.holds(self.M, self.flat(leaf(oblique), margin=0.19))
        self.fails("does not prove", self.M, self.flat(leaf(oblique), margin=0.21))

    def test_file(self):
        good = self.flat(leaf(Z))
        self.holds(self.M, good)
        self.assertEqual(len(good), HEADER + 4 + 29)
        self.fails("file ends", self.M, *[good[:n] for n in range(8, len(good), 7)])
        self.fails("bytes follow", self.M, good + b"\0", good + leaf(Z))
        self.fails("another kind", self.M, b"", b"CCDPROOG" + good[8:])
        for step in (8, 9, 128, 255):               # with and without the numbers of a plane
            self.fails("no such step", self.M, self.flat(bytes([step])), self.flat(bytes([step]) + leaf(Z)[1:]))
        for count in (2, 3, 256, 1 << 31, (1 << 32) - 1):
            self.fails("more than one", self.M, good[:HEADER] + struct.pack("<I", count) + good[HEADER + 4:])
        self.fails("cannot be split", self.M, self.flat(b"\0" + leaf(Z)), self.flat(b"\1" + leaf(Z)))
        self.fails("margin is negative", self.M, self.flat(leaf(Z), margin=-0.5))
        for bad, place in itertools.product((-0.5, -5e-324, math.nan, math.inf, -math.inf), range(3)):
            a = with_radii(FLAT, *[bad if i == place else 0.5 for i in range(3)])
            reason, verdict = ("radius", "broken") if math.isfinite(bad) else ("not finite", "unverifiable")
            made = two(a, FLAT, free(), free(p=(0, 0, 1)), leaf(Z))
            self.fails(reason, (a, certificate(a), *self.M), made, verdict=verdict)
        minus_0 = with_radii(FLAT, -0.0)
        self.holds((minus_0, certificate(minus_0)), two(minus_0, minus_0, free(), free(p=(0, 0, 1)), leaf(Z), 0.99))
        self.fails("time is negative", self.M, self.flat(leaf(Z), duration=-1.0))

    def test_indices(self):
        def make(links=(free(), free(p=(0, 0, 1))), bodies=((FLAT, 1), (FLAT, 2)), pairs=((0, 1, 0.5),)):
            return proof(list(links), list(bodies), list(pairs), leaf(Z) * len(pairs))
        self.holds(self.M, make(), make(pairs=()), proof([], [], [], b""))
        self.holds(self.M, make(links=(free(p=(0, 0, 1)),), bodies=((FLAT, 0), (FLAT, 1))))
        for on in (1, 2, 3, 1 << 31):   # a link whose parent is itself or a later link
            self.fails("no such link before", self.M, make(links=(free(on=on), free(p=(0, 0, 1)))))
        self.fails("no such link", self.M, make(bodies=((FLAT, 3), (FLAT, 2))))
        self.fails("no such body", self.M, make(pairs=((0, 2, 0.5),)), make(pairs=((2, 0, 0.5),)))
        self.fails("does not prove", self.M, make(pairs=((1, 0, 0.5),)), make(pairs=((0, 0, 0.0),)))
        for axes in (0, 1):
            self.holds(self.M, make(links=(moving_link(axes=axes), moving_link(axes=axes, p=(0, 0, 1)))))
        for axes in (2, 3, 256, 1 << 16, 1 << 31, (1 << 32) - 1):
            changed = moving_link(axes=axes)
            for at, links in (28, (changed, free(p=(0, 0, 1)))), (28 + LINK, (free(), changed)):
                self.fails(f"byte {at + 84} ", self.M, make(links=links))
                self.fails("no such axes", self.M, make(links=links))
        deep = [revolute(on=i) for i in range(199)]
        self.holds(self.M, make(links=(*deep, free(p=(0, 0, 1))), bodies=((FLAT, 199), (FLAT, 200))))
        self.fails("chain", self.M, make(links=(*deep, revolute(on=199))), verdict="unverifiable")

    def test_numbers(self):
        for bad in (math.nan, math.inf, -math.inf):
            for place, x in ((4, free((0, bad, 1))), (28, free(q=(0, bad, 0, 1))), (60, free(c=(0, bad, 0))),
                             (88, free(v=(0, bad, 0))), (112, free(w=(0, bad, 0))), (136, moving_link(alpha=bad)),
                             (136, moving_link(beta=bad))):
                self.fails(f"byte {28 + LINK + place} ", self.M, self.flat(leaf(Z), lb=x), verdict="unverifiable")
        p = 0, 0, 1
        for link in (free(p, w=(0, 0, 1000)), revolute(p=p, beta=1000.0), revolute(p=p, alpha=-1000.0)):
            self.fails("rotates too far", self.M, self.flat(leaf(Z), lb=link), verdict="unverifiable")
        self.holds(self.M, self.flat(leaf(Z), lb=revolute(p=(0, 0, 1), alpha=500.0)))
        spin = free(p=(0, 0, 1), w=(0, 0, 250))
        self.fails("does not prove", self.M, self.flat(leaf(Z), lb=spin))   # true, but the interval is too long
        self.holds(self.M, self.flat(split_evenly(8, lambda _: leaf(Z)), lb=spin))
        for q in ((0, 0, 0, 0), (0, 0, 0, 1.01), (0, 0, 0, 1 - 2.0 ** -20)):
            self.fails("1 long", self.M, *(self.flat(leaf(Z), lb=kind(p=(0, 0, 1), q=q))
                                           for kind in (free, revolute, prismatic)))
        self.holds(self.M, self.flat(leaf(Z), lb=free(p=(0, 0, 1), q=(0, 0, 0, 1 - 2.0 ** -21))))
        # Very large and very small numbers are exact, too.
        distance = free(p=(0, 0, 1e300))
        self.holds(self.M, self.flat(leaf(Z), lb=distance, margin=9.9e299, units=(950, 0)))
        ball = with_radii(FLAT, 1e300)
        self.holds((*self.M, ball, certificate(ball)), two(FLAT, ball, free(), free(p=(0, 0, 2e300)), leaf(Z), 9.9e299,
                                                           units=(950, 0)))
        tiny_mesh = mesh([(0, 0, 5e-324), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        tree = certificate(tiny_mesh)
        self.holds((tiny_mesh, tree, *self.M), two(tiny_mesh, FLAT, free(), free(p=(0, 0, 1)), leaf(Z), margin=0.5))

    def test_quaternion(self):
        # A quarter rotate about x rotates y to z, so the triangle reaches up to z = 1.
        q = (math.sqrt(0.5), 0, 0, math.sqrt(0.5))
        above = free(p=(0, 0, 1.25))
        # With the center at y = 1, that corner stays at p + R0 c.
        for up in (free(q=q), free(q=q, c=(0, 1, 0)), revolute(q=q), prismatic(q=q)):
            self.holds(self.M, self.flat(leaf(Z), la=up, lb=above, margin=0.2499))
            self.fails("does not prove", self.M, self.flat(leaf(Z), la=up, lb=above, margin=0.2501))

    def test_quaternion_not_quite_1_long(self):
        # A is turned by half a rotate about z, so its corner is at x = -1, whatever the length of the quaternion.
        e = 2.0 ** -22
        for z in (1 + e, 1 - e):
            for kind in (free, revolute, prismatic):
                def make(margin):
                    return self.flat(leaf(minus(X)), kind(q=(0, 0, z, 0)), free(p=(-3, 0, 0)), margin=margin)
                self.holds(self.M, make(1 - e / 8))
                self.fails("does not prove", self.M, make(1 + e / 8))


class Joints(Case):
    M = POINT, POINT_TREE, FLAT, FLAT_TREE

    def test_sliding(self):
        # A prismatic joint lifts B along z. Its axis may have any length.
        q = (0, -math.sqrt(0.5), 0, math.sqrt(0.5))   # rotates x to z
        for a, alpha, beta in (((1, 0, 0), 1.0, -0.75), ((0.25, 0, 0), 4.0, -3.0), ((-1, 0, 0), -1.0, 0.75)):
            def make(margin, **more):
                return two(FLAT, FLAT, free(), prismatic(a, alpha, beta, q=q), leaf(Z), margin, **more)
            # The rotated triangle reaches from z = 0 to z = 1 above its position.
            self.holds(self.M, make(0.2499))
            self.fails("does not prove", self.M, make(0.2501), make(0.2499, duration=1.1))

    def test_turning(self):
        # A point at x = 1 rotates about z, by angles from -0.5 to 0.5.
        a = points((1, 0, 0))
        for axis, alpha, beta in (((0, 0, 1), -0.5, 1.0), ((0, 0, -0.5), 1.0, -2.0)):
            def make(margin, depth):
                steps = split_evenly(depth, lambda t: leaf(X))
                return two(a, POINT, revolute(axis, alpha, beta), free(p=(2, 0, 0)), steps, margin)
            files = (a, certificate(a), *self.M)
            self.holds(files, make(0.8, 0), make(0.99, 4))
            self.fails("does not prove", files, make(0.9, 0), make(1.001, 4))
        def away(alpha, margin): return two(a, POINT, revolute(alpha=alpha), free(p=(-2, 0, 0)), leaf(minus(X)), margin)
        for alpha in (math.pi, 2.9, -2.0):
            self.holds(files, away(alpha, 1.9999 + math.cos(alpha)))
            self.fails("does not prove", files, away(alpha, 2.0001 + math.cos(alpha)))

    def test_scara(self):
        # Arms of length 1 rotate about z by t and by -2 t, so the tip stays on y = 0. A plate above it is lifted.
        links = [revolute(beta=1.0), revolute(beta=-2.0, p=(1, 0, 0), on=1), prismatic(beta=0.5, p=(1, 0, 0), on=2),
                 prismatic((0, 0, 1), 0.0, 0.5, p=(0, 0, 1))]
        def make(margin, depth, axis=Z):
            steps = split_evenly(depth, lambda t: leaf(axis))
            return proof(links, [(POINT, 3), (FLAT, 4)], [(0, 1, margin)], steps)
        # Both rise by 0.5, but the plane is static. In an interval it is 2^-8 below B at the start, and
        # 2^-8 above A at the end.
        self.holds(self.M, make(0.999 - 2 ** -8, 7))
        self.fails("does not prove", self.M, make(1.0001 - 2 ** -8, 7), make(0.999, 1), make(0.0, 7, Y))
        wall = mesh([(-9, 0.25, -9), (9, 0.25, -9), (0, 0.25, 9)], [(0, 1, 2)])
        def beside(margin, depth):
            return proof(links, [(POINT, 3), (wall, 0)], [(0, 1, margin)], split_evenly(depth, lambda t: leaf(Y)))
        files = (wall, certificate(wall), *self.M)
        self.holds(files, beside(0.24, 6))
        self.fails("does not prove", files, beside(0.251, 6), beside(0.24, 1))

    def test_a_turning_base_carries_both(self):
        # Each body is on its own link, on a base that rotates by 6 radians. They are static relative to each other.
        for base in (revolute(beta=6.0), free(w=(0, 0, 6.0)), revolute((0, 0, 3.0), 1.0, 2.0)):
            links = [base, free(on=1), free(p=(0, 0, 1), on=1), prismatic((1, 0, 0), -0.5, 1.0, p=(0.5, 0, 0), on=1)]
            side = along(*direction(links, 1, (1, 0, 0), 0.5))
            def make(b, axis, frame, margin, depth=0):
                return proof(links, [(POINT, 2), (POINT, b)], [(0, 1, margin)],
                             split_evenly(depth, lambda _: leaf(axis, frame)))
            for frame in (1, 2):
                self.holds(self.M, make(3, Z, frame, 0.999))
            self.fails("does not prove", self.M, make(3, Z, 0, 0.0))
            self.holds(self.M, make(3, Z, 0, 0.99, 6))
            for frame in (1, 2):   # the prismatic joint starts at 0, and moves to 1 along x of the base
                self.fails("does not prove", self.M, make(4, side, frame, 0.001))
            links[3] = prismatic((1, 0, 0), 0.0, 1.0, p=(0.5, 0, 0), on=1)
            for frame in (1, 2):
                self.holds(self.M, make(4, side, frame, 0.499))
                self.fails("does not prove", self.M, make(4, side, frame, 0.501), make(4, Y, frame, 0.1))
            self.fails("does not prove", self.M, make(4, side, 0, 0.0), make(4, side, 0, 0.0, 2))

    def test_bodies_on_one_link(self):
        a, b = points((0, 0, 0)), points((1, 2, 3))
        files = a, certificate(a), b, certificate(b)
        links = [revolute(beta=3.0), free(c=(5, 5, 5), w=(1, 2, 1), v=(9, 9, 9), on=1)]
        for on, frames in ((0, (0, 1, 2)), (2, (1, 2))):
            axis = along(*direction(links, on, (0, 0, 1), 0.5))
            def make(margin, frame):
                return proof(links, [(a, on), (b, on)], [(0, 1, margin)], leaf(axis, frame))
            for frame in frames:
                self.holds(files, make(2.9999, frame))
                self.fails("does not prove", files, make(3.0001, frame))
        self.fails("does not prove", files, make(0.0, 0))

    def test_axes(self):
        # R0 rotates x to y. B moves along x of the parent, or of the joint, which is y of the parent, from 0.5 to 1.5.
        q = 0, 0, math.sqrt(0.5), math.sqrt(0.5)
        for axes, n, other, end in ((0, X, Y, (2, 0, 0)), (1, Y, X, (0, 2, 0))):
            for scale in (1.0, -0.25):
                x = moving_link((scale, 0, 0), ZERO, 0.5 / scale, 1 / scale, axes, q=q)
                def make(axis, margin, p=ZERO): return two(POINT, POINT, free(p), x, leaf(axis), margin)
                self.holds(self.M, make(n, 0.4999), make(minus(n), 0.4999, end))
                self.fails("does not prove", self.M, make(n, 0.5001), make(minus(n), 0.5001, end), make(other, 0.0),
                           make(minus(other), 0.0))
        # The axis is x of the parent, or of the joint. The point at x = 1 of the link is at y = 1 of the parent.
        # With the first axis it rotates by half a turn to y = -1. With the second axis it stays.
        b = points((1, 0, 0))
        files = *self.M, b, certificate(b)
        for axes, n in ((0, minus(Y)), (1, Y)):
            x = moving_link(ZERO, (1, 0, 0), math.pi - 0.001, 0.002, axes, q=q)
            def make(axis, margin): return two(POINT, b, free(), x, leaf(axis), margin)
            self.holds(files, make(n, 0.9999))
            self.fails("does not prove", files, make(minus(n), 0.0), make(n, 1.0001))

    def poses(self, x, t):
        """Returns the position and the axes of a link on the world, as the checker computes them."""
        columns, place, _, _ = self.exact_links([x])[1].pose(Fraction(t))
        return [[lo / so.ONE for lo, _ in v] for v in (place, *columns)]

    def test_axes_of_the_joint_are_turned_ones(self):
        # R0 v and R0 a along the axes of the parent give the same link. So does scaling by powers of two.
        rng = random.Random(12)
        for _ in range(30):
            v, a, p, c, (alpha, beta, t) = ([rng.uniform(-1, 1) for _ in range(3)] for _ in range(5))
            q = [rng.gauss(0, 1) for _ in range(4)]
            x = moving_link(v, a, 2 * alpha, 2 * beta, 1, p, fscale(1 / flength(q), q), c)
            along_parent_axes = x._replace(axes=0, v=rotate(x.q, x.v), a=rotate(x.q, x.a))
            rescaled = x._replace(v=fscale(8, x.v), a=fscale(8, x.a), alpha=x.alpha / 8, beta=x.beta / 8)
            expected = self.poses(x, t)
            for other in (along_parent_axes, rescaled):
                for u, v in zip(self.poses(other, t), expected):
                    self.assertLess(flength(fsub(u, v)), 1e-13)
            without_rotation = self.poses(x._replace(axes=0), t)
            self.assertGreater(max(flength(fsub(u, v)) for u, v in zip(without_rotation, expected)), 1e-3)
            # The usual formula of a joint, with its rotation applied before R0.
            s = x.alpha + t * x.beta
            for e, column in zip(UNIT3, expected[1:]):
                self.assertLess(flength(fsub(rotate(x.q, turn_by(fscale(s, x.a), e)), column)), 1e-13)

    def test_screw_against_its_differential_equation(self):
        # Integrates x' = v + a x (x - center) and center' = v from s = 0 with the Runge-Kutta method.
        rng = random.Random(13)
        for trial in range(10):
            v, a, p, c, y = ([rng.uniform(-1, 1) for _ in range(3)] for _ in range(5))
            q, t = [rng.gauss(0, 1) for _ in range(4)], rng.random()
            q = fscale(1 / flength(q), q)
            x = moving_link(v, a, rng.uniform(-3, 3), rng.uniform(-3, 3), trial & 1, p, q, c)
            matrix = [rotate(q, e) for e in UNIT3]  # the columns of the matrix
            def r0(u): return fadd(*[fscale(f, column) for f, column in zip(u, matrix)])
            if x.axes:
                v, a = r0(v), r0(a)
            at, middle, steps = fadd(p, r0(y)), fadd(p, r0(c)), 1000
            h = (x.alpha + t * x.beta) / steps
            for i in range(steps):
                def slope(at, moved): return fadd(v, fcross(a, fsub(at, fadd(middle, fscale(moved, v)))))
                k1 = slope(at, i * h)
                k2 = slope(fadd(at, fscale(h / 2, k1)), (i + 0.5) * h)
                k3 = slope(fadd(at, fscale(h / 2, k2)), (i + 0.5) * h)
                k4 = slope(fadd(at, fscale(h, k3)), (i + 1) * h)
                at = fadd(at, fscale(h / 6, fadd(k1, k2, k2, k3, k3, k4)))
            place, *columns = self.poses(x, t)
            z = fsub(y, c)
            self.assertLess(flength(fsub(fadd(place, *[fscale(f, u) for f, u in zip(z, columns)]), at)), 1e-8)
            self.assertLess(flength(fsub(in_world([x], 1, y, t), at)), 1e-8)

    def test_screw(self):
        # The point (2, 0, 0) of a link with the center (1, 0, 0) moves along one turn of a helix, up or down by 0.75.
        # A plate is at z = 1. With half of a rotate about x, v and a of the joint point down.
        b, corner = points((2, 0, 0)), (0, (WHOLE, 0, 0))
        plate = mesh([(-9, -9, 1), (9, -9, 1), (0, 9, 1)], [(0, 1, 2)])
        files, turn, half_turn = (b, certificate(b), plate, certificate(plate), *self.M), 2 * math.pi, (1, 0, 0, 0)
        cases = (0, (0, 0, 0, 1), 1), (1, (0, 0, 0, 1), 1), (0, half_turn, 1), (1, half_turn, -1)
        for (axes, q, side), pitch in itertools.product(cases, (0.75, -0.75)):
            v, p = (0, 0, pitch / turn), (0, 0, -side * 0.25 * pitch / turn)
            x, gap = moving_link(v, (0, 0, 1), 0.25, turn, axes, p, q, (1, 0, 0)), 0.25 if side * pitch > 0 else 1.0
            def make(margin):
                return proof([x], [(b, 1), (plate, 0)], [(0, 1, margin)], split_evenly(7, lambda _: leaf(Z)))
            self.holds(files, make(gap - 0.001))
            self.fails("does not prove", files, make(gap + 0.0001))
            for t in (0.0, 0.125, 0.5, 1.0):
                s = 0.25 + turn * t
                distance = math.dist((1 + math.cos(s), side * math.sin(s), side * pitch * t), (5, 6, 7))
                def near(tolerance):
                    return proof([x, free(p=(5, 6, 7))], [(b, 1), (POINT, 2)], [(0, 1, 0.5)], leaf(Z),
                                 witness=(0, t, tolerance - 0.5, corner, corner))
                self.assertNotIn("too far apart", self.run_files(files, near(distance + 1e-9))[0][1])
                self.fails("too far apart", files, near(distance - 1e-9))

    def test_links_against_samples(self):
        rng = random.Random(11)
        for trial in range(40):
            links = random_links(rng, 5, 2.0)
            checker_links = self.exact_links(links)
            for i, t in itertools.product(range(6), (0.0, 0.375, rng.random())):
                place = fadd(*[[lo / so.ONE for lo, _ in x.pose(Fraction(t))[1]] for x in checker_links[i].chain])
                self.assertLess(flength(fsub(place, in_world(links, i, center(links, i), t))), 1e-12)
                columns = checker_links[i].pose(Fraction(t))[0]
                for column, e in zip(columns, UNIT3):
                    self.assertLess(flength(fsub([lo / so.ONE for lo, _ in column], direction(links, i, e, t))), 1e-12)
                    self.assertLess(max(hi - lo for lo, hi in column), 1 << 24)


class Turning(Case):
    def setUp(self):
        # Two plates rotate together about the origin. They are at x = 0 and x = 1 of the same frame.
        self.a = mesh([(0, -3, -3), (0, 3, -3), (0, 0, 3)], [(0, 1, 2)])
        self.b = mesh([(1, -3, -3), (1, 3, -3), (1, 0, 3)], [(0, 1, 2)])
        self.M = self.a, certificate(self.a), self.b, certificate(self.b)
        self.link = free(w=(0, 0, 1.5))

    def plates(self, steps, margin=0.0, apart=False, **more):
        """Returns a proof with both plates on one link, or on two links that are fixed to it."""
        links, ends = ([self.link, free(on=1), free(on=1)], (2, 3)) if apart else ([self.link], (1, 1))
        return proof(links, [*zip((self.a, self.b), ends)], [(0, 1, margin)], steps, **more)

    def test_axis_turns_with_a_body(self):
        axis = along(math.cos(0.75), math.sin(0.75), 0)
        for self.link in (free(w=(0, 0, 1.5)), revolute(beta=1.5), revolute((0, 0, 0.5), beta=3.0)):
            for apart, frame in itertools.product((False, True), (1, 2)):
                self.holds(self.M, self.plates(leaf(axis, frame), 0.99, apart))
                self.fails("does not prove", self.M, self.plates(leaf(axis, 0), 0.0, apart))
                self.fails("does not prove", self.M, self.plates(leaf(X, frame), 0.0, apart))

    def test_two_links_that_turn_alike(self):
        # The lemmas ignore that both rotate about one axis. Over half of an interval each rotates by 0.75 / 2^depth,
        # and theta is twice that. The distance of the corners is at most sqrt 18 for A and sqrt 19 for B.
        for depth, frame in itertools.product((3, 4, 5), (1, 2)):
            theta = 1.5 / 2 ** depth
            second_order_loss = theta ** 2 / 2 * math.sqrt(19 if frame == 1 else 18)   # with the frame of A, and of B
            def make(margin):
                steps = split_evenly(depth, lambda t: leaf(along(math.cos(1.5 * t), math.sin(1.5 * t), 0), frame))
                return two(self.a, self.b, self.link, self.link, steps, margin)
            self.holds(self.M, make(1 - second_order_loss - 1e-6))
            self.fails("does not prove", self.M, make(1 - second_order_loss + 1e-6))

    def test_axis_is_in_world_coordinates_at_the_middle(self):
        def at(middle):
            return leaf(along(math.cos(1.5 * middle), math.sin(1.5 * middle), 0), 1)
        self.holds(self.M, self.plates(split_evenly(2, at, 0, 1), margin=0.99))
        self.fails("does not prove", self.M, self.plates(split_evenly(2, lambda _: leaf(X, 1)), margin=0.99))
        # For one tick the middle is 0, and for three ticks it is 1. The interval is covered to its end.
        self.link = free(w=(0, 0, 0.25))
        for duration, middle in ((1.0, 0), (2.0, 1), (3.0, 1)):
            good = leaf(along(math.cos(middle / 4), math.sin(middle / 4), 0), 2)
            ticks = {"duration": duration - 0.5, "units": TICKS}
            self.holds(self.M, self.plates(good, margin=0.999, **ticks))
            other = leaf(along(math.cos(duration / 8), math.sin(duration / 8), 0), 2)
            if duration != 2.0:
                self.fails("does not prove", self.M, self.plates(other, margin=0.999, **ticks))

    def test_time_is_split(self):
        # A rod of length 1 rotates in the y-z plane by 4 radians. B is 3 above it.
        a = mesh([(0, -1, 0), (0, 1, 0), (0.125, 0, 0)], [(0, 1, 2)])
        files = a, certificate(a), FLAT, FLAT_TREE
        def make(steps): return two(a, FLAT, free(w=(4, 0, 0)), free(p=(0, 0, 3)), steps, margin=1.0)
        self.fails("does not prove", files, make(leaf(Z)))
        good = make(split_evenly(3, lambda _: leaf(Z)))
        self.holds(files, good)
        self.fails("does not prove", files, make(split_evenly(3, lambda t: leaf(Z) if t < 0.9 else leaf(Y))))
        first, size = HEADER + 4 + 3, len(leaf(Z))
        self.fails("file ends", files, good[:-size])                       # without the last leaf
        self.fails("file ends", files, good[:first] + good[first + size:]) # without the first leaf
        # Without the last split and one of its leaves, the interval is longer, and the proof still holds.
        self.holds(files, good[:first - 1] + good[first + size:], make(split_evenly(2, lambda _: leaf(Z))))
        for step in range(first, len(good)):                               # each plane is changed
            if good[step:step + size] == leaf(Z):
                self.fails("", files, good[:step] + leaf(Z)[1:] + good[step + size:])
                self.fails("does not prove", files, good[:step] + leaf(along(0.75, 0, 0)) + good[step + size:],
                           *[good[:step] + leaf(Z, 0, d << 38) + good[step + size:] for d in (-9, 0, 1, 11, 40)])
        self.fails("", files, make(b"\0" + split_evenly(3, lambda _: leaf(Z)))[:-size])


class SecondOrder(Case):
    """Tests each term of the error bound of the lemmas. A margin slightly below the expected bound is proven, and one
    slightly above is not.

    The interval is 0.2 long, and links rotate by 1 radian per time. All meshes are single points."""
    def bound_is(self, expected, links, ends, frame, za=(0, 0, 0), zb=(0, 0, 0), axis=X):
        a, b = points(za), points(zb)
        files = a, certificate(a), b, certificate(b)
        def make(margin):
            return proof(links, [(a, ends[0]), (b, ends[1])], [(0, 1, margin)], leaf(axis, frame), 0.2)
        self.holds(files, make(expected - 1e-6))
        self.fails("does not prove", files, make(expected + 1e-6))

    def test_one_joint(self):
        spin = free(w=(0, 0, 1))
        self.bound_is(1 - 0.005, [spin, free(p=(1, 0, 0))], (1, 2), 1)                     # theta^2 |d|
        # The velocity and the rotation cancel in first order. The second order has theta^2 (|d| + |m|) and 2 theta |m|.
        self.bound_is(1 - 0.005 * (1 + 0.1) - 0.1 * 0.1, [spin, free(p=(1, 0.1, 0), v=(0, -1, 0))], (1, 2), 1)
        self.bound_is(1 - 0.005, [spin, free()], (1, 2), 1, zb=(1, 0, 0))                  # theta^2 r
        back = free(q=(0, 0, -math.sin(0.05), math.cos(0.05)), w=(0, 0, 1))             # unrotated at the middle
        self.bound_is(1 - 0.005, [free(), back], (1, 2), 0, zb=(1, 0, 0))
        self.bound_is(1 - 0.005, [back, free()], (1, 2), 0, za=(-1, 0, 0))
        joint = revolute(alpha=-0.1, beta=1.0)
        self.bound_is(1 - 0.005, [free(), joint], (1, 2), 0, zb=(1, 0, 0))
        self.bound_is(1, [back], (1, 1), 2, za=(0, 1, 0), zb=(1, 1, 0))         # both bodies rotate together
        self.bound_is(1, [joint], (1, 1), 1, za=(0, 1, 0), zb=(1, 1, 0))

    def test_one_axis(self):
        # theta ignores the directions of the axes. For two joints theta is 0.2 and K' is 0.04.
        joint = revolute(alpha=-0.1, beta=1.0)
        back = free(q=(0, 0, -math.sin(0.05), math.cos(0.05)), w=(0, 0, 1))
        # The path has one joint up and one down, so Omega = 0. A is at 1 from its center, and B at sqrt 2.
        for x in (joint, back):
            self.bound_is(1 - 0.02, [x, x], (1, 2), 2, za=(0, 1, 0), zb=(1, 1, 0))
            self.bound_is(1 - 0.02 * math.sqrt(2), [x, x], (1, 2), 1, za=(0, 1, 0), zb=(1, 1, 0))
        # The second joint is on the first one. It rotates in the same or the opposite direction, or about another axis.
        for axis in ((0, 0, 1), (0, 0, -1), (1, 0, 0), (0.6, 0, 0.8)):
            second = revolute(axis, -0.1, 1.0, on=1)
            self.bound_is(1 - 0.02, [joint, second], (0, 2), 0, zb=(1, 0, 0))
            self.bound_is(1 - 0.02, [joint, second], (2, 0), 1, zb=(1, 0, 0))
            self.bound_is(1 - 0.02, [joint, second, free(p=(1, 0, 0), on=2)], (0, 3), 0)
            # The offset between the joints rotates with the first one.
            second = revolute(axis, -0.1, 1.0, p=(1, 0, 0), on=1)
            self.bound_is(1 - 0.005, [joint, second], (0, 2), 0)
        # The joints have different speeds: 0.1 and 0.3.
        second = revolute((0, 0, 0.5), -0.6, 6.0, on=1)
        self.bound_is(1 - 0.4 ** 2 / 2, [joint, second], (0, 2), 0, zb=(1, 0, 0))
        # The offset on the second joint becomes longer: theta^2 (|d| + |m|) + 2 theta |m|.
        slide = [joint, revolute(alpha=-0.1, beta=1.0, on=1), prismatic((1, 0, 0), 0.9, 1.0, on=2)]
        self.bound_is(1 - 0.1 - (0.04 * 1.1 + 2 * 0.2 * 0.1) / 2, slide, (0, 3), 0)

    def test_chains(self):
        z, x = revolute(alpha=-0.1, beta=1.0), revolute((1, 0, 0), -0.1, 1.0, on=1)
        # The link rotates about z and then about x, so theta = 0.2. A point on x is on the axis of its own joint.
        self.bound_is(1 - 0.02, [z, x], (0, 2), 0, zb=(1, 0, 0))
        self.bound_is(1 - 0.02, [z, x], (2, 0), 0, za=(-1, 0, 0))                           # the same for A
        self.bound_is(1 - 0.02, [z, x, free(p=(1, 0, 0), on=2)], (0, 3), 0)    # an offset instead of a point
        # The frame rotates with the end of the chain. The path goes up through x and then z, with opposite signs.
        self.bound_is(1 - 0.02, [z, x], (2, 0), 1, zb=(1, 0, 0))
        self.bound_is(1 - 0.02, [z, x], (0, 2), 2, za=(-1, 0, 0))
        # The path goes up through x to z, and down through another joint with the same rotation.
        twin = revolute((1, 0, 0), -0.1, 1.0, on=1)
        self.bound_is(1 - 0.02, [z, x, twin], (2, 3), 1, zb=(1, 0, 0))
        # The path goes up through x, and then along the offset of the twin. Its length is 1. It rotates with z's link.
        twin = revolute((1, 0, 0), -0.1, 1.0, p=(1, 0, 0), on=1)
        self.bound_is(1 - 0.005, [z, x, twin], (2, 3), 1)
        # Each offset has its own bound. The path from A to B has the offsets 5 and -4, a path from the world only one.
        offset_links = [z, *(revolute((1, 0, 0), -0.1, 1.0, p=(x, 0, 0), on=1) for x in (-5, -4))]
        for frame in (0, 1, 2):
            self.bound_is(1 - 0.005 * 9, offset_links, (2, 3), frame)
        # A prismatic joint does not rotate. Its offset of 3 and the next offset of 4 rotate with the joint before.
        slide = [z, prismatic((1, 0, 0), -3.0, 0.0, on=1), revolute((1, 0, 0), -0.1, 1.0, p=(4, 0, 0), on=2)]
        self.bound_is(1 - 0.005 * 7, slide, (0, 3), 0)
        # The offset becomes longer: theta^2 (|d| + |m|) + 2 theta |m|.
        slide = [z, prismatic((1, 0, 0), 0.9, 1.0, on=1)]
        self.bound_is(1 - 0.1 - (0.01 * 1.1 + 2 * 0.1 * 0.1) / 2, slide, (0, 2), 0)
        # A screw rotates, and its offset becomes longer. The offset comes before the rotation, and the point after it.
        screw = [z, moving_link((1, 0, 0), (0, 0, 1), -0.1, 1.0, 1, p=(1, 0, 0), on=1)]
        self.bound_is(1 - 0.1 - (0.01 * 1.1 + 2 * 0.1 * 0.1) / 2, screw, (0, 2), 0)
        self.bound_is(2 - 0.1 - (0.01 * 1.1 + 2 * 0.1 * 0.1 + 0.04) / 2, screw, (0, 2), 0, zb=(1, 0, 0))
        # In the frame of the screw, the path has the rotation before the offset. A is at the position of z.
        self.bound_is(1 - 0.1 - (0.01 * 1.1 + 2 * 0.1 * 0.1) / 2, screw, (1, 2), 2)

    def test_three_joints(self):
        # theta = 0.3 for any axes in any order. Along one axis the bound is tight.
        for axis in ((0, 1, 0), (math.sqrt(0.5), 0, math.sqrt(0.5)), (0, 0, 1), (1, 0, 0)):
            joints = [revolute(alpha=-0.1, beta=1.0), revolute((1, 0, 0), -0.1, 1.0, on=1),
                      revolute(axis, -0.1, 1.0, on=2)]
            self.bound_is(1 - 0.09 / 2, joints, (0, 3), 0, zb=(1, 0, 0))
            self.bound_is(1 - 0.09 / 2, joints, (3, 0), 0, za=(-1, 0, 0))
            self.bound_is(1 - 0.09 / 2, joints, (3, 0), 1, zb=(1, 0, 0))
        joints = [revolute(alpha=-0.1, beta=1.0, on=i) for i in range(3)]
        self.bound_is(1 - 0.09 / 2, joints, (0, 3), 0, zb=(1, 0, 0))


class SecondDerivatives(Case):
    """Compares Lemma 2 with numerical derivatives of motions in binary64."""
    # The weights of the finite difference formula for the second derivative.
    STENCIL, STEP = (1 / 90, -3 / 20, 3 / 2, -49 / 18, 3 / 2, -3 / 20, 1 / 90), 0.02

    def pose_in_frame(self, links, frame, end, t):
        """Returns the position of the center and the axes of the link `end`, in the frame of the link `frame`."""
        origin, axes = in_world(links, frame, center(links, frame), t), [direction(links, frame, e, t) for e in UNIT3]
        place = fsub(in_world(links, end, center(links, end), t), origin)
        return [[fdot(x, e) for e in axes] for x in (place, *(direction(links, end, e, t) for e in UNIT3))]

    def longest(self, columns):
        """Returns the spectral norm of the matrix with these columns, or slightly less."""
        u = 0.8, 0.48, 0.36
        for _ in range(20):
            x = fadd(*map(fscale, u, columns))
            u = [fdot(column, x) for column in columns]
            u = fscale(1 / (flength(u) or 1), u)
        return flength(fadd(*map(fscale, u, columns)))

    def fractions(self, links, frame, end, t0, t1):
        """Returns the largest ratio of a sampled derivative to its bound: K and K'. It is None for a small bound."""
        checker_links, t, h = self.exact_links(links), (t0 + t1) / 2, (t1 - t0) / 2
        *_, k, k_prime = so.motion(checker_links[frame], checker_links[end], Fraction(t), so.fix(Fraction(h)))
        maxima, out = [0, 0], []
        for i in range(-4, 5):
            samples = [self.pose_in_frame(links, frame, end, t + (i / 4 + j * self.STEP) * h) for j in range(-3, 4)]
            place, *columns = [fscale(self.STEP ** -2, fadd(*map(fscale, self.STENCIL, v))) for v in zip(*samples)]
            maxima = [*map(max, maxima, (flength(place), self.longest(columns)))]
        for min_tolerance, bound in zip(maxima, (k / so.ONE, k_prime / so.ONE)):
            self.assertLessEqual(min_tolerance, bound * (1 + 1e-6) + 1e-8)
            out.append(min_tolerance / bound if bound > 0.01 else None)
        return out

    def test_random_chains(self):
        rng, fractions = random.Random(14), ([], [])
        for trial in range(200):
            count = rng.randint(1, 5)
            links = random_links(rng, count, rng.choice((1.0, 3.0)))
            frame, end, k = rng.randint(0, count), rng.randint(0, count), rng.randrange(1, 5)
            i = rng.randrange(1 << k)
            for found, fraction in zip(fractions, self.fractions(links, frame, end, i / 2 ** k, (i + 1) / 2 ** k)):
                if fraction is not None:
                    found.append(fraction)
        for found, mean in zip(fractions, (0.4, 0.7)):
            self.assertGreater(len(found), 50)
            self.assertGreater(sum(found) / len(found), mean)

    def test_bounds_that_are_needed(self):
        # With all joints along one axis, K' is tight. So is the bound of an offset across that axis, up or down.
        for count in (1, 2, 3):
            joints = [revolute(alpha=-0.1 * i, beta=1.0 + i, on=i) for i in range(count)]
            arm = [*joints, free(p=(1, 0, 0), on=count)]
            self.assertGreater(self.fractions(joints, 0, count, 0.25, 0.5)[1], 0.999)
            self.assertGreater(self.fractions(joints, count, 0, 0.25, 0.5)[1], 0.999)
            self.assertGreater(self.fractions(arm, 0, count + 1, 0.25, 0.5)[0], 0.999)
            # On the way up, all later joints rotate the offset of the first one.
            up = [joints[0]._replace(p=(1, 0, 0)), *joints[1:]]
            self.assertGreater(self.fractions(up, count, 0, 0.25, 0.5)[0], 0.999)
            # The path goes up and down, with opposite rotations.
            down = [x._replace(beta=-x.beta, alpha=-x.alpha, on=x.on and x.on + count) for x in joints]
            both = [*joints, *down, free(p=(1, 0, 0), on=2 * count)]
            place, along_parent_axes = self.fractions(both, count, 2 * count + 1, 0.25, 0.5)
            self.assertGreater(min(place, along_parent_axes), 0.999)
        # An offset that passes the axis needs 2 theta |m|. Its theta^2 |m| is comparatively small.
        for half, least in ((0.05, 0.95), (0.01, 0.99)):
            slide = [revolute(beta=1.0), prismatic((1000, 0, 0), -0.5, 1.0, on=1)]
            self.assertGreater(self.fractions(slide, 0, 2, 0.5 - half, 0.5 + half)[0], least)
            self.assertGreater(self.fractions([prismatic((1000, 0, 0), -0.5, 1.0), revolute(beta=1.0, on=1)], 2, 0,
                                           0.5 - half, 0.5 + half)[0], least)


class Balls(Case):
    """Tests leaves with balls. A margin slightly below the expected bound is proven, and one slightly above is not.
    Distances are exact in binary64, except after rotations."""
    def pair_bound_is(self, expected, a, b, la, lb, step, slack=0.0, **more):
        self.bound_is(expected, [la, lb], a, b, (1, 2), step, slack, **more)

    def bound_is(self, expected, links, a, b, ends, step, slack=1e-9, orders=(None, None), **more):
        files = [x for m, order in zip((a, b), orders) for x in (m, certificate(m, order))]
        def make(margin): return proof(links, [(a, ends[0]), (b, ends[1])], [(0, 1, margin)], step, **more)
        if expected <= 0:
            self.fails("is too near", files, make(0.0))
        else:
            self.holds(files, make(expected - slack if slack else math.nextafter(expected, 0)))
            reason = f"the ball around {'AB'[step[0] - 6]} of pair 0 is too near the other node"
            self.fails(reason, files, make(expected + slack))

    def bounds_are(self, want_a, want_b, a, b, la=free(), lb=free(), slack=0.0, **more):
        """Tests the margins that a ball around A and one around B prove, and the same with A and B exchanged."""
        for expected, step, other in ((want_a, AROUND_A, AROUND_B), (want_b, AROUND_B, AROUND_A)):
            self.pair_bound_is(expected, a, b, la, lb, step, slack, **more)
            self.pair_bound_is(expected, b, a, lb, la, other, slack, **more)

    def test_points(self):
        for x, y, z, distance in ((1, 0, 0, 1), (0, -2, 0, 2), (0, 0, 0.5, 0.5), (3, -4, 12, 13), (-2, 3, 6, 7),
                             (0, 0, 0, 0)):
            self.bounds_are(distance, distance, POINT, points((x, y, z)))
            self.bounds_are(distance, distance, POINT, POINT, free(p=(1, 2, 3)), free(p=(1 + x, 2 + y, 3 + z)))
            self.bounds_are(distance, distance, POINT, points((x - 1, y + 2, z)), lb=free(p=(1, -2, 0), c=(7, 8, -9)))

    def test_radii(self):
        for ra, rb in ((0.25, 0), (0, 0.25), (0.5, 0.125), (0.75, 0.25), (2, 0)):
            self.bounds_are(1 - ra - rb, 1 - ra - rb, points((0, 0, 0, ra)), points((0, 0, 1, rb)))
        # The ball's center is that of the bounding box of the vertices, and the largest radius is added to its radius.
        self.bounds_are(1.5, 1.5, points((0, 0, 0), (2, 0, 0, 0.5)), points((4, 0, 0)))
        self.bounds_are(1.5, 2, points((0, 0, 0, 0.5), (2, 0, 0)), points((4, 0, 0)))
        # Boxes of the other node are split down to triangles. A triangle counts with the largest radius of its corners.
        a = points((0, 0, 0, 0.125))
        self.pair_bound_is(0.625, a, points((1, 0, 0, 0.25), (3, 0, 0, 1.5)), free(), free(), AROUND_A)
        b = mesh([(1, 0, 0), (3, 0, 0, 0.5), (3, 1, 0)], [(0, 1, 2)])
        self.pair_bound_is(0.875 - 0.5, a, b, free(), free(), AROUND_A)

    def test_ball_is_around_the_box(self):
        # The box of A is 6 by 8 around (7, -2, 1), with most vertices at one end.
        a = points((4, -2, 5), (10, -2, 5), (4, -2, -3), (4, -2, 4.5), (4, -2, 4))
        for place, distance in (((7, -10, 1), 8), ((7, 10, 1), 12), ((22, -2, 1), 15), ((10, 2, 13), 13),
                                ((7, 3, 1), 5)):
            self.pair_bound_is(distance - 5, a, points(place), free(), free(), AROUND_A)
        a = mesh([(4, -2, 5), (10, -2, 5), (4, -2, -3)], [(0, 1, 2)])
        for place, distance, near in (((7, -10, 1), 8, 8), ((7, 10, 1), 12, 12), ((22, -2, 1), 15, 12),
                                      ((7, 3, 1), 5, 5)):
            self.bounds_are(distance - 5, near, a, points(place))
        self.pair_bound_is(13 - 2.5, points((0, 0, 0), (3, 4, 0)), points((4.5, 6, 12)), free(), free(), AROUND_A)
        # The ball reaches the farthest vertex, not the corners of the box. Here its radius is 4 around the origin.
        a = points((-3, 0, 0), (0, 0, 4), (3, 0, 0), (0, 0, -4))
        for order in itertools.permutations(range(4)):
            self.bound_is(13 - 4, [], a, points((5, 12, 0)), (0, 0), AROUND_A, 0.0, orders=(order, None))
        # The farthest vertex and the largest radius may belong to different vertices.
        a = points((-3, 0, 0, 0.5), (0, 0, 4, 0.25), (3, 0, 0, 0.75), (0, 0, -4))
        self.pair_bound_is(13 - 4.75, a, points((5, 12, 0)), free(), free(), AROUND_A)

    def test_other_part_is_boxes_of_triangles(self):
        # A point is in the box of a triangle, but not in the triangle. No ball separates them, but a plane does.
        b = mesh([(0, 0, 0), (2, 0, 0), (0, 2, 0)], [(0, 1, 2)])
        self.pair_bound_is(0, points((1.5, 1.5, 0)), b, free(), free(), AROUND_A)
        self.pair_bound_is(0, points((2, 2, 0)), b, free(), free(), AROUND_A)
        self.pair_bound_is(1, points((2, 3, 0)), b, free(), free(), AROUND_A)
        self.pair_bound_is(5, points((5, 6, 0)), b, free(), free(), AROUND_A)
        self.pair_bound_is(13, points((5, 6, -12)), b, free(), free(), AROUND_A)
        self.pair_bound_is(13, points((-3, -4, 12)), b, free(), free(), AROUND_A)
        self.pair_bound_is(3, points((1, -3, 0)), b, free(), free(), AROUND_A)
        a = points((1.5, 1.5, 0))
        apart = two(a, b, free(), free(), leaf(along(-math.sqrt(0.5), -math.sqrt(0.5), 0)), 0.7)
        self.holds((a, certificate(a), b, certificate(b)), apart)
        # The nearest triangle counts, at any index. The boxes of most nodes contain the point.
        b = points((-3, -4, 0), (6, 8, 0), (0, 2, 0), (0, 7, 0))
        for order in itertools.permutations(range(4)):
            self.bound_is(2, [], points((0, 0, 0)), b, (0, 0), AROUND_A, 0.0, orders=(None, order))

    def test_moves(self):
        # B passes A. At half of the time it is 4 away. It moves by 3 to both sides of that point.
        self.bounds_are(1, 1, POINT, points((5, 0, 0)), lb=free(p=(-1, -3, 0), v=(0, 6, 0)))
        self.bounds_are(1, 1, POINT, POINT, la=free(v=(1, 0, 0)), lb=free(p=(4, -3, 0), v=(1, 6, 0)))
        self.bounds_are(3, 3, POINT, POINT, lb=free(p=(5, 0, 0), v=(-2, 0, 0)))
        self.bounds_are(3, 3, POINT, POINT, lb=prismatic((-1, 0, 0), -5.0, 2.0))
        self.bounds_are(0, 0, POINT, POINT, lb=free(p=(5, 0, 0), v=(-5, 0, 0)))
        self.bounds_are(2, 2, POINT, POINT, lb=free(p=(5, 0, 0), v=(-2, 0, 0)), duration=1.5)
        self.bounds_are(5, 5, POINT, POINT, lb=free(p=(5, 0, 0), v=(-2, 0, 0)), duration=0.0)
        lb = free(p=(4, -3, 0), v=(0, 6, 0))
        for step in (AROUND_A, AROUND_B):
            made = [two(POINT, POINT, free(), lb, split_evenly(1, lambda _: step), margin) for margin in (2.77, 2.78)]
            self.holds((POINT, POINT_TREE), made[0])                            # sqrt(16 + 2.25) - 1.5
            self.fails("is too near", (POINT, POINT_TREE), made[1])

    def test_ticks(self):
        # For one tick the middle is 0, and the interval begins before. For three ticks the middle is 1.
        for ticks, expected in ((1, 10 - 1), (2, 9 - 1), (3, 9 - 2), (4, 8 - 2)):
            for duration in ticks - 1.0, ticks - 0.5:
                more = {"lb": free(p=(10, 0, 0), v=(-1, 0, 0)), "duration": duration, "units": TICKS}
                self.bounds_are(expected, expected, POINT, POINT, **more)

    def test_units(self):
        a, b = points((0, 0, 0, 0.125), (6, 0, 8)), points((3, 12, 4, 0.125), (3, 20, 4))
        for e in (-1000, -60, -40, 0, 3, 40, 100):
            for lb in (free(), free(p=(0, -1, 0), v=(0, 2, 0)), free(c=(2.0 ** -60, 2.0 ** 40, 0))):
                drop = any(lb.v)
                slack = 1e-6 if e > 64 else 0.0
                self.pair_bound_is(12 - 5 - 0.25 - drop, a, b, free(), lb, AROUND_A, slack, units=(e, 0))
        large = 2.0 ** 990
        self.bounds_are(2 * large, 2 * large, POINT, points((0, 3 * large, 0, large)), units=(950, 0))
        tiny = 5e-324
        self.bounds_are(2 * tiny, 2 * tiny, POINT, points((0, 3 * tiny, 0, tiny)), units=(-1074, 0))

    def test_both_move_together(self):
        # The frame is the other body's link.
        a, b = points((20, 0, 0)), points((23, 4, 0))
        common_motion = free(p=(-4.5, 4.5, -4.5), v=(9, -9, 9))
        self.bounds_are(5, 5, a, b, common_motion, common_motion)
        self.bounds_are(0, 0, a, b, common_motion, free())          # each moves by 7.8 to both sides
        self.bounds_are(0, 0, a, b, free(), common_motion)
        for spin in (revolute(beta=6.0), revolute((1, 2, -2), 1.0, 2.0, p=(1, 1, 1)),
                     free(w=(3, -6, 6), v=(1, 9, 9), c=(1, 2, 3))):
            for step in (AROUND_A, AROUND_B):
                self.bound_is(5, [spin], a, b, (1, 1), step)
                self.bound_is(5, [spin, free(p=(1, 0, 0), on=1), free(p=(1, 3, 4), on=1)], POINT, POINT, (2, 3), step)
                # One of them slides on the rotating link, by 1 to both sides of (3, 4, 0).
                self.bound_is(4, [spin, free(on=1), free(p=(2, 4, 0), v=(2, 0, 0), on=1)], POINT, POINT, (2, 3), step)
                self.bound_is(0, [spin, free(on=1)], a, b, (2, 0), step)
                self.bound_is(0, [spin, free(on=1)], a, b, (0, 2), step)

    def test_turning(self):
        # A rotates by 0.5 to both sides. The corner at distance 2 moves by 1 in first order, and the second order adds
        # half of 0.25 * 2. In the frame of A, the corner of B at distance 10 rotates instead.
        corner, distance, back = points((2, 0, 0)), points((10, 0, 0)), (0, 0, -math.sin(0.25), math.cos(0.25))
        for a in (revolute(alpha=-0.5, beta=1.0), revolute((0, 0, -0.25), 2.0, -4.0), free(q=back, w=(0, 0, 1))):
            self.bounds_are(8 - 1 - 0.25, 8 - 5 - 1.25, corner, distance, a, free(), 1e-9)
            self.bounds_are(7.75 - 1 - 0.25, 7.75 - 5 - 1.25, points((2, 0, 0, 0.25)), distance, a, free(), 1e-9)
            # The center of the ball counts, not the corners of the node.
            self.bounds_are(10, 10 - 5 - 1.25, POINT, distance, a, free(), 1e-9)
            self.pair_bound_is(10 - 3, points((-3, 0, 0), (3, 0, 0)), distance, a, free(), AROUND_A, 1e-9)
            self.pair_bound_is(8 - 3 - 1 - 0.25, points((-1, 0, 0), (5, 0, 0)), distance, a, free(), AROUND_A, 1e-9)
            # On the axis nothing moves, but the bound of the second derivative ignores the direction of the offset.
            self.bounds_are(10 - 0.25, 10 - 1.5, points((0, 0, 2)), points((0, 0, 12)), a, free(), 1e-9)
        # With another center, the corner is at distance 2 from it.
        a = free(p=fscale(-5, rotate(back, (1, 0, 0))), q=back, w=(0, 0, 1), c=(5, 0, 0))
        self.pair_bound_is(8 - 1 - 0.25, points((7, 0, 0)), distance, a, free(), AROUND_A, 1e-9)
        # At the middle of the time A points to y.
        a = revolute(alpha=math.pi / 2 - 0.5, beta=1.0)
        self.pair_bound_is(8 - 1.25, corner, points((0, 10, 0)), a, free(), AROUND_A, 1e-9)
        self.pair_bound_is(math.sqrt(104) - 1.25, corner, distance, a, free(), AROUND_A, 1e-9)
        # Half of the velocity, and the rotation's displacement of 1 along y, are added as vectors.
        for v, m in (((6, 0, 0), math.hypot(3, 1)), ((0, 6, 0), 4), ((0, -2, 0), 0), ((0, -6, 0), 2),
                     ((0, 0, 1), math.hypot(1, 0.5))):
            a = free(p=fscale(-0.5, v), q=back, v=v, w=(0, 0, 1))
            self.pair_bound_is(8 - m - 0.25, corner, distance, a, free(), AROUND_A, 1e-9)

    def test_chains(self):
        # As in SecondOrder, the interval is 0.2 long, and each joint rotates by 0.1 to both sides.
        z, x, k = revolute(alpha=-0.1, beta=1.0), revolute((1, 0, 0), -0.1, 1.0, on=1), 0.2 ** 2
        one, distance = points((1, 0, 0)), points((10, 0, 0))
        self.bound_is(9 - 0.1 - k / 2, [z, x], one, distance, (2, 0), AROUND_A, duration=0.2)
        self.bound_is(9 - 0.1 - k / 2, [z, x], distance, one, (0, 2), AROUND_B, duration=0.2)
        self.bound_is(9 - 0.1 - k / 2, [z, x, free(p=(1, 0, 0), on=2)], POINT, distance, (3, 0), AROUND_A, duration=0.2)
        self.bound_is(9 - 1 - 10 * k / 2, [z, x], one, distance, (2, 0), AROUND_B, duration=0.2)
        # In the frame of the link of z, only x rotates, about the axis through the point.
        self.bound_is(9 - 0.005, [z, x], one, distance, (2, 1), AROUND_A, duration=0.2)
        self.bound_is(9 - 0.05, [z, x], one, distance, (2, 1), AROUND_B, duration=0.2)
        # Two joints rotate by the same angle, so the links are static relative to each other. The lemmas ignore
        # that the joints have the same axis.
        twin = revolute((1, 0, 0), -0.1, 1.0, on=1)
        self.bound_is(9 - k / 2, [z, x, twin], one, distance, (2, 3), AROUND_A, duration=0.2)
        self.bound_is(9 - 10 * k / 2, [z, x, twin], one, distance, (2, 3), AROUND_B, duration=0.2)

    def test_axes_of_links(self):
        # B is a rod along its own x, which is rotated to y = x. In its frame A is at (12, 5), or at (-5, -12).
        q, s = (0, 0, math.sin(math.pi / 8), math.cos(math.pi / 8)), math.sqrt(0.5)
        rod_b = points(*[(i, 0, 0) for i in range(25)])
        for up in (free, revolute, prismatic):
            lb = up(p=(1, 2, 3), q=q)
            self.pair_bound_is(5, points((1 + 7 * s, 2 + 17 * s, 3)), rod_b, free(), lb, AROUND_A, 1e-9)
            self.pair_bound_is(13, points((1 + 7 * s, 2 - 17 * s, 3)), rod_b, free(), lb, AROUND_A, 1e-9)
        # The center of the ball around A is at (0, 1, 0) after a quarter turn. The rotation of B does not matter.
        a, quarter = points((0, 0, 0), (2, 0, 0)), (0, 0, math.sqrt(0.5), math.sqrt(0.5))
        for qb in ((0, 0, 0, 1), quarter, (0.5, 0.5, 0.5, 0.5)):
            self.pair_bound_is(1, a, POINT, free(q=quarter), free(p=(0, 3, 0), q=qb), AROUND_A, 1e-9)
            self.pair_bound_is(4, a, POINT, free(q=quarter), free(p=(3, 5, 0), q=qb), AROUND_A, 1e-9)
        # Both links have centers that are not at the origin.
        la, lb = free(q=quarter, c=(3, 1, 2)), free(p=(0, 3, 0), q=quarter, c=(-1, 4, 2))
        self.pair_bound_is(1, a, POINT, la, lb, AROUND_A, 1e-9)

    def test_parts(self):
        # The ball around the whole A contains B. The balls around its points do not.
        a, b = points((0, 0, 0), (6, 0, 0)), points((3, 4, 0))
        self.pair_bound_is(1, a, b, free(), free(), AROUND_A)
        files = a, certificate(a), b, certificate(b)
        def make(steps, margin): return two(a, b, free(), free(), steps, margin)
        for steps in (b"\0" + AROUND_A + AROUND_A, b"\0" + AROUND_B + AROUND_A, AROUND_B):
            self.holds(files, make(steps, math.nextafter(5, 0)))
            self.fails("is too near", files, make(steps, 5))
        # Only one half of A is far enough from B. The other half needs another leaf.
        for order, first in (((0, 1), True), ((1, 0), False)):
            a = mesh([(0, 0, 0), (2, 0, 0), (0, 2, 0), (-9, 0, 0)], [(0, 1, 2), (3, 3, 3)])
            b = points((1.5, 1.5, 0))
            files, plane = (a, certificate(a, order), b, certificate(b)), leaf(along(math.sqrt(0.5), math.sqrt(0.5), 0))
            for ball in (AROUND_A, AROUND_B):
                self.fails("is too near", files, make(ball, 0.5), make(b"\0" + ball + ball, 0.5))
                steps = [plane, ball] if first else [ball, plane]
                self.holds(files, make(b"\0" + b"".join(steps), 0.5))
                reason = f"the ball around {'AB'[ball[0] - 6]} of"
                self.fails(reason, files, make(b"\0" + b"".join(reversed(steps)), 0.5))
        # The same with exchanged bodies: step 1 splits B.
        a, b = b, a
        files = a, certificate(a), b, certificate(b, (0, 1))
        plane = leaf(along(-math.sqrt(0.5), -math.sqrt(0.5), 0))
        for ball in (AROUND_A, AROUND_B):
            self.holds(files, make(b"\1" + plane + ball, 0.5))
            self.fails("is too near", files, make(ball, 0.5), make(b"\1" + ball + plane, 0.5))
        self.fails("cannot be split", files, make(b"\0" + AROUND_A + AROUND_A, 0.5))

    def test_only_the_part_counts(self):
        # Only the two nodes of the entry count, not the whole bodies.
        a, b = points((0, 0, 0), (100, 0, 0)), points((0, 8, 0), (100, -9, 0))
        files = a, certificate(a), b, certificate(b)
        quarters = b"\0" + (b"\1" + AROUND_A + AROUND_B) + (b"\1" + AROUND_B + AROUND_A)
        self.holds(files, two(a, b, free(), free(), quarters, math.nextafter(8, 0)))
        self.fails("ball around A", files, two(a, b, free(), free(), quarters, 8.0))
        self.fails("is too near", files, two(a, b, free(), free(), AROUND_A, 1.0))

    def test_file(self):
        a, b = POINT, points((0, 0, 1))
        files = a, certificate(a), b, certificate(b)
        def make(steps): return two(a, b, free(), free(), steps, 0.5)
        for ball in (AROUND_A, AROUND_B):
            good = make(ball)
            self.assertEqual(len(good), HEADER + 4 + 1)
            self.holds(files, good, make(split_time(ball, leaf(Z))), make(split_time(leaf(Z), ball)))
            self.assertIn("leaves: 3,", self.run_files(files, make(split_time(ball, split_time(leaf(Z), ball))))[0][1])
            self.fails("file ends", files, good[:-1], make(split_time(ball, b"")))
            self.fails("ends too early", files, good[:-2])
            self.fails("bytes follow", files, good + b"\0", good + ball, make(ball + leaf(Z)[1:]))
        self.fails("no such step", files, make(b"\10"), make(split_time(AROUND_A, b"\10")), make(b"\377"))

    def test_pairs(self):
        bodies, links = [(POINT, 1), (POINT, 2), (POINT, 3)], [free(), free(p=(0, 0, 1)), free(p=(0, 0, 3))]
        def make(margins, steps): return proof(links, bodies, [*zip((0, 1, 2), (1, 2, 0), margins)], steps)
        files, steps = (POINT, POINT_TREE), AROUND_A + AROUND_B + AROUND_A
        self.holds(files, make((0.99, 1.99, 2.99), steps))
        for k, around in enumerate("ABA"):
            margins = [0.99, 1.99, 2.99]
            margins[k] += 0.02
            self.fails(f"the ball around {around} of pair {k} is too near the other node", files, make(margins, steps))
        # A body has no distance from itself.
        for pair in ((0, 0), (1, 1)):
            for step in (AROUND_A, AROUND_B):
                self.fails("is too near", files, proof(links, bodies, [(*pair, 0.0)], step))


class Pairs(Case):
    def setUp(self):
        self.links = [free(), free(p=(0, 0, 1)), free(p=(0, 0, 3), v=(0, 0, -0.5))]
        ball = with_radii(FLAT, 0.25)
        self.bodies = [(FLAT, 1), (FLAT, 2), (ball, 3)]
        self.M = FLAT, FLAT_TREE, ball, certificate(ball)

    def make(self, pairs, steps, **more): return proof(self.links, self.bodies, pairs, steps, **more)

    def test_margins(self):
        pairs = [(0, 1, 0.99), (1, 2, 1.24), (2, 0, 2.24)]
        steps = [leaf(Z), leaf(Z), leaf(minus(Z))]
        self.holds(self.M, self.make(pairs, b"".join(steps)))
        for i in range(3):
            a, b, margin = pairs[i]
            more = [*pairs[:i], (a, b, margin + 0.02), *pairs[i + 1:]]
            self.fails(f"pair {i} apart", self.M, self.make(more, b"".join(steps)))
            self.fails("", self.M, self.make(pairs, b"".join(steps[:i] + steps[i + 1:])))
        self.fails("file ends", self.M, self.make(pairs, steps[0] + steps[1]))
        self.fails("bytes follow", self.M, self.make(pairs, b"".join(steps) + steps[2]), self.make([], leaf(Z)))
        self.fails("pair 1 apart", self.M, self.make(pairs, steps[0] + steps[2] + steps[1]))
        self.fails("pair 0 apart", self.M, self.make([pairs[2], pairs[1], pairs[0]], b"".join(steps)))
        self.holds(self.M, self.make(pairs, steps[0] + split_time(leaf(Z), leaf(Z)) + steps[2]))

    def test_an_axis_turns_with_bodies_of_its_pair(self):
        self.links[2] = revolute(beta=0.125, p=(0, 0, 3))
        pairs = [(0, 1, 0.99), (1, 2, 1.7), (0, 2, 2.7)]
        self.holds(self.M, self.make(pairs, leaf(Z, 1) + leaf(Z, 2) + leaf(Z, 2)))
        self.links[2] = revolute((1, 0, 0), -0.5, 0.125, p=(0, 0, 3))
        self.fails("pair 1 apart", self.M, self.make(pairs, leaf(Z, 1) + leaf(Z, 2) + leaf(Z, 2)))

    def test_witness_of_a_pair(self):
        pairs, steps, corner = [(0, 1, 0.99), (1, 2, 1.24)], leaf(Z) * 2, (0, (WHOLE, 0, 0))
        # The gaps are 1 and 2 - 0.5 t. The radius of one body leaves 1.75 - 0.5 t of the second gap.
        for time in (0.0, 0.5, 1.0):
            min_tolerance = 2 - 0.5 * time - 1.24 - 0.25
            self.holds(self.M, self.make(pairs, steps, witness=(0, time, 0.011, corner, corner)),
                       self.make(pairs, steps, witness=(1, time, min_tolerance + 0.001, corner, corner)))
            self.fails("too far apart", self.M, self.make(pairs, steps, witness=(0, time, 0.009, corner, corner)),
                       self.make(pairs, steps, witness=(1, time, min_tolerance - 0.001, corner, corner)))
        self.fails("no such pair", self.M, self.make(pairs, steps, witness=(2, 0.5, 9.0, corner, corner)))
        self.fails("no such pair", self.M, self.make([], b"", witness=(0, 0.5, 9.0, corner, corner)))


class Parts(Case):
    def setUp(self):
        # A is a notch of the plates x = -1 and y = -1, with a small triangle B in it. No single plane separates them.
        self.a = mesh([(-1, -1, -9), (-1, 9, 0), (-1, -1, 9), (9, -1, 0)], [(0, 1, 2), (0, 3, 2)])
        self.b = mesh([(-0.75, -0.75, 0), (-0.5, -0.75, 0), (-0.75, -0.5, 0)], [(0, 1, 2)])
        self.cb = certificate(self.b)
        self.ca = certificate(self.a, [0, 1])
        self.rest = free(), free()

    def notch(self, steps, ca=None, links=None, **more):
        return (self.a, ca or self.ca, self.b, self.cb), two(self.a, self.b, *(links or self.rest), steps, **more)

    def test_split(self):
        for axis in (X, Y, along(math.sqrt(0.5), math.sqrt(0.5), 0), minus(X)):
            self.fails("does not prove", *self.notch(leaf(axis)))
        steps = b"\0" + leaf(X) + leaf(Y)
        self.holds(*self.notch(steps, margin=0.24))
        self.fails("does not prove", *self.notch(steps, margin=0.26))
        self.fails("does not prove", *self.notch(b"\0" + leaf(Y) + leaf(X)))
        self.fails("file ends", *self.notch(b"\0" + leaf(X)))
        self.fails("bytes follow", *self.notch(steps + leaf(X)))
        self.holds(*self.notch(b"\0" + leaf(X) + split_time(leaf(Y), leaf(Y)), margin=0.24))

    def test_moved_by_one_unit(self):
        # The gaps are exactly 0.25. Moving a corner by one unit in the last place makes the gap smaller.
        checker_links = math.nextafter(0.25, 0)
        steps = b"\0" + leaf(X) + leaf(Y)
        self.holds(*self.notch(steps, margin=checker_links))
        for i, axis in ((0, 0), (2, 0), (0, 1)):
            vertices = [[-0.75, -0.75, 0], [-0.5, -0.75, 0], [-0.75, -0.5, 0]]
            vertices[i][axis] = math.nextafter(-0.75, -1)
            self.b = mesh(vertices, [(0, 1, 2)])
            self.cb = certificate(self.b)
            self.fails("does not prove", *self.notch(steps, margin=checker_links))

    def test_order(self):
        steps = b"\0" + leaf(X) + leaf(Y), b"\0" + leaf(Y) + leaf(X)
        for order, right, wrong in (([0, 1], *steps), ([1, 0], *reversed(steps))):
            self.holds(*self.notch(right, certificate(self.a, order)))
            self.fails("does not prove", *self.notch(wrong, certificate(self.a, order)))

    def test_halves(self):
        # The first child of three triangles has one. The point 0 is left of B, and all others are right of it.
        a = points(*[(i, i * i, 0) for i in range(6)])
        left, right = leaf(X), leaf(minus(X))
        for order, steps in ((range(6), b"\0\0" + left + right + right),
                             ([5, 2, 0, 1, 4, 3], b"\0\0" + right + b"\0" + right + left + right),
                             ([1, 2, 3, 4, 5, 0], b"\0" + right + b"\0" + right + b"\0" + right + left)):
            files = a, certificate(a, order), POINT, POINT_TREE
            def make(margin): return two(a, POINT, free(), free(p=(0.5, 0, 0)), steps, margin)
            self.holds(files, make(0.49))
            self.fails("does not prove", files, make(0.51))

    def test_uneven_trees(self):
        # All trees have the same points. The steps separate point 0 from the others, and fit one tree only.
        a = points(*[(i, i * i, 0) for i in range(6)])
        trees = {(0, (1, (2, (3, (4, 5))))): "/lr", ((((5, (4, 3)), 2), 1), 0): "/rl",
                 ((0, 1), (2, (3, (4, 5)))): "//lrr", (((0, (1, 2)), 3), (4, 5)): "///lrrr",
                 ((1, 2), ((3, 0), (4, 5))): "/r//rlr", ((5, ((1, (2, 0)), 3)), 4): "//r//r/rlrr"}
        left, right = leaf(X), leaf(minus(X))
        for (tree, steps), (other, _) in itertools.product(trees.items(), repeat=2):
            files = a, certificate(a, tree=other), POINT, POINT_TREE
            # With exchanged bodies, step 1 splits B, and the planes have the other direction.
            for back, codes in (1, {"/": b"\0", "l": left, "r": right}), (-1, {"/": b"\1", "l": right, "r": left}):
                def make(margin):
                    bodies = [(a, 0), (POINT, 1)][::back]
                    return proof([free(p=(0.5, 0, 0))], bodies, [(0, 1, margin)], b"".join(codes[c] for c in steps))
                if tree == other:
                    self.holds(files, make(0.49))
                    self.fails("does not prove", files, make(0.51))
                else:
                    self.fails("", files, make(0.49))

    def test_any_tree_is_as_good(self):
        # Without splits in the proof, only the bounds of projections and distances split nodes. B is inside most boxes.
        rng, a = random.Random(9), points((-3, -4, 0), (6, 8, 0.5), (0, 2, 0), (0, 7, 1), (1, -3, 0), (-9, 1, 0.25))
        orders = list(itertools.permutations(range(6)))
        for _ in range(40):
            files = a, certificate(a, tree=random_tree(rng, rng.choice(orders))), POINT, POINT_TREE
            for step, height, distance, reason in ((AROUND_B, 0, 2, "is too near"), (leaf(Z), 4, 3, "does not prove"),
                                           (leaf(minus(Z)), -4, 4, "does not prove")):
                def make(margin): return two(a, POINT, free(), free(p=(0, 0, height)), step, margin)
                self.holds(files, make(math.nextafter(distance, 0)))
                self.fails(reason, files, make(float(distance)))

    def test_balls_around_parts_of_uneven_trees(self):
        # The ball around 0 and 1 has radius 1 and center (1, 0, 0). With 2 it has radius 3 and center (3, 0, 0).
        a, b = points((0, 0, 0), (2, 0, 0), (6, 0, 0)), points((1, 6, 0))
        for tree, first, second in (((0, (1, 2)), math.sqrt(37), math.sqrt(45) - 2), (((0, 1), 2), 5, math.sqrt(61)),
                                    ((2, (0, 1)), math.sqrt(61), 5), (((0, 2), 1), math.sqrt(40) - 3, math.sqrt(37))):
            files, distance = (a, certificate(a, tree=tree), b, certificate(b)), min(first, second)
            def make(steps, margin): return two(a, b, free(), free(), steps, margin)
            self.holds(files, make(b"\0" + AROUND_A + AROUND_A, distance - 1e-9))
            self.fails("is too near", files, make(b"\0" + AROUND_A + AROUND_A, distance + 1e-9))
            self.holds(files, make(AROUND_A, math.sqrt(40) - 3 - 1e-9))
            self.fails("is too near", files, make(AROUND_A, math.sqrt(40) - 3 + 1e-9))

    def test_trees_as_they_are_read(self):
        rng = random.Random(10)
        for count in [*range(1, 9), 30]:
            for _ in range(5):
                data = mesh([(i, 0, 0) for i in range(count + 2)], [(i, i + 1, i + 2) for i in range(count)])
                tree = random_tree(rng, rng.sample(range(count), count))
                nodes, read = triangles_of(tree), so.Tree(*self.files(data, certificate(data, tree=tree)))
                self.assertEqual((len(read.ranges), len(read.children)), (2 * count - 1, 2 * count - 1))
                self.assertEqual([[t[0] for t in read.triangles[i:j]] for i, j in read.ranges], nodes)
                def assert_same_children(node, tree):   # compares the children of a node with the pair of trees
                    self.assertEqual(nodes[node], triangles_of(tree)[0])
                    self.assertEqual(len(read.children[node]), 0 if isinstance(tree, int) else 2)
                    for half, child in zip(read.children[node], () if isinstance(tree, int) else tree):
                        assert_same_children(half, child)
                assert_same_children(0, tree)

    def test_deep_trees(self):
        # The points are around B, which is inside the box of each node with more than one point.
        def around(n): return points(*[((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))[i % 4] for i in range(n)])
        a = around(91)
        for to in (0, 1):
            tree = certificate(a, numbers=one_sided_numbers(91, to))
            files = a, tree, POINT, POINT_TREE
            def make(steps, height=0, margin=math.nextafter(1, 0)):
                return two(a, POINT, free(), free(p=(0, 0, height)), steps, margin)
            self.holds(files, make(AROUND_B), make(leaf(Z), 1), make(AROUND_A, 2.5))
            self.fails("is too near", files, make(AROUND_B, margin=1.0), make(AROUND_A))
            self.fails("does not prove", files, make(leaf(Z), 1, 1.0))
            # The proof has all 90 splits, down to points. Each first child is a point, or all splits come first.
            leaves = [leaf(axis) for axis in (minus(X), X, minus(Y), Y)]
            each = [leaves[i % 4] for i in range(91)]
            steps = b"".join(b"\0" + x for x in each[:-1]) + each[-1] if to == 0 else b"\0" * 90 + b"".join(each)
            self.holds(files, make(steps, margin=0.99))
            self.fails("does not prove", files, make(steps, margin=1.0), make(steps.replace(each[2], each[1])))
            # Far deeper trees are read but not checked. Later proofs are still checked.
            deep = around(5001)
            files = deep, certificate(deep, numbers=one_sided_numbers(5001, to)), *files
            for bodies, split in (((deep, POINT), b"\0"), ((POINT, deep), b"\1"), ((deep, deep), b"\0")):
                all_steps = *(AROUND_A, AROUND_B, leaf(Z)), split + AROUND_A * 2, split + leaf(Z) * 2
                proofs = [two(*bodies, free(), free(p=(0, 0, 2.5)), steps) for steps in all_steps]
                lines = self.run_files(files, *proofs, make(AROUND_B))
                self.assertEqual(lines[:-1], [["unverifiable", "a tree is too deep"]] * len(proofs))
                self.assertEqual(lines[-1][0], "holds")
            self.holds(files, proof([], [(deep, 0), (POINT, 0)], [], b""))

    def test_bad_certificates(self):
        steps = b"\0" + leaf(X) + leaf(Y)
        bad = self.ca[:8] + bytes(32) + self.ca[40:]
        self.fails("another mesh", *self.notch(steps, bad))
        self.assertEqual(self.ca[40:], struct.pack("<3I", 1, 0, 1))
        self.fails("another kind", *self.notch(steps, b"x" + self.ca[1:]))
        a = points((-3, 0, 0), (-2, 0, 0), (-1, 0, 0))
        def run(reason, numbers, more=b"", cut=None):
            files = a, (certificate(a, numbers=numbers) + more)[:cut], POINT, POINT_TREE
            made = two(a, POINT, free(), free(), leaf(X), 0.5)
            self.fails(reason, files, made) if reason else self.holds(files, made)
        good = [1, 0, 1, 1, 2], [1, 2, 1, 1, 0], [2, 1, 0, 1, 2], [2, 1, 2, 1, 0]
        for numbers in good:
            run("", numbers)
            run("bytes follow", numbers, b"\0")
            run("bytes follow", [*numbers, 0])
            run("bytes follow", numbers, bytes(20))
            for cut in range(8, 60, 3):
                run("ends too early", numbers, cut=cut)
            # The last triangle repeats another one, or does not exist.
            for other in (numbers[-2], 3, 4, 1 << 31, (1 << 32) - 1):
                run("each triangle once", [*numbers[:-1], other])
        run("each triangle once", [1, 3, 1, 1, 2])
        run("each triangle once", [1, 2, 1, 2, 2])
        # The number of triangles of a first child is at least 1, and less than all.
        for bad in (0, 3, 4, 5, 1 << 31, (1 << 32) - 1):
            run("byte 40", [bad, *good[0][1:]])
            run("a node has no triangle", [bad, *good[0][1:]])
            run("a node has no triangle", [bad, *good[2][1:]])
        for bad in (0, 2, 3, 1 << 31, (1 << 32) - 1):
            run("byte 48", [1, 0, bad, 1, 2])
            run("byte 44", [2, bad, 0, 1, 2])
            run("a node has no triangle", [1, 0, bad, 1, 2])
            run("a node has no triangle", [2, bad, 0, 1, 2])
        # A single triangle only has its index.
        a = points((-1, 0, 0))
        run("", [0])
        run("each triangle once", [1])
        run("bytes follow", [0, 0])
        run("ends too early", [])

    def test_bad_meshes(self):
        files, good = self.notch(b"\0" + leaf(X) + leaf(Y))
        for data, reason, verdict in (
                (self.a + b"\0", "counts", "broken"), (self.a[:-1], "counts", "broken"),
                (b"", "too early", "broken"),
                (mesh([(0, 0, 0)], []), "counts", "broken"), (mesh([], []), "counts", "broken"),
                (mesh([(0, 0, 0)], [(0, 0, 1)]), "no vertex", "broken"), (mesh([], [(0, 0, 0)]), "no vertex", "broken"),
                (mesh([(0, 0, math.nan)], [(0, 0, 0)]), "not finite", "unverifiable"),
                (mesh([(0, 0, 0)], [(0, 0, 0)]), "another mesh", "broken")):
            made = two(data, self.b, *self.rest, b"\0" + leaf(X) + leaf(Y))
            self.fails(reason, (data, *files[1:]), made, verdict=verdict)
            self.fails("is among the arguments", (data, *files[1:]), good, verdict="unverifiable")

    def test_meshes_are_found_by_digest(self):
        (a, ca, b, cb), good = self.notch(b"\0" + leaf(X) + leaf(Y))
        self.holds((b, cb, a, ca), good)
        self.holds((FLAT, FLAT_TREE, b, cb, a, ca, b, cb), good)
        self.holds((b, cb, FLAT, b"nothing", a, ca), good)   # a mesh that is not used
        self.fails("is among the arguments", (a, ca), good, verdict="unverifiable")
        self.fails("another mesh", (a, cb, b, ca), good)
        # Only the digests are exchanged, so A is the small triangle, which cannot be split.
        links, digests = HEADER - 8 - 16 - 72, [hashlib.sha256(m).digest() for m in (a, b)]
        self.assertEqual(good[links:links + 32] + good[links + 36:links + 68], b"".join(digests))
        swapped = good[:links] + digests[1] + good[links + 32:links + 36] + digests[0] + good[links + 68:]
        self.fails("", (a, ca, b, cb), swapped)
        # With really exchanged bodies, the axes have the opposite direction.
        self.holds((a, ca, b, cb), two(b, a, *self.rest, b"\1" + leaf(minus(X)) + leaf(minus(Y)), margin=0.24))

    def test_missing_files(self):
        path, = self.files(two(FLAT, FLAT, free(), free(p=(0, 0, 1)), leaf(Z)))
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            self.assertEqual(so.main([path + "x", path, "--mesh", path + "y", path]), 1)
        self.assertEqual([line.split(": ")[1] for line in out.getvalue().splitlines()], ["unverifiable"] * 2)


class Contact(Case):
    def setUp(self):
        # B moves down at speed 1 from a height of 1. The gap is 0.02 at 0.98.
        self.links = free(), free(p=(0, 0, 1), v=(0, 0, -1))
        self.corner = (0, (WHOLE, 0, 0))
        self.middle = (0, (WHOLE >> 2, WHOLE >> 2, WHOLE >> 1))

    def flat(self, contact, steps=leaf(Z), margin=0.01, duration=None, **more):
        duration = contact[0] if duration is None else duration
        return (FLAT, FLAT_TREE), two(FLAT, FLAT, *self.links, steps, margin, contact, duration=duration, **more)

    def test_flat(self):
        for w in (self.corner, self.middle):
            self.holds(*self.flat((0.98, 0.0101, w, w)))
            self.fails("too far apart", *self.flat((0.98, 0.0099, w, w)))
            self.fails("too far apart", *self.flat((0.97, 0.0101, w, w)))
            self.fails("does not prove", *self.flat((0.9901, 0.0101, w, w)))   # too near before the end
            self.fails("does not prove", *self.flat((1.0, 0.0101, w, w)))
            self.fails("negative", *self.flat((-0.5, 10.0, w, w)))
            for tolerance in (-5e-324, -0.001, -0.0101):
                self.fails("the tolerance is negative", *self.flat((0.995, tolerance, w, w), duration=0.98))
            self.fails("file ends", *self.flat((0.98, 0.0101, w, w), steps=b""))
            self.fails("bytes follow", *self.flat((0.98, 0.0101, w, w), steps=leaf(Z) + b"\0"))

    def test_within_is_not_strict(self):
        # Nothing moves, so nothing is rounded. A distance of 0.5 is within 0.25 + 0.25, but not within any less.
        self.links = free(), free(p=(0, 0, 0.5))
        def make(tolerance): return self.flat((1.0, tolerance, self.middle, self.middle), margin=0.25)
        self.holds(*make(0.25))
        self.fails("too far", *make(math.nextafter(0.25, 0)))

    def test_radii(self):
        for radii in ((0.004, 0.004), (0.008, 0.0)):
            a, b = (with_radii(FLAT, r) for r in radii)
            files = a, certificate(a), b, certificate(b)
            def make(tolerance):
                contact = 0.98, tolerance, self.corner, self.corner
                return two(a, b, *self.links, leaf(Z), 0.002, contact, duration=0.98)
            self.holds(files, make(0.0101))
            self.fails("too far apart", files, make(0.0099))

    def test_radius_of_a_point(self):
        # The radius has the weights of the point: 1/2, 1/8 and 3/8 of the radii 0.25, 1 and 0.5 are 0.4375 in total.
        a = with_radii(FLAT, 0.25, 1.0, 0.5)
        files, weights = (a, certificate(a), FLAT, FLAT_TREE), (WHOLE >> 1, WHOLE >> 3, 3 * WHOLE >> 3)
        def make(tolerance, swap, more=0):
            bodies, p = ((FLAT, a), (0, 0, 1.5)) if swap else ((a, FLAT), (0, 0, 1.5))
            w = 0, (weights[0] - more, weights[1] + more, weights[2])
            return two(*bodies, free(), free(p), leaf(Z), 0.25, (0.5, tolerance, w, w))
        for swap in (False, True):
            self.holds(files, make(1.5 - 0.25 - 0.4375, swap), make(1.5 - 0.25 - 0.4375 - 0.09, swap, WHOLE >> 3))
            self.fails("too far apart", files, make(math.nextafter(1.5 - 0.25 - 0.4375, 0), swap),
                       make(1.5 - 0.25 - 0.4375 - 0.1, swap, WHOLE >> 3))

    def test_time(self):
        # The closest approach until 0.98 is at the end. An earlier witness needs a larger tolerance.
        w = self.corner
        for tau, tolerance in ((0.0, 0.9901), (0.5, 0.4901), (0.98, 0.0101)):
            self.holds(*self.flat((tau, tolerance, w, w), duration=0.98))
            self.fails("too far apart", *self.flat((tau, tolerance - 0.0002, w, w), duration=0.98))
        for tau in (-5e-324, -1e-20, -1.0, -100.0):
            self.fails("the time of the witness is negative", *self.flat((tau, 2000.0, w, w), duration=0.98))
        self.holds(*self.flat((-0.0, 0.9901, w, w), duration=0.98))
        # The time of a witness is not rounded, for example to 0.5 or 0.75 ticks.
        self.links = free(), free(p=(0, 0, 1), v=(0, 0, -0.5))
        for tau in (0.5, 0.75):
            self.holds(*self.flat((tau, 0.9901 - tau / 2, w, w), duration=0.5, units=TICKS))
            self.fails("too far apart", *self.flat((tau, 0.9899 - tau / 2, w, w), duration=0.5, units=TICKS))

    def test_a_later_time(self):
        # The bodies are free until 0.98, and meet at 1. Then B is below A, at an increasing distance.
        w = self.corner
        for tau in (math.nextafter(0.98, 1), 0.985, 1.5, 100.0):
            min_tolerance = abs(1 - tau) - 0.01
            self.holds(*self.flat((tau, min_tolerance + 1e-4, w, w), duration=0.98))
            self.fails("too far apart", *self.flat((tau, min_tolerance - 1e-4, w, w), duration=0.98))
            # The statement has no claim about the time between T and the witness. Everything until T is proven.
            self.fails("does not prove", *self.flat((tau, min_tolerance + 1e-4, w, w), duration=0.9901))
            self.fails("file ends", *self.flat((tau, min_tolerance + 1e-4, w, w), duration=0.98, steps=b""))
        for duration in (0.0, 0.98):
            self.holds(*self.flat((1.0, 0.0, w, w), duration=duration))
            self.fails("too far apart", *self.flat((1.02, 0.0, w, w), duration=duration))
        # The time of a witness is at most the unit of time. No link rotates too far until then.
        self.holds(*self.flat((4.0, 3.0, w, w), duration=0.98, units=(-40, 2)))
        for tau in (math.nextafter(4, 5), 1e9, 1e300):
            files, made = self.flat((tau, 1e301, w, w), duration=0.98, units=(-40, 2))
            self.fails("the unit of time is less than the time", files, made, verdict="unverifiable")
        for spin in (free(p=(0, 0, 1), w=(0, 0, 4)), revolute(p=(0, 0, 1), beta=-4.0)):
            self.links = free(), spin
            self.holds(*self.flat((128.0, 1.0, w, w), duration=0.5))
            for tau in (math.nextafter(128, 129), 1e9, 1e300):
                files, made = self.flat((tau, 1e301, w, w), duration=0.5)
                self.fails("a link rotates too far", files, made, verdict="unverifiable")

    def test_a_clearance(self):
        # B is on an arm, and moves down and up again. It is lowest at half of the time.
        b = points((0, 0, -1))
        links = free(), free(p=(0, 0, 2), q=(math.sin(-0.25), 0, 0, math.cos(-0.25)), w=(1, 0, 0))
        files = FLAT, FLAT_TREE, b, certificate(b)
        def make(tau, tolerance, margin=0.99):
            contact = tau, tolerance, self.corner, self.corner
            return two(FLAT, b, *links, split_evenly(3, lambda _: leaf(Z)), margin, contact)
        self.holds(files, make(0.5, 0.0101))
        self.fails("too far apart", files, make(0.3, 0.0101), make(0.5, 0.0099), make(0.0, 0.0101), make(1.0, 0.0101))
        self.fails("does not prove", files, make(0.5, 0.0101, 1.0001))

    def test_witnesses(self):
        self.fails("too far apart", *self.flat((0.98, 0.0101, self.corner, self.middle)))
        # Weights are non-negative and add up to 1. A sum that overflows is refused, too.
        top, good = 2 * WHOLE - 1, self.corner
        for bad in ((WHOLE, 1, 0), (WHOLE, 0, 1), (WHOLE - 1, 2, 0), (WHOLE - 1, 0, 0), (0, 0, 0), (0, 0, WHOLE - 1),
                    (WHOLE >> 1,) * 3, (WHOLE,) * 3, (top,) * 3, (top, 0, 0), (top, WHOLE + 1, 0), (top, 1, WHOLE),
                    (top, WHOLE // 2, WHOLE // 2 + 1), (WHOLE, WHOLE, 0)):
            for pair in (((0, bad), good), (good, (0, bad)), ((0, bad), (0, bad))):
                self.fails("do not add up to 1", *self.flat((0.98, 1000.0, *pair)))
        self.fails("no such triangle", *self.flat((0.98, 0.0101, (1, self.corner[1]), self.corner)))

    def test_weights_are_of_corners_in_order(self):
        # The point of A is 1 below that of B. With other weights it is elsewhere.
        weights, corners = (WHOLE >> 1, WHOLE >> 3, 3 * WHOLE >> 3), [(0, 0, 0), (4, 0, 0), (0, 4, 0)]
        for order in itertools.permutations(range(3)):
            a = mesh([corners[i] for i in order], [(0, 1, 2)])
            for permuted in itertools.permutations(weights):
                files, w = (a, certificate(a), POINT, POINT_TREE), (0, permuted)
                made = two(a, POINT, free(), free((0.5, 1.5, 1)), leaf(Z), 0.5, (0.5, 0.5, w, self.corner))
                if permuted == tuple(weights[i] for i in order):
                    self.holds(files, made)
                else:
                    self.fails("too far apart", files, made)
        # The smallest weight counts. It moves the point of A down by 2^-55, from 1 below the point of B.
        for low, high in itertools.permutations(range(3), 2):
            a, w = mesh([(0, 0, -(i == low)) for i in range(3)], [(0, 1, 2)]), [0, 0, 0]
            w[low], w[high], files = 1, WHOLE - 1, (a, certificate(a), POINT, POINT_TREE)
            def make(tolerance):
                return two(a, POINT, free(), free((0, 0, 1)), leaf(Z), 0.5, (0.5, tolerance, (0, w), self.corner))
            self.holds(files, make(math.nextafter(0.5, 1)))
            self.fails("too far apart", files, make(0.5))

    def test_place_is_in_the_order_of_the_tree(self):
        low = mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, -1), (1, 0, -1), (0, 1, -1)], [(0, 1, 2), (3, 4, 5)])
        for order, place in (([0, 1], 0), ([1, 0], 1)):
            files = low, certificate(low, order), FLAT, FLAT_TREE
            def make(at): return two(low, FLAT, *self.links, leaf(Z), 0.01,
                                     (0.98, 0.0101, (at, self.corner[1]), self.corner), duration=0.98)
            self.holds(files, make(place))
            self.fails("too far apart", files, make(1 - place))

    def test_turning(self):
        # The tip of a rod rotates about z by 1 radian, and ends 0.01 below the plate y = sin 1 + 0.01.
        a, y = rod(), math.sin(1.0) + 0.01
        b = mesh([(-9, 0, -9), (9, 0, -9), (0, 0, 9)], [(0, 1, 2)])
        files = a, certificate(a), b, certificate(b)
        # The point x = cos 1, z = 0 of the plate has half of its weight at the third corner.
        wx = round((0.25 + math.cos(1.0) / 18) * WHOLE)
        wb = 0, (WHOLE // 2 - wx, wx, WHOLE // 2)
        wa = 0, (0, WHOLE, 0)
        kinds = lambda w: free(w=(0, 0, w)), lambda w: revolute((0, 0, w), beta=1.0)
        for frame, kind in itertools.product((0, 2), kinds):
            def make(time=1.0, steps=split_evenly(4, lambda _: leaf(Y, frame)), tolerance=0.006, wa=wa, w=1.0):
                return two(a, b, kind(w), free(p=(0, y, 0)), steps, 0.005, (time, tolerance, wa, wb), duration=time)
            self.holds(files, make())
            self.fails("too far apart", files, make(tolerance=0.004), make(time=0.9), make(w=-1.0),
                       make(wa=(0, (WHOLE >> 1, WHOLE >> 1, 0))))
            self.fails("does not prove", files, make(time=1.02, tolerance=0.02),
                       make(steps=split_evenly(1, lambda _: leaf(Y))))
            self.fails("file ends", files, make(steps=split_evenly(4, lambda _: leaf(Y))[:-7]))

    def test_chains(self):
        # Links are random trees. The distance of the witness points is computed in binary64.
        rng, a, b = random.Random(4), points((1, 0, 2, 0.25), (5, 5, 5)), points((0, -1, 1, 0.5))
        files = a, certificate(a, [1, 0]), b, certificate(b)
        for _ in range(25):
            distance = 0
            while distance < 1:                          # outside the margin and the radii
                links, tau, ends = random_links(rng, 5), rng.random(), [rng.randint(0, 5) for _ in "AB"]
                on_a, on_b = in_world(links, ends[0], (1, 0, 2), tau), in_world(links, ends[1], (0, -1, 1), tau)
                distance = flength(fsub(on_a, on_b))
            def make(tolerance):
                corner = WHOLE, 0, 0
                return proof(links, [(a, ends[0]), (b, ends[1])], [(0, 1, 0.125)], leaf(Z), 1.0,
                             (0, tau, tolerance - 0.875, (1, corner), (0, corner)))
            self.fails("too far apart", files, make(distance - 1e-9))
            self.assertNotIn("too far apart", self.run_files(files, make(distance + 1e-9))[0][1])


class Arithmetic(Case):
    """Compares the checker with samples in binary64."""
    def near(self, interval, x, slack=1e-12):
        lo, hi = (Fraction(i, so.ONE) for i in interval)
        self.assertTrue(lo <= hi and lo - Fraction(slack) <= Fraction(x) <= hi + Fraction(slack), (lo, x, hi))
        self.assertLess(hi - lo, Fraction(slack))

    def test_series(self):
        for x in (0.0, 1e-200, 1e-9, 0.1, 1.0, 3.14159, 20.0, 100.0, 500.0, 1000.0):
            q = Fraction(x) ** 2
            self.near(so.series(q, 1), math.sin(x) / x if x else 1.0)
            self.near(so.series(q, 2), 2 * (math.sin(x / 2) / x) ** 2 if x else 0.5)
        # sin^2 + cos^2 = 1, far more precisely than binary64.
        q = Fraction(37)
        s, c = so.series(q, 1), so.series(q, 2)
        square = so.add(so.mul(so.fix(q), so.mul(s, s)),
                        so.mul(*[so.sub(so.fix(Fraction(1)), so.mul(c, so.fix(q)))] * 2))
        self.assertTrue(square[0] <= so.ONE <= square[1] and square[1] - square[0] < 1 << 16)

    def test_intervals(self):
        rng = random.Random(1)
        def random_interval():
            a, b = (Fraction(rng.randint(-1000, 1000), rng.randint(1, 999)) for _ in range(2))
            return min(a, b), max(a, b)
        for _ in range(300):
            (a, b), (c, d) = random_interval(), random_interval()
            for x in (a, b, c, d):
                lo, hi = so.fix(x)
                self.assertTrue(lo <= x * so.ONE <= hi and hi - lo <= 1)
            u, v = (so.fix(a)[0], so.fix(b)[1]), (so.fix(c)[0], so.fix(d)[1])
            lo, hi = so.mul(u, v)
            for x in (a, b, (a + b) / 2):
                for y in (c, d, (c + d) / 2):
                    self.assertTrue(Fraction(lo, so.ONE) <= x * y <= Fraction(hi, so.ONE))
        for n in list(range(200)) + [10 ** 40, 10 ** 40 + 1]:
            r = so.root_up(n)
            self.assertTrue(r * r >= n and (r == 0 or (r - 1) ** 2 < n))


class Random(Case):
    def scene(self, rng, speed=1.0, size=0.5, count=5):
        """Returns random links and two bodies, both as inputs and as objects of the checker."""
        def vec(s): return tuple(rng.uniform(-s, s) for _ in range(3))
        links, bodies, files = random_links(rng, count, speed), [], []
        checker_links, ends = self.exact_links(links), [rng.randint(0, count) for _ in range(2)]
        for end in ends:
            shift = vec(2)
            radii = [rng.choice((0.0, 0.0625, rng.uniform(0, 0.25))) * 2 * size for _ in range(9)]
            data = mesh([(*fadd(vec(size), shift), r) for r in radii],
                        [tuple(rng.sample(range(9), 3)) for _ in range(6)])
            tree = random_tree(rng, rng.sample(range(6), 6))
            bodies.append(so.Body(so.Tree(*self.files(data, certificate(data, tree=tree))), checker_links[end], 0))
            files.append((data, tree))
        return links, checker_links, ends, bodies, files

    def corners(self, data, triangles):
        """Returns the corners of some triangles, in the frame of the link, with radii."""
        vertices = struct.unpack_from("<36d", data, 8)
        corners = [struct.unpack_from("<3I", data, 8 + 36 * 8 + 12 * t) for t in triangles]
        return [vertices[4 * i:4 * i + 4] for three in corners for i in three]

    def nodes(self, file):
        """Returns the corners of each node, in the order of the certificate."""
        data, tree = file
        return [self.corners(data, triangles) for triangles in triangles_of(tree)]

    def axis(self, rng, links, ends, corners, t):
        """Returns a direction roughly from A to B, in 2^-50."""
        a, b = ([in_world(links, end, y[:3], t) for y in c] for end, c in zip(ends, corners))
        n = fsub(fscale(1 / len(b), fadd(*b)), fscale(1 / len(a), fadd(*a)))
        n = fadd(fscale(1 / (flength(n) or 1), n), [rng.gauss(0, 0.2) for _ in range(3)])
        return along(*fscale(1 / flength(n), n))

    def motion(self, links, end, frame, t0, t1):
        """Computes P, P', Omega, K and K' by the README, from velocities in the world."""
        t, h = (t0 + t1) / 2, (t1 - t0) / 2
        def chain(i): return chain(links[i - 1].on) + [i] if i else [0]
        def at(i): return in_world(links, i, center(links, i), t)
        def joint(i):   # the rotation vector and the rate of the offset, in the world
            x = links[i - 1]
            v, a = (rotate(x.q, u) if x.axes else u for u in (x.v, x.a))
            return [fscale(h * x.beta, direction(links, x.on, u, t)) for u in (a, v)]
        def turn(i): return fadd([0, 0, 0], *[joint(j)[0] for j in chain(i)[1:]])
        def velocity(i):
            if i == 0:
                return [0, 0, 0]
            parent = links[i - 1].on
            return fadd(velocity(parent), fcross(turn(parent), fsub(at(i), at(parent))), joint(i)[1])
        frame_chain, link_chain = chain(frame), chain(end)
        common = sum(i == j for i, j in zip(frame_chain, link_chain))
        path = [(-1, i) for i in reversed(frame_chain[common:])] + [(1, i) for i in link_chain[common:]]
        k, theta = 0, 0
        for sign, i in path:
            angle, (arm, m) = flength(joint(i)[0]), map(flength, (fsub(at(i), at(links[i - 1].on)), joint(i)[1]))
            carried = theta if sign > 0 else theta + angle   # theta before the joint, or after it
            k, theta = k + carried ** 2 * (arm + m) + 2 * carried * m, theta + angle
        p = fsub(at(end), at(frame))
        slope = fsub(fsub(velocity(end), velocity(frame)), fcross(turn(frame), p))
        return p, slope, fsub(turn(end), turn(frame)), k, theta ** 2

    def readme(self, links, end, corners, side, n, d, frame, t0, t1):
        """Returns the least signed distance by the README."""
        (p, slope, omega, k, k_prime), t = self.motion(links, end, frame, t0, t1), (t0 + t1) / 2
        center_at = in_world(links, end, center(links, end), t)
        z = [(fsub(in_world(links, end, y, t), center_at), ball) for *y, ball in corners]
        k, tilt = k + k_prime * max(flength(y) for y, _ in z), fcross(n, omega)
        return min(side * (fdot(n, p) + s * fdot(n, slope) - d) - k / 2
                   + min(side * fdot(fadd(n, fscale(s, tilt)), y) - ball for y, ball in z) for s in (1, -1))

    def readme_ball(self, links, end, corners, frame, t0, t1):
        """Returns the center of the README's ball at the middle, in the other body's frame, and its radius."""
        (_, slope, omega, k, k_prime), t = self.motion(links, end, frame, t0, t1), (t0 + t1) / 2
        *ranges, radii = zip(*corners)
        g = [(min(c) + max(c)) / 2 for c in ranges]
        z = fsub(in_world(links, end, g, t), in_world(links, end, center(links, end), t))
        r = max(flength(fsub(y, g)) for *y, _ in corners) + max(radii)
        m = flength(fadd(slope, fcross(omega, z))) + (k + k_prime * flength(z)) / 2
        return self.point_in_frame(links, frame, in_world(links, end, g, t), t), r + m

    def point_in_frame(self, links, frame, x, t):
        """Transforms a point of the world to the frame of a link, relative to its center."""
        x = fsub(x, in_world(links, frame, center(links, frame), t))
        return [fdot(x, direction(links, frame, e, t)) for e in UNIT3]

    def test_bound_is_below_samples_and_close(self):
        rng, tight_count = random.Random(7), 0
        for trial in range(120):
            links, checker_links, ends, bodies, files = self.scene(rng)
            frame = (0, *ends)[trial % 3]
            nodes = [rng.randrange(11) for _ in range(2)]
            corners = [self.nodes(file)[p] for file, p in zip(files, nodes)]
            k = rng.randrange(9)
            i = rng.randrange(1 << k)
            t0, t1 = i << 60 - k, i + 1 << 60 - k
            axis, d = self.axis(rng, links, ends, corners, (t0 + t1) / 2 ** 61), rng.uniform(-3, 3)
            n, span = [c / ONE for c in axis], (t0 / 2 ** 60, t1 / 2 ** 60)
            for body, end, c, node, side in zip(bodies, ends, corners, nodes, (-1, 1)):
                plane = [(side * x << so.F - 50,) * 2 for x in axis], int(side * d * so.ONE)
                proven = so.distance_bound(body, node, checker_links[frame], *middle_and_half(t0, t1), *plane) / so.ONE
                least = least_distance(links, end, c, side, n, d, frame, *span, 16)
                self.assertLessEqual(proven, least + 1e-9)
                self.assertAlmostEqual(proven, self.readme(links, end, c, side, n, d, frame, *span), 9)
                if k == 8:
                    self.assertLess(least - proven, 0.01)
                    tight_count += 1
        self.assertGreater(tight_count, 10)

    def test_ball_is_around_samples_and_close(self):
        rng, tight_count = random.Random(8), 0
        for trial in range(120):
            links, checker_links, ends, bodies, files = self.scene(rng)
            (body, other), (end, frame) = bodies, ends
            node, other_node = rng.randrange(11), rng.randrange(11)
            corners, k = self.nodes(files[0])[node], rng.randrange(9)
            i = rng.randrange(1 << k)
            t0, t1 = i << 60 - k, i + 1 << 60 - k
            span = t0 / 2 ** 60, t1 / 2 ** 60
            with unittest.mock.patch.object(so.Body, "is_beyond", autospec=True) as is_beyond_mock:
                margin = rng.choice((0, rng.randrange(so.ONE)))
                so.is_beyond_ball(body, node, other, other_node, *middle_and_half(t0, t1), margin)
            (other_seen, other_node_seen, point, limit), unit = is_beyond_mock.call_args.args, so.ONE << other.bits
            self.assertTrue(other_seen is other and other_node_seen == other_node and all(lo <= hi for lo, hi in point))
            self.assertLess(max(hi - lo for lo, hi in point) / unit, 1e-12)
            point, limit = [lo / unit for lo, _ in point], limit / unit - margin / so.ONE
            expected, max_margin = self.readme_ball(links, end, corners, frame, *span)
            self.assertLess(flength(fsub(point, expected)), 1e-9)
            self.assertAlmostEqual(limit, max_margin, 9)
            max_distance, max_center_distance = 0, 0
            for j in range(17):
                t = span[0] + (span[1] - span[0]) * j / 16
                for *y, ball in corners:
                    x = self.point_in_frame(links, frame, in_world(links, end, y, t), t)
                    max_center_distance = max(max_center_distance, flength(fsub(x, point)))
                    max_distance = max(max_distance, flength(fsub(x, point)) + ball)
            self.assertLessEqual(max_distance, limit + 1e-9)
            if k == 8 and len(corners) == 3:
                # The ball adds the largest radius, while the farthest corner may have a smaller one.
                self.assertLess(limit - max_center_distance - max(ball for *_, ball in corners), 0.02)
                tight_count += 1
        self.assertGreater(tight_count, 3)

    def test_is_beyond(self):
        """Compares the distances with the boxes of all triangles, at the least limits that one box does not exceed."""
        rng, counts = random.Random(4), [0, 0]
        for _ in range(20):
            _, _, _, bodies, files = self.scene(rng)
            body, center = bodies[0], bodies[0].link.center
            for node, triangles in enumerate(triangles_of(files[0][1])):
                point = [rng.randint(-5 << 52, 5 << 52) << so.F + body.bits - 52 for _ in range(3)]
                distance = []                            # for each triangle: the square of the distance, and the radius
                for triangle in triangles:
                    corners = self.corners(files[0][0], [triangle])
                    *ranges, radii = [[int(Fraction(x) * (so.ONE << body.bits)) for x in c] for c in zip(*corners)]
                    ranges = [[x - int(c * (so.ONE << body.bits)) for x in r] for r, c in zip(ranges, center)]
                    gaps = [max(min(r) - x, x - max(r), 0) for r, x in zip(ranges, point)]
                    distance.append((sum(x * x for x in gaps), max(radii)))
                for limit in {math.isqrt(square) - ball + d for square, ball in distance for d in (-1, 0, 1)}:
                    if limit >= 0:
                        expected = all(square > (limit + ball) ** 2 for square, ball in distance)
                        self.assertEqual(body.is_beyond(node, [(x, x) for x in point], limit), expected)
                        counts[expected] += 1
                        # The point has an error of 1, so its nearest possible position counts.
                        is_beyond_with_error = body.is_beyond(node, [(x - 1, x + 1) for x in point], limit)
                        self.assertEqual(is_beyond_with_error, expected and is_beyond_with_error)
        self.assertGreater(min(counts), 50)

    def random_proofs(self, seed, trials, balls, fractions):
        """Tests random splits and leaves. The margins are near the largest margins that the samples allow. Samples refute no accepted proof.
        The margins are these fractions of the margins that the samples allow. Returns counts by (is false, verdict)."""
        rng, counts = random.Random(seed), {}
        for trial in range(trials):
            links, checker_links, ends, bodies, files = self.scene(rng, speed=0.5, size=0.25, count=4)
            if ends[0] == ends[1] == 0:
                continue
            depth, found = rng.randrange(3), []
            def steps(nodes, t0, t1, left):         # nodes are trees
                kind = rng.randrange(3) if left else 3
                if kind < 2 and not isinstance(nodes[kind], int):
                    out = bytes([kind])
                    for p in nodes[kind]:
                        out += steps([p, nodes[1]] if kind == 0 else [nodes[0], p], t0, t1, left - 1)
                    return out
                if kind == 2:
                    middle = (t0 + t1) // 2
                    return split_time(steps(nodes, t0, middle, left - 1), steps(nodes, middle, t1, left - 1))
                corners = [self.corners(data, triangles_of(p)[0]) for (data, _), p in zip(files, nodes)]
                span, frame = (t0 / 2 ** 60, t1 / 2 ** 60), rng.randrange(3)
                if rng.random() < balls:
                    for t in [span[0] + (span[1] - span[0]) * i / 12 for i in range(13)]:
                        a, b = ([(in_world(links, end, y, t), ball) for *y, ball in c] for end, c in zip(ends, corners))
                        found.extend(flength(fsub(x, y)) - p - q for x, p in a for y, q in b)
                    return rng.choice((AROUND_A, AROUND_B))
                axis = self.axis(rng, links, ends, corners, sum(span) / 2)
                n, link = [c / ONE for c in axis], (0, *ends)[frame]
                def least(d): return [least_distance(links, end, c, side, n, d, link, *span, 12)
                                      for end, c, side in zip(ends, corners, (-1, 1))]
                below, above = least(0.0)
                d = round((above - below) / 2 * 2 ** 40) + rng.choice((0, rng.randrange(-1 << 30, 1 << 30)))
                found.append(2 * min(least(d / 2 ** 40)))
                return leaf(axis, frame, d)
            made = steps([tree for _, tree in files], 0, 1 << 60, depth + 1)
            least = min(found)
            meshes = [x for data, tree in files for x in (data, certificate(data, tree=tree))]
            for fraction, decrement in fractions:
                margin = least * fraction - decrement
                if margin >= 0:
                    bodies = [(data, end) for (data, _), end in zip(files, ends)]
                    proof_bytes = proof(links, bodies, [(0, 1, margin)], made, units=(-40, 0))
                    (verdict, reason), = self.run_files(meshes, proof_bytes)
                    key = margin > least, verdict
                    counts[key] = counts.get(key, 0) + 1
                    self.assertTrue(verdict == "holds" or "does not prove" in reason or "too near" in reason, reason)
        self.assertNotIn((True, "holds"), counts)
        for key in ((True, "broken"), (False, "holds"), (False, "broken")):
            self.assertGreater(counts[key], 10, counts)

    def test_random_proofs(self):
        self.random_proofs(21, 40, 0, ((1, -1e-9), (1, 1e-4), (1, 0.05), (1, 0.5)))

    def test_random_balls(self):
        self.random_proofs(22, 40, 0.7, ((1, -1e-9), (0.9, 0), (0.5, 0), (0.1, 0)))

    def test_lowest(self):
        rng = random.Random(3)
        for _ in range(20):
            _, _, _, bodies, files = self.scene(rng)
            for node, corners in enumerate(self.nodes(files[0])):
                m = [rng.randint(-9, 9) << so.F - 3 for _ in range(3)]
                center = bodies[0].link.center
                expected = min(sum(Fraction(c, so.ONE) * (Fraction(y) - z) for c, y, z in zip(m, corner, center))
                           - Fraction(corner[3]) for corner in corners)
                self.assertEqual(Fraction(bodies[0].lowest(node, *m), 1 << so.F + bodies[0].bits), expected)


class Damage(Case):
    def test_single_bits(self):
        """Tests that damaged files raise no exception, and that damage before the motions or in opcodes is refused."""
        a = mesh([(0, -1, 0, 0.125), (0, 1, 0, 0.0625), (0.125, 0, 0)], [(0, 1, 2)])
        files = a, certificate(a), FLAT, FLAT_TREE
        links = [prismatic((0, 1, 0), 0.5, 0.125), revolute((1, 0, 0), 0.25, 4.0, p=(0, -0.5, 0), on=1),
                 free(p=(0, 0, 3))]
        corner = 0, (WHOLE >> 2, WHOLE >> 3, 5 * WHOLE >> 3)
        good = proof(links, [(a, 2), (FLAT, 3)], [(0, 1, 0.875)], split_evenly(3, lambda _: leaf(Z)),
                     witness=(0, 0.25, 4.0, corner, corner))
        good = self.fit(files, good)
        self.holds(files, good)
        rng, bad, places = random.Random(5), [], []
        for i in [*range(0, 28), *(rng.randrange(len(good)) for _ in range(100))]:
            bad.append(good[:i] + bytes([good[i] ^ 1 << rng.randrange(8)]) + good[i + 1:])
            places.append(i)
        for i, (verdict, reason) in zip(places, self.run_files(files, *bad)):
            if i < 8 or 16 <= i < 33:
                self.assertNotEqual(verdict, "holds", (i, reason))
        lines = self.run_files(files, *[good[:n] for n in range(0, len(good), 5)])
        self.assertTrue(all(v == "broken" for v, _ in lines))
        time = good.rindex(struct.pack("<dd", 0.25, 4.0))   # the position of the witness
        bad = [good[:time + i] + bytes([good[time + i] ^ 1 << bit]) + good[time + i + 1:]
               for i in range(16) for bit in range(8)]
        for i, (verdict, reason) in enumerate(self.run_files(files, *bad)):
            if i % 64 == 63:                        # the sign bit
                self.assertIn("is negative", reason)
        tree_certificate = files[1]
        for i in range(0, len(tree_certificate)):
            for bit in (0, 7):
                broken = tree_certificate[:i] + bytes([tree_certificate[i] ^ 1 << bit]) + tree_certificate[i + 1:]
                (verdict, reason), = self.run_files((a, broken, *files[2:]), good)
                self.assertEqual(verdict, "broken", (i, reason))

    def test_single_bits_of_a_tree(self):
        a = points(*[(i, 0, 0) for i in range(5)])
        good = certificate(a, tree=((3, 1), (0, (4, 2))))
        numbers = struct.unpack("<9I", good[40:])
        self.assertEqual(numbers, (2, 1, 3, 1, 1, 0, 1, 4, 2))
        made = self.fit((a, good, POINT, POINT_TREE), two(a, POINT, free(), free(p=(0, 0, 1)), leaf(Z), 0.5))
        for i, bit in itertools.product(range(9), (0, 1, 2, 3, 8, 31)):
            other = certificate(a, numbers=[*numbers[:i], numbers[i] ^ 1 << bit, *numbers[i + 1:]])
            (verdict, reason), = self.run_files((a, other, POINT, POINT_TREE), made)
            is_tree = (i, bit) == (0, 0)            # a first child of three triangles is valid
            self.assertEqual(other == certificate(a, tree=((3, (1, 0)), (4, 2))), is_tree)
            self.assertEqual(verdict, "holds" if is_tree else "broken", (i, bit, reason))


if __name__ == "__main__":
    unittest.main()
