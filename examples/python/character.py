#!/usr/bin/env python3
"""Balls in a character that moves: they stay inside it in every frame, by proof.

    character.py [--out FOLDER] [--frames N]

A figure made of smoothed boxes twists and waves. Writes character.npz with the balls of all frames, and character.png.
"""
import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from boxes import smoothed, solid_of_boxes

import medial_vk as mv


def figure_of_boxes():
    body, neck, head = (-3.5, -2.5, 8, 3.5, 2.5, 20), (-2, -2, 20, 2, 2, 22), (-4, -3.5, 22, 4, 3.5, 29)
    arms = [(3.5, -1.5, 16, 13, 1.5, 19), (-13, -1.5, 16, -3.5, 1.5, 19)]
    legs = [(0.8, -2, 0, 3.5, 2, 8), (-3.5, -2, 0, -0.8, 2, 8)]
    vertices, triangles = solid_of_boxes([body, neck, head, *arms, *legs], size=0.75)
    return mv.Mesh(smoothed(vertices, triangles, 12), triangles)


def posed(points, phase):
    """The vertices at a phase of the motion, from 0 to 2 pi: arms go up and down, and the body twists and bends."""
    x, y, z = points.T
    side, lift = np.sign(x), 0.9 * np.sin(phase)
    angle = side * lift * np.clip((np.abs(x) - 4) / 4, 0, 1)  # about the shoulders, at x = 4 and -4, z = 17.5
    along, above = x - 4 * side, z - 17.5
    x, z = (4 * side + np.cos(angle) * along - np.sin(angle) * above, 17.5 + np.sin(angle) * along + np.cos(angle) * above)
    x = x + 0.008 * np.sin(phase) * z**2
    turn = 0.04 * np.sin(phase + 0.6) * z
    return np.column_stack([np.cos(turn) * x - np.sin(turn) * y, np.sin(turn) * x + np.cos(turn) * y, z])


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--out", type=Path, default=Path("."), help="folder of the results (default: this one)")
parser.add_argument("--frames", type=int, default=24, help="frames of one round of the motion (default: 24)")
arguments = parser.parse_args()
rest = figure_of_boxes()

follower = mv.Follower(rest, mv.fit_spheres(rest, 128, balls_only=True))
rest_heights = follower.balls.centres[:, 2]
frames, solid, balls, proved = [], [], [], 0
phases = np.linspace(0, 2 * np.pi, arguments.frames, endpoint=False)
for phase in phases:
    vertices = posed(rest.vertices, phase)
    frame = follower.update(vertices)
    measures = follower.measure()
    proved += mv.prove_spheres(rest.moved(vertices), frame).inside.proved  # from the numbers alone
    frames.append(frame)
    solid.append(measures.solid_volume)
    balls.append(measures.ball_volume)
print(f"{proved} of {len(frames)} frames proved: no ball reaches out")
print(f"balls fill {np.min(np.divide(balls, solid)):.1%} to {np.max(np.divide(balls, solid)):.1%} of the figure")
np.savez(arguments.out / "character.npz", centre=[f.centres for f in frames], radius=[f.radii for f in frames])

plt.style.use(Path(__file__).with_name("style.mplstyle"))
figure = plt.figure(figsize=(12, 4.2), layout="constrained")
chosen = [0, arguments.frames // 4, 3 * arguments.frames // 4]
for place, number in enumerate(chosen):
    view = figure.add_subplot(1, 4, place + 1, projection="3d", elev=8, azim=-75)
    view.set_axis_off()
    view.set_title(f"Frame {number}")
    frames[number].plot(view, colour=rest_heights, mesh=rest.moved(posed(rest.vertices, phases[number])))
chart = figure.add_subplot(1, 4, 4)
chart.plot(solid, label="figure")
chart.plot(balls, label="union of the balls")
chart.set(xlabel="frame", ylabel="volume", title="Volume over time", ylim=(0, 1.15 * np.max(solid)))
chart.legend(loc="lower center")
figure.savefig(arguments.out / "character.png")
