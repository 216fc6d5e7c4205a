#!/usr/bin/env python3
"""Tests of second_opinion.py. Meshes, certificates and proofs are built here by hand, from the README.

Binary64 is used only to make inputs and to sample motions; what is tested decides without it.
"""
import contextlib, hashlib, io, itertools, math, os, random, struct, tempfile, unittest
from fractions import Fraction
import second_opinion as so

X, Y, Z = (16384, 0, 0), (0, 16384, 0), (0, 0, 16384)
UNIT3 = (1, 0, 0), (0, 1, 0), (0, 0, 1)
TICKS = (-40, 60)   # units with which the time is counted in whole units: 2^-60 of 2^60
WHOLE = 1 << 62
AUTO = -0x5eed0ff5   # as an offset: halfway between the heights of the parts, by Case.fit
# ---- files ----
def minus(axis): return tuple(-c for c in axis)


def mesh(vertices, triangles):
    return (struct.pack("<II", len(vertices), len(triangles))
            + b"".join(struct.pack("<4d", *v, *[0.0] * (4 - len(v))) for v in vertices)   # without a radius it is 0
            + b"".join(struct.pack("<3I", *t) for t in triangles))


def points(*vertices):
    """A mesh whose triangles are points."""
    return mesh(vertices, [(i, i, i) for i in range(len(vertices))])


def thick(mesh_bytes, *radii):
    """The mesh with other radii of its vertices: one for each, or one for all."""
    count, = struct.unpack_from("<I", mesh_bytes)
    out = bytearray(mesh_bytes)
    for i in range(count):
        struct.pack_into("<d", out, 32 + 32 * i, radii[i % len(radii)])
    return bytes(out)


def certificate(mesh_bytes, order=(0,)):
    return b"CCDBODY1" + hashlib.sha256(mesh_bytes).digest() + struct.pack(f"<{len(order)}I", *order)


def free(p=(0, 0, 0), q=(0, 0, 0, 1), v=(0, 0, 0), w=(0, 0, 0), c=(0, 0, 0), on=0): return on, 0, p, q, (v, w, c)
def turns(a=(0, 0, 1), alpha=0.0, beta=0.0, p=(0, 0, 0), q=(0, 0, 0, 1), on=0): return on, 1, p, q, (a, (alpha, beta))
def slides(a=(0, 0, 1), alpha=0.0, beta=0.0, p=(0, 0, 0), q=(0, 0, 0, 1), on=0): return on, 2, p, q, (a, (alpha, beta))


def link_bytes(link):
    parent, kind, p, q, rest = link
    numbers = [*p, *q, *itertools.chain(*rest)]
    return struct.pack(f"<IB{len(numbers)}d", parent, kind, *numbers)


def leaf(axis, frame=0, d=AUTO): return struct.pack("<B3hi", 3 + frame, *axis, d)
def seven(x): return x.to_bytes(7, "little", signed=True)
def fine_leaf(axis, frame=0, d=AUTO): return bytes([6 + frame]) + b"".join(map(seven, (*axis, d)))
def split_time(first, second, part=32768): return struct.pack("<BH", 2, part) + first + second


def halves(depth, make, t0=0.0, t1=1.0):
    """The time split 2^depth times into equal parts; make(middle) is the leaf of a part."""
    if depth == 0:
        return make((t0 + t1) / 2)
    m = (t0 + t1) / 2
    return split_time(halves(depth - 1, make, t0, m), halves(depth - 1, make, m, t1))


def proof(links, bodies, pairs, steps, duration=1.0, witness=None, units=None):
    """bodies: (mesh, link); pairs: (body, body, margin);
    witness = (pair, time, tolerance, (place, weights) of A, of B), weights in 2^-62, of which two are written."""
    units = units or (-40, max(-60, math.frexp(duration)[1]))
    out = b"CCDPROOF" + struct.pack("<iiIII", *units, len(links), len(bodies), len(pairs))
    out += b"".join(map(link_bytes, links))
    for m, link in bodies:
        out += hashlib.sha256(m).digest() + struct.pack("<I", link)
    for pair in pairs:
        out += struct.pack("<IId", *pair)
    out += struct.pack("<d", duration)
    if witness is None:
        return out + b"\0" + steps
    out += b"\1" + struct.pack("<Idd", *witness[:3])
    for place, weights in witness[3:]:
        out += struct.pack("<I2Q", place, *weights[:2])
    return out + steps


def two(a, b, la, lb, steps, margin=0.0, contact=None, **more):
    """Two bodies, each on a link of its own."""
    witness = contact and (0, *contact)
    return proof([la, lb], [(a, 1), (b, 2)], [(0, 1, margin)], steps, witness=witness, **more)


HEADER = 8 + 8 + 12 + 2 * (5 + 128) + 2 * 36 + 16 + 8   # of two bodies on free links, to the number of witnesses
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
    """exp([a]x) v, along and across a."""
    angle = flength(a)
    if angle == 0:
        return list(v)
    e = fscale(1 / angle, a)
    along = fscale(fdot(e, v), e)
    return fadd(along, fscale(math.cos(angle), fsub(v, along)), fscale(math.sin(angle), fcross(e, v)))


def rotate(q, v):
    """The rotation of q / |q|, as q v q* / |q|^2."""
    u, w = q[:3], q[3]
    t = fadd(fscale(w, v), fcross(u, v))                    # q v = (-u.v, t)
    r = fadd(fscale(fdot(u, v), u), fscale(w, t), fcross(u, t))
    return fscale(1 / (fdot(u, u) + w * w), r)


def up(link, y, t):
    """From the frame of a link to that of its parent, as the table of the README says."""
    _, kind, p, q, rest = link
    if kind == 0:
        v, w, c = rest
        return fadd(p, rotate(q, c), fscale(t, v), turn_by(fscale(t, w), rotate(q, fsub(y, c))))
    a, (alpha, beta) = rest
    a = fscale(alpha + t * beta, a)
    return fadd(p, rotate(q, turn_by(a, y) if kind == 1 else fadd(y, a)))


def where(links, i, y, t):
    while i:
        y, i = up(links[i - 1], y, t), links[i - 1][0]
    return y


def direction(links, i, u, t): return fsub(where(links, i, u, t), where(links, i, (0, 0, 0), t))


def axis_at(links, frame, n, middle, t):
    """The axis n of the world in the middle, as it is at t if it turns with a link."""
    return fadd(*[fscale(fdot(n, direction(links, frame, e, middle)), direction(links, frame, e, t)) for e in UNIT3])


def centre(links, i): return links[i - 1][4][2] if i and links[i - 1][1] == 0 else (0, 0, 0)


def least_height(links, end, corners, side, n, d, frame, t0, t1, samples):
    """Of any samples of balls above the plane, or below it if the side is -1."""
    least = math.inf
    for i in range(samples + 1):
        t = t0 + (t1 - t0) * i / samples
        ns, origin = axis_at(links, frame, n, (t0 + t1) / 2, t), where(links, frame, centre(links, frame), t)
        w = [fdot(ns, direction(links, end, e, t)) for e in UNIT3]
        start = fdot(ns, fsub(where(links, end, (0, 0, 0), t), origin)) - d
        least = min(least, min(side * (start + fdot(w, y)) - flength(n) * ball for *y, ball in corners))
    return least


def random_link(rng, on, speed=1.0):
    def vec(s): return tuple(rng.uniform(-s, s) for _ in range(3))
    p, q, kind = vec(1), tuple(rng.gauss(0, 1) for _ in range(4)), rng.randrange(3)
    q = tuple(fscale(1 / flength(q), q))
    if kind == 0:
        return free(p, q, vec(speed), vec(speed), vec(0.5), on)
    if rng.random() < 0.15:
        speed = 0
    return (turns, slides)[kind - 1](vec(1), rng.uniform(-2, 2), rng.uniform(-2, 2) * speed, p, q, on)


