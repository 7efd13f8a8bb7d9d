"""The arguments of the compared runs, and which inputs each is run on."""

import shlex
from typing import NamedTuple

# Arguments, one run per line; MESH is the path of the input, which is also on standard input.
ON_EVERY_MESH = """
MESH -v --resolution 40 -o points.ply --report report.json --check --medial-mesh mesh.ply --sheet-curve curve.csv \
 --ball-volumes volumes.csv --picture picture.png --size 320x240
MESH --resolution 20 -o points.csv --report report.json --check --mode thesis
"""

FORMATS = """
MESH --resolution 48
MESH --resolution 48 -o points.ply --ascii
MESH --resolution 48 -o points.csv
MESH --resolution 48 -o points.npz
MESH --resolution 48 -o points.json
MESH --resolution 48 -o balls.glb
MESH --resolution 48 -o balls.glb --gpu-instancing --sphere-detail 1
MESH --resolution 48 -o balls.glb --mesh-spheres --sphere-detail 1
MESH --resolution 48 --mesh-spheres
MESH --resolution 48 -o balls.ply --mesh-spheres --sphere-detail 0 --ascii
MESH --resolution 48 -o points.ply --medial-mesh mesh.ply --ascii
MESH --resolution 48 -o points.ply --medial-mesh mesh.ma --sheet-curve curve.svg
MESH --resolution 48 -o points.ply --picture picture.png --show balls --colour radius --view top --up z --size 200
MESH --resolution 48 -o points.ply --picture picture.png --show both --colour sheet --view 1,-2,3 --size 400x200
MESH --resolution 48 -o points.ply --html page.html
MESH --resolution 48 -o points.ply --report - -q
- --resolution 48 -o - --check
"""

OPTIONS = """
MESH --resolution 16 -o points.ply --report report.json --backend cpu --check
MESH --resolution 10 -o points.ply --report report.json --backend cpu --mode thesis --picture picture.png --size 160
MESH --resolution 40 -o points.ply --report report.json --radius 0.05
MESH --resolution 24 -o points.ply --report report.json --radius 0.05 --mode thesis
MESH --resolution 80 -o points.ply --report report.json --simplify --epsilon 0.2 --check
MESH --resolution 40 -o points.ply --report report.json --perturb 0.001 --seed 7 --check
MESH --resolution 40 -o points.ply --report report.json --object-angle 0.3 --extra-levels 2
MESH --resolution 60 -o points.ply --report report.json --keep-volume 0.9 --ball-volumes volumes.csv --html page.html
MESH --resolution 60 -o points.ply --report report.json --keep-volume 0.8 --keep-topology --medial-mesh mesh.ply
MESH --resolution 48 -o points.ply --report report.json --sheet-crease 0 --sheet-width 0
MESH --resolution 48 -o points.ply --report report.json --sheet-angle 12 --sheet-border 40 --absorb-fragments 20
MESH --resolution 64 -o points.ply --report report.json --threads 1 -v
MESH --resolution 64 -o points.ply --report report.json --memory 64 --kernel-times
"""

SPHERES = """
spheres MESH -v --count 32 --check --report report.json --histogram histogram.svg --picture picture.png
spheres MESH -v --count 16 --contract cover --check --report report.json --histogram histogram.csv
spheres MESH -v --count 32 --contract balanced --report report.json --histogram histogram.svg
spheres MESH --count 32 --method source --check --report report.json
spheres MESH --resolution 6 --method source --object-angle 0.8 --report report.json
spheres MESH --count 16 --method source --contract cover --check --report report.json
spheres MESH --count 16 --method source --contract balanced --report report.json
spheres MESH --error 0.4 -o spheres.json --report report.json
spheres MESH --max-gap 0.4 -o spheres.json --contract balanced --report -
"""

# --check cannot decide that an open mesh is covered: exit code 7.
OPEN_SPHERES = """
spheres MESH --count 16 --method source --check --report report.json
spheres MESH --count 4 --contract cover --check --report report.json
"""

SPHERE_FORMATS = """
spheres MESH --count 16 --levels -o spheres.csv
spheres MESH --count 16 --levels -o spheres.json
spheres MESH --count 16 --levels -o spheres.json --format foam
spheres MESH --count 16 --levels -o spheres.json --contract cover --report report.json
spheres MESH --count 16 --levels -o spheres.json --contract balanced --report report.json
spheres MESH --count 16 -o spheres.yml
spheres MESH --count 16 -o spheres.xrdf
spheres MESH --count 16 -o spheres.urdf --threads 1
spheres MESH --count 16 -o spheres.json --backend cpu --check
spheres - --count 16 -o -
"""

