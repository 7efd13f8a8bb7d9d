"""The build backend of the Python package (PEP 517): CMake builds the native module, and this module packs the wheel.

Nothing is downloaded. Required are CMake, Ninja, a compiler and the development packages that README.md lists;
``scripts/install-dependencies --python`` installs them on Debian 12. The wheel is reproducible: the same sources, compiler
and Python give the same bytes."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from elf_audit import audited_tag  # noqa: E402
from wheel_file import Metadata, write_sdist, write_wheel  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
#: Copyright files of what the module holds: by Debian package.
HELD = ("libeigen3-dev", "libfmt-dev", "libvulkan-volk-dev", "nlohmann-json3-dev", "pybind11-dev", "libstdc++6")


def get_requires_for_build_wheel(config_settings: dict[str, str] | None = None) -> list[str]:
    """Programs of the system are needed, and no Python packages."""
    return []


def get_requires_for_build_editable(config_settings: dict[str, str] | None = None) -> list[str]:
    """As for a wheel."""
    return []


def get_requires_for_build_sdist(config_settings: dict[str, str] | None = None) -> list[str]:
    """Git lists the files of a source archive."""
    return []


def build_wheel(
    wheel_directory: str, config_settings: dict[str, str] | None = None, metadata_directory: str | None = None
) -> str:
    """Builds the wheel and returns its name."""
    require_programs()
    with tempfile.TemporaryDirectory() as folder:
        staged = Path(folder) / "staged"
        build = build_folder(Path(folder))
        build_module(build)
        run("cmake", "--install", build, "--component", "python", "--prefix", staged)
        module = next((staged / "medial_vk").glob("_native.*"))
        tag = f"{python_tag()}-{audited_tag(module, [ROOT, build, Path.home()])}"
        return write_wheel(Path(wheel_directory), staged, Metadata.read(ROOT), tag, licences())


def build_editable(
    wheel_directory: str, config_settings: dict[str, str] | None = None, metadata_directory: str | None = None
) -> str:
    """Builds the native module in this tree, and a wheel that has no more than the path to the package there (PEP 660). It
    consists of links to the sources, so that changes of them count at once; after changes of C++, and new files, it is
    built again."""
    require_programs()
    with tempfile.TemporaryDirectory() as folder:
        build = build_folder(Path(folder))
        if not build.is_relative_to(ROOT):
            raise SystemExit(f"medial-vk: {ROOT} cannot be written to: an editable installation has its module there")
        build_module(build)
        path = link_package(build)
        staged = Path(folder) / "staged"
        staged.mkdir()
        (staged / "medial_vk_editable.pth").write_text(f"{path}\n", encoding="utf-8")
        tag = f"{python_tag()}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
        return write_wheel(Path(wheel_directory), staged, Metadata.read(ROOT), tag, licences())


def link_package(build: Path) -> Path:
    """A folder with a package of links to the sources and to the native module of a build."""
    path = ROOT / "build" / f"editable-{python_tag()}"
    shutil.rmtree(path, ignore_errors=True)
    package = path / "medial_vk"
    package.mkdir(parents=True)
    sources = [file for file in (ROOT / "python" / "medial_vk").iterdir() if file.suffix in (".py", ".pyi", ".typed")]
    for file in [*sources, next((build / "python" / "medial_vk").glob("_native.*.so"))]:
        (package / file.name).symlink_to(file)
    return path


def build_module(build: Path) -> None:
    """Compiles what has changed."""
    run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", *cmake_options(build))
    run("cmake", "--build", build, "--target", "medial_vk_python")


def build_sdist(sdist_directory: str, config_settings: dict[str, str] | None = None) -> str:
    """Packs the tracked files, from which a wheel can be built, and returns the name of the archive."""
    if not (ROOT / ".git").exists():
        raise SystemExit("medial-vk: a source archive is made in a checkout, where git lists the files")
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True).stdout
    return write_sdist(Path(sdist_directory), ROOT, listed.decode().split("\0")[:-1], Metadata.read(ROOT))


def require_programs() -> None:
    """Ends with a message that names what is missing."""
    missing = [name for name in ("cmake", "ninja", "c++", "objdump") if shutil.which(name) is None]
    if missing:
        raise SystemExit(
            f"medial-vk: {', '.join(missing)} not found. Install what README.md lists; on Debian 12:\n"
            "  scripts/install-dependencies --python"
        )


def build_folder(temporary: Path) -> Path:
    """In the source tree, so that another build compiles only what has changed; elsewhere, if that is read-only."""
    inside = ROOT / "build" / f"wheel-{python_tag()}"
    try:
        cache = inside / "CMakeCache.txt"
        if cache.is_file() and f"CMAKE_HOME_DIRECTORY:INTERNAL={ROOT}\n" not in cache.read_text(encoding="utf-8"):
            shutil.rmtree(inside)  # the tree has been moved or copied
        inside.mkdir(parents=True, exist_ok=True)
        return inside if os.access(inside, os.W_OK) else temporary / "build"
    except OSError:
        return temporary / "build"


def cmake_options(build: Path) -> list[str]:
    """Only the module is built, with all that it needs linked into it."""
    prefix_map = f"-ffile-prefix-map={ROOT}=. -ffile-prefix-map={build}=build"
    options = {
        "CMAKE_BUILD_TYPE": "Release",
        "CMAKE_UNITY_BUILD": "ON",
        "CMAKE_C_FLAGS": f"{os.environ.get('CFLAGS', '')} {prefix_map}".strip(),
        "CMAKE_CXX_FLAGS": f"{os.environ.get('CXXFLAGS', '')} {prefix_map}".strip(),
        "MEDIAL_VK_BUILD_EXAMPLES": "OFF",
        "MEDIAL_VK_BUILD_PYTHON": "ON",
        "MEDIAL_VK_BUILD_TESTS": "OFF",
        "MEDIAL_VK_PORTABLE_MODULE": "ON",
        "MEDIAL_VK_PYTHON_DIR": ".",
        "MEDIAL_VK_USE_ASSIMP": "OFF",
        "Python3_EXECUTABLE": sys.executable,
    }
    if shutil.which("ccache") and "CMAKE_CXX_COMPILER_LAUNCHER" not in os.environ:
        options["CMAKE_C_COMPILER_LAUNCHER"] = options["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
    return [f"-D{name}={value}" for name, value in options.items()]


def python_tag() -> str:
    """Of this Python and its ABI: pybind11 needs a wheel for each."""
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{version}-{version}{sysconfig.get_config_var('abiflags') or ''}"


def licences() -> dict[str, bytes]:
    """The project's licence, and the notices of the libraries in the module, where the system has them."""
    texts = {"LICENSE": (ROOT / "LICENSE").read_bytes()}
    for package in HELD:
        notice = Path("/usr/share/doc") / package / "copyright"
        if notice.is_file():
            texts[f"third_party/{package}.txt"] = notice.read_bytes()
        else:
            print(f"medial-vk: {notice} is missing: add the notice before you pass the wheel on", file=sys.stderr)
    return texts


def run(*command: object) -> None:
    """Runs a program, whose output goes to that of the build."""
    status = subprocess.run([str(word) for word in command]).returncode
    if status != 0:
        raise SystemExit(f"medial-vk: {command[0]} failed with the exit code {status}")
