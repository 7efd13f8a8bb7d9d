"""The table of `medial-vk batch` (docs/formats.md): lines as bytes, and the few columns that the workflow reads."""
import os
import pathlib

from files import text_of, write_whole

TABLE = "batch.csv"
WITH_RESULTS = ("done", "reading")
AT_WORK = ("started", "reading")


def split_line(line):
    """The cells of a line: quotes hold commas, and quotes twice."""
    if b'"' not in line:
        return line.split(b",")
    cells, cell, quoted, i = [], bytearray(), False, 0
    while i < len(line):
        byte = line[i:i + 1]
        if quoted and byte == b'"' and line[i + 1:i + 2] == b'"':
            cell += b'"'
            i += 1
        elif byte == b'"':
            quoted = not quoted
        elif byte == b"," and not quoted:
            cells.append(bytes(cell))
            cell.clear()
        else:
            cell += byte
        i += 1
    cells.append(bytes(cell))
    return cells


def join_cells(cells):
    quoted = [b'"' + cell.replace(b'"', b'""') + b'"' if b"," in cell or b'"' in cell else cell for cell in cells]
    return b",".join(quoted)


def name_of_line(line):
    """The name in the table of a mesh that a list names so: absolute paths are names from the root."""
    return line[1:] if line.startswith("/") else line


class Row:
    """A line of the table."""

    def __init__(self, columns, line, cells):
        self.line = line
        self.cells = dict(zip(columns, cells))
        self.name = text_of(self.cells["name"])
        self.state = text_of(self.cells["state"])
        self.error = text_of(self.cells["error"])

    def is_settled(self):
        return self.state in ("done", "failed")

    def files(self):
        """The names of its files in the folder of the table."""
        return [self.name + ending for ending in text_of(self.cells["files"]).split()]


class Table:
    """The last line of each mesh. Lines that are cut off or damaged are left out, as `medial-vk batch` does."""

    def __init__(self, folder):
        self.header = b""
        self.rows = {}
        try:
            data = (pathlib.Path(folder) / TABLE).read_bytes()
        except OSError:
            return
        lines = data.split(b"\n")[:-1]
        if not lines or not lines[0].startswith(b"name,state,error,"):
            return
        self.header = lines[0]
        columns = [text_of(cell) for cell in split_line(self.header)]
        for line in lines[1:]:
            cells = split_line(line)
            if len(cells) != len(columns):
                continue
            row = Row(columns, line, cells)
            self.rows.pop(row.name, None)
            self.rows[row.name] = row

    def missing_file(self, folder):
        """One of the files that the lines name and that is not in the folder; None if all are there."""
        return next((name for row in self.rows.values() for name in row.files()
                     if not os.path.exists(os.path.join(folder, name))), None)

    def failed_line(self, name, file, reason):
        """The line of a mesh that has no results for this reason."""
        cells = {"name": name, "state": "failed", "error": reason.replace("\n", " "), "file": file}
        columns = [text_of(cell) for cell in split_line(self.header)]
        return join_cells([cells.get(column, "").encode(errors="surrogateescape") for column in columns])


def write_table(folder, header, lines):
    write_whole(pathlib.Path(folder) / TABLE, b"".join(line + b"\n" for line in [header, *lines]))
