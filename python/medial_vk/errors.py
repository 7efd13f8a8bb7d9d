"""The exceptions of this package: one for each kind of error of the library."""

from __future__ import annotations


class Error(Exception):
    """The base of all of them. The text names what is at fault."""


class UsageError(Error, ValueError):
    """An argument that the call does not accept; the message names it."""


class InvalidMeshError(Error, ValueError):
    """A mesh with an index out of range, a coordinate that is not finite, no extent, or nothing enclosed."""


class NoDeviceError(Error, RuntimeError):
    """No usable Vulkan device; the message lists those that were found, with reasons."""


class OutOfMemoryError(Error, MemoryError):
    """The memory of the host or of the device does not suffice."""


class StoppedError(Error, RuntimeError):
    """The call was stopped. Calls that Ctrl-C or a progress function ends raise the exception of those instead."""


class InternalError(Error, RuntimeError):
    """A defect of the library, or a device that was lost."""
