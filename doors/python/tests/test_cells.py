"""Robots and cells. Answers are compared with closed forms, poses, and distances of single pairs."""

import pickle
import runpy
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigid_ccd import Body, Cell, EdgesQuery, InputError, Joint, PathContact, Robot, UnresolvedError, distance

URDF = """<robot name="arm">
  <link name="base"/>
  <link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
  <link name="fore"><collision><origin xyz="0.5 0 0"/><geometry><sphere radius="0.2"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="1 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>"""
HERE: Any = ([0, 0, 0], [0, 0, 0, 1])


@pytest.fixture
def robot(tmp_path: Path) -> Robot:
    file = tmp_path / "arm.urdf"
    file.write_text(URDF)
    return Robot.from_urdf(file)


def test_a_robot_is_that_of_its_file(robot: Robot) -> None:
    assert robot.joint_names == ["shoulder", "elbow"]
    assert robot.link_names == ["base", "upper", "fore"]
    assert robot.limits.tolist() == [[-3, 3], [-3, 3]]
    # Neighbours are not checked.
    assert robot.checked_pairs == []
    pose = robot.pose("fore", [0.3, 1])
    assert pose[:3, 3] == pytest.approx([np.cos(0.3), np.sin(0.3), 0])


def test_a_contact_is_where_trigonometry_says(robot: Robot) -> None:
    cell = Cell(robot)
    cell.add_obstacle("post", Body.sphere(0.1), ([0, 1.5, 0], [0, 0, 0, 1]))
    # The ball is at 1.5 in the direction of the shoulder.
    path = [[0, 0], [3, 0]]
    touch = np.pi / 2 - 2 * np.arcsin(0.3 / 2 / 1.5)
    contact = cell.first_contact(path, tolerance=1e-6)
    assert isinstance(contact, PathContact)
    assert (contact.segment, contact.a, contact.b) == (0, "fore", "post")
    assert touch - 1e-5 < 3 * contact.fraction <= touch
    assert np.linalg.norm(np.subtract(contact.witness_a, contact.witness_b)) < 1e-5
    assert not cell.is_free(path) and cell.is_free([[0, 0], [touch - 1e-2, 0]])
    nearest = cell.closest_approach([[0, 0], [1, 0]], tolerance=1e-6)
    exact = 2 * 1.5 * np.sin((np.pi / 2 - 1) / 2) - 0.3
    assert nearest.lower <= exact <= nearest.upper <= nearest.lower + 2e-6
    assert nearest.nearest is not None and nearest.nearest.fraction == pytest.approx(1)


def test_tables_agree_with_single_paths(robot: Robot) -> None:
    rng = np.random.default_rng(1)
    cell = Cell(robot)
    for k in range(6):
        cell.add_obstacle(f"box{k}", Body.box(0.1, 0.1, 0.1), (rng.uniform(-1.5, 1.5, 3), [0, 0, 0, 1]))
    start, end = rng.uniform(-3, 3, (2, 200, 2))
    free = cell.answer_edges(start, end)
    first = cell.answer_edges(start, end, question="first-contact", threads=2)
    close = cell.answer_edges(start, end, question="closest-approach")
    assert {"free", "contact"} == set(free["status"])
    assert ((free["status"] == "free") == (first["status"] == "free")).all()
    assert {"free", "contact", "overlapping"} == set(first["status"])
    for k in range(200):
        path = [start[k], end[k]]
        assert cell.is_free(path) == (free["status"][k] == "free")
        contact, nearest = cell.first_contact(path), cell.closest_approach(path)
        if contact is None:
            assert first["a"][k] is None and first["time"][k] == 1
        else:
            assert (first["a"][k], first["b"][k]) == (contact.a, contact.b)
            assert first["time"][k] == contact.fraction
        assert close["distance_lower"][k] == nearest.lower
        assert close["distance_upper"][k] == nearest.upper
    paths = np.stack([start, (start + end) / 2, end], axis=1)
    table = cell.answer_paths(paths, question="first-contact")
    assert ((table["time"] >= 0) & (table["time"] <= 2)).all() and (table["time"] > 1).any()


