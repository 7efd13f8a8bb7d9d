#!/usr/bin/env python3
"""Fits spheres to the example arm and reads every format back with an independent parser.

    spheres_back.py CASE MEDIAL_VK MAKE_ARM

All formats must hold the same spheres, to the last bit. Case `inside` tests them against the meshes of the URDF, which are
read here by other code: each sphere lies inside the geometry of its link that holds its centre. The exit code is 77 if a
parser is missing.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

try:
    import numpy
    import yaml
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

COUNT = 24


def fit(folder, output, *more):
    command = [MEDIAL_VK, "spheres", str(ARM), "--count-per-link", str(COUNT), "--method", "source", "--backend", "cpu",
               "-q", "-o", str(folder / output), *more]
    subprocess.run(command, check=True)
    return (folder / output).read_text()


def by_link(rows):
    links = {}
    for link, x, y, z, r in rows:
        links.setdefault(link, []).append((float(x), float(y), float(z), float(r)))
    return links


def from_json(text):
    return {link: [(*s["centre"], s["radius"]) for s in spheres]
            for link, spheres in json.loads(text)["links"].items()}


def from_csv(text):
    rows = list(csv.reader(text.splitlines()))
    assert rows[0] == ["link", "x", "y", "z", "radius"], rows[0]
    return by_link(rows[1:])


def from_yaml_spheres(links):
    for spheres in links.values():
        for sphere in spheres:
            assert list(sphere) == ["center", "radius"]
            assert all(isinstance(x, float) for x in (*sphere["center"], sphere["radius"])), sphere
    return {link: [(*s["center"], s["radius"]) for s in spheres] for link, spheres in links.items()}


def from_curobo(text):
    data = yaml.safe_load(text)
    kinematics = data["robot_cfg"]["kinematics"]
    assert kinematics["collision_spheres"] == data["collision_spheres"]
    assert kinematics["collision_link_names"] == list(data["collision_spheres"])
    assert kinematics["collision_sphere_buffer"] == 0.0 and kinematics["format_version"] == 2.0
    return from_yaml_spheres(data["collision_spheres"])


def from_xrdf(text):
    data = yaml.safe_load(text)
    assert data["format"] == "xrdf" and data["format_version"] == 1.0
    name = data["collision"]["geometry"]
    assert data["self_collision"]["geometry"] == name
    return from_yaml_spheres(data["geometry"][name]["spheres"])


def from_urdf(text):
    before, after = (xml.etree.ElementTree.fromstring(t) for t in (ARM.read_text(), text))
    assert [j.attrib for j in before.iter("joint")] == [j.attrib for j in after.iter("joint")]
    assert len(list(before.iter("visual"))) == len(list(after.iter("visual")))
    rows = []
    for link in after.iter("link"):
        for collision in link.findall("collision"):
            assert [e.tag for e in collision] == ["geometry", "origin"]
            assert collision.find("origin").get("rpy") == "0 0 0"
            radius = collision.find("geometry/sphere").get("radius")
            rows.append((link.get("name"), *collision.find("origin").get("xyz").split(), radius))
    return by_link(rows)


def from_foam(text):
    links = {}
    for key, branches in json.loads(text).items():
        assert list(branches) == [str(COUNT)] and list(branches[str(COUNT)]) == ["1"]
        level = branches[str(COUNT)]["1"]
        assert list(level) == ["mean", "best", "worst", "spheres"]
        for sphere in level["spheres"]:
            links.setdefault(key.split("::")[0], []).append((*sphere["origin"], sphere["radius"]))
    return links


CASES = {"csv": ("a.csv", (), from_csv), "curobo": ("a.yml", (), from_curobo), "xrdf": ("a.xrdf", (), from_xrdf),
         "urdf": ("a.urdf", (), from_urdf), "foam": ("f.json", ("--format", "foam"), from_foam)}


def test_levels(folder):
    levels = json.loads(fit(folder, "l.json", "--levels"))["levels"]
    rows = list(csv.DictReader(fit(folder, "l.csv", "--levels").splitlines()))
    foam = json.loads(fit(folder, "f.json", "--levels", "--format", "foam"))
    for i, level in enumerate(levels):
        mine = [(r["link"], *(float(r[k]) for k in ("x", "y", "z", "radius"))) for r in rows if int(r["level"]) == i]
        assert mine == [(link, *s["centre"], s["radius"]) for link, spheres in level["links"].items() for s in spheres]
        assert level["num_spheres"] == len(mine)
    assert len(levels) > 3
    for branches in foam.values():
        sizes = [(int(branch), len(depths["1"]["spheres"])) for branch, depths in branches.items()]
        assert sizes == sorted(sizes) and all(size <= branch for branch, size in sizes), sizes


def rotation(rpy):
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(a), math.sin(a)) for a in rpy)
    about_x = numpy.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = numpy.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = numpy.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def read_triangles(path):
    lines = [line.split() for line in path.read_text().splitlines() if line]
    if path.suffix == ".stl":
        return numpy.array([list(map(float, w[1:])) for w in lines if w[0] == "vertex"]).reshape(-1, 3, 3)
    vertices = numpy.array([list(map(float, w[1:])) for w in lines if w[0] == "v"])
    return vertices[[[int(i) - 1 for i in w[1:]] for w in lines if w[0] == "f"]]


def numbers(element, attribute, default):
    return numpy.array(list(map(float, element.get(attribute, default).split()))) if element is not None else \
        numpy.array(list(map(float, default.split())))


def distance_to_triangles(p, t):
    """The distance of a point to each triangle: to its foot in the face, if that lies in the face, or to the edges."""
    a, b, c = t[:, 0], t[:, 1], t[:, 2]

    def to_segment(u, v):
        share = numpy.clip(((p - u) * (v - u)).sum(1) / ((v - u) ** 2).sum(1), 0, 1)
        return numpy.linalg.norm(p - u - share[:, None] * (v - u), axis=1)

    n = numpy.cross(b - a, c - a)
    n /= numpy.linalg.norm(n, axis=1)[:, None]
    within = numpy.all([(numpy.cross(v - u, p - u) * n).sum(1) >= 0 for u, v in ((a, b), (b, c), (c, a))], axis=0)
    edges = numpy.minimum(numpy.minimum(to_segment(a, b), to_segment(b, c)), to_segment(c, a))
    return numpy.where(within, numpy.abs(((p - a) * n).sum(1)), edges)


def winding(p, t):
    """The winding number by solid angles (Van Oosterom and Strackee 1983)."""
    a, b, c = (t[:, i] - p for i in range(3))
    x, y, z = (numpy.linalg.norm(v, axis=1) for v in (a, b, c))
    det = (a * numpy.cross(b, c)).sum(1)
    return numpy.arctan2(det, x * y * z + (a * b).sum(1) * z + (b * c).sum(1) * x + (c * a).sum(1) * y).sum() / (2 * math.pi)


def slack_in(geometry, p):
    """The depth of a point in a geometry, in its frame; negative if it lies outside."""
    shape = geometry[0]
    if shape.tag == "sphere":
        return float(shape.get("radius")) - numpy.linalg.norm(p)
    if shape.tag == "box":
        return (numbers(shape, "size", "") / 2 - numpy.abs(p)).min()
    if shape.tag == "cylinder":
        return min(float(shape.get("radius")) - math.hypot(p[0], p[1]), float(shape.get("length")) / 2 - abs(p[2]))
    name = shape.get("filename").replace("package://robot_arm/", "")
    triangles = read_triangles(ARM.parent / name) * numbers(shape, "scale", "1 1 1")
    return distance_to_triangles(p, triangles).min() * (1 if winding(p, triangles) > 0.5 else -1)


def test_inside(folder):
    links = from_json(fit(folder, "a.json"))
    urdf = xml.etree.ElementTree.parse(ARM).getroot()
    worst = 1
    for link in urdf.iter("link"):
        spheres = links[link.get("name")]
        assert 1 <= len(spheres) <= COUNT
        for x, y, z, r in spheres:
            slack = -1
            for collision in link.findall("collision"):
                origin = collision.find("origin")
                turn = rotation(numbers(origin, "rpy", "0 0 0"))
                local = turn.T @ (numpy.array([x, y, z]) - numbers(origin, "xyz", "0 0 0"))
                slack = max(slack, slack_in(collision.find("geometry"), local) - r)
            worst = min(worst, slack)
    print(f"the least distance of a sphere from the outside is {worst:.3g} m")
    # Distances here are rounded, too, by some 1e-16 m.
    assert worst > -1e-15, worst


def main():
    with tempfile.TemporaryDirectory() as name:
        global ARM
        folder = pathlib.Path(name)
        subprocess.run([sys.executable, sys.argv[3], name], check=True)
        ARM = folder / "robot_arm/arm.urdf"
        subprocess.run([sys.executable, sys.argv[3], str(folder / "again")], check=True)
        for file in (folder / "robot_arm").rglob("*.*"):
            assert file.read_bytes() == (folder / "again" / file.relative_to(folder)).read_bytes(), file
        case = sys.argv[1]
        if case == "inside":
            return test_inside(folder)
        if case == "levels":
            return test_levels(folder)
        output, more, parse = CASES[case]
        expected, found = from_json(fit(folder, "a.json")), parse(fit(folder, output, *more))
        assert len(expected) == 7 and sum(map(len, expected.values())) > 60
        assert list(found) == list(expected), list(found)
        if case == "foam":  # by geometry, since those of a link may be in another order
            found, expected = ({link: sorted(s) for link, s in d.items()} for d in (found, expected))
        for link, spheres in expected.items():
            assert found[link] == spheres, link


MEDIAL_VK = sys.argv[2]
main()
