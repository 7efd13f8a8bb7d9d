#!/usr/bin/env python3
"""The parts of a shape are its medial sheets: which there are, and how much of the volume each of them holds.

    sheets.py [MESH] [--out FOLDER] [--resolution N]

Without a mesh, the shape is a chair of six boards and a curved back. Writes sheets.png, and sheets.npz with the number of
the sheet of every medial sphere.
"""
import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from boxes import solid_of_boxes

import medial_vk as mv


def chair():
    seat, back = (0, 0, 40, 44, 44, 44), (3, 44, 40, 41, 47, 96)
    sides = [(x, 4, 0, x + 3, 40, 41) for x in (5, 36)]
    arms = [(x, 10, 58, x + 6, 45, 61) for x in (-2, 40)]
    posts = [(x + 1, 10, 43, x + 4, 13, 59) for x in (-2, 41)]
    vertices, triangles = solid_of_boxes([seat, back, *sides, *arms, *posts], size=2)
    above = np.maximum(vertices[:, 2] - 44, 0)
    vertices[:, 1] += above**2 / 250  # the back leans
    return mv.Mesh(vertices, triangles)


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("mesh", nargs="?", help="OBJ, PLY, STL or OFF")
parser.add_argument("--out", type=Path, default=Path("."), help="folder of the results (default: this one)")
parser.add_argument("--resolution", type=int, default=80, help="voxels along the longest side (default: 80)")
arguments = parser.parse_args()
shape = mv.read_mesh(arguments.mesh) if arguments.mesh else chair()

# An object angle of 1 keeps the middle of each board, and leaves out the seams to its edges.
found = mv.analyse(shape, resolution=arguments.resolution, object_angle=1.0, volumes=True)
share = found.significance.of_sheet
order = np.argsort(-share)
needed = 1 + np.searchsorted(np.cumsum(share[order]), 0.95)
print(f"{len(found)} spheres in {len(share)} sheets; {needed} sheets hold 95 % of the volume")
for sheet in order[:needed]:
    print(f"sheet {sheet}: {share[sheet]:6.1%}, thickness {2 * found.sheets.mean_radii[sheet]:.2f}")
found.save(arguments.out / "sheets.npz")

plt.style.use(Path(__file__).with_name("style.mplstyle"))
figure = plt.figure(figsize=(11, 5), layout="constrained")
view = figure.add_subplot(1, 2, 1, projection="3d", elev=18, azim=-58)
view.set_axis_off()
shape.plot(view, colour="#94a3b8", alpha=0.12)
chart = figure.add_subplot(1, 2, 2)
for place, sheet in enumerate(order[share[order] > 0.01][:10]):
    colour = f"C{place % 10}"
    points = found.spheres.centres[found.spheres.sheets == sheet]
    view.scatter(*points.T, s=7, color=colour)
    bar = chart.barh(place, 100 * share[sheet], color=colour)
    chart.bar_label(bar, [f"{100 * share[sheet]:.1f} %, {2 * found.sheets.mean_radii[sheet]:.1f} thick"], padding=4)
view.set_title("A chair by medial sheets")
chart.set(title="What each sheet holds", xlabel="share of the volume, %", ylabel="sheet", yticks=[])
chart.set_xlim(0, 150 * share.max())
chart.invert_yaxis()
figure.savefig(arguments.out / "sheets.png")
