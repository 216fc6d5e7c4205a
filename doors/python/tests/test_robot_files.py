"""Robots from MJCF files, robots that links carry, and the features of meshes in contact."""

import pickle
from pathlib import Path

import numpy as np
import pytest

from rigid_ccd import Body, Cell, InputError, Joint, Robot

UPRIGHT = [0, 0, 0, 1]
FINGER = """<mujoco><compiler angle="radian"/><worldbody><body name="finger" pos="0 0 0.5">
    <joint name="hinge" pos="0 0 0.1" axis="0 1 0" ref="0.2" range="-1 1"/><geom name="tip" size="0.1" pos="0 0 0.4"/>
    </body><geom type="box" size="0.1 0.1 0.1"/></worldbody></mujoco>"""


def write_finger(folder: Path) -> Path:
    file = folder / "finger.xml"
    file.write_text(FINGER)
    return file


def test_a_model_of_mujoco_is_a_robot(tmp_path: Path) -> None:
    robot = Robot.from_mjcf(write_finger(tmp_path))
    assert robot.joint_names == ["hinge"] and robot.checked_pairs == [("world", "finger")]
    np.testing.assert_array_equal(robot.limits, [[-1, 1]])
    # At the reference position the body has its own pose. At others it is rotated about the anchor, 0.6 above the
    # world.
    np.testing.assert_allclose(robot.pose("finger", [0.2])[:3, 3], [0, 0, 0.5], atol=1e-15)
    turned = [-0.1 * np.sin(0.5), 0, 0.6 - 0.1 * np.cos(0.5)]
    np.testing.assert_allclose(robot.pose("finger", [0.7])[:3, 3], turned, atol=1e-15)
    again = pickle.loads(pickle.dumps(robot))
    assert again.joint_names == robot.joint_names
    text = "<mujoco><worldbody><geom name='floor' type='{}'/><body name='ball'><freejoint/><geom size='0.1'/></body></worldbody></mujoco>"
    (tmp_path / "floor.xml").write_text(text.format("sdf"))
    with pytest.raises(InputError, match="geom `floor`: a signed distance field is not supported"):
        Robot.from_mjcf(tmp_path / "floor.xml")
    (tmp_path / "floor.xml").write_text(text.format("plane").replace("type=", "size='1 1 1' type="))
    above_floor = Cell(Robot.from_mjcf(tmp_path / "floor.xml"))
    assert above_floor.is_free([9, 9, 0.11, 0, 0, 0]) and not above_floor.is_free([9, 9, 0.09, 0, 0, 0])


def test_a_text_is_no_path_and_a_path_no_text(tmp_path: Path) -> None:
    text = '<robot name="r"><link name="a"/></robot>' + " " * 5000
    for read in (Robot.from_urdf, Robot.from_mjcf):
        with pytest.raises(InputError, match="path: this is the text of a robot") as refused:
            read(text)
        assert len(str(refused.value)) < 200
    with pytest.raises(InputError, match="text: this is not XML; Robot.from_urdf reads"):
        Robot.from_urdf_text("robot.urdf")


def test_the_folder_of_an_srdf_is_looked_at_before_the_work(tmp_path: Path) -> None:
    arm = Robot([Joint.revolute("turn", "base", "arm", axis=[0, 0, 1])], {"base": Body.sphere(1), "arm": Body.sphere(1)})
    told: list[tuple[int, int]] = []
    for path in (tmp_path / "nowhere" / "arm.srdf", ""):
        with pytest.raises(FileNotFoundError):
            arm.classify_link_contacts(srdf=path, progress=lambda *now: told.append(now))
    assert told == []


def test_an_infinite_position_is_named() -> None:
    wheel = Robot([Joint.revolute("wheel", "base", "rim")], {"base": Body.sphere(1), "rim": Body.sphere(0.1)})
    with pytest.raises(InputError, match="joint `wheel`: position is NaN or infinite"):
        wheel.pose("rim", [np.inf])


def test_a_link_carries_a_robot(tmp_path: Path) -> None:
    arm = Robot([Joint.revolute("turn", "base", "arm", ([0, 0, 1], UPRIGHT))], {"base": Body.sphere(0.1)})
    finger = Robot.from_mjcf(write_finger(tmp_path))
    both = Robot.combined({"": arm, "tool": finger}, {"tool": ([1, 0, 0], UPRIGHT)}, carriers={"tool": "arm"})
    assert both.joint_names == ["turn", "tool/hinge"]
    carried = both.pose("arm", [0.7, 0.2]) @ [1, 0, 0.5, 1]
    np.testing.assert_allclose(both.pose("tool/finger", [0.7, 0.2])[:, 3], carried, atol=1e-15)
    assert pickle.loads(pickle.dumps(both)).checked_pairs == both.checked_pairs
    with pytest.raises(InputError):
        Robot.combined({"arm": arm, "tool": finger}, carriers={"tool": "nothing"})
    with pytest.raises(InputError, match="there is no robot 'hand'"):
        Robot.combined({"arm": arm}, carriers={"hand": "arm/arm"})


def test_contacts_name_the_features_of_meshes() -> None:
    slide = Joint.prismatic("slide", "base", "ball", axis=[0, 0, 1])
    cell = Cell(Robot([slide], {"ball": Body.sphere(0.1)}))
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0.5], [-1, 1, 0.5], [0, 3, 0]])
    roof = Body(corners, [[0, 1, 2], [0, 2, 3], [3, 2, 4]])
    cell.add_obstacle("roof", roof, ([-0.5, -0.3, -2], UPRIGHT))
    touch = cell.first_contact([[0.0], [-3.0]])
    # The ball is over the first triangle, and has no features itself.
    assert touch is not None and (touch.feature_a, touch.feature_b) == (None, "f0")
    table = cell.answer_edges([[0.0]], [[-3.0]], question="first-contact")
    assert [table["feature_a"][0], table["feature_b"][0]] == [touch.feature_a, touch.feature_b]
