"""Holds the robots in folders against MuJoCo (MJCF) and Pinocchio (URDF): frames, pairs, least distances.

Prints for each folder how many models the reference reads and rigid_ccd reads, why it refuses others, by how much frames differ at
random configurations, how many models check other pairs, and how many least distances are not within the bounds. What differs is
named on the standard error. Needs the Python packages rigid_ccd, mujoco, pin and NumPy.

    python ccd-bench/scripts/robot_models.py FOLDER...
"""

import re
import sys
from collections import Counter
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import pinocchio
from rigid_ccd import Cell, Robot

CONFIGURATIONS = 3
# MuJoCo stores the vertices of meshes in single precision.
MESH_ERROR = 1e-5


def rotation(yaw, pitch, roll):
    """The quaternion (w, x, y, z) of yaw, then pitch, then roll."""
    (a, b, c), (x, y, z) = np.cos([yaw / 2, pitch / 2, roll / 2]), np.sin([yaw / 2, pitch / 2, roll / 2])
    return [a * b * c + x * y * z, a * b * z - x * y * c, a * y * c + x * b * z, x * b * c - a * y * z]


class MujocoModel:
    """A model as MuJoCo sees it, with the names that rigid_ccd gives to what has none."""

    def __init__(self, path):
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.data = mujoco.MjData(self.model)
        m = self.model
        self.links = [m.body(k).name or f"body{k}" for k in range(m.nbody)]
        self.links[0] = "world"
        self.joints = []
        for k in range(m.njnt):
            body = m.jnt_bodyid[k]
            self.joints.append(m.joint(k).name or f"{self.links[body]}/joint{k - m.body_jntadr[body]}")

    def place(self, positions):
        m, d = self.model, self.data
        d.qpos[:] = m.qpos0
        for k, name in enumerate(self.joints):
            at = m.jnt_qposadr[k]
            if name in positions:
                d.qpos[at] = positions[name]
            elif f"{name}/yaw" in positions:
                angles = [positions[f"{name}/{own}"] for own in ("yaw", "pitch", "roll")]
                if m.jnt_type[k] == mujoco.mjtJoint.mjJNT_FREE:
                    d.qpos[at : at + 3] = [positions[f"{name}/{own}"] for own in "xyz"]
                    at += 3
                d.qpos[at : at + 4] = rotation(*angles)
        for k in range(m.nmocap):
            name = f"{self.links[np.flatnonzero(m.body_mocapid == k)[0]]}/mocap"
            d.mocap_pos[k] = [positions[f"{name}/{own}"] for own in "xyz"]
            d.mocap_quat[k] = rotation(*[positions[f"{name}/{own}"] for own in ("yaw", "pitch", "roll")])
        for _ in range(m.neq):  # a joint may follow one that follows
            for k in np.flatnonzero(m.eq_type == mujoco.mjtEq.mjEQ_JOINT):
                one, other = m.eq_obj1id[k], m.eq_obj2id[k]
                if not m.eq_active0[k] or self.joints[one] in positions:
                    continue
                to, of = (m.jnt_qposadr[j] if j >= 0 else -1 for j in (one, other))
                moved = d.qpos[of] - m.qpos0[of] if of >= 0 else 0.0
                d.qpos[to] = m.qpos0[to] + np.polyval(m.eq_data[k][4::-1], moved)
        mujoco.mj_kinematics(m, d)

    def frame(self, link):
        k, frame = self.links.index(link), np.eye(4)
        frame[:3, :3], frame[:3, 3] = self.data.xmat[k].reshape(3, 3), self.data.xpos[k]
        return frame

    def collides(self, geom):
        m = self.model
        in_pair = geom in m.pair_geom1 or geom in m.pair_geom2
        return m.geom_contype[geom] or m.geom_conaffinity[geom] or in_pair

    def pairs(self):
        """The pairs of bodies of which MuJoCo checks some geoms, by its documentation."""
        m = self.model
        excluded = {(min(s >> 16, s & 0xFFFF), max(s >> 16, s & 0xFFFF)) for s in map(int, m.exclude_signature)}
        weld = m.body_weldid
        above = weld[m.body_parentid[weld]]
        filters = not m.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_FILTERPARENT
        pairs = set()
        for one in range(m.ngeom):
            for other in range(one):
                a, b = sorted((int(m.geom_bodyid[other]), int(m.geom_bodyid[one])))
                masks = m.geom_contype[one] & m.geom_conaffinity[other] or m.geom_contype[other] & m.geom_conaffinity[one]
                near = filters and weld[a] and weld[b] and (above[a] == weld[b] or above[b] == weld[a])
                if masks and weld[a] != weld[b] and not near and (a, b) not in excluded:
                    pairs.add((a, b))
        for one, other in zip(m.pair_geom1, m.pair_geom2):
            pairs.add(tuple(sorted((int(m.geom_bodyid[one]), int(m.geom_bodyid[other])))))
        return {frozenset(self.links[k] for k in pair) for pair in pairs}

    def height_over(self, plane, geom):
        """The height of a geom over a plane."""
        m, d = self.model, self.data
        kind, size = m.geom_type[geom], m.geom_size[geom]
        axes = d.geom_xmat[geom].reshape(3, 3)
        normal = axes.T @ d.geom_xmat[plane].reshape(3, 3)[:, 2]
        middle = (d.geom_xpos[geom] - d.geom_xpos[plane]) @ axes @ normal
        kinds = mujoco.mjtGeom
        if kind == kinds.mjGEOM_SPHERE:
            return middle - size[0]
        if kind == kinds.mjGEOM_CAPSULE:
            return middle - size[0] - size[1] * abs(normal[2])
        if kind == kinds.mjGEOM_CYLINDER:
            return middle - size[0] * np.hypot(*normal[:2]) - size[1] * abs(normal[2])
        if kind == kinds.mjGEOM_ELLIPSOID:
            return middle - np.linalg.norm(size * normal)
        if kind == kinds.mjGEOM_BOX:
            return middle - size @ abs(normal)
        mesh = m.geom_dataid[geom]
        first = m.mesh_vertadr[mesh]
        return middle + (m.mesh_vert[first : first + m.mesh_vertnum[mesh]] @ normal).min()

    def least_distance(self, pairs):
        m, least = self.model, np.inf
        solid = [geom for geom in range(m.ngeom) if self.collides(geom)]
        plane = m.geom_type == mujoco.mjtGeom.mjGEOM_PLANE
        for one in solid:
            for other in solid:
                link = frozenset(self.links[m.geom_bodyid[geom]] for geom in (one, other))
                if one <= other or link not in pairs or plane[one] and plane[other]:
                    continue
                if plane[one] or plane[other]:
                    least = min(least, self.height_over(*((one, other) if plane[one] else (other, one))))
                else:
                    least = min(least, mujoco.mj_geomDistance(m, self.data, one, other, 10.0, None))
        return max(least, 0.0)


