"""Machine-checkable proofs: they hold, forged proofs do not, and unprovable answers raise exceptions."""

import pickle
from pathlib import Path

import numpy as np
import pytest

from rigid_ccd import (
    Body,
    Cell,
    InputError,
    InterruptError,
    Joint,
    Motion,
    Proof,
    Robot,
    UnresolvedError,
    check_folder,
    check_proof,
    first_contact,
    prove,
)
from rigid_ccd import PosePath

WALL = Body.box(0.1, 5, 5)
FLIES = Motion([-3, 0, 0], velocity=[4, 0, 0], angular_velocity=[0, 1, 2])
ARM = """<robot name="arm">
  <link name="base"/>
  <link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>"""


@pytest.fixture
def cell(tmp_path: Path) -> Cell:
    file = tmp_path / "arm.urdf"
    file.write_text(ARM)
    cell = Cell(Robot.from_urdf(file))
    cell.add_obstacle("post", Body.sphere(0.1), ([0, 0.7, 0], [0, 0, 0, 1]))
    return cell


def proof_of(body: Body, motion: Motion = FLIES, **settings: float) -> Proof:
    return prove(body, WALL, motion, **settings)  # type: ignore[arg-type]


def test_proofs_of_contacts_and_of_free_motions_hold() -> None:
    cube = Body.box(1, 1, 1)
    hit = first_contact(cube, WALL, FLIES, tolerance=1e-3)
    proof = proof_of(cube, tolerance=1e-3)
    assert proof.check() == "holds"
    assert hit is not None and f"until {hit.time}" in str(proof)
    away = proof_of(cube, Motion([-3, 0, 0], velocity=[-1, 0, 0]))
    assert away.check() == "holds" and "until 1" in str(away)
    # Static bodies with a gap of 1.9.
    kept = proof_of(cube, Motion([-3, 0, 0]), margin=1.875)
    assert kept.check() == "holds"


def test_a_changed_proof_does_not_hold() -> None:
    proof = proof_of(Body.box(1, 1, 1))
    for at in range(len(proof.proof)):
        assert check_proof(proof.proof[:at], proof.meshes).startswith("broken: ")
    other = proof_of(Body.box(1, 1, 1.25))
    assert check_proof(proof.proof, other.meshes).startswith("broken: ")
    assert check_proof(b"no proof", proof.meshes).startswith("broken: ")
    with pytest.raises(InputError, match="these bytes are not a proof"):
        str(Proof(b"no proof", proof.meshes))


def test_files_are_those_of_the_command(tmp_path: Path) -> None:
    proof = proof_of(Body.sphere(0.5))
    proof.save(tmp_path / "proofs", "hit")
    names = sorted(file.suffix for file in (tmp_path / "proofs").iterdir())
    assert names == [".body", ".body", ".mesh", ".mesh", ".proof"]
    again = pickle.loads(pickle.dumps(proof))
    assert again == proof and again.check() == "holds"
    loaded = Proof.load(tmp_path / "proofs", "hit")
    assert loaded == proof and loaded.check() == "holds"


def test_a_saved_proof_is_not_lost(tmp_path: Path) -> None:
    hit, free = proof_of(Body.sphere(0.5)), proof_of(Body.sphere(0.5), Motion([-3, 0, 0]))
    hit.save(tmp_path, "it.proof")
    hit.save(tmp_path, "it")
    with pytest.raises(FileExistsError, match="it.proof is another proof"):
        free.save(tmp_path, "it")
    assert Proof.load(tmp_path, "it.proof") == hit
    free.save(tmp_path, "it", overwrite=True)
    assert Proof.load(tmp_path, "it") == free
    hit.save(tmp_path, "hit")
    assert check_folder(tmp_path) == {"hit": "holds", "it": "holds"}
    told: list[tuple[int, int | None]] = []

    def interrupt(done: int, total: int | None) -> None:
        told.append((done, total))
        raise KeyboardInterrupt

    with pytest.raises(InterruptError, match="1 of 2 proofs are checked") as interrupted:
        check_folder(tmp_path, progress=interrupt)
    assert interrupted.value.results == {"hit": "holds"} and told == [(1, 2)]
    (tmp_path / "hit.proof").write_bytes(hit.proof[:-1])
    assert check_folder(tmp_path)["hit"].startswith("broken: ")
    next(tmp_path.glob("*.mesh")).unlink()
    with pytest.raises(InputError, match="hit.proof: the folder has no mesh with the digest"):
        check_folder(tmp_path)
    with pytest.raises(InputError, match="there is no proof in this folder"):
        check_folder(tmp_path / "nothing")


