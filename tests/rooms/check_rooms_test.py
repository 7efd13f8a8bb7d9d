#!/usr/bin/env python3
"""scripts/check-rooms finds each kind of fault, in small source trees with one fault each.

  check_rooms_test.py SCRIPT
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOMS = """
tree runtime/include
room medial_vk
  doors *
  outer_doors *
  used_by *
tree shaders
room shared/types
  doors *
  outer_doors *
room kernels
  uses shared/types
tree runtime/src library
room base
  declares mesh.h
  doors *
  outer_doors clock.h
room device
  uses base shared/types
  doors device.h
tree cpu_reference/include
room cpu_reference
  outer_doors *
  used_by src/judge
tree src product
room judge
  uses cpu_reference
  doors judge.h
room cli
  uses base judge
"""
FILES = {
    "cmake/rooms.txt": ROOMS,
    "runtime/include/medial_vk/mesh.h": "#include <vector>\n",
    "shaders/shared/types/types.h": "",
    "shaders/kernels/run.comp": '#include "types.h"\n',
    "runtime/src/base/clock.h": '#include "medial_vk/mesh.h"\n',
    "runtime/src/base/blocks.h": "",
    "runtime/src/device/device.h": '#include "base/blocks.h"\n#include "types.h"\n',
    "runtime/src/device/inner.h": "",
    "cpu_reference/include/cpu_reference/check.h": "",
    "src/judge/judge.h": '#include "cpu_reference/check.h"\n',
    "src/judge/inner.h": "",
    "src/cli/used.h": '#include "base/clock.h"\n#include "judge/judge.h"\n',
    "src/cli/run.cpp": '#include "base/clock.h"\n#include "judge/judge.h"\n#include "page.vert.h"\n',
    "examples/embed.cpp": '#include "medial_vk/mesh.h"\n',
    "tests/any_test.cpp": '#include "device/inner.h"\n#include "cpu_reference/check.h"\n',
}


class CheckRooms(unittest.TestCase):
    def check(self, expected, files):
        """Runs the script on FILES and these. Expects lines with these beginnings and parts, or, for None, no fault."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**FILES, **files}.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            run = subprocess.run([sys.executable, SCRIPT, folder], capture_output=True, text=True, check=False)
            self.assertEqual(run.stderr, "")
            if expected is None:
                self.assertEqual(run.returncode, 0, run.stdout)
                return
            self.assertEqual(run.returncode, 1, run.stdout)
            self.assertEqual(len(run.stdout.splitlines()), len(expected), run.stdout)
            for line, (start, part) in zip(run.stdout.splitlines(), expected):
                self.assertTrue(line.startswith(start), line)
                self.assertIn(part, line)

    def test_nothing_wrong(self):
        self.check(None, files={})

    def test_room_that_is_not_declared(self):
        self.check([("src/judge/judge.h:2:", "which is not declared")],
                   files={"src/judge/judge.h": '#include "cpu_reference/check.h"\n#include "base/clock.h"\n'})

    def test_room_below(self):
        self.check([("runtime/src/base/clock.h:1:", "a room below it")],
                   files={"runtime/src/base/clock.h": '#include "device/device.h"\n'})

    def test_cycle_of_declarations(self):
        text = ROOMS.replace("room base\n", "room base\n  uses device\n")
        self.check([(f"cmake/rooms.txt:{text.splitlines().index('  uses device') + 1}:", "no room above it")],
                   files={"cmake/rooms.txt": text})

    def test_public_headers_belong_to_rooms(self):
        with_device = ROOMS.replace("room device\n", "room device\n  declares device.h\n")
        public = {"cmake/rooms.txt": with_device, "runtime/include/medial_vk/device.h": '#include "medial_vk/mesh.h"\n'}
        self.check(None, files=public)
        self.check([("runtime/src/base/clock.h:1:", "a room below it")],
                   files={**public, "runtime/src/base/clock.h": '#include "medial_vk/device.h"\n'})
        self.check([("runtime/include/medial_vk/mesh.h:1:", "a room below it")],
                   files={**public, "runtime/include/medial_vk/mesh.h": '#include "medial_vk/device.h"\n'})
        self.check([("runtime/include/medial_vk/new.h:1:", "no room")], files={"runtime/include/medial_vk/new.h": ""})
        self.check([("cmake/rooms.txt:", "declared by base, too")],
                   files={"cmake/rooms.txt": ROOMS.replace("room device\n", "room device\n  declares mesh.h\n")})
        self.check([("cmake/rooms.txt:", "no public header gone.h")],
                   files={"cmake/rooms.txt": ROOMS.replace("declares mesh.h", "declares mesh.h gone.h")})

    def test_declared_but_not_used(self):
        self.check([("cmake/rooms.txt:", "includes none of its headers")],
                   files={"runtime/src/device/device.h": '#include "types.h"\n'})

    def test_private_header_of_another_room(self):
        self.check([("src/cli/run.cpp:1:", "private to judge")], files={"src/cli/run.cpp": '#include "judge/inner.h"\n'})

    def test_private_header_of_another_tree(self):
        self.check([("src/cli/run.cpp:1:", "private to base")], files={"src/cli/run.cpp": '#include "base/blocks.h"\n'})

    def test_reference_outside_the_judge(self):
        self.check([("cmake/rooms.txt:", "is not for src/cli")],
                   files={"cmake/rooms.txt": ROOMS + "  uses cpu_reference\n"})
        self.check([("src/cli/run.cpp:1:", "which is not declared")],
                   files={"src/cli/run.cpp": '#include "cpu_reference/check.h"\n'})

    def test_room_of_the_same_name_in_another_tree(self):
        self.check([("cmake/rooms.txt:", "is not for runtime/src/judge")],
                   files={"cmake/rooms.txt": ROOMS.replace("tree src product", "tree runtime/src library\nroom judge\n"
                                                           "  uses cpu_reference\ntree src product"),
                          "runtime/src/judge/a.h": '#include "cpu_reference/check.h"\n'})

    def test_public_header_with_a_private_one(self):
        self.check([("runtime/include/medial_vk/mesh.h:1:", "a public header includes runtime/src/base/clock.h")],
                   files={"runtime/include/medial_vk/mesh.h": '#include "base/clock.h"\n'})

    def test_example_with_a_private_header(self):
        self.check([("examples/embed.cpp:1:", "no public header")], files={"examples/embed.cpp": '#include "base/clock.h"\n'})

    def test_shader_of_another_room(self):
        self.check([("shaders/shared/types/types.h:1:", "a room below it")],
                   files={"shaders/shared/types/types.h": '#include "../../kernels/run.comp"\n',
                          "cmake/rooms.txt": ROOMS.replace("room kernels\n", "room kernels\n  doors *\n")})

    def test_folder_without_a_room_and_missing_header(self):
        self.check([("runtime/src/attic/old.cpp:1:", "in no room"), ("src/cli/run.cpp:1:", 'there is no "judge/gone.h"')],
                   files={"runtime/src/attic/old.cpp": "", "src/cli/run.cpp": '#include "judge/gone.h"\n'})

    def test_umbrella_in_the_library(self):
        umbrella = {"runtime/include/medial_vk/medial_vk.h": '#include "medial_vk/mesh.h"\n',
                    "src/judge/judge.h": '#include "cpu_reference/check.h"\n#include "medial_vk/medial_vk.h"\n'}
        self.check(None, files=umbrella)
        for file in ("runtime/src/base/clock.h", "runtime/include/medial_vk/mesh.h"):
            self.check([(f"{file}:1:", "includes headers of all rooms")],
                       files={**umbrella, file: '#include "medial_vk/medial_vk.h"\n'})

    def test_public_header_in_a_subfolder(self):
        new = {"runtime/include/medial_vk/small/new.h": ""}
        self.check([("runtime/include/medial_vk/small/new.h:1:", "no room of runtime/src declares")], files=new)
        self.check(None, files={**new, "cmake/rooms.txt": ROOMS.replace("declares mesh.h", "declares mesh.h small/new.h")})

    def test_file_in_no_room(self):
        support = {"tests/support/solids.h": ""}
        for file, kept in (("runtime/src/base/blocks.h", ""), ("src/judge/judge.h", '#include "cpu_reference/check.h"\n'),
                           ("cpu_reference/include/cpu_reference/check.h", "")):
            up = "../" * file.count("/")
            self.check([(f"{file}:{kept.count(chr(10)) + 1}:", "tests/support/solids.h, which is in no room")],
                       files={**support, file: f'{kept}#include "{up}tests/support/solids.h"\n'})
        self.check([("examples/embed.cpp:1:", "no public header")],
                   files={**support, "examples/embed.cpp": '#include "../tests/support/solids.h"\n'})

    def test_comments_around_an_include(self):
        for text in ('/**/ #include "device/device.h"\n', '/* a */ # /* b */ include /**/ "device/device.h" // c\n',
                     '#include /*\n*/ "device/device.h"\n', '/* "\n*/ #include <device/device.h>\n',
                     '#inc\\\nlude "device/device.h"\n', '// a \\\n b\n%:include "device/device.h"\n',
                     'const char* a = "/*";\n#include "device/device.h"\n', '#import "device/device.h"\n',
                     'char a = \'"\'; // "\n#include "device/device.h"\n'):
            number = text.count("\n")
            self.check([(f"runtime/src/base/clock.h:{number}:", "a room below it")],
                       files={"runtime/src/base/clock.h": text})
        self.check([("runtime/src/base/clock.h:2:", "a macro names")],
                   files={"runtime/src/base/clock.h": '#define A "device/device.h"\n#include A\n'})

    def test_includes_that_are_no_directives(self):
        for text in ('// #include "device/device.h"\n', '/*\n#include "device/device.h"\n*/\n',
                     'auto a = R"(\n#include "device/device.h"\n)";\n', '// a \\\n#include "device/device.h"\n'):
            self.check(None, files={"runtime/src/base/clock.h": text})

    def test_unknown_suffixes(self):
        device = FILES["runtime/src/device/device.h"]
        self.check([("runtime/src/device/device.h:3:", "whose suffix is none of")],
                   files={"runtime/src/base/x.tbl": "", "runtime/src/device/device.h": device + "#include <base/x.tbl>\n"})
        self.check([("src/cli/run.cpp:1:", "whose suffix is none of")],
                   files={"docs/table.txt": "", "src/cli/run.cpp": '#include "../../docs/table.txt"\n'})
        for suffix in (".inc", ".inl", ".ipp", ".hpp", ".cc", ".cxx", ".hxx", ".H"):
            file = f"src/cli/x{suffix}"
            self.check([(f"{file}:1:", f"{suffix} is no suffix")], files={file: ""})
        self.check(None, files={"tests/any_test.hpp": ""})

    def test_trees_that_include_only_others(self):
        text = ROOMS.replace("tree cpu_reference/include\n", "tree cpu_reference/include\n  only cpu_reference/include\n")
        check = "cpu_reference/include/cpu_reference/check.h"
        self.check(None, files={"cmake/rooms.txt": text})
        for name in ('"../../../runtime/include/medial_vk/mesh.h"', "<medial_vk/mesh.h>"):
            self.check([(f"{check}:1:", "only includes files of cpu_reference/include")],
                       files={"cmake/rooms.txt": text, check: f"#include {name}\n"})

    def test_the_reference_includes_only_its_own_rooms(self):
        lines = (Path(SCRIPT).parent.parent / "cmake/rooms.txt").read_text(encoding="utf-8").splitlines()
        only = {line.split()[1]: set(below.split()[1:]) for line, below in zip(lines, lines[1:])
                if line.startswith("tree ") and below.startswith("  only ")}
        own = {"cpu_reference/include", "cpu_reference/src"}
        for tree in own:
            self.assertLessEqual(only.get(tree, {"all"}), own)

    def test_cpp_beside_the_page(self):
        self.check([("src/page/a.cpp:1:", "in no room")], files={"src/page/a.cpp": '#include "a.h"\n', "src/page/a.glsl": ""})

    def test_subfolders_of_a_room_that_are_no_rooms(self):
        both = {"runtime/src/base/a/x.h": '#include "base/b/y.h"\n', "runtime/src/base/b/y.h": '#include "base/a/x.h"\n'}
        self.check([("runtime/src/base/a/x.h:1:", "is no room"), ("runtime/src/base/b/y.h:1:", "is no room")], files=both)
        self.check([("src/cli/a/x.cpp:1:", "is no room")], files={"src/cli/a/x.cpp": ""})
        self.check(None, files={"shaders/kernels/a/x.comp": "", "src/cli/shaders/x.vert": ""})

    def test_sizes(self):
        many = {f"tests/many/a{i}.h": "" for i in range(26)}
        self.check([("tests/many:1:", "26 sources")], files=many)
        many = {f"src/cli/a{i}.h": "" for i in range(24)}
        self.check([("src/cli:1:", "26 sources")], files=many)
        self.check(None, files={**many, "cmake/rooms.txt": ROOMS + "  many one for each option\n"})
        self.check([("tests/big.h:1:", "401 lines")], files={"tests/big.h": "\n" * 401})
        self.check(None, files={"tests/big.h": "// long: a table.\n" + "\n" * 401})
        body = "  x();\n" * 79
        self.check([("tests/f.cpp:5:", "N::f has 81 lines")],
                   files={"tests/f.cpp": "namespace n {\nstruct A { int b = g(); };\n\n// What it does.\nvoid N::f(A a = {}) {\n"
                          + body + "}\n}\n"})
        self.check(None, files={"tests/f.cpp": "void f() {\n  // long: a list.\n" + body + "}\n"})
        self.check(None, files={"tests/f.cpp": "void f() {\n" + "  x();\n" * 78 + "}\n"})
        self.check([("tests/f.py:1:", "f has 81 lines")], files={"tests/f.py": "def f():\n" + "    x()\n" * 80})
        self.check([("src/page/f.js:2:", "f has 81 lines")],
                   files={"src/page/f.js": "//\nexport function f(a) {\n" + "  if (a) {\n  }\n" * 39 + "  x();\n}\n"})

    def test_sizes_of_scripts(self):
        self.check([("bench/run:1:", "401 lines")], files={"bench/run": "#!/usr/bin/env python3\n" + "\n" * 400})
        self.check([("bench/run:2:", "f has 81 lines")],
                   files={"bench/run": "#!/usr/bin/env python3\ndef f():\n" + "    x()\n" * 80})
        self.check([("scripts/run:2:", "f has 82 lines")],
                   files={"scripts/run": "#!/usr/bin/env bash\nf() {\n" + "  x\n" * 80 + "}\n"})

    def test_prose_is_no_reason(self):
        self.check([("tests/big.h:1:", "402 lines")], files={"tests/big.h": "// It was too long: a pity.\n" + "\n" * 401})


SCRIPT = sys.argv.pop(1)
unittest.main()