class PinocchioModel:
    """A robot as Pinocchio sees it; all of its joints have positions of their own."""

    def __init__(self, path):
        self.model = pinocchio.buildModelFromUrdf(str(path))
        self.data = self.model.createData()
        self.links = [frame.name for frame in self.model.frames if frame.type == pinocchio.FrameType.BODY]
        root = ElementTree.parse(path).getroot()
        self.solid = [link.get("name") for link in root.iter("link") if link.find("collision/geometry") is not None]

    def pairs(self):
        """The pairs of links with shapes of which one moves against the other, except those that a joint connects."""
        frames = {link: self.model.frames[self.model.getFrameId(link, pinocchio.FrameType.BODY)] for link in self.links}
        above = {link: self.model.frames[self.model.frames[frame.parentFrame].parentFrame].name for link, frame in frames.items()}
        pairs = combinations([link for link in self.solid if link in frames], 2)
        moves = ((a, b) for a, b in pairs if frames[a].parentJoint != frames[b].parentJoint)
        return {frozenset(pair) for pair in moves if above[pair[0]] != pair[1] and above[pair[1]] != pair[0]}

    def place(self, positions):
        m = self.model
        q = pinocchio.neutral(m)
        for joint, name in zip(m.joints[1:], list(m.names)[1:]):
            if joint.nq == 2:
                q[joint.idx_q : joint.idx_q + 2] = np.cos(positions[name]), np.sin(positions[name])
            elif joint.nq == 1:
                q[joint.idx_q] = positions[name]
        pinocchio.framesForwardKinematics(m, self.data, q)

    def frame(self, link):
        return self.data.oMf[self.model.getFrameId(link, pinocchio.FrameType.BODY)].homogeneous


