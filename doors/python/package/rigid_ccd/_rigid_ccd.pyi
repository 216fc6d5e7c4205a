from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, Protocol, TypeAlias, Unpack, final

from numpy import float64
from numpy.typing import ArrayLike, NDArray

from ._answers import Contact, Distance, PathContact, PathDistance, PathRange
from ._proofs import Proof
from ._settings import OfApproaches as _OfApproaches
from ._settings import OfContacts as _OfContacts
from ._settings import OfDistances as _OfDistances
from ._settings import OfPathContacts as _OfPathContacts
from ._settings import OfPaths as _OfPaths
from ._settings import Progress as _Progress

__all__ = [
    "Body",
    "Cell",
    "Joint",
    "LinkTrajectory",
    "Motion",
    "PosePath",
    "Robot",
    "Table",
    "answer_table",
    "check_proof",
    "closest_approach",
    "distance",
    "first_contact",
    "is_free",
    "proof_statement",
    "prove",
    "read_proof",
]

class _ScipyRotation(Protocol):
    def as_matrix(self) -> Any: ...

class _Polynomials(Protocol):
    @property
    def x(self) -> Any: ...
    @property
    def c(self) -> Any: ...

class _Spline(Protocol):
    @property
    def t(self) -> Any: ...
    @property
    def c(self) -> Any: ...
    @property
    def k(self) -> Any: ...
    def __call__(self, x: Any, nu: int = 0) -> Any: ...

class _Mesh(Protocol):
    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...

_Rotation: TypeAlias = ArrayLike | _ScipyRotation
_Pose: TypeAlias = ArrayLike | tuple[ArrayLike, _Rotation]
_Pieces: TypeAlias = Literal["auto", "triangles", "patches", "hull", "outer-hull"]
_Unit: TypeAlias = Literal["um", "mm", "cm", "m", "in", "ft"]
_Curve: TypeAlias = _Polynomials | _Spline
_Movement: TypeAlias = Motion | PosePath | LinkTrajectory

@final
class Body:
    def __new__(
        cls, vertices: ArrayLike, faces: ArrayLike, *, pieces: _Pieces = "auto", surface: bool = False
    ) -> Body: ...
    @classmethod
    def from_file(
        cls,
        path: str | PathLike[str],
        *,
        part: str | int | None = None,
        unit: _Unit | None = None,
        pieces: _Pieces = "auto",
        file_unit: _Unit | None = None,
        scale: float | None = None,
        mirror: Literal["x", "y", "z"] | None = None,
        surface: bool = False,
    ) -> Body: ...
    @classmethod
    def from_trimesh(cls, mesh: _Mesh, *, pieces: _Pieces = "auto", surface: bool = False) -> Body: ...
    @classmethod
    def box(
        cls, x: float | None = None, y: float | None = None, z: float | None = None, *, size: ArrayLike | None = None
    ) -> Body: ...
    @classmethod
    def sphere(cls, radius: float) -> Body: ...
    @classmethod
    def capsule(cls, radius: float, half_height: float) -> Body: ...
    @classmethod
    def cylinder(cls, radius: float, half_height: float, excess: float | None = None) -> Body: ...
    @classmethod
    def cone(cls, radius: float, half_height: float, excess: float | None = None) -> Body: ...
    @classmethod
    def _from_bytes(cls, stored: bytes) -> Body: ...
    def save(self, path: str | PathLike[str]) -> None: ...
    @property
    def is_solid(self) -> bool: ...
    @property
    def piece_count(self) -> int: ...
    @property
    def report(self) -> str: ...
    @property
    def excess(self) -> float: ...

@final
class Motion:
    def __new__(
        cls,
        position: ArrayLike | None = None,
        rotation: _Rotation | None = None,
        velocity: ArrayLike | None = None,
        angular_velocity: ArrayLike | None = None,
        center: ArrayLike | None = None,
    ) -> Motion: ...
    @classmethod
    def between(
        cls, start: _Pose, end: _Pose, duration: float = 1.0, center: ArrayLike | None = None
    ) -> Motion: ...
    @classmethod
    def still(cls, pose: _Pose) -> Motion: ...
    @property
    def end(self) -> float | None: ...
    def pose(self, time: float) -> NDArray[float64]: ...

@final
class PosePath:
    def __new__(
        cls,
        times: ArrayLike,
        poses: ArrayLike | Iterable[_Pose],
        center: ArrayLike | None = None,
        angular_velocities: ArrayLike | None = None,
    ) -> PosePath: ...
    @property
    def end(self) -> float: ...
    def pose(self, time: float) -> NDArray[float64]: ...