def test_distances_are_those_of_bodies(robot: Robot) -> None:
    rng = np.random.default_rng(2)
    cell = Cell(robot)
    box = Body.box(0.2, 0.3, 0.1)
    place: Any = ([0.8, 0.4, 0.5], [0.8, 0, 0.6, 0])
    cell.add_obstacle("box", box, place)
    upper, fore = Body.box(0.4, 0.05, 0.05), Body.sphere(0.2)
    shift = np.eye(4)
    shift[0, 3] = 0.5
    for configuration in rng.uniform(-3, 3, (20, 2)):
        found = cell.closest_approach(configuration, tolerance=1e-6)
        poses = [robot.pose(link, configuration) @ shift for link in ("upper", "fore")]
        least = min(
            distance(body, box, pose, place).upper
            for body, pose in zip((upper, fore), poses, strict=True)
        )
        assert found.lower - 1e-9 <= least <= found.upper + 1e-6


def test_cells_change(robot: Robot) -> None:
    cell = Cell(robot)
    path = [[0, 0], [3, 0]]
    for question in (cell.is_free, cell.first_contact, cell.closest_approach, cell.clearance_ranges, cell.prove):
        with pytest.raises(InputError, match="nothing is compared in this cell: 3 links, 1 without bodies"):
            question(path)
    with pytest.raises(InputError, match="nothing is compared"):
        cell.answer_edges(path[:1], path[1:])
    cell.add_obstacle("post", Body.sphere(0.1), ([0, 1.5, 0], [0, 0, 0, 1]))
    assert not cell.is_free(path)
    cell.move_obstacle("post", ([0, 3.5, 0], [0, 0, 0, 1]))
    assert cell.is_free(path) and not cell.is_free(path, margin=2.5)
    cell.set_padding("fore", 2.5)
    assert not cell.is_free(path)
    cell.set_clearance("fore", "post", 0.5)
    assert cell.is_free(path)
    cell.attach("rod", Body.capsule(0.05, 1.2), "fore", ([1.5, 0, 0], [0.5**0.5, 0, 0.5**0.5, 0]))
    contact = cell.first_contact(path)
    assert contact is not None and (contact.a, contact.b) == ("rod", "post")
    cell.detach("rod")
    assert cell.is_free(path)
    cell.remove_obstacle("post")
    assert "0 obstacles" in repr(cell)


def test_pairs_are_proven_and_written(tmp_path: Path) -> None:
    # The ball of the forearm meets a pillar on the base within the shoulder's limits, but not within narrower limits.
    pillar = (
        '<link name="base"><collision><origin xyz="0 1.5 0"/><geometry><sphere radius="0.1"/></geometry>'
        "</collision></link>"
    )
    text = URDF.replace('<link name="base"/>', pillar).replace('name="arm"', 'name="two links"')
    for limit, evidence in (("3", "sometimes"), ("1", "never")):
        file, srdf = tmp_path / "arm.urdf", tmp_path / "arm.srdf"
        shoulder = text.replace('lower="-3" upper="3"', f'lower="-1" upper="{limit}"', 1)
        elbow = shoulder.replace('lower="-3" upper="3"', 'lower="-0.1" upper="0.1"')
        file.write_text(elbow)
        robot = Robot.from_urdf(file)
        table = robot.classify_link_contacts(20_000, srdf=srdf)
        pairs = {(a, b): e for a, b, e in zip(table["link_a"], table["link_b"], table["evidence"], strict=True)}
        assert pairs[("base", "fore")] == evidence
        again = Robot.from_urdf(file, srdf)
        assert (("base", "fore") in again.checked_pairs) == (evidence == "sometimes")
        assert not [remark for remark in again.remarks if "another name" in remark]
        assert '<robot name="two links">' in srdf.read_text()