def test_a_proof_says_whether_it_ends_in_a_contact(cell: Cell) -> None:
    hit, free = proof_of(Body.sphere(0.5)), proof_of(Body.sphere(0.5), Motion([-3, 0, 0]))
    found = first_contact(Body.sphere(0.5), WALL, FLIES)
    assert found is not None and (hit.outcome, hit.until) == ("contact", found.time)
    assert repr(hit) == f"Proof(contact at {found.time}, 2 bodies)"
    assert (free.outcome, free.until, repr(free)) == ("free", 1, "Proof(free until 1.0, 2 bodies)")
    assert repr(Proof(b"", [])) == "Proof(these bytes are not a proof)"
    first, second = cell.prove([[-1.0], [0.0], [3.0], [0.0]])
    assert (first.outcome, first.until) == ("free", 1)
    assert second.outcome == "contact" and 0 < second.until < 1


def test_a_list_of_proofs_is_an_answer(cell: Cell) -> None:
    """All proofs state "free" exactly if the path is free. If a proof is missing, there is an exception."""
    random = np.random.default_rng(7)
    seen = set()
    for _ in range(40):
        path = random.uniform(-3, 3, (int(random.integers(1, 4)), 1))
        try:
            proofs = cell.prove(path)
        except InputError as error:
            assert "upper and post touch at" in str(error) and isinstance(error.results, list)
            assert not cell.is_free(path)
            seen.add("error")
            continue
        assert proofs and all(proof.check() == "holds" for proof in proofs)
        assert all(proof.outcome == "free" for proof in proofs) == cell.is_free(path)
        seen.add(proofs[-1].outcome)
    assert seen == {"error", "free", "contact"}


def test_a_configuration_alone_rests(cell: Cell) -> None:
    rest, = cell.prove([0.0])
    assert (rest.check(), rest.outcome, rest.until) == ("holds", "free", 1)
    with pytest.raises(InputError, match="upper and post touch at 0"):
        cell.prove([np.pi / 2])


def test_at_a_limit_there_are_the_proofs_of_what_is_known(cell: Cell) -> None:
    with pytest.raises(UnresolvedError) as ended:
        cell.prove([[-1.0], [0.0], [1.0]], deadline=1e-12)
    assert isinstance(ended.value.results, list) and ended.value.safe_until is not None
    assert all(proof.check() == "holds" for proof in ended.value.results)
    with pytest.raises(UnresolvedError) as stopped:
        prove(Body.box(1, 1, 1), WALL, FLIES, tolerance=1e-9, budget=2)
    known = stopped.value.results
    assert known is None or (isinstance(known, Proof) and known.until == stopped.value.safe_until)


def test_what_has_no_proof_is_said() -> None:
    with pytest.raises(InputError, match="touch at the start"):
        prove(Body.box(1, 1, 1), WALL)
    moving = PosePath([0, 1], np.tile(np.eye(4), (2, 1, 1)))
    with pytest.raises(TypeError, match="motion_a: .*a Motion for a proof"):
        prove(WALL, WALL, moving)  # type: ignore[arg-type]


def test_each_segment_of_a_path_has_a_proof(cell: Cell) -> None:
    path = [[-1.0], [0.0], [3.0], [0.0]]
    contact = cell.first_contact(path)
    assert contact is not None and contact.segment == 1
    proofs = cell.prove(path)
    assert [proof.check() for proof in proofs] == ["holds"] * 2
    assert len(cell.prove([[-1.0], [-0.5], [0.0]])) == 2
    with pytest.raises(InputError, match="upper and post touch at 0, and no proof"):
        cell.prove([[np.pi / 2], [3.0]])
    with pytest.raises(InputError, match="positions"):
        cell.prove([[0.0, 1.0]])


def test_a_proof_says_what_moves_in_the_numbers_that_were_given(cell: Cell) -> None:
    falls = Motion([-3, 0, 0], velocity=[4, 0, 0.3], angular_velocity=[0, 0, 20])
    for duration in (1.0, 10.0, 0.01, 3e-5):
        proof = prove(Body.sphere(0.5), WALL, falls, duration=duration)
        assert "velocity [4.0, 0.0, 0.3] axis [0.0, 0.0, 20.0]" in str(proof)
        assert proof.check() == "holds"
    turns, = cell.prove([[0.25], [-2.5]])
    assert "axis [0.0, 0.0, 1.0] start 0.25 rate -2.75" in str(turns)
    slider = Joint.prismatic("x", "rail", "cart", axis=[0, 0, 1])
    rail = Cell(Robot([slider], {"cart": Body.sphere(0.5)}))
    rail.add_obstacle("wall", WALL, ([9, 0, 0], [0, 0, 0, 1]))
    slides, = rail.prove([[40.5], [-700.0]])
    assert "velocity [0.0, 0.0, 1.0] axis [0.0, 0.0, 0.0] start 40.5 rate -740.5" in str(slides)
