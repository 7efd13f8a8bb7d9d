"""Vulkan devices, and the contexts in which they compute."""

from __future__ import annotations

import os
import threading

from . import _native
from ._results import Result


class Device(Result):
    """A device as Vulkan lists it."""

    index: int  #: Its position in Vulkan's list.
    name: str
    type: str  #: "discrete", "integrated", "virtual", "cpu" or "other".
    driver: str  #: Name and version.
    memory_bytes: int  #: Of its largest heap.
    usable: bool
    why_not: list[str]  #: If it is not usable: every reason.


class Context:
    """A device, ready to compute. Threads may share a context: one at a time uses it, and the others wait. Contexts
    share nothing, so that several compute at once.

    Args:
        device: An index, or part of a name; empty: the environment variable ``MEDIAL_VK_DEVICE``, else the best device.
        threads: Of the host, for work on this context; 0: one per core.
        validation: Enables the Khronos validation layer.
        cache_folder: Of the pipeline cache; empty: that of the user.

    Raises:
        NoDeviceError: No device is usable; the message has the reasons.
    """

    def __init__(self, device: str | int = "", *, threads: int = 0, validation: bool = False, cache_folder: str | os.PathLike[str] = "") -> None:
        self._native = _native.open_context(
            {"device": str(device), "threads": threads, "validation": validation, "cache_folder": os.fspath(cache_folder)}
        )

    @property
    def device(self) -> Device:
        """The device on which it computes."""
        return Device(**self._native.device())

    def __repr__(self) -> str:
        return f"Context({self.device.name!r})"


def list_devices() -> list[Device]:
    """All devices, in Vulkan's order, with the reasons why some are not usable.

    Raises:
        NoDeviceError: There is no loader or no driver of Vulkan.
    """
    return [Device(**values) for values in _native.list_devices()]


_lock = threading.Lock()
_default: list[Context] = []


def _renew_lock() -> None:
    global _lock
    _lock = threading.Lock()  # another thread may have held it at the fork


os.register_at_fork(after_in_child=_renew_lock)


def default_context() -> Context:
    """The context of calls without a ``context``: made at the first of them, on the best device or that of the
    environment variable ``MEDIAL_VK_DEVICE``, and shared by all threads. A process that was forked off makes its own."""
    with _lock:
        if not _default or not _default[-1]._native.is_here():
            _default.append(Context())
        return _default[-1]


def native_context(context: Context | None) -> _native.Context:
    """The object of the library."""
    return (context if context is not None else default_context())._native