def test_wrong_input_is_named(robot: Robot, tmp_path: Path) -> None:
    cell = Cell(robot)
    cell.add_obstacle("post", Body.sphere(0.1), ([0, 1.5, 0], [0, 0, 0, 1]))
    with pytest.raises(InputError, match="configuration 1 of the path.*shoulder"):
        cell.is_free([[0, 0], [9, 0]])
    with pytest.raises(InputError, match="3 positions for 2 joints"):
        cell.is_free([[0, 0, 0]])
    with pytest.raises(InputError, match="shape"):
        cell.answer_paths(np.zeros((4, 2, 3)))
    with pytest.raises(InputError, match="shape"):
        cell.is_free(np.zeros((0, 2)))
    with pytest.raises(InputError, match="already a link, an attached body or an obstacle named `post`"):
        cell.add_obstacle("post", Body.sphere(0.1))
    with pytest.raises(InputError, match="no link `hand`"):
        cell.set_padding("hand", 1)
    with pytest.raises(InputError, match="'all' is not is-free"):
        wrong: Any = "all"
        cell.answer_edges([[0, 0]], [[1, 0]], question=wrong)
    unknown: Any = {"clearance": 1.0}
    with pytest.raises(TypeError, match="unexpected keyword argument 'clearance'"):
        cell.is_free([[0, 0]], **unknown)
    with pytest.raises(UnresolvedError) as caught:
        cell.first_contact([[0, 0], [3, 0]], deadline=0)
    assert caught.value.safe_until == 0
    assert len(cell.answer_edges(np.zeros((0, 2)), np.zeros((0, 2)), question="first-contact")) == 0
    rows = cell.answer_edges([[0, 0], [0, 0]], [[1, 0], [9, 0]])
    assert rows["status"].tolist() == ["free", "error"] and "shoulder" in rows["reason"][1]
    with pytest.raises(InputError, match="nothing.urdf"):
        Robot.from_urdf(tmp_path / "nothing.urdf")


def test_a_cell_is_pickled_as_it_is(robot: Robot) -> None:
    rng = np.random.default_rng(5)
    cell = Cell(robot)
    for k in range(4):
        cell.add_obstacle(f"box{k}", Body.box(0.1, 0.1, 0.1), (rng.uniform(-1.5, 1.5, 3), [0.8, 0, 0.6, 0]))
    cell.move_obstacle("box1", ([1, 1, 0], [0, 0, 0, 1]))
    cell.remove_obstacle("box0")
    cell.attach("tool", Body.sphere(0.05), "fore", ([0.3, 0, 0], [0, 0, 0, 1]), may_touch=["upper"])
    cell.attach("lost", Body.sphere(0.05), "fore")
    cell.detach("lost")
    cell.set_padding("fore", 0.02)
    cell.set_padding("fore", 0.01)
    cell.set_clearance("tool", "box2", 0.3)
    cell.set_clearance("box2", "tool", 0.2)
    cell.allow_contact("fore", "box3")
    cell.allow_contact("box2", "upper")
    cell.forbid_contact("upper", "box2")
    again = pickle.loads(pickle.dumps(cell))
    assert repr(again) == repr(cell)
    start, end = rng.uniform(-3, 3, (2, 300, 2))
    for ask in ("is-free", "first-contact", "closest-approach"):
        one, other = (each.answer_edges(start, end, question=ask) for each in (cell, again))
        for column in one:
            assert [*one[column]] == [*other[column]] or np.array_equal(one[column], other[column], equal_nan=True)
    assert 0 < np.sum(cell.answer_edges(start, end)["status"] == "free") < 300