def mimics(path):
    """The joints of a URDF that follow others: name, other, multiplier, offset."""
    text = path.read_text(errors="replace")
    for name, body in re.findall(r'<joint\b[^>]*\bname="([^"]+)"[^>]*>(.*?)</joint>', text, re.S):
        own = re.search(r"<mimic\b([^>]*)>", body)
        if own:
            values = dict(re.findall(r'(\w+)="([^"]*)"', own[1]))
            yield name, values["joint"], float(values.get("multiplier", 1)), float(values.get("offset", 0))


def random_positions(random, robot):
    low, high = robot.limits.T
    low, high = np.where(np.isfinite(low), low, -1.5), np.where(np.isfinite(high), high, 1.5)
    return random.uniform(low, high)


def read(path, is_mjcf):
    reader = Robot.from_mjcf if is_mjcf else Robot.from_urdf
    return reader(path, meshes="hull")


def hold(path, is_mjcf, reference, robot, counts):
    """Holds a robot against a reference, and counts what differs."""
    random = np.random.default_rng(1)
    pairs = {frozenset(pair) for pair in robot.checked_pairs}
    if pairs != reference.pairs():
        counts["other pairs"] += 1
        print(f"{path}: pairs {len(pairs)} of {len(reference.pairs())}", file=sys.stderr)
    counts["pairs"] += len(pairs)
    cell = Cell(robot)
    for _ in range(CONFIGURATIONS):
        q = random_positions(random, robot)
        positions = dict(zip(robot.joint_names, q))
        if not is_mjcf:
            for name, other, multiplier, offset in 3 * list(mimics(path)):
                positions[name] = multiplier * positions.get(other, 0.0) + offset
        reference.place(positions)
        frames = [(robot.pose(link, q), reference.frame(link)) for link in reference.links if link in robot.link_names]
        difference = max(abs(own - other).max() for own, other in frames)
        if difference > 1e-9:
            print(f"{path}: frames differ by {difference}", file=sys.stderr)
        counts["frames differ by"] = max(counts["frames differ by"], float(difference))
        if is_mjcf and pairs:
            own, other = cell.closest_approach([q]), reference.least_distance(pairs)
            counts["distances"] += 1
            counts["of which not 0"] += int(other > 0)
            if not own.lower - MESH_ERROR <= min(other, 10.0) <= own.upper + MESH_ERROR and own.lower < 10:
                counts["distances not within bounds"] += 1
                print(f"{path}: {own.lower} to {own.upper}, but {other}: {own.nearest}", file=sys.stderr)


def survey(folder):
    counts, reasons = Counter(), Counter()
    for path in sorted([*folder.rglob("*.xml"), *folder.rglob("*.urdf")]):
        is_mjcf = "<mujoco" in path.read_text(errors="replace") and path.suffix == ".xml"
        if path.suffix == ".xml" and not is_mjcf:
            continue
        try:
            reference = MujocoModel(path) if is_mjcf else PinocchioModel(path)
        except Exception:
            continue  # A part of a model, or a broken one.
        counts["models"] += 1
        try:
            robot = read(path, is_mjcf)
        except Exception as error:
            reasons[re.sub(r"`[^`]*`|/\S+", "…", str(error))[-90:]] += 1
            print(f"{path}: {error}", file=sys.stderr)
            continue
        counts["read"] += 1
        hold(path, is_mjcf, reference, robot, counts)
    print(folder, dict(counts), dict(reasons))


if __name__ == "__main__":
    for name in sys.argv[1:]:
        survey(Path(name))
