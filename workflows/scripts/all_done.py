"""all_done.py MERGED OUTPUT: fails if meshes have failed."""
import pathlib
import sys

from files import read_json

merged = read_json(sys.argv[1])
if merged["failed"] > 0:
    sys.exit(f"{merged['failed']} of {merged['meshes']} meshes failed: {merged['failures']} has the reasons")
pathlib.Path(sys.argv[2]).touch()
