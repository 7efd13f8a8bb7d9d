#!/usr/bin/env python3
"""Writes a flattened torus as a binary PLY: a solid with a broad medial sheet, of any number of triangles.
   bench/write_torus.py FILE.ply [TRIANGLES] [--round]      (default: 5,000,000)
The tube's section is an ellipse of half axes 0.3 and 0.12 on a circle of radius 0.7, with ten waves along it. --round: a
circle of radius 0.3 on a circle of radius 1 instead, a tube without a broad sheet."""
import array
import math
import sys

arguments = [argument for argument in sys.argv[1:] if argument != "--round"]
is_round = len(arguments) < len(sys.argv) - 1
if not arguments or any(argument.startswith("-") for argument in arguments):
    sys.exit(__doc__)

# Around the tube and along the circle; two and a half times as many along, or twice as many of the round one, for
# triangles of even shape.
triangles = int(arguments[1]) if len(arguments) > 1 else 5_000_000
around = max(3, round(math.sqrt(triangles / (4 if is_round else 5))))
along = max(3, round(triangles / (2 * around)))

points = array.array("f")
for i in range(along):
    u = 2 * math.pi * i / along
    for j in range(around):
        v = 2 * math.pi * j / around
        radius = (1 if is_round else 0.7) + 0.3 * math.cos(v)
        height = 0.3 if is_round else 0.12 * (1 + 0.2 * math.cos(10 * u))
        points.extend((radius * math.cos(u), radius * math.sin(u), height * math.sin(v)))

# A face is a byte, 3, and three integers of 32 bits.
faces = bytearray()
for i in range(along):
    row, next_row = i * around, (i + 1) % along * around
    for j in range(around):
        k = (j + 1) % around
        a, b, c, d = row + j, next_row + j, next_row + k, row + k
        for face in ((a, b, c), (a, c, d)):
            faces += b"\3" + array.array("i", face).tobytes()

with open(arguments[0], "wb") as out:
    out.write(f"""ply
format binary_little_endian 1.0
element vertex {len(points) // 3}
property float x
property float y
property float z
element face {2 * around * along}
property list uchar int vertex_indices
end_header
""".encode())
    points.tofile(out)
    out.write(faces)
