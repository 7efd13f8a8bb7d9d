"""Writes the .def file of the DLL: the names that the public headers declare, and no others.

    exported_names.py NM LIBRARY.a HEADERS OUTPUT.def

A symbol of the archive is exported if it is a function of the namespace medial_vk, if each class around it is defined and
its name is declared in the public headers, and if all types of its parameters are public: private overloads of public
names have private types, or the same name in a private class.
"""
import pathlib
import re
import subprocess
import sys

nm, archive, headers, output = sys.argv[1:]
text = ""
for header in sorted(pathlib.Path(headers).glob("*.h")):
    code = re.sub(r"//[^\n]*", "", header.read_text())
    text += re.sub(r'"(\\.|[^"\\])*"', '""', code)
classes = set(re.findall(r"\b(?:class|struct)\s+(?:\[\[\w+\]\]\s*)?(\w+)\s*(?:final\s*)?(?::[^;{]*)?\{", text))
types = classes | set(re.findall(r"\benum\s+class\s+(\w+)", text)) | set(re.findall(r"\b(?:class|struct)\s+(\w+);", text))
types |= set(re.findall(r"\busing\s+(\w+)\s*=", text))
types.discard("Impl")
functions = set(re.findall(r"\b(\w+)\s*\(", text))


def parts_of(name):
    """["medial_vk", "Context", "create"] and the parameters of a demangled name, or nothing."""
    name = re.sub(r"\[abi:\w+\]", "", name)
    begin = re.match(r"(?:medial_vk::)(?:\w+::)*(?:~?\w+|operator[^\w(]+|operator\(\)|operator \w[^(]*)(?=\()", name)
    if not begin:
        return None
    words = re.sub(r"operator.*", "operator", begin.group()).split("::")
    return words, name[begin.end():]


def is_public(name):
    found = parts_of(name)
    if not found:
        return False
    words, parameters = found
    around, last = words[1:-1], words[-1]
    if any(word not in classes for word in around):
        return False
    is_special = around and (last.lstrip("~") == around[-1] or last == "operator")
    if not is_special and last not in functions and last != "operator":
        return False
    used = re.findall(r"medial_vk::((?:\w+::)*\w+)", parameters)
    return all(word in types for use in used for word in use.split("::"))


listing = subprocess.run([nm, "--extern-only", "--defined-only", "--format=posix", archive],
                         check=True, capture_output=True, text=True).stdout
symbols = sorted({line.split()[0] for line in listing.splitlines() if len(line.split()) > 1 and line.split()[1] == "T"})
names = subprocess.run(["c++filt"], input="\n".join(symbols), check=True, capture_output=True, text=True).stdout.splitlines()
exported = [symbol for symbol, name in zip(symbols, names) if is_public(name)]
if len(exported) < 100:
    sys.exit(f"Only {len(exported)} public names found in {archive}")
pathlib.Path(output).write_text("EXPORTS\n" + "".join(f"  {symbol}\n" for symbol in exported))
