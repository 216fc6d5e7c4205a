"""Machine-checkable proofs of answers."""

from dataclasses import dataclass, field
from hashlib import sha256
from os import PathLike
from pathlib import Path

from ._rigid_ccd import InputError, check_proof, proof_statement


@dataclass(frozen=True)
class Proof:
    """A machine-checkable proof that bodies stay apart, and where they first come near each other.

    The command ``ccd check`` and the crate ``ccd-check`` check the files that `save` writes. What a proof says, and what it
    does not, is in ``docs/certificates.md``.

    Attributes:
        proof: the statement with its proof, as bytes.
        meshes: for each mesh its bytes, and those of its tree.
    """

    proof: bytes = field(repr=False)
    meshes: list[tuple[bytes, bytes]] = field(repr=False)

    def check(self) -> str:
        """Check the proof by code that shares nothing with what found it: "holds", or why it does not."""
        return check_proof(self.proof, self.meshes)

    def __str__(self) -> str:
        """Return what is stated: meshes, motions, margins and times."""
        return proof_statement(self.proof)

    def save(self, folder: str | PathLike[str], name: str) -> None:
        """Write NAME.proof to a folder, and each mesh with its tree as DIGEST.mesh and DIGEST.body."""
        if not name or Path(name).name != name:
            raise InputError(f"name: {name!r} is no name of a file")
        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        for mesh, tree in self.meshes:
            digest = sha256(mesh).hexdigest()[:16]
            (folder / f"{digest}.mesh").write_bytes(mesh)
            (folder / f"{digest}.body").write_bytes(tree)
        (folder / f"{name}.proof").write_bytes(self.proof)
