#!/usr/bin/env python3
"""Balls in the place of a robot's links, for a planner that must never miss a collision.

    robot_spheres.py [ROBOT.urdf] [--out FOLDER] [--count N] [--contract cover|inside]

Without a URDF, the robot is the arm of examples/robot_arm. The balls of each link cover all of its visual mesh, by proof.
Writes robot_spheres.yml, which cuRobo reads, and robot_spheres.png.
"""
import argparse
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import medial_vk as mv


def motion_of(origin):
    """The matrix of an <origin>: a turn by roll, pitch and yaw, then a shift."""
    matrix = np.eye(4)
    if origin is not None:
        roll, pitch, yaw = map(float, origin.get("rpy", "0 0 0").split())
        for axis, angle in ((2, yaw), (1, pitch), (0, roll)):
            turn, (u, v) = np.eye(4), ((axis + 1) % 3, (axis + 2) % 3)
            turn[[u, v, u, v], [u, v, v, u]] = np.cos(angle), np.cos(angle), -np.sin(angle), np.sin(angle)
            matrix = matrix @ turn
        matrix[:3, 3] = list(map(float, origin.get("xyz", "0 0 0").split()))
    return matrix


def placed(points, matrix):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("robot", nargs="?", type=Path, help="URDF with a visual mesh for each link")
parser.add_argument("--out", type=Path, default=Path("."), help="folder of the results (default: this one)")
parser.add_argument("--count", type=int, default=24, help="balls per link (default: 24)")
parser.add_argument("--contract", choices=("cover", "inside"), default="cover", help="what is proved (default: cover)")
arguments = parser.parse_args()
if arguments.robot is None:
    maker = Path(__file__).parents[1] / "robot_arm" / "make_arm.py"
    subprocess.run([sys.executable, maker, arguments.out], check=True)
    arguments.robot = arguments.out / "robot_arm" / "arm.urdf"
robot = ElementTree.parse(arguments.robot).getroot()

# Where each link stands, with all joints at 0: a URDF names parents before children here.
pose = {robot.find("link").get("name"): np.eye(4)}
for joint in robot.iter("joint"):
    parent, child = joint.find("parent").get("link"), joint.find("child").get("link")
    pose[child] = pose[parent] @ motion_of(joint.find("origin"))

plt.style.use(Path(__file__).with_name("style.mplstyle"))
figure = plt.figure(figsize=(9, 4.4), layout="constrained")
views = [figure.add_subplot(1, 2, i + 1, projection="3d", elev=14, azim=-62) for i in range(2)]
plain = np.format_float_positional  # YAML reads 1e-05 as a word
lines, total = ["collision_spheres:"], 0
for number, link in enumerate(robot.iter("link")):
    name, visual, shape = link.get("name"), link.find("visual"), link.find("visual/geometry/mesh")
    raw = mv.read_mesh(arguments.robot.parent / shape.get("filename").replace("package://robot_arm/", ""))
    scale = np.array(list(map(float, shape.get("scale", "1 1 1").split())))
    mesh = raw.moved(placed(scale * raw.vertices, motion_of(visual.find("origin"))))  # in metres, in the link's frame

    fit = mv.fit_spheres(mesh, arguments.count, contract=arguments.contract, balls_only=True)
    proof = getattr(mv.prove_spheres(mesh, fit, fit), arguments.contract)  # again, from the numbers alone
    claim = f"{arguments.contract} proved" if proof.proved else "NOT PROVED"
    far = f"reaching out by up to {1000 * fit.reach[0][2]:.1f} mm"
    gap = f"leaving gaps of up to {1000 * mv.measure_gap(mesh, fit)[1]:.1f} mm"
    print(f"{name:10} {len(fit):3} balls, {claim}, {far if arguments.contract == 'cover' else gap}")
    lines += [f"  {name}:"]
    for centre, radius in zip(fit.centres.tolist(), fit.radii.tolist()):
        lines += [f"    - center: [{', '.join(map(plain, centre))}]", f"      radius: {plain(radius)}"]
    total += len(fit)

    mesh.moved(placed(mesh.vertices, pose[name])).plot(views[0], colour=f"C{number % 10}")
    mv.Balls(centres=placed(fit.centres, pose[name]), radii=fit.radii).plot(views[1], colour=f"C{number % 10}")

(arguments.out / "robot_spheres.yml").write_text("\n".join(lines) + "\n")
relation = "that cover" if arguments.contract == "cover" else "inside"
for view, title in zip(views, ("A robot's links", f"{total} balls {relation} them, with proof")):
    view.set_title(title)
    view.set_axis_off()
figure.savefig(arguments.out / "robot_spheres.png")