def test_a_closest_approach_is_compared_with_a_clearance(robot: Robot) -> None:
    cell = Cell(robot)
    cell.add_obstacle("post", Body.box(0.1, 0.1, 1), ([3, 0, 0], [0, 0, 0, 1]))
    start, end = np.zeros((3, 2)), np.array([[0.5, 0], [1, 0], [0, 1]])
    nearest = cell.answer_edges(start, end, question="closest-approach")["distance_upper"]
    for clearance, expected in ((0.5 * nearest.min(), "kept"), (nearest.max() + 0.1, "violated")):
        found = cell.answer_edges(start, end, question="closest-approach", clearance=clearance)
        assert set(found["status"]) == {expected}
    assert set(cell.answer_edges(start, end, question="closest-approach")["status"]) == {"measured"}


def test_edges_of_tables_are_those_of_arrays(robot: Robot) -> None:
    pyarrow: Any = pytest.importorskip("pyarrow")
    cell = Cell(robot)
    cell.add_obstacle("post", Body.box(0.1, 0.1, 1), ([1.2, 0.3, 0], [0, 0, 0, 1]))
    query = EdgesQuery(cell, question="first-contact", rest={"elbow": 0.5}, tolerance=1e-5)
    cell.remove_obstacle("post")
    again = pickle.loads(pickle.dumps(query))
    ids, start, end = [f"e{k}" for k in range(40)], np.linspace(-2, 0, 40), np.linspace(-1, 2, 40)
    table = {"id": ids, "from_shoulder": start, "to_shoulder": end}
    cell.add_obstacle("post", Body.box(0.1, 0.1, 1), ([1.2, 0.3, 0], [0, 0, 0, 1]))
    ends = [np.column_stack([each, np.full(40, 0.5)]) for each in (start, end)]
    expected = cell.answer_edges(ends[0], ends[1], question="first-contact", tolerance=1e-5)
    for found in (query(table), again(table), pyarrow.table(dict(again(pyarrow.table(table)).to_pydict()))):
        assert [str(each) for each in found["status"]] == [*expected["status"]] and [str(each) for each in found["id"]] == ids
    assert {"free", "contact"} <= set(expected["status"])
    parts = list(query(iter([pyarrow.table(table).slice(0, 7), pyarrow.table(table).slice(7)])))
    assert pyarrow.concat_tables(parts).schema == query.schema(pyarrow.table(table).schema)
    for wrong, message in (({"id": ["a"], "from_shoulder": [0]}, "to_shoulder"), ({"from_shoulder": [0]}, "id")):
        with pytest.raises(InputError, match=message):
            query(wrong)
    in_degrees = {"id": ids, "from_shoulder_deg": np.rad2deg(start), "to_shoulder": end}
    found = query(in_degrees)
    assert [*found["status"]] == [*expected["status"]] and np.nanmax(np.abs(found["time"] - expected["time"])) < 1e-9
    for more, message in ((["from_shoulder"], "two columns for the joint shoulder"), (["from_elbow_deg"], "elbow has columns, but also a position")):
        with pytest.raises(InputError, match=message):
            query({**in_degrees, **{name: start for name in more}})
    with pytest.raises(InputError, match="knee"):
        EdgesQuery(cell, rest={"knee": 0})
    with pytest.raises((InputError, TypeError), match="question"):
        EdgesQuery(cell, question="all")  # type: ignore[arg-type]


def test_a_robot_of_yourdfpy_is_that_of_its_file(tmp_path: Path) -> None:
    yourdfpy = pytest.importorskip("yourdfpy")
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "corner.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
    mesh = '<mesh filename="package://arm/meshes/corner.obj" scale="0.1 0.1 0.1"/>'
    text = URDF.replace('<link name="base"/>', f'<link name="base"><collision><geometry>{mesh}</geometry></collision></link>')
    path = tmp_path / "arm.urdf"
    path.write_text(text)
    known = Robot.from_urdf(path, packages=[tmp_path.parent]) if tmp_path.name == "arm" else None
    load = {"build_scene_graph": False, "load_meshes": False}
    robot = Robot.from_yourdfpy(yourdfpy.URDF.load(str(path), **load))
    assert known is None or robot.checked_pairs == known.checked_pairs
    assert robot.joint_names == Robot.from_urdf_text(URDF).joint_names
    again = pickle.loads(pickle.dumps(robot))
    assert again.checked_pairs == robot.checked_pairs == [("base", "fore")]
    with pytest.raises(InputError):
        Robot.from_urdf_text(text, tmp_path / "nowhere" / "arm.urdf")


