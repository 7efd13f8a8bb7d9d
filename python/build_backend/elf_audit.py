"""What a native module needs from the system that loads it, and the platform tag that is true of it (PEP 600)."""

from __future__ import annotations

import re
import subprocess
import sysconfig
from pathlib import Path

#: Part of glibc, which a manylinux tag promises. Vulkan's loader is opened at run time, if it is there.
OF_GLIBC = re.compile(r"(libc|libm|libdl|libpthread|librt|ld-linux[-\w]*)\.so\.\d+")


def audited_tag(module: Path, private: list[Path]) -> str:
    """``manylinux_X_Y_ARCH`` for the highest version of glibc that the module needs.

    Raises SystemExit if it needs another library, exports more than its entry, has a search path, or holds one of the
    ``private`` paths.
    """
    dynamic = text_of("objdump", "-p", module)
    needed = re.findall(r"NEEDED\s+(\S+)", dynamic)
    foreign = [name for name in needed if not OF_GLIBC.fullmatch(name)]
    require(not foreign, f"it needs {', '.join(foreign)}")
    require("RPATH" not in dynamic and "RUNPATH" not in dynamic, "it has a search path for libraries")
    symbols = text_of("objdump", "-T", module).splitlines()
    exported = [line.split()[-1] for line in symbols if re.search(r" [gwui].* \.\w+\s", line) and "*UND*" not in line]
    require(exported == ["PyInit__native"], f"it exports {exported}")
    content = module.read_bytes()
    held = [str(path) for path in private if len(path.parts) > 1 and str(path).encode() + b"/" in content]
    require(not held, f"it holds the paths {held}")
    versions = re.findall(r"GLIBC_(\d+)\.(\d+)", "\n".join(symbols))
    require(bool(versions), "it needs no glibc, for which alone there is a tag here")
    major, minor = max((int(a), int(b)) for a, b in versions)
    return f"manylinux_{major}_{minor}_{sysconfig.get_platform().rsplit('-', 1)[-1]}"


def require(condition: bool, what: str) -> None:
    """Ends the build with the reason."""
    if not condition:
        raise SystemExit(f"medial-vk: the native module is not fit for a wheel: {what}")


def text_of(*command: object) -> str:
    """The output of a program."""
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True).stdout
