"""Generated meshes in folders: small tori, broken files, equal names, names with blanks and letters of any alphabet."""
import math
import random

FOLDERS = ("", "second folder", "größe", "日本/深い 所")
BROKEN = {"no faces.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "broken.obj": "f 1 2 3\n", "empty.stl": "", "cut.off": "OFF\n8 12 0\n0 0\n"}
KILLERS = ("kills-crash.obj", "kills-memory.obj", "kills-time.obj")


def torus(seed, around=9, across=6):
    """A bumpy torus of 2 * around * across triangles, as OBJ."""
    draw = random.Random(seed)
    radius, bump, waves = draw.uniform(0.25, 0.45), draw.uniform(0.02, 0.1), draw.randint(2, 4)
    lines = []
    for i in range(around):
        u = 2 * math.pi * i / around
        for j in range(across):
            v = 2 * math.pi * j / across
            r = radius + bump * math.sin(waves * u) * math.cos(v)
            lines.append(f"v {(1 + r * math.cos(v)) * math.cos(u):.9g} {(1 + r * math.cos(v)) * math.sin(u):.9g} "
                         f"{r * math.sin(v):.9g}")
    for i in range(around):
        for j in range(across):
            a, b = i * across + j, i * across + (j + 1) % across
            c, d = (i + 1) % around * across + j, (i + 1) % around * across + (j + 1) % across
            lines += [f"f {a + 1} {c + 1} {b + 1}", f"f {b + 1} {c + 1} {d + 1}"]
    return "\n".join(lines) + "\n"


def write_meshes(folder, count, seed, killers=()):
    """`count` meshes, broken ones and these killers among them. Returns the names of those that must fail."""
    bad = {**BROKEN, **{name: torus(1) for name in killers}}
    names = [f"{FOLDERS[i % len(FOLDERS)]}/{i // len(FOLDERS):03}{' part' * (i % 7 == 3)}.obj" for i in range(count - len(bad))]
    texts = {name: torus(1000 * seed + i) for i, name in enumerate(names)}
    texts.update((f"{FOLDERS[i % len(FOLDERS)]}/{name}", text) for i, (name, text) in enumerate(bad.items()))
    texts = {name.lstrip("/"): text for name, text in texts.items()}
    for name, text in texts.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return {name for name in texts if name.rsplit("/", 1)[-1] in bad}