class PPoly:
    """Polynomials with the attributes of scipy.interpolate.PPoly."""

    def __init__(self, c: Any, x: Any) -> None:
        self.c, self.x = np.asarray(c, float), np.asarray(x, float)


def test_a_curve_is_a_path(robot: Robot) -> None:
    cell = Cell(robot)
    cell.add_obstacle("post", Body.sphere(0.1), ([0, 1.5, 0], [0, 0, 0, 1]))
    touch = np.pi / 2 - 2 * np.arcsin(0.3 / 2 / 1.5)
    # The shoulder turns by t^2 / 2, from the time 0, first as a polynomial about 0, then about 1.
    curve = PPoly([[[0.5, 0], [0.5, 0]], [[0, 0], [1, 0]], [[0, 0], [0.5, 0]]], [0, 1, 2.4])
    contact = cell.first_contact(curve, tolerance=1e-6)
    assert isinstance(contact, PathContact)
    expected = np.sqrt(2 * touch)
    assert (contact.segment, contact.a, contact.b) == (1, "fore", "post")
    assert expected - 1e-5 < contact.time <= expected
    assert contact.fraction == pytest.approx((contact.time - 1) / 1.4)
    assert not cell.is_free(curve)
    early = PPoly(curve.c[:, :1], curve.x[:2])
    assert cell.is_free(early)
    table = cell.answer_paths([curve, early], "first-contact", tolerance=1e-6)
    assert table["status"].tolist() == ["contact", "free"]
    assert table["time"].tolist() == [contact.time, 1]
    nearest = cell.closest_approach(early, tolerance=1e-6)
    at_the_end = cell.closest_approach([0.5, 0], tolerance=1e-9)
    assert nearest.lower <= at_the_end.upper and at_the_end.lower <= nearest.upper <= nearest.lower + 2e-6
    assert nearest.nearest is not None and nearest.nearest.time == pytest.approx(1)
    ranges = cell.clearance_ranges(curve)
    # The ball touches the post, and leaves it again.
    assert [item.clearance for item in ranges] == ["kept", "unverified", "violated", "unverified", "kept"]
    assert ranges[0].end <= expected <= ranges[2].start
    assert ranges[2].end <= np.sqrt(2 * (np.pi - touch)) <= ranges[4].start
    assert (ranges[0].start, ranges[-1].end) == (0, 2.4)


def test_wrong_curves_are_refused(robot: Robot) -> None:
    cell = Cell(robot)
    with pytest.raises(InputError, match="the joint is at"):
        cell.is_free(PPoly([[[9, 0]], [[0, 0]]], [0, 1]))
    with pytest.raises(InputError, match="3 positions for 2 joints"):
        cell.is_free(PPoly(np.zeros((2, 1, 3)), [0, 1]))
    with pytest.raises(InputError, match="coefficients of shape"):
        cell.is_free(PPoly(np.zeros((2, 1)), [0, 1]))
    with pytest.raises(InputError, match="jumps by 1"):
        cell.is_free(PPoly([[[0, 0], [1, 0]]], [0, 1, 2]))


