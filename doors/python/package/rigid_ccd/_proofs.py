"""Machine-checkable proofs of answers."""

from dataclasses import dataclass
from hashlib import sha256
from os import PathLike
from pathlib import Path
from typing import Literal

from ._errors import InputError, InterruptError
from ._progress import reporter
from ._rigid_ccd import check_proof, proof_statement, read_proof
from ._settings import Progress


@dataclass(frozen=True, repr=False)
class Proof:
    """A machine-checkable proof that bodies stay apart until a time, and of two points that are near each other then.

    The command ``ccd check`` and the crate ``ccd-check`` check the files that `save` writes. ``docs/certificates.md``
    describes what a proof states, and what it does not.

    Attributes:
        proof: the statement with its proof, as bytes.
        meshes: for each mesh its bytes, and the bytes of its tree.
    """

    proof: bytes
    meshes: list[tuple[bytes, bytes]]

    @property
    def until(self) -> float:
        """The time until which nothing touches; for a segment of a path, the fraction from 0 to 1."""
        return read_proof(self.proof)[0]

    @property
    def outcome(self) -> Literal["free", "contact"]:
        """The outcome at the time `until`: "contact" if two bodies are near each other then, and "free" otherwise."""
        return "contact" if read_proof(self.proof)[1] else "free"

    def check(self) -> str:
        """Check the proof with code independent of the engine. Return "holds", or the reason why it does not."""
        return check_proof(self.proof, self.meshes)

    def __str__(self) -> str:
        """Return the statement of the proof: meshes, motions, margins and times."""
        return proof_statement(self.proof)

    def __repr__(self) -> str:
        """Return a short form of the statement. Does not check the proof."""
        try:
            until, has_contact, digests = read_proof(self.proof)
        except InputError as error:
            return f"Proof({error})"
        return f"Proof({'contact at' if has_contact else 'free until'} {until}, {len(digests)} bodies)"

    def save(self, folder: str | PathLike[str], name: str, *, overwrite: bool = False) -> None:
        """Write the proof to NAME.proof in a folder, and each mesh with its tree to DIGEST.mesh and DIGEST.body.

        Raises:
            FileExistsError: another proof has that name, and `overwrite` is False.
        """
        folder, file = _files(folder, name)
        if not overwrite and file.exists() and file.read_bytes() != self.proof:
            raise FileExistsError(f"{file} is another proof; overwrite=True replaces it")
        folder.mkdir(parents=True, exist_ok=True)
        for mesh, tree in self.meshes:
            digest = sha256(mesh).hexdigest()[:16]
            (folder / f"{digest}.mesh").write_bytes(mesh)
            (folder / f"{digest}.body").write_bytes(tree)
        file.write_bytes(self.proof)

    @classmethod
    def load(cls, folder: str | PathLike[str], name: str) -> "Proof":
        """Read NAME.proof and its meshes from a folder that `save` or ``ccd`` wrote. Does not check the proof.

        Raises:
            InputError: the file is not a proof, or one of its meshes is missing.
        """
        folder, file = _files(folder, name)
        return cls._read(file, _meshes(folder))

    @classmethod
    def _read(cls, file: Path, meshes: dict[str, tuple[bytes, bytes]]) -> "Proof":
        proof = file.read_bytes()
        needed = dict.fromkeys(read_proof(proof)[2])
        if missing := [digest for digest in needed if digest not in meshes]:
            raise InputError(f"{file}: the folder has no mesh with the digest {missing[0]}")
        return cls(proof, [meshes[digest] for digest in needed])


def check_folder(folder: str | PathLike[str], *, progress: Progress = None) -> dict[str, str]:
    """Check all proofs in a folder. Return for each name "holds", or the reason why the proof does not hold.

    Args:
        folder: the folder.
        progress: a function, called with the number of checked proofs and the number of all proofs; a bar of tqdm; or
            True for a new bar.

    Raises:
        InputError: the folder has no proof, a file is not a proof, or a mesh is missing.
        InterruptError: Ctrl-C was pressed. `results` has the results of the proofs checked so far.
    """
    files = sorted(Path(folder).glob("*.proof"))
    if not files:
        raise InputError(f"{folder}: there is no proof in this folder")
    meshes = _meshes(Path(folder))
    report, end_report = reporter(progress)
    verdicts: dict[str, str] = {}
    try:
        for file in files:
            verdicts[file.stem] = Proof._read(file, meshes).check()
            if report is not None:
                report(len(verdicts), len(files))
    except KeyboardInterrupt as cause:
        interrupted = InterruptError(f"interrupted; {len(verdicts)} of {len(files)} proofs are checked")
        interrupted.results = verdicts
        raise interrupted from cause
    finally:
        end_report()
    return verdicts


def _files(folder: str | PathLike[str], name: str) -> tuple[Path, Path]:
    """Return a folder, and the path of a proof in it. The name may end in .proof."""
    stem = name.removesuffix(".proof")
    if not stem or Path(stem).name != stem:
        raise InputError(f"name: {name!r} is not the name of a file")
    return Path(folder), Path(folder) / f"{stem}.proof"


def _meshes(folder: Path) -> dict[str, tuple[bytes, bytes]]:
    """Read the meshes of a folder and their trees, as a dict by the digests of the meshes."""
    meshes = {}
    for file in sorted(folder.glob("*.mesh")):
        mesh = file.read_bytes()
        meshes[sha256(mesh).hexdigest()] = (mesh, file.with_suffix(".body").read_bytes())
    return meshes
