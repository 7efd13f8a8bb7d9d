"""What all results share: named fields that cannot be assigned, and a short text.

Data classes of the standard library would do, but their import takes as long as that of all of this package."""

from __future__ import annotations

from typing import Any, ClassVar


class Result:
    """A record with named fields, which are its annotations. Arrays belong to it; it is equal to nothing but itself,
    since comparisons of arrays have no truth value."""

    _fields: ClassVar[tuple[str, ...]] = ()

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        own = tuple(name for name in cls.__dict__.get("__annotations__", {}) if name != "_fields")
        cls._fields = cls._fields + own

    def __init__(self, **values: Any) -> None:
        if tuple(values) != self._fields and set(values) != set(self._fields):
            raise TypeError(f"{type(self).__name__} has the fields {self._fields}, not {tuple(values)}")
        self.__dict__.update(values)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"{name} of {type(self).__name__} cannot be assigned")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"{name} of {type(self).__name__} cannot be deleted")

    def __repr__(self) -> str:
        shown = (name for name in self._fields if not name.startswith("_"))
        return f"{type(self).__name__}({', '.join(f'{name}={_short(getattr(self, name))}' for name in shown)})"


def _short(value: object) -> str:
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple) and shape not in ((), (2,), (3,)):
        return f"<{getattr(value, 'dtype', '')} array of shape {shape}>"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, list) and len(value) > 4:
        return f"<list of {len(value)}>"
    return repr(value)