def test_robots_are_combined(robot: Robot) -> None:
    poses: Any = {"right": ([0, 1.5, 0], [0, 0, 0, 1])}
    both = Robot.combined({"left": robot, "right": robot, "cart": robot}, poses, {"cart": "floating"})
    assert both.joint_names[:5] == ["left/shoulder", "left/elbow", "right/shoulder", "right/elbow", "cart/base/x"]
    assert both.limits[:2].tolist() == robot.limits.tolist()
    q = np.array([0.3, 1, -0.2, 0.5, 1, 2, 3, 0, 0, 0, 0.4, 0.6])
    assert both.pose("right/fore", q)[:3, 3] == pytest.approx(robot.pose("fore", q[2:4])[:3, 3] + [0, 1.5, 0])
    assert both.pose("cart/fore", q)[:3, 3] == pytest.approx(robot.pose("fore", q[10:])[:3, 3] + [1, 2, 3])
    far = np.concatenate([np.zeros(4), [9, 9, 9], np.zeros(5)])
    turned = far.copy()
    turned[0], turned[2] = 1, -1
    cell = Cell(both)
    contact = cell.first_contact([far, turned])
    assert contact is not None and {contact.a.split("/")[0], contact.b.split("/")[0]} == {"left", "right"}
    again = pickle.loads(pickle.dumps(both))
    assert again.joint_names == both.joint_names and Cell(again).first_contact([far, turned]) == contact
    with pytest.raises(InputError, match="poses: there is no robot 'b'"):
        Robot.combined({"a": robot}, {"b": ([0, 0, 0], [0, 0, 0, 1])})
    with pytest.raises(InputError, match="'rolling' is not fixed, planar or floating"):
        Robot.combined({"a": robot}, bases={"a": "rolling"})  # type: ignore[dict-item]


def test_curves_are_what_their_objects_say(robot: Robot) -> None:
    class Called(PPoly):
        def __call__(self, times: Any) -> Any:
            return np.stack([0.5 * times, 0 * times], axis=1)

    cell = Cell(robot)
    cell.add_obstacle("post", Body.sphere(0.1), ([0, 1.5, 0], [0, 0, 0, 1]))
    line = [[[0.5, 0]], [[0, 0]]]
    assert cell.is_free(Called(line, [0, 1]))
    # A BPoly has the values at both ends as its coefficients.
    with pytest.raises(InputError, match="convert it to a scipy.interpolate.PPoly"):
        cell.is_free(Called([[[0, 0]], [[0.5, 0]]], [0, 1]))
    constant = PPoly([[[0.2, 0.1]]], [0, 1])
    assert cell.is_free(constant)
    with pytest.raises(InputError, match="0 coefficients instead of 1"):
        cell.is_free(PPoly(np.zeros((0, 1, 2)), [0, 1]))
    late = PPoly(line, [-30, -29])
    with pytest.raises(UnresolvedError) as caught:
        cell.is_free(late, deadline=0)
    assert caught.value.safe_until == -30
    assert cell.closest_approach(late).limit is None
    assert cell.closest_approach(late, deadline=0).limit is not None


def test_contacts_have_witnesses_while_threads_compete(robot: Robot) -> None:
    cell = Cell(robot)
    # The body is so fine that measuring a contact takes a part of the time limit of the first attempt.
    angles = np.linspace(0, 2 * np.pi, 400)
    ring = np.stack([1.5 * np.sin(angles), 1.5 * np.cos(angles), 0.05 * np.cos(40 * angles)], axis=1)
    faces = [[k, k + 1, k + 2] for k in range(len(ring) - 2)]
    cell.add_obstacle("ring", Body(ring, faces, surface=True), ([0, 0.4, 0], [0, 0, 0, 1]))

    def lost(seed: int) -> int:
        ends = np.random.default_rng(seed).uniform(-3, 3, (300, 2, 2))
        found = [cell.first_contact(path, tolerance=1e-7) for path in ends]
        return sum(contact is not None and not np.isfinite(contact.witness_a).all() for contact in found)

    with ThreadPoolExecutor(16) as threads:
        assert sum(threads.map(lost, range(16))) == 0


