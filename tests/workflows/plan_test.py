#!/usr/bin/env python3
"""plan_test.py MEDIAL_VK: what a run of the workflow plans, and the table of `medial-vk batch` that it reads."""
import json
import os
import subprocess
import sys
import unittest

from meshes import torus
from workflow_runs import SOURCE, Folder

import plan
import table

MEDIAL_VK = sys.argv[1]


class Plan(unittest.TestCase):
    @staticmethod
    def states(names, size=10):
        return {name: [name, [size, 1]] for name in names}

    def test_a_mesh_stays_in_its_chunk(self):
        first = plan.assign({}, self.states("abcdefg"), 3, 1e9)
        self.assertEqual(first, {"000000": ["a", "b", "c"], "000001": ["d", "e", "f"], "000002": ["g"]})
        # b is gone, A and h are new.
        second = plan.assign(first, self.states("Aacdefgh"), 3, 1e9)
        self.assertEqual(second, {"000000": ["a", "c"], "000001": ["d", "e", "f"], "000002": ["g"], "000003": ["A", "h"]})
        # A chunk without meshes ends.
        third = plan.assign(second, self.states("acdefh"), 3, 1e9)
        self.assertEqual(third, {"000000": ["a", "c"], "000001": ["d", "e", "f"], "000003": ["h"]})

    def test_large_files_are_few_in_a_chunk(self):
        self.assertEqual(plan.assign({}, self.states("abcd", 6), 3, 12), {"000000": ["a", "b"], "000001": ["c", "d"]})
        self.assertEqual(plan.assign({}, self.states("ab", 60), 3, 12), {"000000": ["a"], "000001": ["b"]})


class PlanOfFiles(Folder):
    def keys(self, **settings):
        config = {"meshes": self.folder / "in", "output": self.folder / "out", "medial_vk": MEDIAL_VK, "chunk": 1,
                  "chunk_megabytes": 1, "options": "--resolution 8", **settings}
        key = plan.make_plan(config)
        return key, json.loads((self.folder / f"out/.workflow/plan-{key}.json").read_text())["chunks"]

    def test_keys_hold_what_results_depend_on(self):
        (self.folder / "in").mkdir()
        for name in "ab":
            (self.folder / f"in/{name}.obj").write_text(torus(1))
        scene = {"asset": {"version": "2.0"}, "buffers": [{"uri": "c%20d.bin", "byteLength": 4}]}
        (self.folder / "in/c.gltf").write_text(json.dumps(scene))
        (self.folder / "in/c d.bin").write_bytes(b"1234")
        key, before = self.keys()
        self.assertEqual(self.keys(), (key, before))
        (self.folder / "in/b.obj").write_text(torus(2))
        key, after = self.keys()
        self.assertEqual({number for number in before if before[number] != after[number]}, {"000001"})
        (self.folder / "in/c d.bin").write_bytes(b"12345678")
        _, beside = self.keys()
        self.assertEqual({number for number in after if beside[number] != after[number]}, {"000002"})
        for settings in ({"options": "--resolution 9"}, {"verify": "today"}):
            _, others = self.keys(**settings)
            self.assertFalse(set(others.values()) & set(beside.values()), settings)
        self.assertEqual(self.keys()[1], beside)

    TABLE = b"name,state,error,files\na.obj,done,,.medial.ply .report.json\nb.obj,failed,none,\n"

    def write_results(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "batch.csv").write_bytes(self.TABLE)
        for name in ("a.obj.medial.ply", "a.obj.report.json"):
            (folder / name).touch()

    def check_losses(self, record, text, folder, names):
        """`record` is kept until one of these files is gone."""
        for name in names:
            with self.subTest(name):
                self.write_results(folder)
                record.write_text(text)
                key = self.keys(chunk=2)[0]
                self.assertTrue(record.exists())
                (folder / name).unlink()
                self.assertEqual(self.keys(chunk=2)[0], key)
                self.assertFalse(record.exists())

    def test_a_record_without_its_results_is_none(self):
        (self.folder / "in").mkdir()
        for name in "ab":
            (self.folder / f"in/{name}.obj").write_text(torus(1))
        _, chunks = self.keys(chunk=2)
        chunk = self.folder / "out/.workflow/chunks/000000"
        record, run = chunk / f"done-{chunks['000000']}.json", chunk / "runs/one"
        self.check_losses(record, '{"run": "one"}', run, ("batch.csv", "a.obj.medial.ply", "a.obj.report.json"))
        self.write_results(run)
        (run / "batch.csv").write_bytes(self.TABLE[:self.TABLE.index(b"b.obj")])
        record.write_text('{"run": "one"}')
        self.keys(chunk=2)
        self.assertFalse(record.exists())

    def test_a_merge_without_its_results_is_none(self):
        (self.folder / "in").mkdir()
        for name in "ab":
            (self.folder / f"in/{name}.obj").write_text(torus(1))
        key, _ = self.keys(chunk=2)
        record, output = self.folder / f"out/.workflow/merged-{key}.json", self.folder / "out"
        (output / "failures.csv").touch()
        text = '{"meshes": 2, "beside": ["failures.csv"]}'
        self.check_losses(record, text, output, ("batch.csv", "a.obj.medial.ply", "a.obj.report.json", "failures.csv"))

    def test_settings_that_cannot_work_are_refused_by_name(self):
        (self.folder / "in").mkdir()
        (self.folder / "in/a.obj").write_text(torus(1))
        for option in ("-o x", "-ox", "--output=x", "--threads 3", "--list", "--merge", "-q", "-v", "-qv", "--verbose", "--quiet",
                       "-h", "--help"):
            with self.subTest(option), self.assertRaises(SystemExit) as end:
                self.keys(options=f"--resolution 8 {option}")
            self.assertIn(option.split()[0], str(end.exception))
        for settings in ({"output": self.folder / "r{4}"}, {"output": "-r3"}, {"meshes": "-"}):
            with self.subTest(settings), self.assertRaises(SystemExit) as end:
                self.keys(**settings)
            self.assertIn(next(iter(settings)), str(end.exception))
        self.keys(options="--picture .png --view -0.9,-0.6,1.1")  # a value may begin with the same sign

    def test_jobs_find_a_program_by_a_relative_path(self):
        (self.folder / "in").mkdir()
        (self.folder / "in/a.obj").write_text(torus(1))
        (self.folder / "bin").mkdir()
        (self.folder / "bin/medial-vk").symlink_to(os.path.abspath(MEDIAL_VK))
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.folder)
        key, chunks = self.keys(medial_vk="bin/medial-vk", options="--resolution 6 --backend cpu")
        subprocess.run([sys.executable, SOURCE / "workflows/scripts/run_chunk.py", "out/.workflow/chunks/000000",
                        chunks["000000"], "--attempt", "1", "--last-attempt", "1", "--threads", "1", "--memory", "2000",
                        "--minutes", "1"], check=True, capture_output=True)
        subprocess.run([sys.executable, SOURCE / "workflows/scripts/merge.py", "out", key], check=True, capture_output=True)
        self.assertEqual({row.state for row in table.Table(self.folder / "out").rows.values()}, {"done"})


