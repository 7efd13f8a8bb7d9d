#!/usr/bin/env python3
"""How thick are the walls of a part, and where is the thinnest one?

    thickness.py [MESH] [--out FOLDER]

Without a mesh, the part is a bracket in millimetres, with a pocket whose floor is only 1.2 mm thick. Writes thickness.png
and prints the thinnest wall with its proof.
"""
import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from boxes import solid_of_boxes

import medial_vk as mv


def bracket():
    plates = [(0, 0, 0, 60, 40, 5), (0, 36, 0, 60, 40, 45)]
    rib = (28, 16, 0, 32, 40, 30)
    pocket, slots = (38, 35, 14, 54, 38.8, 38), [(8, 10, -1, 20, 22, 6), (40, 10, -1, 52, 22, 6)]
    return mv.Mesh(*solid_of_boxes([*plates, rib], [pocket, *slots], size=2))


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("mesh", nargs="?", help="OBJ, PLY, STL or OFF")
parser.add_argument("--out", type=Path, default=Path("."), help="folder of the picture (default: this one)")
arguments = parser.parse_args()
part = mv.read_mesh(arguments.mesh) if arguments.mesh else bracket()

# The thinnest wall anywhere, with a proof that no wall is thinner.
least = mv.least_wall(part)
print(f"thinnest wall: {least.lower:.4f} to {least.upper:.4f}, at {np.round(least.thinnest.centre, 2)}")

# The thickness in the middle of each triangle, as an interval that is proved; near edges no wall limits the ball.
corners = part.vertices[part.triangles]
areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
walls = mv.thickness(part, corners.mean(axis=1))
in_walls = walls.in_walls
widest = np.max(walls.upper[in_walls] - walls.lower[in_walls])
print(f"{np.count_nonzero(in_walls)} of {len(areas)} triangles in walls; intervals are at most {widest:.3f} wide")
thin = in_walls & (walls.lower < 2 * least.upper)
print(f"walls thinner than {2 * least.upper:.2f}: {areas[thin].sum() / areas.sum():.1%} of the surface")

plt.style.use(Path(__file__).with_name("style.mplstyle"))
figure = plt.figure(figsize=(11, 4.6), layout="constrained")
view = figure.add_subplot(1, 2, 1, projection="3d", elev=24, azim=-58, computed_zorder=False)
view.set_axis_off()
part.plot(view, colour=np.where(in_walls, walls.lower, np.nan), label="thickness, mm")
view.scatter(*least.thinnest.contacts.T, s=140, color="none", edgecolors="#dc2626", linewidths=2.5, zorder=9)
view.set_title("Walls by thickness, the thinnest circled (grey: edges)")
chart = figure.add_subplot(1, 2, 2)
edges = np.linspace(0, 1.05 * walls.upper[in_walls].max(), 40)
chart.hist(walls.lower[in_walls], edges, weights=100 * areas[in_walls] / areas.sum(), label="lower ends of the intervals")
chart.axvline(least.upper, color="#dc2626", label=f"thinnest wall: {least.upper:.2f} mm")
chart.set(xlabel="thickness, mm", ylabel="share of the surface, %", title="Thickness by area")
chart.margins(y=0.25)
chart.legend(loc="upper left")
figure.savefig(arguments.out / "thickness.png")