def test_a_plane_has_no_end(robot: Robot) -> None:
    cell = Cell(robot)
    cell.add_plane("slope", ([2, 0, 0], [np.sqrt(0.5), 0, -np.sqrt(0.5), 0]))
    # The ball is at 1.5 from the shoulder, and never reaches the half-space beyond x = 2 - 0.2.
    assert cell.is_free([[0, 0], [3, 0]])
    cell.move_obstacle("slope", ([1.5, 1e6, 0], [np.sqrt(0.5), 0, -np.sqrt(0.5), 0]))
    for own in (cell, pickle.loads(pickle.dumps(cell))):
        contact = own.first_contact([[2, 0], [0, 0]], tolerance=1e-6)
        assert isinstance(contact, PathContact)
        assert (contact.a, contact.b) == ("fore", "slope")
        assert 2 - 2 * contact.fraction == pytest.approx(np.arccos(1.3 / 1.5), abs=1e-5)
    cell.remove_obstacle("slope")
    with pytest.raises(InputError, match="nothing is compared"):
        cell.is_free([[0, 0], [3, 0]])


def test_frames_may_be_in_degrees(robot: Robot) -> None:
    pandas = pytest.importorskip("pandas")
    cell = Cell(robot)
    cell.add_obstacle("post", Body.sphere(0.1), ([0, 1.5, 0], [0, 0, 0, 1]))
    path = np.array([[0.0, 0.1], [1.5, 0.2]])
    degrees = np.rad2deg(path)
    for frame in (
        pandas.DataFrame({"shoulder_deg": degrees[:, 0], "elbow": path[:, 1]}),
        pandas.DataFrame(degrees, columns=["shoulder_deg", "elbow_deg"]),
    ):
        for one, other in zip((cell.first_contact(frame), cell.first_contact(frame[::-1])), (cell.first_contact(path), cell.first_contact(path[::-1]))):
            assert one is not None and other is not None and one.fraction == pytest.approx(other.fraction, abs=1e-9)
        assert robot.pose("fore", frame.iloc[1]) == pytest.approx(robot.pose("fore", path[1]))
        assert cell.answer_edges(frame, path)["status"].tolist() == cell.answer_edges(path, frame)["status"].tolist()
    with pytest.raises(InputError, match="the labels are elbow_deg, shoulder"):
        cell.is_free(pandas.DataFrame(degrees, columns=["elbow_deg", "shoulder"]))
    slide = Cell(Robot([Joint.prismatic("x", "rail", "cart")], {"cart": Body.sphere(1)}))
    slide.add_plane("floor", ([0, 0, -2], [0, 0, 0, 1]))
    with pytest.raises(InputError, match="the joint x slides, and has no degrees"):
        slide.is_free(pandas.DataFrame({"x_deg": [1.0]}))


def test_what_is_not_checked_is_said(robot: Robot, tmp_path: Path) -> None:
    assert "3 links, 1 without bodies; 2 bodies; 0 pairs of links checked, 1 not (adjacent)" in repr(robot)
    assert robot.remarks[0] == "1 link without bodies, compared with nothing: base"
    cell = Cell(robot)
    cell.add_obstacle("post", Body.sphere(0.1), ([0, 3, 0], [0, 0, 0, 1]))
    cell.allow_contact("fore", "post")
    assert "1 obstacle, 1 contact allowed: post" in repr(cell)
    assert cell.remarks[-1] == "1 contact allowed: fore and post"
    # Most links have no body.
    axis = ([1, 0, 0], [0, 0, 0, 1])
    joints = [Joint.revolute(f"to {b}", a, b, axis) for a, b in ("wa", "ab", "bc")]
    bare = Robot(joints, {"c": Body.sphere(0.1)})
    assert "most of the robot is not checked: 2 of 3 moving links have no bodies: a, b" in repr(bare)
    with pytest.warns(UserWarning, match="most of the robot is not checked"):
        Cell(bare)


def lifted() -> Cell:
    """Returns a fork that holds a can on a table, below a shelf that the can meets at 0.793."""
    cell = Cell(Robot([Joint.prismatic("lift", "rail", "fork")]))
    cell.add_obstacle("table", Body.box(1, 1, 0.1), ([0, 0, -0.1], [0, 0, 0, 1]))
    cell.add_obstacle("shelf", Body.box(1, 1, 0.01), ([0, 0, 0.923], [0, 0, 0, 1]))
    return cell


