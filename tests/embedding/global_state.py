#!/usr/bin/env python3
"""No state of the process: the library's object files hold no variable that can be written, but those listed here.

  global_state.py libmedial_vk.a

Looks at what objdump says of every symbol's section. What is constant but holds addresses (.data.rel.ro) is made
read-only before a program starts.
"""
import re
import subprocess
import sys

# (object file, name): the reason why it may exist.
ALLOWED = [
    (r"instance\.cpp\.o", r"medial_vk::volk_mutex\(\)::mutex", "guards what follows"),
    (r"volk_source\.c\.o", r"medial_vk_(vk|volk)\w+", "volk's pointers to the loader and to functions of instances"),
    (r"volk_source\.c\.o", r"loaded(Module|Instance|Device)", "the loader, and what volk was given last"),
    (r"required_limits\.cpp\.o", r".*::kRequired", "constexpr; g++ 12 leaves it where addresses are filled in"),
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
    seen, strangers = 0, []
    for member, section, name in variables(sys.argv[1]):
        seen += 1
        if not any(re.fullmatch(m, member) and re.fullmatch(n, name) for m, n, _ in ALLOWED):
            strangers.append(f"{member}: {name} in {section}")
    if strangers:
        sys.exit("variables that outlive a call; if one must be, say why in this script:\n" + "\n".join(strangers))
    if seen == 0:
        sys.exit("not even volk's: does objdump understand this file?")
    print(f"{seen} variables, all of them known")


main()