@final
class Joint:
    @classmethod
    def revolute(
        cls,
        name: str,
        parent: str,
        child: str,
        origin: _Pose | None = None,
        axis: ArrayLike | None = None,
        limits: ArrayLike | None = None,
        mimic: tuple[str, float, float] | None = None,
    ) -> Joint: ...
    @classmethod
    def prismatic(
        cls,
        name: str,
        parent: str,
        child: str,
        origin: _Pose | None = None,
        axis: ArrayLike | None = None,
        limits: ArrayLike | None = None,
        mimic: tuple[str, float, float] | None = None,
    ) -> Joint: ...
    @classmethod
    def fixed(cls, name: str, parent: str, child: str, origin: _Pose | None = None) -> Joint: ...
    @property
    def name(self) -> str: ...
    @property
    def limits(self) -> tuple[float, float]: ...

@final
class LinkTrajectory:
    @property
    def duration(self) -> float: ...
    def pose(self, time: float) -> NDArray[float64]: ...

@final
class Robot:
    def __new__(
        cls,
        joints: Iterable[Joint],
        bodies: Mapping[str, Body | Sequence[tuple[Body, _Pose]]] | None = None,
        may_touch: Sequence[tuple[str, str]] = ...,
    ) -> Robot: ...
    @classmethod
    def from_urdf(
        cls,
        path: str | PathLike[str],
        srdf: str | PathLike[str] | None = None,
        packages: str | PathLike[str] | Iterable[str | PathLike[str]] | None = None,
        geometry: Literal["collision", "visual"] = "collision",
        meshes: Literal["exact", "hull"] = "exact",
    ) -> Robot: ...
    @classmethod
    def from_mjcf(
        cls,
        path: str | PathLike[str],
        srdf: str | PathLike[str] | None = None,
        geometry: Literal["collision", "visual"] = "collision",
        meshes: Literal["exact", "hull"] = "exact",
    ) -> Robot: ...
    @classmethod
    def from_urdf_text(
        cls,
        text: str,
        path: str | PathLike[str] = ...,
        srdf: str | PathLike[str] | None = None,
        packages: str | PathLike[str] | Iterable[str | PathLike[str]] | None = None,
        geometry: Literal["collision", "visual"] = "collision",
        meshes: Literal["exact", "hull"] = "exact",
    ) -> Robot: ...
    @classmethod
    def from_yourdfpy(
        cls,
        urdf: Any,
        srdf: str | PathLike[str] | None = None,
        geometry: Literal["collision", "visual"] = "collision",
        meshes: Literal["exact", "hull"] = "exact",
    ) -> Robot: ...
    @classmethod
    def combined(
        cls,
        robots: Mapping[str, Robot],
        poses: Mapping[str, _Pose] | None = None,
        bases: Mapping[str, Literal["fixed", "planar", "floating"]] | None = None,
        carriers: Mapping[str, str] | None = None,
    ) -> Robot: ...
    @property
    def joint_names(self) -> list[str]: ...
    @property
    def link_names(self) -> list[str]: ...
    @property
    def limits(self) -> NDArray[float64]: ...
    @property
    def checked_pairs(self) -> list[tuple[str, str]]: ...
    @property
    def remarks(self) -> list[str]: ...
    def _joint_column(self, names: list[str], prefix: str, joint: str) -> tuple[str, bool] | None: ...
    def pose(self, link: str, configuration: ArrayLike) -> NDArray[float64]: ...
    def link_trajectory(
        self,
        link: str,
        start: ArrayLike,
        end: ArrayLike,
        duration: float = 1.0,
        seen_from: str | None = None,
    ) -> LinkTrajectory: ...
    def classify_link_contacts(
        self,
        max_boxes: int = 100_000,
        *,
        srdf: str | PathLike[str] | None = None,
        progress: _Progress = None,
    ) -> Table: ...