def test_a_can_is_lifted_from_a_table() -> None:
    cell, can, at = lifted(), Body.cylinder(0.033, 0.06), ([0, 0, 0.06], [0, 0, 0, 1])
    up = [[0], [1]]
    cell.attach("can", can, "fork", at)
    stands = cell.first_contact(up)
    assert stands is not None and (stands.b, stands.fraction) == ("table", 0)
    contact = cell.first_contact(up, start="leave", tolerance=1e-5)
    assert contact is not None and (contact.a, contact.b) == ("can", "shelf")
    assert 0.793 - 1e-5 < contact.fraction <= 0.793
    assert cell.is_free([[0.0], [0.7]], start="leave") and not cell.is_free([[0.0], [-0.01]], start="leave")
    table = cell.answer_edges([[0.0], [0.0]], [[0.7], [1.0]], "first-contact", start="leave")
    assert table["status"].tolist() == ["free", "contact"]
    wrong: Any = {"start": "leave"}
    for question in (cell.closest_approach, cell.clearance_ranges, cell.prove):
        with pytest.raises(TypeError, match="'start'"):
            question(up, **wrong)
    other: Any = "go"
    with pytest.raises(InputError, match="'go' is not report or leave"):
        cell.is_free(up, start=other)
    # Contacts with the table can also be allowed in other ways.
    cell.allow_contact("table", "can")
    for change in ("allowed", "may touch"):
        contact = cell.first_contact(up, tolerance=1e-5)
        assert contact is not None and contact.b == "shelf", change
        cell.detach("can")
        cell.attach("can", can, "fork", at, may_touch=["table"])
    with pytest.raises(InputError, match="start policy `leave`"):
        cell.set_clearance("can", "table", -0.01)
    cell.forbid_contact("can", "table")
    assert not cell.is_free(up[:1])


def test_the_example_picks_and_places(capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(Path(__file__).parents[1] / "examples/pick_and_place.py"))
    printed = capsys.readouterr().out
    for line in (
        "the way over the shelf is free",
        "onto the shelf: can touches shelf at 0.666",
        "into the shelf: right finger touches shelf at 1.744",
        "into the other arm: other/fore touches right finger at 1.28",
        "into the table: can touches table at 0.0000",
        "the can is on the shelf, and the arm is back",
    ):
        assert line in printed, printed


def test_a_path_is_read_in_the_order_of_its_elements() -> None:
    slides = [Joint.prismatic("x", "w", "a", axis=[1, 0, 0]), Joint.prismatic("y", "a", "b", axis=[0, 1, 0])]
    cell = Cell(Robot(slides, {"b": Body.sphere(0.1)}))
    cell.add_obstacle("post", Body.box(0.1, 0.1, 5), ([2, 0, 0], [0, 0, 0, 1]))
    path = np.array([[0, 4.0], [1, -1]]).T
    assert not path.flags.c_contiguous
    large = np.zeros((4, 6))
    large[::-2, ::3] = path
    pandas: Any = pytest.importorskip("pandas")
    given: list[Any] = [path, path.copy(order="C"), path.tolist(), large[::-2, ::3], path.astype(">f4"), pandas.DataFrame(path)]
    known = cell.first_contact(path.tolist(), tolerance=1e-6)
    assert known is not None and 0.44 < known.fraction < 0.46
    for each in given:
        assert not cell.is_free(each)
        assert cell.first_contact(each, tolerance=1e-6) == known
        assert all(proof.check() == "holds" for proof in cell.prove(each, tolerance=1e-6))
        assert repr(cell.clearance_ranges(each)) == repr(cell.clearance_ranges(path.tolist()))
    rows = cell.answer_paths(np.asfortranarray([path, path[::-1]]), "first-contact", tolerance=1e-6)
    assert rows["time"][0] == known.fraction and set(rows["status"]) == {"contact"}
