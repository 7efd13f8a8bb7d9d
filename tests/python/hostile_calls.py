"""Random and hostile calls of the Python package: wrong shapes, types and strides, NaN, arrays that other threads change
or shrink, callbacks that raise, calls from several threads. Every call must return or raise; nothing may crash.

    hostile_calls.py [--calls N] [--seed S] [--threads T]

The last line counts the calls by outcome. The exit code is 1 after an exception that no call should raise."""

import argparse
import collections
import math
import random
import sys
import threading

import numpy as np
import shapes

import medial_vk as mv

#: What a call may raise: errors of the package, and Python's own for arguments of no use (TypeError, ValueError).
EXPECTED = (mv.errors.Error, TypeError, ValueError, OverflowError)


class Raised(Exception):
    """By a callback."""


class Strange:
    """An object whose conversion to an array raises."""

    def __array__(self, *_args, **_keywords):
        raise Raised("no array")


class Hostile:
    """Makes arguments."""

    def __init__(self, seed):
        self.rng = random.Random(seed)
        self.numbers = np.random.default_rng(seed)
        mesh = mv.Mesh(*shapes.torus(around=12, across=8))
        box = mv.Mesh(*shapes.box())
        inside = mv.fit_spheres(box, 4, balls_only=True)
        cover = mv.fit_spheres(box, 4, contract="cover", balls_only=True)
        self.meshes = [mesh, box, mesh.on_side("outside")]
        self.bodies = [mv.Body(mesh), mv.Body(box, inside, cover), mv.Body(None, inside), mv.Body(None, None, cover)]
        self.followers = [mv.Follower(box, inside, steps=0), mv.CoverFollower(box, cover)]
        self.groups = [mv.BodyGroup(self.bodies[:2], [0, 1])]
        self.planes = [mv.PlaneShape([[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [0, 3]])]
        self.axes = [mv.plane_axis(self.planes[0], object_angle=0.2)]
        self.roadmaps = [mv.plane_voronoi([self.planes[0], [[2, 2], [3, 3]], [[3.0, 2.0]]]).roadmap()]
        self.shared = [self.numbers.random((64, 3)) for _ in range(4)]  # other threads write to them

    def one_of(self, *choices):
        return self.rng.choice(choices)

    def array(self, *shape):
        """Of this shape and ordinary, or of another one, another type, or full of what is no number."""
        kind = self.rng.randrange(16)
        if kind < 6:
            return self.numbers.random(shape)
        if kind == 6:
            return self.numbers.random(self.one_of((), (0,), (0, 3), (3,), (5, 2), (2, 3, 1), (4, 4), (1, 4, 4), shape[::-1]))
        if kind == 7:
            return (100 * self.numbers.random(shape)).astype(self.one_of("f2", "f4", ">f8", "i1", "u8", "c16", "?", "O", "S4", "M8[s]"))
        if kind == 8:
            broken = self.numbers.random(shape)
            if broken.size:
                broken.flat[self.rng.randrange(broken.size)] = self.one_of(math.nan, math.inf, 1e300, -1e-300, 5e-324)
            return broken
        if kind == 9:
            wide = self.numbers.random(tuple(2 * n for n in shape))
            return wide[tuple(slice(None, None, self.one_of(2, -2)) for _ in shape)]
        if kind == 10:
            return np.broadcast_to(self.numbers.random(shape[-1:]), shape)
        if kind == 11:
            read_only = self.numbers.random(shape)
            read_only.flags.writeable = False
            return read_only.tolist() if self.rng.random() < 0.5 else memoryview(read_only)
        if kind == 12:
            return self.one_of(None, 7, "x", b"x", object(), Strange(), [[1, 2], [3]], {}, float, [[]], math.nan)
        if kind == 13:
            raw = bytearray(8 * max(math.prod(shape), 1) + 1)
            return np.frombuffer(memoryview(raw)[1:], dtype="f8", count=math.prod(shape)).reshape(shape)  # not aligned
        if kind == 14:
            return self.rng.choice(self.shared)
        return np.full(shape, self.one_of(0.0, -1.0, 1e18, 1e19, 1e-320))

    def index_array(self, n, most):
        rows = self.numbers.integers(0, most, size=(n, 3))
        kind = self.rng.randrange(8)
        if kind < 4:
            return rows.astype(self.one_of("i4", "i8", "u4", "u8", "i2"))
        if kind == 4:
            return rows + self.one_of(-1, 1, 2**31, 2**32, 2**62)
        return self.array(n, 3)

    def number(self, *usual):
        return self.rng.choice(usual) if self.rng.random() < 0.9 else self.one_of(
            -1, 0, 1e-300, -0.5, 2**70, math.nan, math.inf, None, "x", [1], 1.5, True, np.float32(2), 10**400)

    def callback(self):
        def fail(_stage, _done):
            raise Raised("callback")

        return self.one_of(None, None, None, lambda stage, done: None, fail, 7, lambda: None)

    def mesh(self):
        kind = self.rng.randrange(10)
        if kind < 7:
            return self.rng.choice(self.meshes)
        return self.one_of(None, object(), "part.stl", 3)

    def body(self):
        return self.rng.choice(self.bodies) if self.rng.random() < 0.95 else self.one_of(None, 3, self.meshes[0])

    def balls(self):
        kind = self.rng.randrange(4)
        n = self.rng.randrange(6)
        if kind == 0:
            return self.array(n, 4)
        if kind == 1:
            return self.array(n, 3), self.array(n)
        if kind == 2:
            return mv.Balls(centres=self.numbers.random((n, 3)), radii=self.numbers.random(n))
        return self.one_of(None, self.array(n, 3), (1, 2, 3))

    def poses(self):
        if self.rng.random() < 0.3:
            return self.array(2, 4, 4)
        poses = np.stack([shapes.pose(self.numbers.normal(size=3), self.rng.random()) for _ in range(self.rng.randrange(1, 4))])
        return poses[0] if self.rng.random() < 0.4 else poses

    # Calls. Sizes are small: what is tested is the way in and out.

    def make_mesh(self):
        n = self.rng.randrange(12)
        mv.Mesh(self.array(n, 3), self.index_array(self.rng.randrange(12), max(n, 1)), threads=self.number(0, 1, 2))

    def queries(self):
        mesh = self.mesh()
        self.one_of(
            lambda: mesh.closest_points(self.array(5, 3)),
            lambda: mesh.depths(self.array(5, 3), threads=self.number(1)),
            lambda: mesh.moved(self.array(len(mesh.vertices), 3)),
            lambda: mesh.on_side(self.one_of("inside", "outside", "x", None), margin=self.number(0, 0.1)),
        )()

    def analyse(self):
        found = mv.analyse(self.mesh(), resolution=self.number(2, 5), object_angle=self.number(0.6), radius=self.number(0),
                           sheets=self.number(True, False), keep_volume=self.number(0), mode=self.one_of("certified", "thesis", "x"),
                           progress=self.callback(), medial_mesh=self.one_of(False, True), threads=self.number(1))
        mv.curvature(found, spacing=self.number(0.0), progress=self.callback())

    def fit(self):
        mv.fit_spheres(self.mesh(), self.number(1, 2), contract=self.one_of("inside", "inside", "inside", "x"), resolution=self.one_of(4, 8, 8, -1),
                       balls_only=True, progress=self.callback(), error=self.number(0.0))

    def prove(self):
        self.one_of(lambda: mv.prove_spheres(self.mesh(), self.balls(), self.balls(), threads=self.number(1)),
                    lambda: mv.measure_gap(self.mesh(), self.balls()))()

    def union(self):
        made = mv.measure_union(self.balls(), complex=self.one_of(True, False), threads=self.number(1))
        if made.complex is not None:
            made.complex.topology()

    def make_body(self):
        mv.Body(self.one_of(None, self.mesh()), self.balls(), self.balls())

    def distance(self):
        a, b, poses = self.body(), self.body(), self.poses()
        self.one_of(
            lambda: mv.distance_bounds(a, b, poses, threads=self.number(1)),
            lambda: mv.distance_bounds(a, b, poses, start=mv.distance_bounds(b, a, poses)),
            lambda: mv.distances(a, b, poses, start=mv.distances(b, a, poses)),
            lambda: mv.distances(a, b, poses, tolerance=self.number(0.0), limit=self.number(math.inf)),
            lambda: mv.collide(a, b, poses, by_balls=self.one_of(True, False)),
            lambda: mv.penetration(a, b, poses, directions=self.number(8), most_queries=self.number(20), volume_tolerance=1.0),
            lambda: mv.first_contact(a, b, poses, poses, tolerance=self.one_of(1e-2, 0, math.nan), pivot=self.array(3)),
            lambda: mv.rigid_pose(poses),
            lambda: mv.PlacedBodies([a, b], poses).nearest(a, poses, self.number(1), limit=self.number(math.inf)),
        )()

    def follow(self):
        follower = self.rng.choice(self.followers)
        self.one_of(lambda: follower.update(self.array(8, 3)), follower.measure, follower.reset, lambda: follower.balls,
                    lambda: mv.Follower(self.meshes[1], self.balls(), steps=self.number(0), rule=self.one_of("tangent", "x")),
                    lambda: mv.CoverFollower(self.meshes[1], self.balls()))()

    def boundary(self):
        self.one_of(
            lambda: mv.thickness(self.mesh(), self.array(3, 3), delta=self.number(0.0), width=self.number(0.1),
                                 queries=self.number(50), progress=self.callback()),
            lambda: mv.least_wall(self.mesh(), cells=self.one_of(10, 100, -1), width=self.number(0.5), progress=self.callback()),
            lambda: mv.curvature(self.balls(), spokes=self.one_of(None, (self.array(3, 3), self.array(3, 3)), 5)),
        )()

    def plane(self):
        n = self.rng.randrange(8)
        shape = self.one_of(self.planes[0], self.planes[0], self.array(n, 2), [self.array(n, 2), self.array(3, 2)], self.mesh())
        axis = self.axes[0]
        self.one_of(
            lambda: mv.PlaneShape(shape, fill=self.one_of("nonzero", "evenodd", "x"), threads=self.number(1)).report,
            lambda: mv.plane_axis(shape, side=self.one_of("inside", "both", "x"), object_angle=self.number(0.6), radius=self.number(0.0),
                                  margin=self.number(0.0), progress=self.callback()),
            lambda: mv.plane_axis_as_published(self.planes[0], samples=self.one_of(0, 6, -1, "x"), object_angle=self.one_of(0.6, 3, None)),
            lambda: self.planes[0].nearest(self.array(5, 2)),
            lambda: self.planes[0].decide_circle(self.array(2), self.number(0.1), self.one_of(7, self.array(5), None, -1)),
            lambda: axis.prune(self.number(0.1), self.number(0.2)).longest_paths(),
            lambda: axis.lines(step=self.one_of(0.01, -1, math.nan, "x"), smooth=self.number(0.0)),
            lambda: axis.at(self.one_of([0, 1], [10**9, 0], self.array(2), [-1, 0]), self.array(2)),
            lambda: mv.plane_voronoi([shape, self.array(n, 2), [[5.0, 5.0]]], object_angle=self.number(0.0), progress=self.callback()),
            lambda: self.roadmaps[0].widest_path(self.array(2), self.array(2)),
        )()

    def site(self):
        kind = self.rng.randrange(6)
        if kind < 2:
            return self.one_of(self.meshes[0], self.meshes[1], self.mesh())
        if kind < 4:
            return self.array(self.rng.randrange(4), 3)
        return mv.Site(self.one_of(None, None, self.meshes[1]), points=self.array(2, 3), segments=self.array(2, 2, 3),
                       triangles=self.array(1, 3, 3))

    def between(self):
        sites = [self.meshes[1], self.one_of(mv.Site(segments=[[[2, 0, 0], [2, 1, 0]]]), [[0.0, 2, 0]], self.site())]
        if self.rng.random() < 0.4:
            sites.append(self.site())
        found = mv.site_voronoi(sites, resolution=self.number(4, 6), margin=self.number(0.0), threads=self.number(1),
                                progress=self.one_of(None, None, self.callback()))
        roadmap = found.roadmap(threads=self.number(1), progress=self.callback())
        if self.rng.random() < 0.5:
            roadmap.widest_path(self.array(3), self.array(3))

    def assembly(self):
        def part():
            return mv.Part(self.one_of(self.meshes[1], self.meshes[1], None, self.mesh()), link=self.one_of("a", "b", "b", 7),
                           name=self.one_of("x", None), pose=self.one_of(None, None, self.poses()),
                           ball=self.one_of(None, None, (self.array(3), self.number(0.1))), volume=self.one_of(None, self.number(9.0)))

        def poses():
            return np.stack([shapes.pose(self.numbers.normal(size=3)) for _ in range(2)])

        self.one_of(
            lambda: mv.fit_parts([part() for _ in range(self.rng.randrange(3))], self.number(1, 2), total=self.number(0, 3),
                                 resolution=8, balls_only=True, progress=self.callback()),
            lambda: mv.BodyGroup([self.body(), self.body()], self.one_of([0, 1], self.array(2), [5, 2**40]),
                                 self.one_of(None, [[0, 1]], self.array(2, 2)), poses=self.one_of(None, self.poses())),
            lambda: self.groups[0].least_distances(self.one_of(poses(), self.array(2, 4, 4)), exact=self.number(False),
                                                   limit=self.number(math.inf), threads=self.number(1)),
            lambda: self.groups[0].least_distances(poses(), start=self.groups[0].least_distances(poses())),
        )()

    def function(self):
        """Of points, that answers with points, or not."""
        def fail(_points):
            raise Raised("function")

        def scale(points):
            return points * (0.5 / np.maximum(np.linalg.norm(points, axis=1), 1e-12))[:, None]

        return self.one_of(*6 * [scale], fail, lambda points: points, lambda points: self.array(len(points), 3), lambda: None, 7, None)

    def any_boundary(self):
        inside = self.one_of(None, lambda points: np.linalg.norm(points, axis=1) < 0.5, self.function())
        mv.analyse_boundary(self.function(), self.one_of([-0.5] * 3, self.array(3)), self.one_of([0.5] * 3, self.array(3)), contains=inside,
                            resolution=self.one_of(2, 3, 0, "x"), extra_levels=1, mode=self.one_of("certified", "thesis"),
                            error=self.number(0.0), progress=self.callback(), threads=self.number(1, 2))

    def call(self):
        """One call: the name of what it did, and of what it raised."""
        work = self.rng.choices(
            (self.make_mesh, self.queries, self.analyse, self.fit, self.prove, self.union, self.make_body, self.distance,
             self.follow, self.boundary, self.plane, self.between, self.any_boundary, self.assembly),
            weights=(20, 20, 12, 6, 15, 15, 10, 30, 10, 10, 20, 15, 15, 15),
        )[0]
        try:
            work()
        except Raised:
            return work.__name__, "its own exception"
        except EXPECTED as error:
            return work.__name__, type(error).__name__
        except AttributeError:  # of what is no mesh or body at all
            return work.__name__, "AttributeError"
        return work.__name__, "result"


def disturb(arrays, ended):
    """Writes to arrays that calls read, and gives their memory back."""
    rng = np.random.default_rng(0)
    while not ended.wait(0.001):
        for array in arrays:
            array[:] = rng.random(array.shape)
            array.resize((0, 3), refcheck=False)
            array.resize((64, 3), refcheck=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--calls", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    outcomes, failures, ended, counting = collections.Counter(), [], threading.Event(), threading.Lock()
    makers = [Hostile(options.seed + i) for i in range(options.threads)]
    for maker in makers[1:]:  # threads share what can be shared
        maker.meshes, maker.bodies, maker.followers = makers[0].meshes, makers[0].bodies, makers[0].followers
        maker.shared = makers[0].shared

    def work(maker):
        for _ in range(options.calls // options.threads):
            state = maker.rng.getstate()
            try:
                outcome = maker.call()
                with counting:
                    outcomes[outcome] += 1
            except BaseException as error:  # noqa: B902
                failures.append((error, state[1][-1]))
                raise

    threads = [threading.Thread(target=work, args=(maker,)) for maker in makers]
    threads.append(threading.Thread(target=disturb, args=(makers[0].shared, ended)))
    for thread in threads:
        thread.start()
    for thread in threads[:-1]:
        thread.join()
    ended.set()
    threads[-1].join()
    for (name, outcome), count in sorted(outcomes.items()):
        print(f"{count:8} {name}: {outcome}")
    without = {name for name, _ in outcomes} - {name for name, outcome in outcomes if outcome == "result"}
    print(f"{sum(outcomes.values())} calls, {len(failures)} unexpected exceptions", *(f"no result of {n}" for n in without))
    return 1 if failures or (without and options.calls >= 500) else 0


if __name__ == "__main__":
    sys.exit(main())
