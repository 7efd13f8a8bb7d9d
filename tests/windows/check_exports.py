"""The DLL of an unpacked zip needs Windows alone, and exports names of medial_vk alone; so does the tool.

    check_exports.py TREE
"""
import pathlib
import re
import subprocess
import sys

tree = pathlib.Path(sys.argv[1])
dump = lambda file: subprocess.run(["x86_64-w64-mingw32-objdump", "-p", str(file)], check=True, capture_output=True,
                                   text=True).stdout
system = re.compile(r"(?i)^(kernel32|advapi32|shell32|msvcrt|ucrtbase|api-ms-win-.*|user32|ntdll)[.]dll$")
wrong = []
for file in sorted((tree / "bin").glob("*")):
    needed = re.findall(r"DLL Name: (\S+)", dump(file))
    print(f"{file.name} needs {' '.join(needed)}")
    wrong += [f"{file.name} needs {name}" for name in needed if not system.match(name)]
table = dump(tree / "bin" / "medial_vk.dll").split("[Ordinal/Name Pointer] Table")[1]
names = re.findall(r"^\s*\[\s*\d+\]\s+(?:\+base\[\s*\d+\]\s+\w+\s+)?(\S+)$", table, re.M)
if len(names) < 200:
    wrong.append(f"only {len(names)} exported names")
wrong += [f"{name} is exported" for name in names if not re.match(r"_ZNK?9medial_vk", name)]
print(f"medial_vk.dll exports {len(names)} names")
sys.exit("\n".join(wrong) if wrong else 0)
