from os import PathLike
from typing import Any, Literal, Protocol, TypeAlias, final

from numpy import float64
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Body",
    "Contact",
    "Distance",
    "InputError",
    "Motion",
    "Unresolved",
    "closest_approach",
    "distance",
    "first_contact",
    "is_free",
]

class _ScipyRotation(Protocol):
    def as_matrix(self) -> Any: ...

class _Mesh(Protocol):
    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...

_Rotation: TypeAlias = ArrayLike | _ScipyRotation
_Pose: TypeAlias = ArrayLike | tuple[ArrayLike, _Rotation]
_Point: TypeAlias = tuple[float, float, float]
_Pieces: TypeAlias = Literal["auto", "triangles", "patches", "hull"]
_Unit: TypeAlias = Literal["um", "mm", "cm", "m", "in", "ft"]

class InputError(ValueError): ...

class Unresolved(RuntimeError):
    safe_until: float

@final
class Body:
    def __new__(cls, vertices: ArrayLike, faces: ArrayLike, *, pieces: _Pieces = "auto") -> Body: ...
    @classmethod
    def from_file(
        cls,
        path: str | PathLike[str],
        *,
        part: str | None = None,
        unit: _Unit | None = None,
        pieces: _Pieces = "auto",
    ) -> Body: ...
    @classmethod
    def from_trimesh(cls, mesh: _Mesh, *, pieces: _Pieces = "auto") -> Body: ...
    @classmethod
    def box(cls, x: float, y: float, z: float) -> Body: ...
    @classmethod
    def sphere(cls, radius: float) -> Body: ...
    @classmethod
    def capsule(cls, radius: float, half_height: float) -> Body: ...
    @property
    def is_solid(self) -> bool: ...
    @property
    def pieces(self) -> int: ...
    @property
    def report(self) -> str: ...

@final
class Motion:
    def __new__(
        cls,
        position: ArrayLike | None = None,
        rotation: _Rotation | None = None,
        velocity: ArrayLike | None = None,
        spin: ArrayLike | None = None,
        center: ArrayLike | None = None,
    ) -> Motion: ...
    @classmethod
    def between(
        cls, start: _Pose, end: _Pose, *, duration: float = 1.0, center: ArrayLike | None = None
    ) -> Motion: ...
    def pose(self, time: float) -> NDArray[float64]: ...

@final
class Contact:
    @property
    def time(self) -> float: ...
    @property
    def kind(self) -> Literal["contact", "touching", "overlapping"]: ...
    @property
    def witness_a(self) -> _Point: ...
    @property
    def witness_b(self) -> _Point: ...
    @property
    def normal(self) -> _Point | None: ...
    @property
    def distance(self) -> tuple[float, float] | None: ...
    @property
    def feature_a(self) -> str | None: ...
    @property
    def feature_b(self) -> str | None: ...

@final
class Distance:
    @property
    def lower(self) -> float: ...
    @property
    def upper(self) -> float: ...
    @property
    def time(self) -> float: ...
    @property
    def witness_a(self) -> _Point | None: ...
    @property
    def witness_b(self) -> _Point | None: ...

def first_contact(
    a: Body,
    b: Body,
    motion_a: Motion | None = None,
    motion_b: Motion | None = None,
    duration: float = 1.0,
    *,
    tolerance: float = 1e-3,
    margin: float = 0.0,
    budget: int | None = None,
    deadline: float | None = None,
) -> Contact | None: ...
def is_free(
    a: Body,
    b: Body,
    motion_a: Motion | None = None,
    motion_b: Motion | None = None,
    duration: float = 1.0,
    *,
    tolerance: float = 1e-3,
    margin: float = 0.0,
    budget: int | None = None,
    deadline: float | None = None,
) -> bool: ...
def closest_approach(
    a: Body,
    b: Body,
    motion_a: Motion | None = None,
    motion_b: Motion | None = None,
    duration: float = 1.0,
    *,
    tolerance: float = 1e-3,
    budget: int | None = None,
    deadline: float | None = None,
) -> Distance: ...
def distance(
    a: Body,
    b: Body,
    pose_a: _Pose | None = None,
    pose_b: _Pose | None = None,
    *,
    tolerance: float = 1e-3,
) -> Distance: ...
