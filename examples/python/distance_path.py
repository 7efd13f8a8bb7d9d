#!/usr/bin/env python3
"""The distance between two parts over a path, and their first contact.

    distance_path.py [--out FOLDER]

A ring turns as it is lowered into a fork. Balls give an interval for each pose in microseconds, triangles the distance
itself, and conservative steps the first contact between the poses, too. Writes distance_path.png and distance_path.csv.
"""
import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from boxes import solid_of_boxes

import medial_vk as mv


def fork():
    return mv.Mesh(*solid_of_boxes([(-4, -2, -6, 4, 2, -4), (-4, -2, -5, -2.5, 2, 3), (2.5, -2, -5, 4, 2, 3)], size=0.5))


def ring(major=1.6, minor=0.5, around=60, across=24):
    turn, roll = (2 * np.pi * np.arange(n) / n for n in (around, across))
    u, v = np.meshgrid(turn, roll, indexing="ij")
    far = major + minor * np.cos(v)
    vertices = np.stack([far * np.cos(u), far * np.sin(u), minor * np.sin(v)], axis=-1).reshape(-1, 3)
    a = np.arange(around * across).reshape(around, across)
    b, d = np.roll(a, -1, axis=0), np.roll(a, -1, axis=1)
    c = np.roll(b, -1, axis=1)
    return mv.Mesh(vertices, np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)]))


def pose(time):
    """A line down into the fork, and half of a turn about the axis across it; time goes from 0 to 1."""
    angle, matrix = np.pi * 0.9 * time, np.eye(4)
    matrix[[0, 2, 0, 2], [0, 2, 2, 0]] = np.cos(angle), np.cos(angle), np.sin(angle), -np.sin(angle)
    matrix[:3, 3] = (1 - time) * np.array([1.0, 0.0, 8.0]) + time * np.array([0.0, 0.0, -5.0])
    return matrix


def body(mesh):
    return mv.Body(mesh, mv.fit_spheres(mesh, 128, balls_only=True),
                   mv.fit_spheres(mesh, 128, contract="cover", balls_only=True))


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--out", type=Path, default=Path("."), help="folder of the results (default: this one)")
arguments = parser.parse_args()
a_mesh, b_mesh = fork(), ring()
a, b = body(a_mesh), body(b_mesh)

times = np.linspace(0, 1, 401)
poses = np.stack([pose(time) for time in times])
balls = mv.distance_bounds(a, b, poses)
exact = mv.distances(a, b, poses)
contact = mv.first_contact(a, b, pose(0), pose(1))
print(f"free until {contact.free_until:.6f}, {contact.verdict} at {contact.contact_at:.6f}")
decided = np.count_nonzero(balls.verdicts != mv.VERDICTS.index("undecided"))
print(f"balls alone decide {decided} of {len(times)} poses; their intervals are {np.mean(balls.upper - balls.lower):.3f} wide")
table = np.column_stack([times, balls.lower, balls.upper, exact.lower, exact.upper])
np.savetxt(arguments.out / "distance_path.csv", table, delimiter=",", comments="",
           header="time,lower_by_balls,upper_by_balls,lower,upper")

plt.style.use(Path(__file__).with_name("style.mplstyle"))
figure = plt.figure(figsize=(11, 4.6), layout="constrained")
view = figure.add_subplot(1, 2, 1, projection="3d", elev=12, azim=-70)
view.set_axis_off()
a_mesh.plot(view, colour="#94a3b8")
for time, colour in zip((0.0, 0.5 * contact.contact_at, contact.contact_at), ("#93c5fd", "#3b82f6", "#ea580c")):
    matrix = pose(time)
    b_mesh.moved(b_mesh.vertices @ matrix[:3, :3].T + matrix[:3, 3]).plot(view, colour=colour)
view.set_title("A ring falls into a fork")
chart = figure.add_subplot(1, 2, 2)
chart.fill_between(times, balls.lower, balls.upper, color="#bfdbfe", label="interval by balls")
chart.plot(times, exact.upper, color="#1e3a8a", label="distance by triangles")
chart.axvline(contact.contact_at, color="#ea580c", linestyle="--", label=f"first contact, {contact.contact_at:.4f}")
chart.set(xlabel="time", ylabel="distance", xlim=(0, 1), ylim=(0, None), title="Distance over the path")
chart.legend()
figure.savefig(arguments.out / "distance_path.png")
