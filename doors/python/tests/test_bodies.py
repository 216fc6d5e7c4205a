"""Bodies, from arrays, files and trimesh."""

import os
import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from rigid_ccd import Body, InputError, Motion, closest_approach

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
# The faces are oriented outward.
FACES = np.array(
    [
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ]
)  # fmt: skip


def test_a_box_has_half_extents_or_a_size() -> None:
    halves, size = Body.box(0.5, 1, 1.5), Body.box(size=[1, 2, 3])
    assert repr(halves) == repr(size) == repr(pickle.loads(pickle.dumps(size)))
    for wrong in ({}, {"x": 1}, {"x": 1, "y": 1, "z": 1, "size": [1, 1, 1]}, {"size": [1, 1]}, {"size": [1, 1, -1]}):
        with pytest.raises(InputError):
            Body.box(**wrong)


def test_a_cube_is_a_solid_of_one_piece() -> None:
    cube = Body(CORNERS, FACES)
    assert cube.is_solid and cube.piece_count == 1
    assert "solid" in repr(cube)
    assert Body(CORNERS, FACES, pieces="triangles").piece_count == 12


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.int16])
def test_vertices_of_any_kind_of_number_are_taken(dtype: type) -> None:
    assert Body(CORNERS.astype(dtype), FACES.astype(np.uint8)).is_solid
    assert Body(np.asfortranarray(CORNERS.astype(dtype)), FACES[::-1].tolist()).is_solid
    wide: NDArray[np.generic] = np.zeros((16, 6), dtype=dtype)
    wide[::2, ::2] = CORNERS
    assert Body(wide[::2, ::2], FACES).is_solid


@pytest.mark.parametrize(
    ("vertices", "faces", "message"),
    [
        (CORNERS[:, :2], FACES, "vertices: an array of shape"),
        (CORNERS.ravel(), FACES, "vertices: an array of shape"),
        ([["a", "b", "c"]], FACES, "vertices: "),
        (CORNERS, FACES.astype(float), "faces: indices are integers"),
        (CORNERS, FACES - 1, "faces: face 0 has the index -1"),
        (CORNERS, FACES + 1, "vertex"),
        (CORNERS * np.nan, FACES, "vertex 0"),
        (CORNERS * np.inf, FACES, "vertex 0"),
        (CORNERS, np.zeros((0, 3), dtype=int), "face"),
        (np.zeros((0, 3)), np.zeros((0, 3), dtype=int), "vert"),
        (None, FACES, "vertices"),
        (CORNERS + 1j, FACES, "vertices: numbers are needed"),
        (CORNERS.astype(str), FACES, "vertices: numbers are needed"),
        (CORNERS, [[0, 1, 2], [0]], "faces: "),
    ],
)
def test_what_is_no_mesh_is_refused(vertices: object, faces: object, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Body(vertices, faces)  # type: ignore[arg-type]


def test_names_are_checked() -> None:
    with pytest.raises(InputError, match="pieces"):
        Body(CORNERS, FACES, pieces="cubes")  # type: ignore[arg-type]
    for wrong in (-1.0, float("nan"), float("inf")):
        message = r"is (-1|NaN|inf), but must be from 0 to 1e12"
        with pytest.raises(InputError, match=message):
            Body.box(1, wrong, 1)
        with pytest.raises(InputError, match=message):
            Body.capsule(1, wrong)
        with pytest.raises(InputError, match=message):
            Body.sphere(wrong)


@pytest.mark.parametrize("make", [Body.cylinder, Body.cone])
def test_round_bodies_tell_how_far_they_stick_out(make: Callable[..., Body], tmp_path: Path) -> None:
    usual, fine = make(2, 1), make(2, 1, excess=1e-5)
    assert 0 < usual.excess <= 2 / 4096
    assert 0 < fine.excess <= 1e-5
    assert usual.is_solid and "exceeded by" in repr(usual)
    for again in (pickle.loads(pickle.dumps(fine)), saved(fine, tmp_path / "fine.ccd")):
        assert again.excess == fine.excess
    for radius, half_height, excess in ((-1, 1, None), (1, float("nan"), None), (1, 1, 1e-9), (1, 1, float("nan"))):
        with pytest.raises(InputError, match="radius|half height|excess"):
            make(radius, half_height, excess)


def saved(body: Body, path: Path) -> Body:
    body.save(path)
    return Body.from_file(path)


def test_files_are_read(tmp_path: Path) -> None:
    path = tmp_path / "cube.obj"
    lines = ["v " + " ".join(map(str, v)) for v in CORNERS] + ["f " + " ".join(map(str, f + 1)) for f in FACES]
    path.write_text("\n".join(lines))
    assert Body.from_file(path).is_solid
    assert Body.from_file(str(path)).piece_count == 1
    with pytest.raises(FileNotFoundError) as missing:
        Body.from_file(tmp_path / "nothing.obj")
    assert missing.value.filename == str(tmp_path / "nothing.obj")
    # Reading a pipe without a writer would block.
    os.mkfifo(tmp_path / "pipe.obj")
    for other in ("pipe.obj", "."):
        with pytest.raises(InputError, match="is not a file"):
            Body.from_file(tmp_path / other)
    with pytest.raises(InputError, match="unit"):
        Body.from_file(path, unit="mile")  # type: ignore[arg-type]
    path.write_text("v 1 2\n")
    with pytest.raises(InputError):
        Body.from_file(path)


def test_files_are_adjusted(tmp_path: Path) -> None:
    path = tmp_path / "cube.obj"
    lines = ["v " + " ".join(map(str, v + 2)) for v in CORNERS] + ["f " + " ".join(map(str, f + 1)) for f in FACES]
    path.write_text("\n".join(lines))

    def gap(body: Body, at: list[float]) -> float:
        # The cube extends from 1 to 3, with a ball of radius 1 beside it.
        return closest_approach(body, Body.sphere(1), None, Motion(at), tolerance=1e-9).upper

    assert gap(Body.from_file(path), [10, 2, 2]) == pytest.approx(6)
    mirrored = Body.from_file(path, mirror="x")
    assert gap(mirrored, [-10, 2, 2]) == pytest.approx(6)
    assert mirrored.is_solid
    assert gap(Body.from_file(path, file_unit="mm", unit="cm", scale=5), [10, 1, 1]) == pytest.approx(7.5)
    hollow = Body.from_file(path, surface=True)
    assert not hollow.is_solid and hollow.piece_count == 12
    assert not Body(CORNERS, FACES, surface=True).is_solid
    for wrong in ({"scale": 0}, {"scale": float("nan")}, {"mirror": "w"}, {"file_unit": "mile"}):
        with pytest.raises(InputError, match=next(iter(wrong))):
            Body.from_file(path, **wrong)
    with pytest.raises(InputError, match="surface"):
        Body(CORNERS, FACES, pieces="hull", surface=True)
    stored = saved(hollow, tmp_path / "cube.ccd")
    assert not stored.is_solid
    with pytest.raises(InputError, match="a prepared body"):
        Body.from_file(tmp_path / "cube.ccd", scale=2)


def test_meshes_of_trimesh_are_taken() -> None:
    trimesh = pytest.importorskip("trimesh")
    assert Body.from_trimesh(trimesh.creation.icosphere(2)).is_solid
    with pytest.raises(TypeError, match="an object with vertices and faces is needed, not str"):
        Body.from_trimesh("mesh")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="to_mesh"):
        Body.from_trimesh(trimesh.Scene(trimesh.creation.icosphere(2)))