class TableOfBatch(Folder):
    def test_lines_are_those_of_the_program(self):
        (self.folder / "in").mkdir()
        for name in ("a.obj", 'b, "c".obj', "größe.obj"):
            (self.folder / "in" / name).write_text(torus(3))
        subprocess.run([MEDIAL_VK, "batch", "-q", "--backend", "cpu", "--resolution", "6", self.folder / "in", "-o",
                        self.folder / "out"], check=True)
        read = table.Table(self.folder / "out")
        self.assertEqual(sorted(read.rows), ["a.obj", 'b, "c".obj', "größe.obj"])
        data = (self.folder / "out/batch.csv").read_bytes()
        for row in read.rows.values():
            self.assertEqual(table.join_cells(table.split_line(row.line)), row.line)
            self.assertTrue((self.folder / "out" / row.files()[0]).is_file())
        # The program takes a line that was added here for one of its own, and keeps the others.
        line = read.failed_line('d, "e".obj', "/d", "its process ended")
        table.write_table(self.folder / "out", read.header, [*(row.line for row in read.rows.values()), line])
        result = subprocess.run([MEDIAL_VK, "batch", "--backend", "cpu", "--resolution", "6", self.folder / "in", "-o",
                                 self.folder / "out"], check=True, capture_output=True, text=True)
        self.assertIn("0 done, 3 done before", result.stderr)
        self.assertEqual((self.folder / "out/batch.csv").read_bytes(), data + line + b"\n")

    def test_damaged_and_cut_lines_are_none(self):
        header = b"name,state,error,files"
        (self.folder / "batch.csv").write_bytes(header + b"\na,done,,.x.y\na,started,,\nb,do\nc,done,,.x.y\nd,done,,")
        self.assertEqual({name: row.state for name, row in table.Table(self.folder).rows.items()},
                         {"a": "started", "c": "done"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
