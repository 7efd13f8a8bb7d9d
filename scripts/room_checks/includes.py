"""The #include directives of a source."""

import re

# Comments, and strings, which may hold what looks like a comment. The name of an included file in < > is no string.
TOKEN = re.compile(r"""(?P<comment>//(?:\\\n|[^\n])*|/\*.*?(?:\*/|\Z))"""
                   r"""|(?P<raw>R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)")"""
                   r"""|include[ \t]*<[^>\n]*>|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'""", re.DOTALL)
DIRECTIVE = re.compile(r"\s*(?:#|%:)\s*(?:include|include_next|import)\b(.*)")
NAME = re.compile(r'\s*(?:"([^"]+)"|<([^>]+)>)')


def includes(text):
    """Yields (line, name, True if the name is quoted) of each include, without those in comments and raw strings.

    The name is None if a macro gives it.
    """
    directive = ""
    for number, line in enumerate(TOKEN.sub(without_comment, text).split("\n"), 1):
        directive += line
        if directive.endswith("\\"):
            directive = directive[:-1]
            continue
        if found := DIRECTIVE.match(directive):
            name = NAME.match(found[1])
            yield (number, name[1] or name[2], name[1] is not None) if name else (number, None, False)
        directive = ""


def without_comment(token):
    """A blank for a comment, which does not end a line of the program, and "" for a raw string; with as many lines."""
    count = token[0].count("\n")
    if token["comment"]:
        return " " + "\\\n" * count
    return '""' + "\n" * count if token["raw"] else token[0]
