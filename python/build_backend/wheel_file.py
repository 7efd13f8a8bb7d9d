"""Wheels and source archives as files, with the same bytes for the same content."""

from __future__ import annotations

import base64
import gzip
import hashlib
import io
import os
import re
import tarfile
import time
import tomllib
import zipfile
from dataclasses import dataclass
from pathlib import Path



@dataclass
class Metadata:
    """Of a package, from pyproject.toml and the header with the version."""

    project: dict[str, object]
    version: str
    readme: str

    @classmethod
    def read(cls, root: Path) -> Metadata:
        """From the source tree."""
        project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        header = (root / "runtime/include/medial_vk/version.h").read_text(encoding="utf-8")
        version = ".".join(re.findall(r"#define MEDIAL_VK_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))
        return cls(project, version, (root / project["readme"]).read_text(encoding="utf-8"))

    @property
    def distribution(self) -> str:
        """The name and version in file names."""
        return f"{str(self.project['name']).replace('-', '_')}-{self.version}"

    def text(self) -> str:
        """METADATA (core metadata 2.1)."""
        project = self.project
        lines = [
            "Metadata-Version: 2.1",
            f"Name: {project['name']}",
            f"Version: {self.version}",
            f"Summary: {project['description']}",
            "License: MIT",
            f"Requires-Python: {project['requires-python']}",
        ]
        lines += [f"Classifier: {name}" for name in project["classifiers"]]
        lines += [f"Requires-Dist: {name}" for name in project["dependencies"]]
        for extra, names in project["optional-dependencies"].items():
            lines.append(f"Provides-Extra: {extra}")
            lines += [f"Requires-Dist: {name}; extra == '{extra}'" for name in names]
        lines.append("Description-Content-Type: text/markdown")
        return "\n".join(lines) + "\n\n" + self.readme


def moment() -> int:
    """Seconds since 1970 for all files: SOURCE_DATE_EPOCH, or the first that a zip can hold."""
    return max(int(os.environ.get("SOURCE_DATE_EPOCH", "0")), 315532800)


def write_wheel(folder: Path, staged: Path, metadata: Metadata, tag: str, licences: dict[str, bytes]) -> str:
    """Packs the files below ``staged`` with what a wheel has besides (PEP 427); returns the name of the wheel."""
    files = {path.relative_to(staged).as_posix(): path.read_bytes() for path in staged.rglob("*") if path.is_file()}
    info = f"{metadata.distribution}.dist-info"
    about = {f"licenses/{name}": text for name, text in licences.items()}
    about["METADATA"] = metadata.text().encode()
    about["WHEEL"] = f"Wheel-Version: 1.0\nGenerator: medial_vk_backend\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    ordered = sorted(files.items()) + sorted((f"{info}/{name}", text) for name, text in about.items())
    record = "".join(f"{name},sha256={digest(text)},{len(text)}\n" for name, text in ordered)
    ordered.append((f"{info}/RECORD", f"{record}{info}/RECORD,,\n".encode()))
    name = f"{metadata.distribution}-{tag}.whl"
    with zipfile.ZipFile(folder / name, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path, text in ordered:
            entry = zipfile.ZipInfo(path, time.gmtime(moment())[:6])
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if ".so" in path else 0o100644) << 16
            archive.writestr(entry, text)
    return name


def write_sdist(folder: Path, root: Path, names: list[str], metadata: Metadata) -> str:
    """Packs these files of the source tree, and PKG-INFO; returns the name of the archive."""
    archive = io.BytesIO()
    with tarfile.open(fileobj=archive, mode="w", format=tarfile.PAX_FORMAT) as tar:
        for name in sorted(names):
            add(tar, f"{metadata.distribution}/{name}", (root / name).read_bytes(), os.access(root / name, os.X_OK))
        add(tar, f"{metadata.distribution}/PKG-INFO", metadata.text().encode(), False)
    name = f"{metadata.distribution}.tar.gz"
    (folder / name).write_bytes(gzip.compress(archive.getvalue(), mtime=moment()))
    return name


def add(tar: tarfile.TarFile, name: str, content: bytes, is_program: bool) -> None:
    """Adds a file without anything of this machine."""
    entry = tarfile.TarInfo(name)
    entry.size, entry.mtime, entry.mode = len(content), moment(), 0o755 if is_program else 0o644
    tar.addfile(entry, io.BytesIO(content))


def digest(content: bytes) -> str:
    """As RECORD has it."""
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