ROBOT = """
spheres MESH --count-per-link 4 -v --check --report report.json --picture picture.png --up z
spheres MESH --count-per-link 3 -o spheres.json --levels --contract balanced
spheres MESH --total 12 -o spheres.xrdf --contract cover --report report.json
spheres MESH --total 16 -o spheres.csv --method source
spheres MESH --total 16 -o spheres.yml --visual
spheres MESH --total 16 -o spheres.json --format foam --levels
"""

# The subset of the options, of spheres and of the robot for --quick.
QUICK_OPTIONS = OPTIONS.split("\n")[1::3]
QUICK_SPHERES = SPHERES.split("\n")[1::2] + SPHERE_FORMATS.split("\n")[1::3]
QUICK_ROBOT = ["spheres MESH --total 16 --check --report report.json"]

WITHOUT_INPUT = """
--help
--version
--list-devices
spheres --help

--resolutoin 40
none.obj
spheres
spheres none.urdf --total 9
spheres none.stl --count 4
"""

# Arguments that must be refused, although the file is valid.
USAGE = """
MESH --resolution 0
MESH --resolution forty
MESH --object-angle 2
MESH --keep-volume 1.5
MESH --keep-topology
MESH --mode best
MESH --device no-such-device
MESH --device 0 --backend cpu
MESH -q -v
MESH -o points.txt
MESH -o none/points.ply
MESH -o points.csv --mesh-spheres
MESH -o points.ply --report points.ply
MESH --picture picture.jpg
MESH --show both
MESH MESH
spheres MESH
spheres MESH --count 0
spheres MESH --count 4 --contract none
spheres MESH --count 4 --method source --max-gap 0.1
spheres MESH --count 4 --contract balanced --check
spheres MESH --count 4 --contract cover --max-gap 0.1
spheres MESH --count 4 --object-angle 0.5
spheres MESH --count 4 --levels -o spheres.yml
spheres MESH --total 4
spheres MESH --count 4 -o none/spheres.csv
"""

ROBOT_USAGE = """
spheres MESH --count 4
spheres MESH --total 4
spheres MESH --total 30 --histogram histogram.svg
MESH
"""


class Case(NamedTuple):
    """One run of both programs."""

    input: str  # below the folder of inputs; may be empty
    arguments: str
    is_error: bool = False  # an error message is expected

    def words(self, inputs):
        return [word.replace("MESH", f"{inputs}/{self.input}") for word in shlex.split(self.arguments)]

    def __str__(self):
        return f"{self.input or 'no input'}, {' '.join(shlex.split(self.arguments)) or 'no arguments'}"


def cases_of(inputs, *texts, is_error=False):
    """A case for each input and line."""
    lines = [line for text in texts for line in (text.strip().split("\n") if isinstance(text, str) else text) if line]
    return [Case(name, line, is_error) for name in inputs for line in lines]


def error_cases(broken):
    of_meshes = [name for name in broken if not name.endswith(".urdf")]
    return [
        *cases_of([""], WITHOUT_INPUT, is_error=True),
        Case("", "", is_error=True),
        *cases_of(["box.off"], USAGE, is_error=True),
        *cases_of(["robot_arm/arm.urdf"], ROBOT_USAGE, is_error=True),
        *cases_of(of_meshes, "MESH -o points.ply --report report.json", is_error=True),
        *cases_of(broken, "spheres MESH --count 4", is_error=True),
        *cases_of(broken[len(of_meshes):], "spheres MESH --total 4", is_error=True),
    ]


def plan(made, models, broken, quick):
    """All cases; those of one input follow each other."""
    robot = ["robot_arm/arm.urdf"]
    if quick:
        some = [name for name in ("messy.obj", "open.obj", "turtle-6k.obj") if name in made]
        return [*cases_of(some + models[:1], ON_EVERY_MESH), *cases_of(["two.obj"], FORMATS),
                *cases_of(["torus.ply"], QUICK_OPTIONS), *cases_of(["box.off"], QUICK_SPHERES),
                *cases_of(robot, QUICK_ROBOT), *error_cases(broken)]
    return [*cases_of(made + models, ON_EVERY_MESH), *cases_of(["torus.ply", "two.obj"], FORMATS),
            *cases_of(["torus.ply", "two.obj"], OPTIONS),
            *cases_of(["torus.ply", "box.off"], SPHERES), *cases_of(["torus.ply"], SPHERE_FORMATS),
            *cases_of(["open.obj"], OPEN_SPHERES), *cases_of(robot, ROBOT), *error_cases(broken)]
