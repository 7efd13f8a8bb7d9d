"""The functions of a source, with their first and last lines, for the limits of size of scripts/check-rooms."""

import ast
import re

from room_checks.suffixes import CODE


def functions(suffix, lines):
    """Yields (first line, last line, name) of the functions of a file, without lambdas in functions."""
    if suffix == ".py":
        for node in ast.walk(ast.parse("\n".join(lines))):
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
                yield node.lineno, node.end_lineno, node.name
    elif suffix in CODE:
        yield from c_functions("\n".join(lines))
    elif suffix in (".js", ".mjs", ".sh"):
        yield from functions_by_indentation(lines)


def functions_by_indentation(lines):
    """The functions of JavaScript and of the shell: their last brace is indented as their first line is."""
    for first, line in enumerate(lines):
        found = (re.match(r"( *)(?:export )?(?:async )?function\*? (\w+)\(", line) or re.match(r"( *)(\w+)\(\) \{", line)
                 or re.match(r"( +)(?:static |async |get |set )*(\w+)\([^;]*\) \{$", line))
        if not found or found[2] in ("if", "for", "while", "switch", "catch"):
            continue
        last = next((i for i in range(first, len(lines)) if lines[i].startswith(found[1] + "}")), first)
        yield first + 1, last + 1, found[2]


TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"'
                   r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*|[{};]", re.DOTALL | re.MULTILINE)


def c_functions(text):
    """Counts braces: a brace opens a function if the text before it has a parameter list and declares no class or array."""
    stack, start, kind = [], 0, ""  # of (kind, offset of the first character of the declaration, name)
    for token in TOKEN.finditer(text):
        if token[0] not in "{};":
            continue
        if token[0] == "{":
            before = strip_comments(text[start : token.start()])
            kind, name = kind_of_block(before)
            if any(k == "function" for k, _, _ in stack):
                kind = "inner"
            first = start + len(text[start : token.start()]) - len(drop_leading(text[start : token.start()]))
            stack.append((kind, first, name))
        elif token[0] == "}" and stack:
            kind, first, name = stack.pop()
            if kind == "function":
                yield text.count("\n", 0, first) + 1, text.count("\n", 0, token.start()) + 1, name
            # Braces after members initialize them and do not open the function's body, which follows.
            if re.match(r"\s*[,{]", text[token.end() :]):
                continue
        # Braces of a value do not start a new declaration.
        if token[0] == ";" or kind != "other":
            start = token.end()


def strip_comments(text):
    return TOKEN.sub(lambda t: t[0] if t[0] in "{};" else ('""' if t[0][0] in "\"R'" else " "), text)


def drop_leading(text):
    """Removes blanks and comments before the first word."""
    while found := re.match(r"\s+|//[^\n]*\n?|/\*.*?\*/|#[^\n]*\n", text, re.DOTALL):
        text = text[found.end() :]
    return text


def kind_of_block(before):
    """The kind of block that a brace opens, by the declaration before it, and the name of a function."""
    before = re.sub(r"operator\s*[^\w\s(]+", "operator", before)
    for nested in (r"\([^()]*\)", r"<[^<>()]*>"):  # parameters and template arguments, from the inside out
        while (shorter := re.sub(nested, "@" if nested[1] == "(" else "", before)) != before:
            before = shorter
    if "(" in before:  # an argument
        return "other", ""
    if re.search(r"\b(namespace|class|struct|union|enum|extern)\b[^@=]*$", before):
        return "scope", ""
    found = re.search(r"([~\w:]+)\s*@", before)
    is_value = "=" in before and "[" not in before
    return ("function", found[1]) if found and not is_value else ("other", "")
