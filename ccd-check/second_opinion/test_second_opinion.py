#!/usr/bin/env python3
"""Tests of second_opinion.py. Meshes, certificates and proofs are built here by hand, from the README.

Binary64 is used only to make inputs and to sample motions; what is tested decides without it.
"""
import contextlib, hashlib, io, math, os, random, struct, tempfile, unittest
from fractions import Fraction
import second_opinion as so

X, Y, Z = (16384, 0, 0), (0, 16384, 0), (0, 0, 16384)


def minus(axis): return tuple(-c for c in axis)


def mesh(vertices, triangles):
    return (struct.pack("<II", len(vertices), len(triangles))
            + b"".join(struct.pack("<3d", *v) for v in vertices)
            + b"".join(struct.pack("<3I", *t) for t in triangles))


def certificate(mesh_bytes, tree, axes=X + Y + Z, order=None):
    """tree = (own triangles, children); the own triangles stand before those of the children."""
    numbers, nodes = [], []

    def walk(node):
        own, children = node
        numbers.extend(own)
        nodes.append(struct.pack("<BB9h", len(children), len(own), *axes))
        for child in children:
            walk(child)

    walk(tree)
    numbers = order or numbers
    return (b"CCDBODY1" + hashlib.sha256(mesh_bytes).digest()
            + struct.pack(f"<{len(numbers)}I", *numbers) + b"".join(nodes))


def motion(p=(0, 0, 0), q=(0, 0, 0, 1), v=(0, 0, 0), w=(0, 0, 0), c=(0, 0, 0)):
    return [float(x) for x in (*p, *q, *v, *w, *c)]


def leaf(axis, frame=0): return struct.pack("<B3h", 3 + frame, *axis)
def fine_leaf(axis, frame=0): return struct.pack("<B3i", 6 + frame, *axis)
def split_time(first, second, part=32768): return struct.pack("<BH", 2, part) + first + second


def halves(depth, make, t0=0.0, t1=1.0):
    """The time split 2^depth times into equal parts; make(middle) is the leaf of a part."""
    if depth == 0:
        return make((t0 + t1) / 2)
    m = (t0 + t1) / 2
    return split_time(halves(depth - 1, make, t0, m), halves(depth - 1, make, m, t1))


def proof(a, b, ma, mb, steps, duration=1.0, margin=0.0, contact=None, units=(-40, -60)):
    """contact = (time, tolerance, (place, weights) of A, of B), weights in 2^-31, of which two are written."""
    duration = contact[0] if contact else duration
    out = b"CCDPROOF" + struct.pack("<ii", *units)
    out += hashlib.sha256(a).digest() + hashlib.sha256(b).digest()
    out += struct.pack("<16d", *ma) + struct.pack("<16d", *mb) + struct.pack("<2d", duration, margin)
    if contact is None:
        return out + b"\0" + steps
    _, tolerance, *witnesses = contact
    out += b"\1" + struct.pack("<d", tolerance)
    for place, weights in witnesses:
        out += struct.pack("<3I", place, *weights[:2])
    return out + steps


WHOLE = 1 << 31
FLAT = mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
FLAT_TREE = certificate(FLAT, ([0], []))


def rod(x0=0.0, x1=1.0): return mesh([(x0, 0, 0), (x1, 0, 0), (x0, -0.125, 0)], [(0, 1, 2)])


class Case(unittest.TestCase):
    def run_files(self, a, ca, b, cb, *proofs):
        """The verdicts and reasons the command prints."""
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for i, data in enumerate((a, ca, b, cb, *proofs)):
                paths.append(os.path.join(folder, str(i)))
                with open(paths[-1], "wb") as f:
                    f.write(data)
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                status = so.main(["--a", *paths[:2], "--b", *paths[2:4], *paths[4:]])
        lines = [line.split(": ", 2)[1:] for line in out.getvalue().splitlines()]
        self.assertEqual(len(lines), len(proofs))
        self.assertEqual(status, 0 if all(v == "holds" for v, _ in lines) else 1)
        return lines

    def holds(self, *files):
        for line in self.run_files(*files):
            self.assertEqual(line[0], "holds", line)

    def fails(self, reason, *files, verdict="broken"):
        for line in self.run_files(*files):
            self.assertEqual(line[0], verdict, line)
            self.assertIn(reason, line[1])


