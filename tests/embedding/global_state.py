#!/usr/bin/env python3
"""The library has no global state: its object files hold no writable variable except those that are listed here.

  global_state.py libmedial_vk.a

Reads the section of every symbol by objdump. Constants that hold addresses (.data.rel.ro) become read-only before a
program starts. g++ 12 forgets the constness of a constant whose type is deduced (constexpr std::array x = ...).
"""
import re
import subprocess
import sys

# (object file, name): the reason why it may exist.
ALLOWED = [
    (r"instance\.cpp\.o", r"medial_vk::volk_mutex\(\)::mutex", "guards the variables below"),
    (r"volk_source\.c\.o", r"medial_vk_(vk|volk)\w+", "volk's pointers to the loader and to functions of instances"),
    (r"volk_source\.c\.o", r"loaded(Module|Instance|Device)", "the loader, and the last arguments of volk"),
    (r".*", r"DW\.ref\.\w+", "the compiler's, for exceptions: never written"),
]
WRITABLE = re.compile(r"^(\.data|\.bss|\.tdata|\.tbss|\*COM\*)")
READ_ONLY = re.compile(r"^\.data\.rel\.ro")


def variables(library):
    """(object file, section, name) of every symbol that has a size and can be written."""
    table = subprocess.run(["objdump", "--syms", "--demangle", library], capture_output=True, text=True, check=True)
    member = ""
    for line in table.stdout.splitlines():
        if found := re.match(r"^(\S+):\s+file format", line):
            member = found[1]
        # value, seven flags, section, size, name
        if not (found := re.match(r"^[0-9a-f]{16} .{7} (\S+)\t([0-9a-f]{16}) +(?:\.hidden )?(.*)$", line)):
            continue
        section, size, name = found[1], int(found[2], 16), found[3]
        if size > 0 and WRITABLE.match(section) and not READ_ONLY.match(section):
            yield member, section, name


def main():
    seen, unlisted = 0, []
    for member, section, name in variables(sys.argv[1]):
        seen += 1
        if not any(re.fullmatch(m, member) and re.fullmatch(n, name) for m, n, _ in ALLOWED):
            unlisted.append(f"{member}: {name} in {section}")
    if unlisted:
        sys.exit("variables that outlive a call; if one is necessary, add it with the reason to this script:\n"
                 + "\n".join(unlisted))
    if seen == 0:
        sys.exit("not even the variables of volk were found: can objdump read this file?")
    print(f"{seen} variables, all of them listed")


main()
