"""Meshes for measurements: generated or found."""

import math
import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent

# Cells along the turtle's longest side, by the approximate number of triangles: an animal-like smooth union of
# ellipsoids (examples/make_model.cpp), the same solid each time.
TURTLES = {"turtle-6k": 52, "turtle-24k": 104, "turtle-96k": 208, "turtle-1m": 672}
# Kind and triangles of meshes with what scans have (bench/scans/make_scan.cpp).
SCANS = {"bust-24k": ("bust", 24_092), "bust-96k": ("bust", 95_936), "creature-6k": ("creature", 6_000),
         "creature-65k": ("creature", 65_000)}
# The triangles of figures of overlapping and open parts (bench/assemblies/make_figure.cpp), and what else they have.
FIGURES = {"figure-124k": (124_000, []), "figure-124k-sheets": (124_000, ["sheets"])}
GENERATED = ["torus-16k", *TURTLES, *SCANS, *FIGURES]
EXTENSIONS = (".obj", ".ply", ".stl", ".off")


def write_torus(path, around=64, along=125, major=1.0, minor=0.4, flatten=0.5):
    """A flattened torus of 2 * around * along triangles, turned so that no edge is along an axis."""
    c, s = math.cos(0.7), math.sin(0.7)
    with open(path, "w", encoding="ascii") as out:
        for i in range(along):
            for j in range(around):
                phi, psi = 2 * math.pi * i / along, 2 * math.pi * j / around
                ring = major + minor * math.cos(psi)
                x, y, z = ring * math.cos(phi), ring * math.sin(phi), flatten * minor * math.sin(psi)
                x, y = c * x - s * y, s * x + c * y
                y, z = c * y - s * z, s * y + c * z
                out.write(f"v {x:.9f} {y:.9f} {z:.9f}\n")
        for i in range(along):
            for j in range(around):
                a, b = i * around + j, (i + 1) % along * around + j
                d, e = i * around + (j + 1) % around, (i + 1) % along * around + (j + 1) % around
                out.write(f"f {a + 1} {b + 1} {e + 1}\nf {a + 1} {e + 1} {d + 1}\n")


def make(name, folder, programs):
    """The path of a generated mesh, made in `folder` by one of the `programs` if it is not there yet."""
    path = Path(folder) / f"{name}.obj"
    if path.exists():
        return path
    if name == "torus-16k":
        write_torus(path)
    elif name in TURTLES:
        subprocess.run([programs / "make_model", path, str(TURTLES[name])], check=True, stdout=subprocess.DEVNULL)
    elif name in SCANS:
        kind, triangles = SCANS[name]
        subprocess.run([programs / "bench_make_scan", kind, path, str(triangles)], check=True,
                       stdout=subprocess.DEVNULL)
    elif name in FIGURES:
        triangles, rest = FIGURES[name]
        subprocess.run([programs / "bench_make_figure", path, str(triangles), *rest], check=True,
                       stdout=subprocess.DEVNULL)
    else:
        raise SystemExit(f"there is no mesh named {name}; there are {', '.join(GENERATED)}")
    return path


def found_models():
    """The mesh files in the folder that MEDIAL_VK_MODELS names, or in shared/models beside the source tree, if any."""
    folder = Path(os.environ.get("MEDIAL_VK_MODELS") or ROOT.parent / "shared" / "models")
    if not folder.is_dir():
        return []
    return sorted(path for path in folder.iterdir() if path.suffix.lower() in EXTENSIONS)