@final
class Cell:
    def __new__(cls, robot: Robot) -> Cell: ...
    @property
    def robot(self) -> Robot: ...
    def add_obstacle(self, name: str, body: Body, pose: _Pose | None = None) -> None: ...
    def add_plane(self, name: str, pose: _Pose | None = None) -> None: ...
    def move_obstacle(self, name: str, pose: _Pose) -> None: ...
    def remove_obstacle(self, name: str) -> None: ...
    def attach(
        self,
        name: str,
        body: Body,
        link: str,
        pose: _Pose | None = None,
        may_touch: Sequence[str] = ...,
    ) -> None: ...
    def detach(self, name: str) -> None: ...
    def allow_contact(self, a: str, b: str) -> None: ...
    def forbid_contact(self, a: str, b: str) -> None: ...
    @property
    def remarks(self) -> list[str]: ...
    def set_padding(self, link: str, distance: float) -> None: ...
    def set_clearance(self, a: str, b: str, distance: float) -> None: ...
    def is_free(
        self,
        path: ArrayLike | _Curve,
        **settings: Unpack[_OfPathContacts],
    ) -> bool: ...
    def first_contact(
        self,
        path: ArrayLike | _Curve,
        **settings: Unpack[_OfPathContacts],
    ) -> PathContact | None: ...
    def prove(
        self, path: ArrayLike, *, progress: _Progress = None, **settings: Unpack[_OfContacts]
    ) -> list[Proof]: ...
    def closest_approach(
        self,
        path: ArrayLike | _Curve,
        **settings: Unpack[_OfApproaches],
    ) -> PathDistance: ...
    def clearance_ranges(
        self,
        path: ArrayLike | _Curve,
        *,
        resolution: float = ...,
        max_pose_error: float = 0.0,
        **settings: Unpack[_OfContacts],
    ) -> list[PathRange]: ...
    def answer_edges(
        self,
        start: ArrayLike,
        end: ArrayLike,
        /,
        question: Literal["is-free", "first-contact", "closest-approach"] = "is-free",
        *,
        threads: int | None = None,
        progress: _Progress = None,
        **settings: Unpack[_OfPaths],
    ) -> Table: ...
    def answer_paths(
        self,
        paths: ArrayLike | Sequence[_Curve],
        question: Literal["is-free", "first-contact", "closest-approach"] = "is-free",
        *,
        threads: int | None = None,
        progress: _Progress = None,
        **settings: Unpack[_OfPaths],
    ) -> Table: ...
    def __reduce__(self) -> tuple[type[Cell], tuple[Robot], dict[str, Any]]: ...
    def __setstate__(self, state: dict[str, Any]) -> None: ...

@final
class Table:
    def __new__(cls, table: Any) -> Table: ...
    @property
    def column_names(self) -> list[str]: ...
    def keys(self) -> list[str]: ...
    def take(self, rows: ArrayLike) -> Table: ...
    def _column_before(self, name: str, other: Table) -> Table: ...
    @classmethod
    def _from_bytes(cls, stored: bytes, checksum: int) -> Table: ...
    def __reduce__(self) -> tuple[Callable[[bytes, int], Table], tuple[bytes, int]]: ...
    def __len__(self) -> int: ...
    def __contains__(self, name: str, /) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def __getitem__(self, name: str, /) -> NDArray[Any]: ...
    def __array__(self, *_args: object, **_how: object) -> None: ...
    def __arrow_c_schema__(self) -> object: ...
    def __arrow_c_array__(self, requested_schema: object | None = None) -> tuple[object, object]: ...
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...

def first_contact(
    a: Body,
    b: Body,
    motion_a: _Movement | None = None,
    motion_b: _Movement | None = None,
    duration: float | None = None,
    **settings: Unpack[_OfContacts],
) -> Contact | None: ...
def prove(
    a: Body,
    b: Body,
    motion_a: Motion | None = None,
    motion_b: Motion | None = None,
    duration: float | None = None,
    **settings: Unpack[_OfContacts],
) -> Proof: ...
def check_proof(proof: bytes, meshes: Sequence[tuple[bytes, bytes]]) -> str: ...
def proof_statement(proof: bytes) -> str: ...
def read_proof(proof: bytes) -> tuple[float, bool, list[str]]: ...
def is_free(
    a: Body,
    b: Body,
    motion_a: _Movement | None = None,
    motion_b: _Movement | None = None,
    duration: float | None = None,
    **settings: Unpack[_OfContacts],
) -> bool: ...
def closest_approach(
    a: Body,
    b: Body,
    motion_a: _Movement | None = None,
    motion_b: _Movement | None = None,
    duration: float | None = None,
    **settings: Unpack[_OfApproaches],
) -> Distance: ...
def distance(
    a: Body,
    b: Body,
    pose_a: _Pose | None = None,
    pose_b: _Pose | None = None,
    **settings: Unpack[_OfDistances],
) -> Distance: ...
def answer_table(
    question: str,
    a: Body,
    b: Body,
    motions: Any,
    *,
    threads: int | None = None,
    progress: _Progress = None,
    micros: bool = True,
    **settings: Any,
) -> Table: ...