class Free(Case):
    def setUp(self):
        self.above = motion(p=(0, 0, 1))

    def flat(self, steps, ma=motion(), mb=motion(p=(0, 0, 1)), **more):
        return FLAT, FLAT_TREE, FLAT, FLAT_TREE, proof(FLAT, FLAT, ma, mb, steps, **more)

    def test_at_rest(self):
        for frame in range(3):
            self.holds(*self.flat(leaf(Z, frame), margin=0.99))
            self.holds(*self.flat(fine_leaf((0, 0, 1 << 30), frame), margin=0.99))

    def test_margin_is_strict(self):
        self.fails("does not prove", *self.flat(leaf(Z), margin=1.0))
        self.holds(*self.flat(leaf(Z), margin=math.nextafter(1.0, 0)))

    def test_no_duration(self):
        self.holds(*self.flat(leaf(Z), duration=0.0))
        self.fails("time is empty", *self.flat(split_time(leaf(Z), leaf(Z), 0)))

    def test_moves(self):
        mb = motion(p=(0, 0, 1), v=(5, 0, -0.75))
        self.holds(*self.flat(leaf(Z), mb=mb, margin=0.24))
        self.holds(*self.flat(split_time(leaf(Z), leaf(Z), 1234), mb=mb, margin=0.24))
        self.fails("does not prove", *self.flat(leaf(Z), mb=mb, margin=0.26))
        self.fails("does not prove", *self.flat(split_time(leaf(Z), leaf(Z)), mb=mb, margin=0.26))
        self.fails("does not prove", *self.flat(leaf(Z), mb=mb, duration=1.5))

    def test_part_of_time(self):
        # B goes down beside A: it is above until 0.25, and beside from 0.125 on.
        mb = motion(p=(0, 0, 0.5), v=(8, 0, -2))
        self.holds(*self.flat(split_time(leaf(Z), leaf(X), 12288), mb=mb, margin=0.1))
        for part in (32768, 65536 - 12288, 8192, 16384):
            self.fails("does not prove", *self.flat(split_time(leaf(Z), leaf(X), part), mb=mb, margin=0.1))
        self.fails("does not prove", *self.flat(split_time(leaf(X), leaf(Z), 12288), mb=mb, margin=0.1))

    def test_axis(self):
        self.fails("does not prove", *self.flat(leaf(minus(Z))))
        self.fails("does not prove", *self.flat(leaf((0, 0, 0))))
        self.fails("does not prove", *self.flat(leaf(Y)))
        self.fails("longer than 1", *self.flat(leaf((0, 0, 16385))))
        self.fails("longer than 1", *self.flat(leaf((181, 0, 16384))))
        self.fails("longer than 1", *self.flat(fine_leaf((1, 0, 1 << 30))))
        self.fails("longer than 1", *self.flat(fine_leaf((0, 0, -1 << 31))))
        # A bent axis shows a shorter gap: here 0.8 less 0.6 of the extent along x.
        bent = (9830, 0, 13107)
        self.holds(*self.flat(leaf(bent), margin=0.19))
        self.fails("does not prove", *self.flat(leaf(bent), margin=0.21))

    def test_file(self):
        files = self.flat(leaf(Z))
        good = files[-1]
        self.holds(*files)
        self.fails("file ends", *files[:-1], *[good[:n] for n in range(8, len(good), 7)])
        self.fails("bytes follow", *files[:-1], good + b"\0", good + leaf(Z))
        self.fails("another kind", *files[:-1], b"", b"CCDPROOG" + good[8:])
        self.fails("no such step", *self.flat(b"\x09"))
        self.fails("no such claim", *files[:-1], good[:352] + b"\2" + good[353:])
        self.fails("can not be split", *self.flat(b"\0\0" + leaf(Z)))
        self.holds(*self.flat(b"\0\1" + leaf(Z)))   # a node of one triangle gives that triangle
        self.fails("negative", *self.flat(leaf(Z), margin=-0.5))
        self.fails("negative", *self.flat(leaf(Z), duration=-1.0))

    def test_numbers(self):
        for bad in (math.nan, math.inf, -math.inf):
            self.fails("byte 216", *self.flat(leaf(Z), mb=motion(p=(0, bad, 1))), verdict="unverifiable")
        spin = motion(p=(0, 0, 1), w=(0, 0, 1000))
        self.fails("turns too far", *self.flat(leaf(Z), mb=spin), verdict="unverifiable")
        spin = motion(p=(0, 0, 1), w=(0, 0, 250))
        self.fails("does not prove", *self.flat(leaf(Z), mb=spin))   # true, but this is too long a stretch
        self.holds(*self.flat(halves(8, lambda _: leaf(Z)), mb=spin))
        self.fails("1 long", *self.flat(leaf(Z), mb=motion(p=(0, 0, 1), q=(0, 0, 0, 0))))
        self.fails("1 long", *self.flat(leaf(Z), mb=motion(p=(0, 0, 1), q=(0, 0, 0, 1.01))))
        # Very large and very small numbers are exact too.
        far = motion(p=(0, 0, 1e300))
        self.holds(*self.flat(leaf(Z), mb=far, margin=9.9e299))
        tiny = mesh([(0, 0, 5e-324), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        tree = certificate(tiny, ([0], []))
        self.holds(tiny, tree, FLAT, FLAT_TREE, proof(tiny, FLAT, motion(), self.above, leaf(Z), margin=0.5))

    def test_quaternion(self):
        # A quarter turn about x takes y to z, so that the triangle stands up to z = 1.
        q = (math.sqrt(0.5), 0, 0, math.sqrt(0.5))
        up = motion(q=q)
        above = motion(p=(0, 0, 1.25))
        self.holds(*self.flat(leaf(Z), ma=up, mb=above, margin=0.2499))
        self.fails("does not prove", *self.flat(leaf(Z), ma=up, mb=above, margin=0.2501))
        # With its centre at y = 1 that corner stays at p + R0 c.
        turned = motion(q=q, c=(0, 1, 0))
        self.holds(*self.flat(leaf(Z), ma=turned, mb=above, margin=0.2499))


    def test_quaternion_not_quite_1_long(self):
        # A is turned by half a turn about z, so that its corner is at x = -1, however long the quaternion is.
        e = 2.0 ** -22
        least = 1
        for z in (1 + e, 1 - e):
            def make(margin): return self.flat(leaf(minus(X)), motion(q=(0, 0, z, 0)), motion(p=(-3, 0, 0)), margin=margin)
            self.holds(*make(least - e / 8))
            self.fails("does not prove", *make(least + e / 8))


class Turning(Case):
    def setUp(self):
        # Two plates that turn together about the origin: x = 0 and x = 1 of the same frame.
        self.a = mesh([(0, -3, -3), (0, 3, -3), (0, 0, 3)], [(0, 1, 2)])
        self.b = mesh([(1, -3, -3), (1, 3, -3), (1, 0, 3)], [(0, 1, 2)])
        self.ca, self.cb = certificate(self.a, ([0], [])), certificate(self.b, ([0], []))
        self.m = motion(w=(0, 0, 1.5))

    def plates(self, steps, **more):
        return self.a, self.ca, self.b, self.cb, proof(self.a, self.b, self.m, self.m, steps, **more)

    def test_axis_turns_with_a_body(self):
        axis = tuple(math.trunc(c * 16384) for c in (math.cos(0.75), math.sin(0.75), 0))
        self.holds(*self.plates(leaf(axis, 1), margin=0.99))
        self.holds(*self.plates(leaf(axis, 2), margin=0.99))
        self.fails("does not prove", *self.plates(leaf(axis, 0)))
        self.fails("does not prove", *self.plates(leaf(X, 1)))

    def test_axis_is_in_world_coordinates_at_the_middle(self):
        def at(middle): return leaf(tuple(math.trunc(c * 16384) for c in (math.cos(1.5 * middle), math.sin(1.5 * middle), 0)), 1)
        self.holds(*self.plates(halves(2, at), margin=0.99))
        self.fails("does not prove", *self.plates(halves(2, lambda _: leaf(X, 1)), margin=0.99))

    def test_time_is_split(self):
        # A rod of length 1 turns in the y-z plane by 4 radians; B is 3 above.
        a = mesh([(0, -1, 0), (0, 1, 0), (0.125, 0, 0)], [(0, 1, 2)])
        files = a, certificate(a, ([0], [])), FLAT, FLAT_TREE
        def make(steps): return proof(a, FLAT, motion(w=(4, 0, 0)), motion(p=(0, 0, 3)), steps, margin=1.0)
        self.fails("does not prove", *files, make(leaf(Z)))
        good = make(halves(3, lambda _: leaf(Z)))
        self.holds(*files, good)
        self.fails("does not prove", *files, make(halves(3, lambda t: leaf(Z) if t < 0.9 else leaf(Y))))
        self.fails("file ends", *files, good[:-7])                        # the last leaf is dropped
        self.fails("file ends", *files, good[:353 + 9] + good[353 + 9 + 7:])  # the first one is dropped
        # Without the last splits, and a leaf of each, the stretches are longer; that is a proof still.
        self.holds(*files, good[:353 + 6] + good[353 + 9 + 7:], make(halves(2, lambda _: leaf(Z))))


class SecondOrder(Case):
    """What the lemma takes off, one term at a time: a margin a little below is proven, one a little above is not.

    The stretch is 0.2 long and bodies turn by 1 about z; most meshes are single points."""
    def bound(self, want, ma, mb, frame, za=(0, 0, 0), zb=(0, 0, 0)):
        a, b = mesh([za], [(0, 0, 0)]), mesh([zb], [(0, 0, 0)])
        files = a, certificate(a, ([0], [])), b, certificate(b, ([0], []))
        def make(margin): return proof(a, b, ma, mb, fine_leaf((1 << 30, 0, 0), frame), 0.2, margin)
        self.holds(*files, make(want - 1e-6))
        self.fails("does not prove", *files, make(want + 1e-6))

    def test_terms(self):
        spin = motion(w=(0, 0, 1))
        self.bound(1 - 0.005, spin, motion(p=(1, 0, 0)), 1)                        # |phi|^2 |P|
        far = math.hypot(1, 0.1)
        self.bound(1 - 0.005 * (far + 2), spin, motion(p=(1, 0.1, 0), v=(0, -1, 0)), 1)   # 2 |phi| |D|
        self.bound(1 - 0.005, spin, motion(), 1, zb=(1, 0, 0))                     # |delta| |phi| r
        back = motion(q=(0, 0, -math.sin(0.05), math.cos(0.05)), w=(0, 0, 1))      # straight at the middle
        self.bound(1 - 0.005, motion(), back, 0, zb=(1, 0, 0))                     # |delta| |omega| r of B
        self.bound(1 - 0.005, back, motion(), 0, za=(-1, 0, 0))                    # and of A
        self.bound(1, back, back, 2, za=(0, 1, 0), zb=(1, 1, 0))                   # all turns together


class Nodes(Case):
    def setUp(self):
        # A is a notch: plates x = -1 and y = -1. B is a small triangle in it. No plane parts them.
        self.a = mesh([(-1, -1, -9), (-1, 9, 0), (-1, -1, 9), (9, -1, 0)], [(0, 1, 2), (0, 3, 2)])
        self.b = mesh([(-0.75, -0.75, 0), (-0.5, -0.75, 0), (-0.75, -0.5, 0)], [(0, 1, 2)])
        self.cb = certificate(self.b, ([0], []))
        self.ca = certificate(self.a, ([], [([0], []), ([1], [])]))
        self.rest = motion(), motion()

    def notch(self, steps, ca=None, m=None, **more):
        return self.a, ca or self.ca, self.b, self.cb, proof(self.a, self.b, *(m or self.rest), steps, **more)

    def test_split(self):
        for axis in (X, Y, (11585, 11585, 0), minus(X)):
            self.fails("does not prove", *self.notch(leaf(axis)))
        steps = b"\0" + leaf(X) + leaf(Y)
        self.holds(*self.notch(steps, margin=0.24))
        self.fails("does not prove", *self.notch(b"\0" + leaf(Y) + leaf(X)))
        self.fails("file ends", *self.notch(b"\0" + leaf(X)))
        self.fails("bytes follow", *self.notch(steps + leaf(X)))
        self.holds(*self.notch(b"\0\1" + leaf(X) + split_time(leaf(Y), leaf(Y)), margin=0.24))

    def test_trees(self):
        # Both triangles in one node; in the other order; an own triangle and a child, which no node has.
        steps = b"\0" + leaf(X) + leaf(Y), b"\0" + leaf(Y) + leaf(X)
        self.holds(*self.notch(steps[0], certificate(self.a, ([0, 1], []))))
        self.holds(*self.notch(steps[1], certificate(self.a, ([1, 0], []))))
        mixed = certificate(self.a, ([0], [([1], [])]))
        self.fails("both", *self.notch(steps[1], mixed))
        def deep(levels):
            nodes = struct.pack("<BB9h", 1, 0, *X, *Y, *Z) * (levels - 1)
            end = certificate(self.a, ([0, 1], []))
            return end[:48] + nodes + end[48:]
        self.holds(*self.notch(b"\0" * 63 + steps[0], deep(64)))
        self.fails("levels", *self.notch(b"\0" * 64 + steps[0], deep(65)))

    def test_axes_of_nodes_do_not_matter(self):
        for axes in ((0,) * 9, (-32768,) * 9, X + X + X):
            ca = certificate(self.a, ([], [([0], []), ([1], [])]), axes)
            self.holds(*self.notch(b"\0" + leaf(X) + leaf(Y), ca, margin=0.24))
            self.fails("does not prove", *self.notch(leaf(X), ca))

    def test_bad_certificates(self):
        steps = b"\0" + leaf(X) + leaf(Y)
        two = ([], [([0], []), ([1], [])])
        bad = self.ca[:8] + bytes(32) + self.ca[40:]
        self.fails("another mesh", *self.notch(steps, bad))
        self.fails("each triangle once", *self.notch(steps, certificate(self.a, two, order=[0, 0])),)
        self.fails("each triangle once", *self.notch(steps, certificate(self.a, two, order=[0, 2])))
        # A triangle is left out of the nodes, or is out of all of them.
        self.fails("in no node", *self.notch(leaf(X), certificate(self.a, ([0], []), order=[0, 1])))
        self.fails("more triangles", *self.notch(leaf(X), certificate(self.a, ([0, 1, 1], []), order=[0, 1])))
        self.fails("neither", *self.notch(leaf(X), certificate(self.a, ([], []), order=[0, 1])))
        self.fails("bytes follow", *self.notch(steps, self.ca + b"\0"))
        self.fails("ends too early", *self.notch(steps, self.ca[:-1]))
        self.fails("another kind", *self.notch(steps, b"x" + self.ca[1:]))

    def test_bad_meshes(self):
        files = list(self.notch(b"\0" + leaf(X) + leaf(Y)))
        for data, reason, verdict in (
                (self.a + b"\0", "counts", "broken"), (self.a[:-1], "counts", "broken"),
                (b"", "too early", "broken"), (mesh([(0, 0, 0)], []), "counts", "broken"),
                (mesh([(0, 0, 0)], [(0, 0, 1)]), "no vertex", "broken"),
                (mesh([(0, 0, math.nan)], [(0, 0, 0)]), "byte 24", "unverifiable"),
                (mesh([(0, 0, 0)], [(0, 0, 0)]), "another mesh", "broken")):
            self.fails(reason, data, *files[1:], verdict=verdict)

    def test_swapped(self):
        a, ca, b, cb, good = self.notch(b"\0" + leaf(X) + leaf(Y))
        self.fails("mesh of A", b, cb, a, ca, good)
        self.fails("mesh of A", a, ca, b, cb, good[:16] + good[48:80] + good[16:48] + good[80:])
        self.fails("mesh of B", a, ca, a, ca, good)
        self.fails("another mesh", a, cb, b, ca, good)
        # Really swapped, the axes point the other way.
        swapped = proof(b, a, *self.rest, b"\1" + leaf(minus(X)) + leaf(minus(Y)), margin=0.24)
        self.holds(b, cb, a, ca, swapped)


class Contact(Case):
    def setUp(self):
        # B comes down at 1 per second from 1 above. They are 0.02 apart at 0.98.
        self.m = motion(), motion(p=(0, 0, 1), v=(0, 0, -1))
        self.corner = (0, (WHOLE, 0, 0))
        self.middle = (0, (1 << 29, 1 << 29, 1 << 30))

    def flat(self, contact, steps=leaf(Z), margin=0.01, **more):
        return FLAT, FLAT_TREE, FLAT, FLAT_TREE, proof(FLAT, FLAT, *self.m, steps, margin=margin, contact=contact, **more)

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

    def test_witnesses(self):
        self.fails("too far apart", *self.flat((0.98, 0.0101, self.corner, self.middle)))
        for bad in ((WHOLE, 1), (WHOLE - 1, 2), (2 * WHOLE - 1, 2 * WHOLE - 1)):
            self.fails("more than one", *self.flat((0.98, 0.0101, (0, bad), (0, bad))))
        self.fails("no such triangle", *self.flat((0.98, 0.0101, (1, self.corner[1]), self.corner)))

    def test_place_is_in_the_order_of_the_tree(self):
        low = mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, -1), (1, 0, -1), (0, 1, -1)], [(0, 1, 2), (3, 4, 5)])
        for order, place in (([0, 1], 0), ([1, 0], 1)):
            files = low, certificate(low, (order, [])), FLAT, FLAT_TREE
            def make(at): return proof(low, FLAT, *self.m, leaf(Z), margin=0.01,
                                       contact=(0.98, 0.0101, (at, self.corner[1]), self.corner))
            self.holds(*files, make(place))
            self.fails("too far apart", *files, make(1 - place))

    def test_turning(self):
        # The tip of a rod turns about z by 1 radian and comes to 0.01 below the plate y = sin 1 + 0.01.
        a, y = rod(), math.sin(1.0) + 0.01
        b = mesh([(-9, 0, -9), (9, 0, -9), (0, 0, 9)], [(0, 1, 2)])
        files = a, certificate(a, ([0], [])), b, certificate(b, ([0], []))
        # The point x = cos 1, z = 0 of the plate: half of the third corner, the rest of the other two.
        wx = round((0.25 + math.cos(1.0) / 18) * WHOLE)
        wb = 0, (WHOLE // 2 - wx, wx, WHOLE // 2)
        wa = 0, (0, WHOLE, 0)
        for frame in (0, 2):
            def make(time=1.0, steps=halves(4, lambda _: leaf(Y, frame)), tolerance=0.006, wa=wa, w=1.0, duration=2.0):
                return proof(a, b, motion(w=(0, 0, w)), motion(p=(0, y, 0)), steps, duration, 0.005,
                             (time, tolerance, wa, wb))
            self.holds(*files, make())
            self.fails("too far apart", *files, make(tolerance=0.004), make(time=0.9), make(w=-1.0),
                       make(wa=(0, (1 << 30, 1 << 30, 0))))
            self.fails("does not prove", *files, make(time=1.02, tolerance=0.02), make(steps=halves(1, lambda _: leaf(Y))))
            self.fails("file ends", *files, make(steps=halves(4, lambda _: leaf(Y))[:-7]))


class Inside(unittest.TestCase):
    """The arithmetic, against samples in binary64."""
    def near(self, interval, x, slack=1e-12):
        lo, hi = (Fraction(i, so.ONE) for i in interval)
        self.assertTrue(lo <= hi and lo - Fraction(slack) <= Fraction(x) <= hi + Fraction(slack), (float(lo), x, float(hi)))
        self.assertLess(hi - lo, Fraction(slack))

    def test_series(self):
        for x in (0.0, 1e-200, 1e-9, 0.1, 1.0, 3.14159, 20.0, 100.0, 500.0):
            q = Fraction(x) ** 2
            self.near(so.series(q, 1), math.sin(x) / x if x else 1.0)
            self.near(so.series(q, 2), 2 * (math.sin(x / 2) / x) ** 2 if x else 0.5)
        # sin^2 + cos^2 = 1, far closer than binary64 can say.
        q = Fraction(37)
        s, c = so.series(q, 1), so.series(q, 2)
        square = so.add(so.mul(so.fix(q), so.mul(s, s)),
                        so.mul(*[so.sub(so.fix(1), so.mul(c, so.fix(q)))] * 2))
        self.assertTrue(square[0] <= so.ONE <= square[1] and square[1] - square[0] < 1 << 16)

    def test_intervals(self):
        rng = random.Random(1)
        def some():
            a, b = (Fraction(rng.randint(-1000, 1000), rng.randint(1, 999)) for _ in range(2))
            return min(a, b), max(a, b)
        for _ in range(300):
            (a, b), (c, d) = some(), some()
            u, v = (so.fix(a)[0], so.fix(b)[1]), (so.fix(c)[0], so.fix(d)[1])
            lo, hi = so.mul(u, v)
            for x in (a, b, (a + b) / 2):
                for y in (c, d, (c + d) / 2):
                    self.assertTrue(Fraction(lo, so.ONE) <= x * y <= Fraction(hi, so.ONE))
        for n in list(range(200)) + [10 ** 40, 10 ** 40 + 1]:
            r = so.root_up(n)
            self.assertTrue(r * r >= n and (r == 0 or (r - 1) ** 2 < n))

    def scene(self, rng):
        """Two random bodies in motion: what the checker holds of them, and where points are, in binary64."""
        def vec(s): return tuple(rng.uniform(-s, s) for _ in range(3))
        moving, where = [], []
        for _ in range(2):
            data = mesh([vec(1) for _ in range(9)], [tuple(rng.sample(range(9), 3)) for _ in range(6)])
            cert = certificate(data, ([], [([5], []), ([0, 1], []), ([], [([2], []), ([3, 4], [])])]))
            q = [rng.gauss(0, 1) for _ in range(4)]
            n = math.sqrt(sum(x * x for x in q))
            m = vec(3), tuple(x / n for x in q), vec(1), vec(2), vec(1)
            with tempfile.TemporaryDirectory() as folder:
                paths = os.path.join(folder, "m"), os.path.join(folder, "c")
                for path, d in zip(paths, (data, cert)):
                    with open(path, "wb") as f:
                        f.write(d)
                tree = so.Tree(paths[1], so.Mesh(paths[0]))
            exact = [tuple(Fraction(x) for x in v) for v in m]
            moving.append(so.Moving(so.Body(tree, exact[4]), exact, Fraction(2), 4))
            where.append((m, data, tree))
        return moving, where

    def at(self, m, data, tree, part, t):
        """The corners of a part at time t, in binary64."""
        p, (x, y, z, w), v, omega, c = m
        def rotate(w, v, y):
            a = [2 * (v[1] * y[2] - v[2] * y[1]), 2 * (v[2] * y[0] - v[0] * y[2]), 2 * (v[0] * y[1] - v[1] * y[0])]
            return [y[0] + w * a[0] + v[1] * a[2] - v[2] * a[1], y[1] + w * a[1] + v[2] * a[0] - v[0] * a[2],
                    y[2] + w * a[2] + v[0] * a[1] - v[1] * a[0]]
        angle = math.sqrt(sum(o * o for o in omega)) * t
        f = math.sin(angle / 2) / angle * t if angle else t / 2
        def below(q): return [q] if q < 0 else [r for child in tree.parts[q] for r in below(child)]
        rc, out = rotate(w, (x, y, z), c), []
        for place in below(part):
            for corner in tree.mesh.triangles[tree.order[~place]]:
                u = [Fraction(i, 1 << tree.mesh.bits) for i in tree.mesh.vertices[corner]]
                r = rotate(math.cos(angle / 2), [o * f for o in omega],
                           rotate(w, (x, y, z), [float(i) - j for i, j in zip(u, c)]))
                out.append([p[i] + rc[i] + t * v[i] + r[i] for i in range(3)])
        return out

    def test_bound_is_below_samples_and_close(self):
        rng, close = random.Random(7), 0
        for trial in range(60):
            (a, b), (wa, wb) = self.scene(rng)
            frame = (None, a, b)[trial % 3]
            phi = (0, 0, 0) if frame is None else (wa, wb)[trial % 3 - 1][0][3]
            n = [rng.gauss(0, 1) for _ in range(3)]
            n = [x / math.sqrt(sum(y * y for y in n)) * 0.999 for x in n]
            axis = [math.trunc(x * 2 ** 30) for x in n]
            pa, pb = (rng.choice([-1, -4, 0, 1, 2, 4]) for _ in range(2))
            k = trial % 8
            t0 = rng.randrange(1 << k)
            t0, t1 = t0 * so.ONE >> k, (t0 + 1) * so.ONE >> k
            low, high = -1 << 110, 1 << 110   # the greatest margin that is proven, by bisection
            while high - low > 1 << 40:
                mid = (low + high) // 2
                ok = so.leaf(a, b, mid, pa, pb, t0, t1, [x << 66 for x in axis], frame)
                low, high = (mid, high) if ok else (low, mid)
            proven = low / so.ONE * 16
            least = math.inf
            first, last = 2 * t0 / so.ONE, 2 * t1 / so.ONE
            for i in range(33):
                t = first + (last - first) * i / 32
                s = t - (first + last) / 2
                angle = math.sqrt(sum(o * o for o in phi)) * s
                e = [x / (math.sqrt(sum(o * o for o in phi)) or 1) for x in phi]
                cr = [e[1] * n[2] - e[2] * n[1], e[2] * n[0] - e[0] * n[2], e[0] * n[1] - e[1] * n[0]]
                d = sum(x * y for x, y in zip(e, n))
                ns = [x * math.cos(angle) + c * math.sin(angle) + y * d * (1 - math.cos(angle)) for x, c, y in zip(n, cr, e)]
                ha = max(sum(x * y for x, y in zip(ns, c)) for c in self.at(*wa, pa, t))
                hb = min(sum(x * y for x, y in zip(ns, c)) for c in self.at(*wb, pb, t))
                least = min(least, hb - ha)
            self.assertLessEqual(proven, least + 1e-7)
            if k == 7:
                self.assertLess(least - proven, 0.01)
                close += 1
        self.assertGreater(close, 5)

    def test_lowest(self):
        rng = random.Random(3)
        for _ in range(20):
            (a, _), ((_, _, tree), _) = self.scene(rng)
            for part in (-1, 0, 1, 2, 3, 4):
                m = [rng.randint(-9, 9) for _ in range(3)]
                def below(q): return [q] if q < 0 else [r for child in tree.parts[q] for r in below(child)]
                want = min(sum(x * y for x, y in zip(m, z)) for q in below(part) for z in a.body.corners[~q])
                self.assertEqual(a.body.lowest(part, m), want)


class Damage(Case):
    def test_single_bits(self):
        """No damage raises anything; damage before the motions or in the steps' kinds is seen."""
        a = mesh([(0, -1, 0), (0, 1, 0), (0.125, 0, 0)], [(0, 1, 2)])
        files = a, certificate(a, ([0], [])), FLAT, FLAT_TREE
        good = proof(a, FLAT, motion(w=(4, 0, 0)), motion(p=(0, 0, 3)), halves(3, lambda _: leaf(Z)), margin=1.0)
        rng, bad, places = random.Random(5), [], []
        for _ in range(150):
            i = rng.randrange(len(good))
            bad.append(good[:i] + bytes([good[i] ^ 1 << rng.randrange(8)]) + good[i + 1:])
            places.append(i)
        for i, (verdict, reason) in zip(places, self.run_files(*files, *bad)):
            if i < 8 or 16 <= i < 80:
                self.assertEqual(verdict, "broken", (i, reason))
        lines = self.run_files(*files, *[good[:n] for n in range(0, len(good), 5)])
        self.assertTrue(all(v == "broken" for v, _ in lines))
        cert = files[1]
        for i in range(0, len(cert)):
            for bit in (0, 7):
                broken = cert[:i] + bytes([cert[i] ^ 1 << bit]) + cert[i + 1:]
                (verdict, reason), = self.run_files(a, broken, *files[2:], good)
                self.assertEqual(verdict, "holds" if i >= 46 else "broken", (i, reason))   # 46: axes, not used


if __name__ == "__main__":
    unittest.main()