def random_links(rng, count, speed=1.0):
    """A tree; half of the links are on the one before."""
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
        """The proof with the best offsets in place of AUTO: each leaf is taken for good, and tells the heights."""
        if struct.pack("<i", AUTO) not in made:   # with which the 7 bytes begin, too
            return made
        real, heights, found = so.leaf, [], []
        def told(*call):
            d = call[-1] >> so.F
            if abs(d) not in (-AUTO, -AUTO << 20):
                return real(*call)
            heights.append(real(*call[:-1], 0))
            if d < 0:                   # of B, that of A is before it
                below, above = heights[-2:]
                up = 20 if d == AUTO << 20 else 0
                found.append((up, round(Fraction(above - below, 2 << so.F + up))))
            return 1 << 4096
        so.leaf = told
        try:
            paths = self.files(*meshes, made)
            self.checked(paths[:-1], paths[-1:])
        finally:
            so.leaf = real
        place = 0
        for up, d in found:
            old = struct.pack("<i", AUTO) if up else seven(AUTO)
            place = made.index(old, place)
            limit = (1 << 8 * len(old) - 1) - 1
            new = max(-limit, min(limit, d)).to_bytes(len(old), "little", signed=True)
            made = made[:place] + new + made[place + len(old):]
            place += len(old)
        return made

    def checked(self, meshes, proofs):
        out, options = io.StringIO(), []
        for i in range(0, len(meshes), 2):
            options += ["--mesh", *meshes[i:i + 2]]
        with contextlib.redirect_stdout(out):
            status = so.main([*options, *proofs])
        return status, [line.split(": ", 2)[1:] for line in out.getvalue().splitlines()]

    def run_files(self, meshes, *proofs):
        """The verdicts and reasons the command prints; meshes are mesh, certificate, mesh, certificate."""
        paths = self.files(*meshes, *(self.fit(meshes, made) for made in proofs))
        status, lines = self.checked(paths[:len(meshes)], paths[len(meshes):])
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
        """Links as the checker reads them, in units of 1."""
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
            self.holds(self.M, self.flat(fine_leaf((0, 0, 1 << 50), frame), margin=0.99))

    def test_margin_is_strict(self):
        self.fails("does not prove", self.M, self.flat(leaf(Z), margin=1.0))
        self.holds(self.M, self.flat(leaf(Z), margin=math.nextafter(1.0, 0)))

    def test_radii_count(self):
        for radii in ((0.25, 0.25), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)):
            files, make = self.thick_pair(radii)
            if sum(radii) < 1:
                self.holds(files, make(leaf(Z), margin=0.4999))
            self.fails("does not prove", files, make(leaf(Z), margin=0.5 if sum(radii) < 1 else 0.0))

    def thick_pair(self, radii, la=free(), lb=free(p=(0, 0, 1))):
        """Two triangles with these radii, and what makes proofs of them."""
        a, b = (thick(FLAT, r) for r in radii)
        return (a, certificate(a), b, certificate(b)), lambda steps, **more: two(a, b, la, lb, steps, **more)

    def test_each_radius_counts(self):
        # Only at its own corner: z is 0, 0.5 and 0.75 there, and radii sink it as far as each has one.
        for radii, least in (((0, 0, 0), 0), ((0.25, 0.25, 0.25), -0.25), ((0, 0.75, 0), -0.25), ((0, 0, 0.5), 0),
                             ((0, 0.5, 0.875), -0.125), ((0.0625, 0.25, 0.75), -0.0625)):
            b = mesh([(0, 0, 0, radii[0]), (1, 0, 0.5, radii[1]), (0, 1, 0.75, radii[2])], [(0, 1, 2)])
            files = *self.M, b, certificate(b)
            for q, p, axis in (((0, 0, 0, 1), 1, Z), ((1, 0, 0, 0), -1, minus(Z))):   # as it is, and turned over
                def make(margin): return two(FLAT, b, free(), free((0, 0, p), q), leaf(axis), margin)
                self.holds(files, make(math.nextafter(1 + least, 0)))
                self.fails("does not prove", files, make(1.0 + least))
        # A motion takes off what it does of flat ones: rate / 2 by the end, and half of the square of half of the turn.
        for rate in (0.0, 0.5):
            lb = free(p=(0, 0, 1), w=(0, 0, rate), v=(0, 0, -rate / 2))
            files, make = self.thick_pair((0.125, 0.25), lb=lb)
            self.holds(files, make(leaf(Z), margin=0.6249 - rate / 2 - rate ** 2 / 8))
            self.fails("does not prove", files, make(leaf(Z), margin=0.6251 - rate / 2 - rate ** 2 / 8))

    def test_radii_of_parts(self):
        # A small ball below and a large one above it: the box of both is lower than either.
        b = points((0, 0, 1, 0.125), (0, 0, 2, 0.75), (0, 0, 3, 2.0))
        files = *self.M, b, certificate(b, (2, 0, 1))
        def make(margin): return two(FLAT, b, free(), free(), leaf(Z), margin)
        self.holds(files, make(math.nextafter(0.875, 0)))
        self.fails("does not prove", files, make(0.875))
        b = points((0, 0, 1, 0.125), (0, 0, 2, 0.75), (0, 0, 3, math.nextafter(2.125, 3)))
        self.fails("does not prove", (*self.M, b, certificate(b, (2, 0, 1))), make(math.nextafter(0.875, 0)))

    def test_offset(self):
        # B is 1 above A, and the plane has to leave half of the margin on both sides of it.
        half = 1 << 19                              # of 1, in 2^20 units of 2^-40
        for frame in (0, 1, 2):
            below = half - (frame == 2) * 2 * half   # seen from A or the world, or from B
            for d, most in ((0, 1.0), (half // 2, 0.5), (-half // 2, 0.5), (half - 1, 2.0 ** -19), (half, 0.0),
                            (-half, 0.0), (2 * half, 0.0), (-8 * half, 0.0), (2 ** 31 - 1 - half, 0.0),
                            (half - 2 ** 31, 0.0)):
                for step in (leaf(Z, frame, below + d), fine_leaf((0, 0, 1 << 50), frame, below + d << 20)):
                    if most > 0:
                        self.holds(self.M, self.flat(step, margin=math.nextafter(most, 0)))
                    self.fails("does not prove", self.M, self.flat(step, margin=most))
            def fine(d): return self.flat(fine_leaf((0, 0, 1 << 50), frame, (below << 20) + d))
            self.holds(self.M, fine(1 - (1 << 39)), fine((1 << 39) - 1))
            self.fails("does not prove", self.M, fine(-1 << 39), fine(1 << 39))

    def test_offset_is_from_the_centre(self):
        # A and B are 10 and 11 above the world, and their centres elsewhere.
        la, lb = free(p=(0, 0, 10), c=(0, 0, 4)), free(p=(0, 0, 11), c=(0, 0, -7))
        for frame, origin in ((0, 0), (1, 14), (2, 4)):
            def make(d):
                return self.flat(fine_leaf((0, 0, 1 << 50), frame, int((d - origin) * 2 ** 40)), la, lb, margin=0.75)
            self.holds(self.M, make(10.5), make(10.4), make(10.6))
            self.fails("does not prove", self.M, make(10.3), make(10.7), make(0), make(-10.5))
        # A plane that goes along with the centre of a body that does not turn.
        la, lb = free(v=(0, 0, 9)), free(p=(0, 0, 1), v=(0, 0, 9))
        for frame, d in ((1, 1 << 19), (2, -1 << 19)):
            self.holds(self.M, self.flat(leaf(Z, frame, d), la, lb, margin=0.99))
        self.fails("does not prove", self.M, self.flat(leaf(Z), la, lb))

    def test_unit_of_offset(self):
        for e in (-60, -40, -10, 0, 3):             # B is 2^(e + 21) above A, and the plane half of that
            lb = free(p=(0, 0, 2.0 ** (e + 21)))
            for step in (leaf(Z, 0, 1), fine_leaf((0, 0, 1 << 50), 0, 1 << 20)):
                def make(margin): return self.flat(step, lb=lb, margin=margin, units=(e, 0))
                self.holds(self.M, make(math.nextafter(2.0 ** (e + 21), 0)))
                self.fails("does not prove", self.M, make(2.0 ** (e + 21)))

    def test_no_duration(self):
        self.holds(self.M, self.flat(leaf(Z), duration=0.0))
        self.fails("time is empty", self.M, self.flat(split_time(leaf(Z), leaf(Z), 32768), duration=0.0))
        self.fails("time is empty", self.M, self.flat(split_time(leaf(Z), leaf(Z), 0)))

    def test_moves(self):
        lb = free(p=(0, 0, 1), v=(5, 0, -0.75))
        self.holds(self.M, self.flat(leaf(Z), lb=lb, margin=0.24))
        self.holds(self.M, self.flat(split_time(leaf(Z), leaf(Z), 1234), lb=lb, margin=0.24))
        self.fails("does not prove", self.M, self.flat(leaf(Z), lb=lb, margin=0.26))
        self.fails("does not prove", self.M, self.flat(split_time(leaf(Z), leaf(Z)), lb=lb, margin=0.26))
        self.fails("does not prove", self.M, self.flat(leaf(Z), lb=lb, duration=1.5))

    def test_part_of_time(self):
        # B goes down beside A: it is above until 0.25, and beside from 0.125 on.
        lb, units = free(p=(0, 0, 0.5), v=(8, 0, -2)), (-40, 0)
        self.holds(self.M, self.flat(split_time(leaf(Z), leaf(X), 12288), lb=lb, margin=0.1, units=units))
        for part in (32768, 65536 - 12288, 8192, 16384):
            self.fails("does not prove", self.M, self.flat(split_time(leaf(Z), leaf(X), part), lb=lb, margin=0.1))
        self.fails("does not prove", self.M, self.flat(split_time(leaf(X), leaf(Z), 12288), lb=lb, margin=0.1))

    def test_the_time_is_counted_in_the_unit(self):
        down = free(p=(0, 0, 1), v=(0, 0, -0.75))
        # Half a tick is rounded up to a whole one, until which the gap shrinks to 0.25.
        for duration in (0.25, 0.5, 1.0):
            self.holds(self.M, self.flat(leaf(Z), lb=down, margin=0.24, duration=duration, units=TICKS))
            made = self.flat(leaf(Z), lb=down, margin=0.26, duration=duration, units=TICKS)
            self.fails("does not prove", self.M, made)
        self.fails("time is empty", self.M, self.flat(split_time(leaf(Z), leaf(Z)), lb=down, units=TICKS))
        # Three ticks are split after the first one by a half, rounded down, and after the second one by 2/3 and more.
        slow = free(p=(0.5, 0, 0.5), v=(1, 0, -0.25))   # above until 2, beside from 0.5 on
        for part, first in ((32768, 1), (43690, 1), (43691, 2), (21845, 0), (21846, 1)):
            made = self.flat(split_time(leaf(Z), leaf(X), part), lb=slow, margin=0.01, duration=3.0, units=TICKS)
            if first == 1:
                self.holds(self.M, made)
            else:
                self.fails("does not prove" if first else "time is empty", self.M, made)
        self.fails("less than the time", self.M, self.flat(leaf(Z), units=(-40, -1)), verdict="unverifiable")
        self.fails("out of range", self.M, self.flat(leaf(Z), units=(-40, 1 << 30)),
                   self.flat(leaf(Z), units=(-1 << 31, 0)), verdict="unverifiable")

    def test_axis(self):
        self.fails("does not prove", self.M, self.flat(leaf(minus(Z))))
        self.fails("does not prove", self.M, self.flat(leaf((0, 0, 0))))
        self.fails("does not prove", self.M, self.flat(leaf(Y)))
        self.fails("longer than 1", self.M, self.flat(leaf((0, 0, 16385))))
        self.fails("longer than 1", self.M, self.flat(leaf((181, 0, 16384))))
        self.fails("longer than 1", self.M, self.flat(fine_leaf((1, 0, 1 << 50))))
        self.fails("longer than 1", self.M, self.flat(fine_leaf((0, 0, -1 << 51))))
        # A bent axis shows a shorter gap: here 0.8 less 0.6 of the extent along x.
        bent = (9830, 0, 13107)
        self.holds(self.M, self.flat(leaf(bent), margin=0.19))
        self.fails("does not prove", self.M, self.flat(leaf(bent), margin=0.21))

    def test_file(self):
        good = self.flat(leaf(Z))
        self.holds(self.M, good)
        self.assertEqual(len(good), HEADER + 12)
        self.assertEqual(len(self.flat(fine_leaf((0, 0, 1 << 50)))), HEADER + 30)
        self.fails("file ends", self.M, *[good[:n] for n in range(8, len(good), 7)])
        self.fails("bytes follow", self.M, good + b"\0", good + leaf(Z))
        self.fails("another kind", self.M, b"", b"CCDPROOG" + good[8:])
        self.fails("no such step", self.M, self.flat(b"\x09"))
        self.fails("more than one", self.M, good[:HEADER] + b"\2" + good[HEADER + 1:])
        self.fails("can not be split", self.M, self.flat(b"\0" + leaf(Z)), self.flat(b"\1" + leaf(Z)))
        self.fails("margin is negative", self.M, self.flat(leaf(Z), margin=-0.5))
        for bad, place in itertools.product((-0.5, -5e-324, math.nan, math.inf, -math.inf), range(3)):
            a = thick(FLAT, *[bad if i == place else 0.5 for i in range(3)])
            why, verdict = ("radius", "broken") if math.isfinite(bad) else ("not finite", "unverifiable")
            made = two(a, FLAT, free(), free(p=(0, 0, 1)), leaf(Z))
            self.fails(why, (a, certificate(a), *self.M), made, verdict=verdict)
        minus_0 = thick(FLAT, -0.0)
        self.holds((minus_0, certificate(minus_0)), two(minus_0, minus_0, free(), free(p=(0, 0, 1)), leaf(Z), 0.99))
        self.fails("time is negative", self.M, self.flat(leaf(Z), duration=-1.0))

    def test_indices(self):
        def make(links=(free(), free(p=(0, 0, 1))), bodies=((FLAT, 1), (FLAT, 2)), pairs=((0, 1, 0.5),)):
            return proof(list(links), list(bodies), list(pairs), leaf(Z) * len(pairs))
        self.holds(self.M, make(), make(pairs=()), proof([], [], [], b""))
        self.holds(self.M, make(links=(free(p=(0, 0, 1)),), bodies=((FLAT, 0), (FLAT, 1))))
        for on in (1, 2, 3, 1 << 31):   # a link on itself, or on a later one
            self.fails("no such link before", self.M, make(links=(free(on=on), free(p=(0, 0, 1)))))
        self.fails("no such link", self.M, make(bodies=((FLAT, 3), (FLAT, 2))))
        self.fails("no such body", self.M, make(pairs=((0, 2, 0.5),)), make(pairs=((2, 0, 0.5),)))
        self.fails("does not prove", self.M, make(pairs=((1, 0, 0.5),)), make(pairs=((0, 0, 0.0),)))
        good = make()
        self.fails("no such kind", self.M, good[:32] + b"\3" + good[33:])
        deep = [turns(on=i) for i in range(199)]
        self.holds(self.M, make(links=(*deep, free(p=(0, 0, 1))), bodies=((FLAT, 199), (FLAT, 200))))
        self.fails("chain", self.M, make(links=(*deep, turns(on=199))), verdict="unverifiable")

    def test_numbers(self):
        for bad in (math.nan, math.inf, -math.inf):
            self.fails("byte 166", self.M, self.flat(leaf(Z), lb=free(p=(0, bad, 1))), verdict="unverifiable")
        p = 0, 0, 1
        for link in (free(p, w=(0, 0, 1000)), turns(p=p, beta=1000.0), turns(p=p, alpha=-1000.0)):
            self.fails("turns too far", self.M, self.flat(leaf(Z), lb=link), verdict="unverifiable")
        self.holds(self.M, self.flat(leaf(Z), lb=turns(p=(0, 0, 1), alpha=500.0)))
        spin = free(p=(0, 0, 1), w=(0, 0, 250))
        self.fails("does not prove", self.M, self.flat(leaf(Z), lb=spin))   # true, but this is too long a stretch
        self.holds(self.M, self.flat(halves(8, lambda _: leaf(Z)), lb=spin))
        for q in ((0, 0, 0, 0), (0, 0, 0, 1.01), (0, 0, 0, 1 - 2.0 ** -20)):
            self.fails("1 long", self.M, *(self.flat(leaf(Z), lb=f(p=(0, 0, 1), q=q)) for f in (free, turns, slides)))
        self.holds(self.M, self.flat(leaf(Z), lb=free(p=(0, 0, 1), q=(0, 0, 0, 1 - 2.0 ** -21))))
        # Very large and very small numbers are exact too.
        far = free(p=(0, 0, 1e300))
        self.holds(self.M, self.flat(leaf(Z), lb=far, margin=9.9e299, units=(950, 0)))
        ball = thick(FLAT, 1e300)
        self.holds((*self.M, ball, certificate(ball)), two(FLAT, ball, free(), free(p=(0, 0, 2e300)), leaf(Z), 9.9e299,
                                                           units=(950, 0)))
        tiny = mesh([(0, 0, 5e-324), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        tree = certificate(tiny)
        self.holds((tiny, tree, *self.M), two(tiny, FLAT, free(), free(p=(0, 0, 1)), leaf(Z), margin=0.5))

    def test_quaternion(self):
        # A quarter turn about x takes y to z, so that the triangle stands up to z = 1.
        q = (math.sqrt(0.5), 0, 0, math.sqrt(0.5))
        above = free(p=(0, 0, 1.25))
        # With its centre at y = 1 that corner stays at p + R0 c.
        for up in (free(q=q), free(q=q, c=(0, 1, 0)), turns(q=q), slides(q=q)):
            self.holds(self.M, self.flat(leaf(Z), la=up, lb=above, margin=0.2499))
            self.fails("does not prove", self.M, self.flat(leaf(Z), la=up, lb=above, margin=0.2501))

    def test_quaternion_not_quite_1_long(self):
        # A is turned by half a turn about z, so that its corner is at x = -1, however long the quaternion is.
        e = 2.0 ** -22
        for z in (1 + e, 1 - e):
            for kind in (free, turns, slides):
                def make(margin):
                    return self.flat(leaf(minus(X)), kind(q=(0, 0, z, 0)), free(p=(-3, 0, 0)), margin=margin)
                self.holds(self.M, make(1 - e / 8))
                self.fails("does not prove", self.M, make(1 + e / 8))


class Joints(Case):
    M = POINT, POINT_TREE, FLAT, FLAT_TREE

    def test_sliding(self):
        # B is carried up x by a slide that is turned to z, and the axis may have any length.
        q = (0, -math.sqrt(0.5), 0, math.sqrt(0.5))   # takes x to z
        for a, alpha, beta in (((1, 0, 0), 1.0, -0.75), ((0.25, 0, 0), 4.0, -3.0), ((-1, 0, 0), -1.0, 0.75)):
            def make(margin, **more):
                return two(FLAT, FLAT, free(), slides(a, alpha, beta, q=q), leaf(Z), margin, **more)
            # Turned so, the triangle itself reaches from z = 0 to 1 above its place.
            self.holds(self.M, make(0.2499))
            self.fails("does not prove", self.M, make(0.2501), make(0.2499, duration=1.1))

    def test_turning(self):
        # A point at x = 1 turns about z by an angle from -0.5 to 0.5.
        a = points((1, 0, 0))
        for axis, alpha, beta in (((0, 0, 1), -0.5, 1.0), ((0, 0, -0.5), 1.0, -2.0)):
            def make(margin, depth):
                steps = halves(depth, lambda t: fine_leaf((1 << 50, 0, 0)))
                return two(a, POINT, turns(axis, alpha, beta), free(p=(2, 0, 0)), steps, margin)
            files = (a, certificate(a), *self.M)
            self.holds(files, make(0.8, 0), make(0.99, 4))
            self.fails("does not prove", files, make(0.9, 0), make(1.001, 4))
        def away(alpha, margin): return two(a, POINT, turns(alpha=alpha), free(p=(-2, 0, 0)), leaf(minus(X)), margin)
        for alpha in (math.pi, 2.9, -2.0):
            self.holds(files, away(alpha, 1.9999 + math.cos(alpha)))
            self.fails("does not prove", files, away(alpha, 2.0001 + math.cos(alpha)))

    def test_scara(self):
        # Arms 1 long turn about z by t and by -2 t, so the tip stays on y = 0, below a plate that a slide lifts.
        links = [turns(beta=1.0), turns(beta=-2.0, p=(1, 0, 0), on=1), slides(beta=0.5, p=(1, 0, 0), on=2),
                 slides((0, 0, 1), 0.0, 0.5, p=(0, 0, 1))]
        def make(margin, depth, axis=Z):
            steps = halves(depth, lambda t: leaf(axis))
            return proof(links, [(POINT, 3), (FLAT, 4)], [(0, 1, margin)], steps)
        # Both rise by 0.5 in all, and the plane does not: in a stretch it is 2^-8 lower than B at the start and
        # higher than A at the end.
        self.holds(self.M, make(0.999 - 2 ** -8, 7))
        self.fails("does not prove", self.M, make(1.0001 - 2 ** -8, 7), make(0.999, 1), make(0.0, 7, Y))
        wall = mesh([(-9, 0.25, -9), (9, 0.25, -9), (0, 0.25, 9)], [(0, 1, 2)])
        def beside(margin, depth):
            return proof(links, [(POINT, 3), (wall, 0)], [(0, 1, margin)], halves(depth, lambda t: leaf(Y)))
        files = (wall, certificate(wall), *self.M)
        self.holds(files, beside(0.24, 6))
        self.fails("does not prove", files, beside(0.251, 6), beside(0.24, 1))

    def test_a_turning_base_carries_both(self):
        # Each body is on a link of its own on a base that turns by 6 radians. Seen from a body nothing turns.
        for base in (turns(beta=6.0), free(w=(0, 0, 6.0)), turns((0, 0, 3.0), 1.0, 2.0)):
            links = [base, free(on=1), free(p=(0, 0, 1), on=1), slides((1, 0, 0), -0.5, 1.0, p=(0.5, 0, 0), on=1)]
            side = tuple(math.trunc(16384 * c) for c in direction(links, 1, (1, 0, 0), 0.5))
            def make(b, axis, frame, margin, depth=0):
                return proof(links, [(POINT, 2), (POINT, b)], [(0, 1, margin)],
                             halves(depth, lambda _: leaf(axis, frame)))
            for frame in (1, 2):
                self.holds(self.M, make(3, Z, frame, 0.999))
            self.fails("does not prove", self.M, make(3, Z, 0, 0.0))
            self.holds(self.M, make(3, Z, 0, 0.99, 6))
            for frame in (1, 2):   # the slide starts at 0 and goes to 1 along x of the base
                self.fails("does not prove", self.M, make(4, side, frame, 0.001))
            links[3] = slides((1, 0, 0), 0.0, 1.0, p=(0.5, 0, 0), on=1)
            for frame in (1, 2):
                self.holds(self.M, make(4, side, frame, 0.499))
                self.fails("does not prove", self.M, make(4, side, frame, 0.501), make(4, Y, frame, 0.1))
            self.fails("does not prove", self.M, make(4, side, 0, 0.0), make(4, side, 0, 0.0, 2))

    def test_bodies_on_one_link(self):
        a, b = points((0, 0, 0)), points((1, 2, 3))
        files = a, certificate(a), b, certificate(b)
        links = [turns(beta=3.0), free(c=(5, 5, 5), w=(1, 2, 1), v=(9, 9, 9), on=1)]
        for on, frames in ((0, (0, 1, 2)), (2, (1, 2))):
            middle = direction(links, on, (0, 0, 1), 0.5)
            axis = [math.trunc(c * (1 << 50) * 0.999999) for c in middle]
            def make(margin, frame):
                return proof(links, [(a, on), (b, on)], [(0, 1, margin)], fine_leaf(axis, frame))
            for frame in frames:
                self.holds(files, make(2.9999, frame))
                self.fails("does not prove", files, make(3.0001, frame))
        self.fails("does not prove", files, make(0.0, 0))

    def test_kinds_against_samples(self):
        rng = random.Random(11)
        for trial in range(40):
            links = random_links(rng, 5, 2.0)
            exact = self.exact_links(links)
            for i, t in itertools.product(range(6), (0.0, 0.375, rng.random())):
                place = fadd(*[[lo / so.ONE for lo, _ in x.pose(Fraction(t))[1]] for x in exact[i].chain])
                centre = links[i - 1][4][2] if i and links[i - 1][1] == 0 else (0, 0, 0)
                self.assertLess(flength(fsub(place, where(links, i, centre, t))), 1e-12)
                columns = exact[i].pose(Fraction(t))[0]
                for column, e in zip(columns, UNIT3):
                    self.assertLess(flength(fsub([lo / so.ONE for lo, _ in column], direction(links, i, e, t))), 1e-12)
                    self.assertLess(max(hi - lo for lo, hi in column), 1 << 24)


class Turning(Case):
    def setUp(self):
        # Two plates that turn together about the origin: x = 0 and x = 1 of the same frame.
        self.a = mesh([(0, -3, -3), (0, 3, -3), (0, 0, 3)], [(0, 1, 2)])
        self.b = mesh([(1, -3, -3), (1, 3, -3), (1, 0, 3)], [(0, 1, 2)])
        self.M = self.a, certificate(self.a), self.b, certificate(self.b)
        self.link = free(w=(0, 0, 1.5))

    def plates(self, steps, **more):
        return two(self.a, self.b, self.link, self.link, steps, **more)

    def test_axis_turns_with_a_body(self):
        axis = tuple(math.trunc(c * 16384) for c in (math.cos(0.75), math.sin(0.75), 0))
        for self.link in (free(w=(0, 0, 1.5)), turns(beta=1.5), turns((0, 0, 0.5), beta=3.0)):
            self.holds(self.M, self.plates(leaf(axis, 1), margin=0.99))
            self.holds(self.M, self.plates(leaf(axis, 2), margin=0.99))
            self.fails("does not prove", self.M, self.plates(leaf(axis, 0)))
            self.fails("does not prove", self.M, self.plates(leaf(X, 1)))

    def test_axis_is_in_world_coordinates_at_the_middle(self):
        def at(middle):
            return leaf(tuple(math.trunc(c * 16384) for c in (math.cos(1.5 * middle), math.sin(1.5 * middle), 0)), 1)
        self.holds(self.M, self.plates(halves(2, at, 0, 1), margin=0.99))
        self.fails("does not prove", self.M, self.plates(halves(2, lambda _: leaf(X, 1)), margin=0.99))
        # One tick has its middle at 0, three have it at 1; what is left is covered to the end.
        self.link = free(w=(0, 0, 0.25))
        for duration, middle in ((1.0, 0), (2.0, 1), (3.0, 1)):
            good = leaf(tuple(math.trunc(c * 16384) for c in (math.cos(middle / 4), math.sin(middle / 4), 0)), 2)
            self.holds(self.M, self.plates(good, margin=0.999, duration=duration, units=TICKS))
            other = leaf(tuple(math.trunc(c * 16384) for c in (math.cos(duration / 8), math.sin(duration / 8), 0)), 2)
            if duration != 2.0:
                self.fails("does not prove", self.M, self.plates(other, margin=0.999, duration=duration, units=TICKS))

    def test_time_is_split(self):
        # A rod of length 1 turns in the y-z plane by 4 radians; B is 3 above.
        a = mesh([(0, -1, 0), (0, 1, 0), (0.125, 0, 0)], [(0, 1, 2)])
        files = a, certificate(a), FLAT, FLAT_TREE
        def make(steps): return two(a, FLAT, free(w=(4, 0, 0)), free(p=(0, 0, 3)), steps, margin=1.0)
        self.fails("does not prove", files, make(leaf(Z)))
        good = make(halves(3, lambda _: leaf(Z)))
        self.holds(files, good)
        self.fails("does not prove", files, make(halves(3, lambda t: leaf(Z) if t < 0.9 else leaf(Y))))
        first, size = HEADER + 1 + 9, len(leaf(Z))
        self.fails("file ends", files, good[:-size])                       # the last leaf is dropped
        self.fails("file ends", files, good[:first] + good[first + size:]) # the first one is dropped
        # Without the last splits, and a leaf of each, the stretches are longer; that is a proof still.
        self.holds(files, good[:first - 3] + good[first + size:], make(halves(2, lambda _: leaf(Z))))
        for step in range(first, len(good)):                               # each leaf is shifted, or bent
            if good[step:step + size] == leaf(Z):
                self.fails("", files, good[:step] + leaf(Z)[1:] + good[step + size:])
                self.fails("does not prove", files, good[:step] + leaf((12000, 0, 0)) + good[step + size:],
                           *[good[:step] + leaf(Z, 0, d << 18) + good[step + size:] for d in (-9, 0, 1, 11, 40)])
        self.fails("", files, make(b"\0" + halves(3, lambda _: leaf(Z)))[:-size])


class SecondOrder(Case):
    """What the lemmas take off, one term at a time: a margin a little below is proven, one a little above is not.

    The stretch is 0.2 long and links turn by 1; all meshes are single points."""
    def bound(self, want, links, ends, frame, za=(0, 0, 0), zb=(0, 0, 0), axis=(1 << 50, 0, 0)):
        a, b = points(za), points(zb)
        files = a, certificate(a), b, certificate(b)
        def make(margin):
            return proof(links, [(a, ends[0]), (b, ends[1])], [(0, 1, margin)], fine_leaf(axis, frame), 0.2)
        self.holds(files, make(want - 1e-6))
        self.fails("does not prove", files, make(want + 1e-6))

    def test_one_joint(self):
        spin = free(w=(0, 0, 1))
        self.bound(1 - 0.005, [spin, free(p=(1, 0, 0))], (1, 2), 1)                     # rho^2 |d|
        # The velocity and the turn cancel in the first order; the second has rho^2 (|d| + |m|) and 2 rho |m|.
        self.bound(1 - 0.005 * (1 + 0.1) - 0.1 * 0.1, [spin, free(p=(1, 0.1, 0), v=(0, -1, 0))], (1, 2), 1)
        self.bound(1 - 0.005, [spin, free()], (1, 2), 1, zb=(1, 0, 0))                  # rho^2 r
        back = free(q=(0, 0, -math.sin(0.05), math.cos(0.05)), w=(0, 0, 1))             # straight at the middle
        self.bound(1 - 0.005, [free(), back], (1, 2), 0, zb=(1, 0, 0))
        self.bound(1 - 0.005, [back, free()], (1, 2), 0, za=(-1, 0, 0))
        joint = turns(alpha=-0.1, beta=1.0)
        self.bound(1 - 0.005, [free(), joint], (1, 2), 0, zb=(1, 0, 0))
        self.bound(1, [back, back], (1, 2), 2, za=(0, 1, 0), zb=(1, 1, 0))              # all turns together
        self.bound(1, [joint, joint], (1, 2), 1, za=(0, 1, 0), zb=(1, 1, 0))

    def test_chains(self):
        z, x = turns(alpha=-0.1, beta=1.0), turns((1, 0, 0), -0.1, 1.0, on=1)
        # About z and then about x: W = 0.01 and rho = 0.1 sqrt 2 + 0.01. A point on x rests on its own joint.
        k = 0.01 + (0.1 * math.sqrt(2) + 0.01) ** 2
        self.bound(1 - k / 2, [z, x], (0, 2), 0, zb=(1, 0, 0))
        self.bound(1 - k / 2, [z, x], (2, 0), 0, za=(-1, 0, 0))                          # the same for A
        self.bound(1 - k / 2, [z, x, free(p=(1, 0, 0), on=2)], (0, 3), 0)                # an arm there, no point
        # The axis turns with the end of the chain: x is left first, then z, with the other signs.
        self.bound(1 - k / 2, [z, x], (2, 0), 1, zb=(1, 0, 0))
        self.bound(1 - k / 2, [z, x], (0, 2), 2, za=(-1, 0, 0))
        # Up and down: on the joint x, and back to z by another joint with the same turn.
        twin = turns((1, 0, 0), -0.1, 1.0, on=1)
        self.bound(1, [z, x, twin], (2, 3), 1, zb=(1, 0, 0))
        # Up by x, which takes off the arm of the twin, 1 long and carried by the link of z.
        twin = turns((1, 0, 0), -0.1, 1.0, p=(1, 0, 0), on=1)
        self.bound(1 - 0.005, [z, x, twin], (2, 3), 1)
        # Arms of one link are added first: the way from A to B has -5 and 4 there. From the world each way has its own.
        arms = [z, turns((1, 0, 0), -0.1, 1.0, p=(-5, 0, 0), on=1), turns((1, 0, 0), -0.1, 1.0, p=(-4, 0, 0), on=1)]
        self.bound(1 - 0.005, arms, (2, 3), 1)
        self.bound(1 - 0.005 * 9, arms, (2, 3), 0)
        # A slide does not turn: its arm, and the next one, are carried by the joint before.
        slide = [z, slides((1, 0, 0), -3.0, 0.0, on=1), turns((1, 0, 0), -0.1, 1.0, p=(4, 0, 0), on=2)]
        self.bound(1 - 0.005, slide, (0, 3), 0)
        # An arm that gets longer: rho^2 (|d| + |m|) + 2 rho |m|.
        slide = [z, slides((1, 0, 0), 0.9, 1.0, on=1)]
        self.bound(1 - 0.1 - (0.01 * 1.1 + 2 * 0.1 * 0.1) / 2, slide, (0, 2), 0)

    def test_three_joints(self):
        joints = [turns(alpha=-0.1, beta=1.0), turns((1, 0, 0), -0.1, 1.0, on=1), turns((0, 1, 0), -0.1, 1.0, on=2)]
        w2 = 0.01
        w3 = w2 + 0.1 * 0.1 * math.sqrt(2) + w2 * 0.1       # |(z + x) x y| = sqrt 2
        rho3 = 0.1 * math.sqrt(3) + w3
        # y turns a point on x down z; along x nothing changes in the first order.
        self.bound(1 - (w3 + rho3 ** 2) / 2, joints, (0, 3), 0, zb=(1, 0, 0))


class Pairs(Case):
    def setUp(self):
        self.links = [free(), free(p=(0, 0, 1)), free(p=(0, 0, 3), v=(0, 0, -0.5))]
        ball = thick(FLAT, 0.25)
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
        self.links[2] = turns(beta=0.125, p=(0, 0, 3))
        pairs = [(0, 1, 0.99), (1, 2, 1.7), (0, 2, 2.7)]
        self.holds(self.M, self.make(pairs, leaf(Z, 1) + leaf(Z, 2) + leaf(Z, 2)))
        self.links[2] = turns((1, 0, 0), -0.5, 0.125, p=(0, 0, 3))
        self.fails("pair 1 apart", self.M, self.make(pairs, leaf(Z, 1) + leaf(Z, 2) + leaf(Z, 2)))

    def test_witness_of_a_pair(self):
        pairs, steps, corner = [(0, 1, 0.99), (1, 2, 1.24)], leaf(Z) * 2, (0, (WHOLE, 0))
        # The gaps are 1 and 2 - 0.5 t; with the radius of a body 1.25 is near.
        for time in (0.0, 0.5, 1.0):
            need = 2 - 0.5 * time - 1.24 - 0.25
            self.holds(self.M, self.make(pairs, steps, witness=(0, time, 0.011, corner, corner)),
                       self.make(pairs, steps, witness=(1, time, need + 0.001, corner, corner)))
            self.fails("too far apart", self.M, self.make(pairs, steps, witness=(0, time, 0.009, corner, corner)),
                       self.make(pairs, steps, witness=(1, time, need - 0.001, corner, corner)))
        self.fails("no such pair", self.M, self.make(pairs, steps, witness=(2, 0.5, 9.0, corner, corner)))
        self.fails("no such pair", self.M, self.make([], b"", witness=(0, 0.5, 9.0, corner, corner)))


class Parts(Case):
    def setUp(self):
        # A is a notch: plates x = -1 and y = -1. B is a small triangle in it. No plane parts them.
        self.a = mesh([(-1, -1, -9), (-1, 9, 0), (-1, -1, 9), (9, -1, 0)], [(0, 1, 2), (0, 3, 2)])
        self.b = mesh([(-0.75, -0.75, 0), (-0.5, -0.75, 0), (-0.75, -0.5, 0)], [(0, 1, 2)])
        self.cb = certificate(self.b)
        self.ca = certificate(self.a, [0, 1])
        self.rest = free(), free()

    def notch(self, steps, ca=None, links=None, **more):
        return (self.a, ca or self.ca, self.b, self.cb), two(self.a, self.b, *(links or self.rest), steps, **more)

    def test_split(self):
        for axis in (X, Y, (11585, 11585, 0), minus(X)):
            self.fails("does not prove", *self.notch(leaf(axis)))
        steps = b"\0" + leaf(X) + leaf(Y)
        self.holds(*self.notch(steps, margin=0.24))
        self.fails("does not prove", *self.notch(b"\0" + leaf(Y) + leaf(X)))
        self.fails("file ends", *self.notch(b"\0" + leaf(X)))
        self.fails("bytes follow", *self.notch(steps + leaf(X)))
        self.holds(*self.notch(b"\0" + leaf(X) + split_time(leaf(Y), leaf(Y)), margin=0.24))

    def test_moved_by_one_unit(self):
        # The gaps are 0.25 exactly; a corner that is nearer by the least step of its binary64 has less.
        exact = math.nextafter(0.25, 0)
        steps = b"\0" + leaf(X) + leaf(Y)
        self.holds(*self.notch(steps, margin=exact))
        for i, axis in ((0, 0), (2, 0), (0, 1)):
            vertices = [[-0.75, -0.75, 0], [-0.5, -0.75, 0], [-0.75, -0.5, 0]]
            vertices[i][axis] = math.nextafter(-0.75, -1)
            self.b = mesh(vertices, [(0, 1, 2)])
            self.cb = certificate(self.b)
            self.fails("does not prove", *self.notch(steps, margin=exact))

    def test_order(self):
        steps = b"\0" + leaf(X) + leaf(Y), b"\0" + leaf(Y) + leaf(X)
        for order, right, wrong in (([0, 1], *steps), ([1, 0], *reversed(steps))):
            self.holds(*self.notch(right, certificate(self.a, order)))
            self.fails("does not prove", *self.notch(wrong, certificate(self.a, order)))

    def test_halves(self):
        # The first half of three is one. The point 0 is left of B, and all others are right of it.
        a = points(*[(i, i * i, 0) for i in range(6)])
        left, right = leaf(X), leaf(minus(X))
        for order, steps in ((range(6), b"\0\0" + left + right + right),
                             ([5, 2, 0, 1, 4, 3], b"\0\0" + right + b"\0" + right + left + right),
                             ([1, 2, 3, 4, 5, 0], b"\0" + right + b"\0" + right + b"\0" + right + left)):
            files = a, certificate(a, order), POINT, POINT_TREE
            def make(margin): return two(a, POINT, free(), free(p=(0.5, 0, 0)), steps, margin)
            self.holds(files, make(0.49))
            self.fails("does not prove", files, make(0.51))

    def test_bad_certificates(self):
        steps = b"\0" + leaf(X) + leaf(Y)
        bad = self.ca[:8] + bytes(32) + self.ca[40:]
        self.fails("another mesh", *self.notch(steps, bad))
        for order in ([0, 0], [0, 2]):
            self.fails("each triangle once", *self.notch(steps, certificate(self.a, order)))
        self.fails("bytes follow", *self.notch(steps, self.ca + b"\0"))
        self.fails("bytes follow", *self.notch(steps, certificate(self.a, [0, 1, 1])))
        self.fails("ends too early", *self.notch(steps, self.ca[:-1]))
        self.fails("ends too early", *self.notch(steps, certificate(self.a, [0])))
        self.fails("another kind", *self.notch(steps, b"x" + self.ca[1:]))

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
            self.fails("is not given", (data, *files[1:]), good, verdict="unverifiable")

    def test_meshes_are_found_by_digest(self):
        (a, ca, b, cb), good = self.notch(b"\0" + leaf(X) + leaf(Y))
        self.holds((b, cb, a, ca), good)
        self.holds((FLAT, FLAT_TREE, b, cb, a, ca, b, cb), good)
        self.holds((b, cb, FLAT, b"nothing", a, ca), good)   # not asked for
        self.fails("is not given", (a, ca), good, verdict="unverifiable")
        self.fails("another mesh", (a, cb, b, ca), good)
        # Swapped in the proof: then A is the small triangle, which has no halves.
        links, digests = HEADER - 8 - 16 - 72, [hashlib.sha256(m).digest() for m in (a, b)]
        self.assertEqual(good[links:links + 32] + good[links + 36:links + 68], b"".join(digests))
        swapped = good.replace(digests[0], b"?" * 32).replace(digests[1], digests[0]).replace(b"?" * 32, digests[1])
        self.fails("", (a, ca, b, cb), swapped)
        # Really swapped, the axes point the other way.
        self.holds((a, ca, b, cb), two(b, a, *self.rest, b"\1" + leaf(minus(X)) + leaf(minus(Y)), margin=0.24))

    def test_missing_files(self):
        path, = self.files(two(FLAT, FLAT, free(), free(p=(0, 0, 1)), leaf(Z)))
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            self.assertEqual(so.main([path + "x", path, "--mesh", path + "y", path]), 1)
        self.assertEqual([line.split(": ")[1] for line in out.getvalue().splitlines()], ["unverifiable"] * 2)


class Contact(Case):
    def setUp(self):
        # B comes down at 1 per second from 1 above. They are 0.02 apart at 0.98.
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
            self.fails("does not prove", *self.flat((0.9901, 0.0101, w, w)))   # within the margin before
            self.fails("does not prove", *self.flat((1.0, 0.0101, w, w)))
            self.fails("negative", *self.flat((-0.5, 10.0, w, w)))
            self.fails("too far apart", *self.flat((0.98, -0.0101, w, w)))
            self.fails("file ends", *self.flat((0.98, 0.0101, w, w), steps=b""))
            self.fails("bytes follow", *self.flat((0.98, 0.0101, w, w), steps=leaf(Z) + b"\0"))

    def test_within_is_not_strict(self):
        # So as not to round, nothing moves: 0.5 is within 0.25 + 0.25, and not within the next number below.
        self.links = free(), free(p=(0, 0, 0.5))
        def make(tolerance): return self.flat((1.0, tolerance, self.middle, self.middle), margin=0.25)
        self.holds(*make(0.25))
        self.fails("too far", *make(math.nextafter(0.25, 0)))

    def test_radii(self):
        for radii in ((0.004, 0.004), (0.008, 0.0)):
            a, b = (thick(FLAT, r) for r in radii)
            files = a, certificate(a), b, certificate(b)
            def make(tolerance):
                contact = 0.98, tolerance, self.corner, self.corner
                return two(a, b, *self.links, leaf(Z), 0.002, contact, duration=0.98)
            self.holds(files, make(0.0101))
            self.fails("too far apart", files, make(0.0099))

    def test_radius_of_a_point(self):
        # It has the same weights as the point: here 1/2, 1/8 and 3/8 of radii 0.25, 1 and 0.5, in all 0.4375.
        a = thick(FLAT, 0.25, 1.0, 0.5)
        files, weights = (a, certificate(a), FLAT, FLAT_TREE), (WHOLE >> 1, WHOLE >> 3)
        def make(tolerance, swap, more=0):
            bodies, p = ((FLAT, a), (0, 0, 1.5)) if swap else ((a, FLAT), (0, 0, 1.5))
            w = 0, (weights[0] - more, weights[1] + more)
            return two(*bodies, free(), free(p), leaf(Z), 0.25, (0.5, tolerance, w, w))
        for swap in (False, True):
            self.holds(files, make(1.5 - 0.25 - 0.4375, swap), make(1.5 - 0.25 - 0.4375 - 0.09, swap, WHOLE >> 3))
            self.fails("too far apart", files, make(math.nextafter(1.5 - 0.25 - 0.4375, 0), swap),
                       make(1.5 - 0.25 - 0.4375 - 0.1, swap, WHOLE >> 3))

    def test_time(self):
        # The closest approach of all of 0.98 is at its end; before it the tolerance has to be larger.
        w = self.corner
        for tau, tolerance in ((0.0, 0.9901), (0.5, 0.4901), (0.98, 0.0101)):
            self.holds(*self.flat((tau, tolerance, w, w), duration=0.98))
            self.fails("too far apart", *self.flat((tau, tolerance - 0.0002, w, w), duration=0.98))
        for tau in (math.nextafter(0.98, 1), 0.99, 100.0, -5e-324, -1.0):
            self.fails("not from 0", *self.flat((tau, 2000.0, w, w), duration=0.98))
        # The time of a witness is not rounded: T is 0.5 ticks, and after 0.5 is not from 0 to T.
        self.links = free(), free(p=(0, 0, 1), v=(0, 0, -0.5))
        self.holds(*self.flat((0.5, 0.7401, w, w), duration=0.5, units=TICKS))
        self.fails("not from 0", *self.flat((0.75, 0.7401, w, w), duration=0.5, units=TICKS))

    def test_a_clearance(self):
        # B goes down and comes up again on an arm, with its lowest point at half of the time.
        b = points((0, 0, -1))
        links = free(), free(p=(0, 0, 2), q=(math.sin(-0.25), 0, 0, math.cos(-0.25)), w=(1, 0, 0))
        files = FLAT, FLAT_TREE, b, certificate(b)
        def make(tau, tolerance, margin=0.99):
            contact = tau, tolerance, self.corner, self.corner
            return two(FLAT, b, *links, halves(3, lambda _: leaf(Z)), margin, contact)
        self.holds(files, make(0.5, 0.0101))
        self.fails("too far apart", files, make(0.3, 0.0101), make(0.5, 0.0099), make(0.0, 0.0101), make(1.0, 0.0101))
        self.fails("does not prove", files, make(0.5, 0.0101, 1.0001))

    def test_witnesses(self):
        self.fails("too far apart", *self.flat((0.98, 0.0101, self.corner, self.middle)))
        for bad in ((WHOLE, 1), (WHOLE - 1, 2), (2 * WHOLE - 1, 2 * WHOLE - 1)):
            self.fails("more than one", *self.flat((0.98, 0.0101, (0, bad), (0, bad))))
        self.fails("no such triangle", *self.flat((0.98, 0.0101, (1, self.corner[1]), self.corner)))

    def test_place_is_in_the_order_of_the_tree(self):
        low = mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, -1), (1, 0, -1), (0, 1, -1)], [(0, 1, 2), (3, 4, 5)])
        for order, place in (([0, 1], 0), ([1, 0], 1)):
            files = low, certificate(low, order), FLAT, FLAT_TREE
            def make(at): return two(low, FLAT, *self.links, leaf(Z), 0.01,
                                     (0.98, 0.0101, (at, self.corner[1]), self.corner), duration=0.98)
            self.holds(files, make(place))
            self.fails("too far apart", files, make(1 - place))

    def test_turning(self):
        # The tip of a rod turns about z by 1 radian and comes to 0.01 below the plate y = sin 1 + 0.01.
        a, y = rod(), math.sin(1.0) + 0.01
        b = mesh([(-9, 0, -9), (9, 0, -9), (0, 0, 9)], [(0, 1, 2)])
        files = a, certificate(a), b, certificate(b)
        # The point x = cos 1, z = 0 of the plate: half of the third corner, the rest of the other two.
        wx = round((0.25 + math.cos(1.0) / 18) * WHOLE)
        wb = 0, (WHOLE // 2 - wx, wx, WHOLE // 2)
        wa = 0, (0, WHOLE, 0)
        kinds = lambda w: free(w=(0, 0, w)), lambda w: turns((0, 0, w), beta=1.0)
        for frame, kind in itertools.product((0, 2), kinds):
            def make(time=1.0, steps=halves(4, lambda _: leaf(Y, frame)), tolerance=0.006, wa=wa, w=1.0):
                return two(a, b, kind(w), free(p=(0, y, 0)), steps, 0.005, (time, tolerance, wa, wb), duration=time)
            self.holds(files, make())
            self.fails("too far apart", files, make(tolerance=0.004), make(time=0.9), make(w=-1.0),
                       make(wa=(0, (WHOLE >> 1, WHOLE >> 1, 0))))
            self.fails("does not prove", files, make(time=1.02, tolerance=0.02),
                       make(steps=halves(1, lambda _: leaf(Y))))
            self.fails("file ends", files, make(steps=halves(4, lambda _: leaf(Y))[:-7]))

    def test_chains(self):
        # Random trees of links: the witnesses are points whose distance is known by binary64.
        rng, a, b = random.Random(4), points((1, 0, 2, 0.25), (5, 5, 5)), points((0, -1, 1, 0.5))
        files = a, certificate(a, [1, 0]), b, certificate(b)
        for _ in range(25):
            links, corner, tau = random_links(rng, 5), (WHOLE, 0, 0), rng.random()
            ends = rng.randint(0, 5), rng.randint(0, 5)
            far = flength(fsub(where(links, ends[0], (1, 0, 2), tau), where(links, ends[1], (0, -1, 1), tau)))
            def make(tolerance):
                return proof(links, [(a, ends[0]), (b, ends[1])], [(0, 1, 0.125)], leaf(Z), 1.0,
                             (0, tau, tolerance - 0.875, (1, corner), (0, corner)))
            self.assertIn(["too far apart"], [[c for c in ("too far apart",) if c in reason]
                                              for _, reason in self.run_files(files, make(far - 1e-9))])
            for _, reason in self.run_files(files, make(far + 1e-9)):
                self.assertNotIn("too far apart", reason)


class Arithmetic(Case):
    """Against samples in binary64."""
    def near(self, interval, x, slack=1e-12):
        lo, hi = (Fraction(i, so.ONE) for i in interval)
        self.assertTrue(lo <= hi and lo - Fraction(slack) <= Fraction(x) <= hi + Fraction(slack), (lo, x, hi))
        self.assertLess(hi - lo, Fraction(slack))

    def test_series(self):
        for x in (0.0, 1e-200, 1e-9, 0.1, 1.0, 3.14159, 20.0, 100.0, 500.0, 1000.0):
            q = Fraction(x) ** 2
            self.near(so.series(q, 1), math.sin(x) / x if x else 1.0)
            self.near(so.series(q, 2), 2 * (math.sin(x / 2) / x) ** 2 if x else 0.5)
        # sin^2 + cos^2 = 1, far closer than binary64 can say.
        q = Fraction(37)
        s, c = so.series(q, 1), so.series(q, 2)
        square = so.add(so.mul(so.fix(q), so.mul(s, s)),
                        so.mul(*[so.sub(so.fix(Fraction(1)), so.mul(c, so.fix(q)))] * 2))
        self.assertTrue(square[0] <= so.ONE <= square[1] and square[1] - square[0] < 1 << 16)

    def test_intervals(self):
        rng = random.Random(1)
        def some():
            a, b = (Fraction(rng.randint(-1000, 1000), rng.randint(1, 999)) for _ in range(2))
            return min(a, b), max(a, b)
        for _ in range(300):
            (a, b), (c, d) = some(), some()
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
    ORDER = 5, 0, 1, 2, 3, 4

    def scene(self, rng, speed=1.0, size=0.5, count=5):
        """Random links and two random bodies on them, as the checker holds them; and the links and meshes."""
        def vec(s): return tuple(rng.uniform(-s, s) for _ in range(3))
        links, bodies, files = random_links(rng, count, speed), [], []
        exact, ends = self.exact_links(links), [rng.randint(0, count) for _ in range(2)]
        for end in ends:
            shift = vec(2)
            radii = [rng.choice((0.0, 0.0625, rng.uniform(0, 0.25))) * 2 * size for _ in range(9)]
            data = mesh([(*fadd(vec(size), shift), r) for r in radii],
                        [tuple(rng.sample(range(9), 3)) for _ in range(6)])
            tree = so.Tree(*self.files(data, certificate(data, self.ORDER)))
            bodies.append(so.Body(tree, exact[end], 0))
            files.append(data)
        return links, exact, ends, bodies, files

    def corners(self, body, data, part):
        """Of a part, in the frame of the link, with radii."""
        vertices = struct.unpack_from("<36d", data, 8)
        triangles = [struct.unpack_from("<3I", data, 8 + 36 * 8 + 12 * t) for t in self.ORDER]
        return [vertices[4 * i:4 * i + 4] for triangle in triangles[slice(*part)] for i in triangle]

    def axis(self, rng, links, ends, corners, t):
        """Roughly from A to B, in 2^-50."""
        a, b = ([where(links, end, y[:3], t) for y in c] for end, c in zip(ends, corners))
        n = fsub(fscale(1 / len(b), fadd(*b)), fscale(1 / len(a), fadd(*a)))
        n = fadd(fscale(1 / (flength(n) or 1), n), [rng.gauss(0, 0.2) for _ in range(3)])
        return [math.trunc(c / flength(n) * 0.999999 * (1 << 50)) for c in n]

    def readme(self, links, end, corners, side, n, d, frame, t0, t1):
        """The least height of the README, by its words: the velocities are those in the world."""
        t, h = (t0 + t1) / 2, (t1 - t0) / 2
        def chain(i): return chain(links[i - 1][0]) + [i] if i else [0]
        def at(i): return where(links, i, centre(links, i), t)
        def joint(i):   # its turn, and the rate of its arm, in the world
            parent, kind, _, q, rest = links[i - 1]
            if kind == 0:
                return [fscale(h, direction(links, parent, v, t)) for v in (rest[1], rest[0])]
            along = fscale(rest[1][1] * h, direction(links, parent, rotate(q, rest[0]), t))
            return (along, [0, 0, 0]) if kind == 1 else ([0, 0, 0], along)
        def turn(i): return fadd([0, 0, 0], *[joint(j)[0] for j in chain(i)[1:]])
        def velocity(i):
            if i == 0:
                return [0, 0, 0]
            parent = links[i - 1][0]
            return fadd(velocity(parent), fcross(turn(parent), fsub(at(i), at(parent))), joint(i)[1])
        here, there = chain(frame), chain(end)
        common = sum(i == j for i, j in zip(here, there))
        way = [(-1, i) for i in reversed(here[common:])] + [(1, i) for i in there[common:]]
        k, omega, w, rho, arm, m = 0, [0, 0, 0], 0, 0, [0, 0, 0], [0, 0, 0]
        for sign, i in way:
            turned, rate = (fscale(sign, v) for v in joint(i))
            more = fscale(sign, fsub(at(i), at(links[i - 1][0])))
            if sign > 0:                # what is before the joint carries the arm
                arm, m = fadd(arm, more), fadd(m, rate)
            if any(turned):
                k += (w + rho ** 2) * (flength(arm) + flength(m)) + 2 * rho * flength(m)
                w += flength(fcross(omega, turned)) + w * flength(turned)
                omega, arm, m = fadd(omega, turned), [0, 0, 0], [0, 0, 0]
                rho = flength(omega) + w
            if sign < 0:                # what is behind it does
                arm, m = fadd(arm, more), fadd(m, rate)
        k += (w + rho ** 2) * (flength(arm) + flength(m)) + 2 * rho * flength(m)
        p = fsub(at(end), at(frame))
        slope = fsub(fsub(velocity(end), velocity(frame)), fcross(turn(frame), p))
        z = [(fsub(where(links, end, y, t), at(end)), ball) for *y, ball in corners]
        tilt = fcross(n, fsub(turn(end), turn(frame)))
        k += (w + rho ** 2) * max(flength(y) for y, _ in z)
        return min(side * (fdot(n, p) + s * fdot(n, slope) - d) - k / 2
                   + min(side * fdot(fadd(n, fscale(s, tilt)), y) - ball for y, ball in z) for s in (1, -1))

    def test_bound_is_below_samples_and_close(self):
        rng, close = random.Random(7), 0
        for trial in range(120):
            links, exact, ends, bodies, files = self.scene(rng)
            frame = (0, *ends)[trial % 3]
            parts = [rng.choice([(0, 6), (0, 3), (3, 6), (1, 3), (4, 6), (0, 1), (2, 3), (5, 6)]) for _ in range(2)]
            corners = [self.corners(b, data, p) for b, data, p in zip(bodies, files, parts)]
            k = rng.randrange(9)
            i = rng.randrange(1 << k)
            t0, t1 = i << 60 - k, i + 1 << 60 - k
            axis, d = self.axis(rng, links, ends, corners, (t0 + t1) / 2 ** 61), rng.uniform(-3, 3)
            n, span = [c / (1 << 50) for c in axis], (t0 / 2 ** 60, t1 / 2 ** 60)
            for body, end, c, part, side in zip(bodies, ends, corners, parts, (-1, 1)):
                plane = [(side * x << so.F - 50,) * 2 for x in axis], int(side * d * so.ONE)
                proven = so.leaf(body, part, t0, t1, exact[frame], *plane) / so.ONE
                least = least_height(links, end, c, side, n, d, frame, *span, 16)
                self.assertLessEqual(proven, least + 1e-9)
                self.assertAlmostEqual(proven, self.readme(links, end, c, side, n, d, frame, *span), 9)
                if k == 8:
                    self.assertLess(least - proven, 0.01)
                    close += 1
        self.assertGreater(close, 10)

    def test_random_proofs(self):
        """Random splits and leaves, and a margin near what samples allow: none is accepted that they refute."""
        rng, counts = random.Random(21), {}
        for trial in range(40):
            links, exact, ends, bodies, files = self.scene(rng, speed=0.5, size=0.25, count=4)
            if ends[0] == ends[1] == 0:
                continue
            depth, found = rng.randrange(3), []
            def steps(parts, t0, t1, left):
                kind = rng.randrange(3) if left else 3
                if kind < 2 and parts[kind][1] - parts[kind][0] > 1:
                    out = bytes([kind])
                    for p in so.halves(parts[kind]):
                        out += steps([p, parts[1]] if kind == 0 else [parts[0], p], t0, t1, left - 1)
                    return out
                if kind == 2:
                    part = rng.randrange(16384, 49152)
                    middle = t0 + ((t1 - t0) * part >> 16)
                    both = steps(parts, t0, middle, left - 1), steps(parts, middle, t1, left - 1)
                    return split_time(*both, part)
                corners = [self.corners(b, data, p) for b, data, p in zip(bodies, files, parts)]
                span, frame = (t0 / 2 ** 60, t1 / 2 ** 60), rng.randrange(3)
                axis = self.axis(rng, links, ends, corners, sum(span) / 2)
                n, link = [c / (1 << 50) for c in axis], (0, *ends)[frame]
                def least(d): return [least_height(links, end, c, side, n, d, link, *span, 12)
                                      for end, c, side in zip(ends, corners, (-1, 1))]
                below, above = least(0.0)
                d = round((above - below) / 2 * 2 ** 40) + rng.choice((0, rng.randrange(-1 << 30, 1 << 30)))
                found.append(2 * min(least(d / 2 ** 40)))
                return fine_leaf(axis, frame, d)
            made = steps([(0, 6), (0, 6)], 0, 1 << 60, depth + 1)
            least = min(found)
            meshes = [x for data in files for x in (data, certificate(data, self.ORDER))]
            for margin in (least + 1e-9, least - 1e-4, least - 0.05, least - 0.5):
                if margin >= 0:
                    whole = proof(links, list(zip(files, ends)), [(0, 1, margin)], made, units=(-40, 0))
                    (verdict, reason), = self.run_files(meshes, whole)
                    key = margin > least, verdict
                    counts[key] = counts.get(key, 0) + 1
                    self.assertTrue(verdict == "holds" or "does not prove" in reason, reason)
        self.assertNotIn((True, "holds"), counts)
        self.assertGreater(counts[True, "broken"], 10)
        self.assertGreater(counts[False, "holds"], 10)
        self.assertGreater(counts[False, "broken"], 10)

    def test_lowest(self):
        rng = random.Random(3)
        for _ in range(20):
            _, _, _, bodies, files = self.scene(rng)
            for part in ((0, 6), (0, 3), (3, 6), (1, 3), (4, 6), (0, 1), (5, 6)):
                m = [rng.randint(-9, 9) << so.F - 3 for _ in range(3)]
                centre = bodies[0].link.centre
                want = min(sum(Fraction(c, so.ONE) * (Fraction(y) - z) for c, y, z in zip(m, corner, centre))
                           - Fraction(corner[3]) for corner in self.corners(bodies[0], files[0], part))
                self.assertEqual(Fraction(bodies[0].lowest(part, *m), 1 << so.F + bodies[0].bits), want)


class Damage(Case):
    def test_single_bits(self):
        """No damage raises anything; damage before the motions or in the steps' kinds is seen."""
        a = mesh([(0, -1, 0, 0.125), (0, 1, 0, 0.0625), (0.125, 0, 0)], [(0, 1, 2)])
        files = a, certificate(a), FLAT, FLAT_TREE
        links = [slides((0, 1, 0), 0.5, 0.125), turns((1, 0, 0), 0.25, 4.0, p=(0, -0.5, 0), on=1), free(p=(0, 0, 3))]
        corner = 0, (WHOLE >> 2, WHOLE >> 3)
        good = proof(links, [(a, 2), (FLAT, 3)], [(0, 1, 0.875)], halves(3, lambda _: leaf(Z)),
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
        cert = files[1]
        for i in range(0, len(cert)):
            for bit in (0, 7):
                broken = cert[:i] + bytes([cert[i] ^ 1 << bit]) + cert[i + 1:]
                (verdict, reason), = self.run_files((a, broken, *files[2:]), good)
                self.assertEqual(verdict, "holds" if i >= 46 else "broken", (i, reason))   # 46: axes, not used


if __name__ == "__main__":
    unittest.main()
