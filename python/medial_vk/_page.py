"""Pages for browsers and notebooks."""

from __future__ import annotations

import os


class Page:
    """One self-contained HTML file, which works without a network. A notebook shows it in a frame."""

    def __init__(self, html: bytes) -> None:
        self.html = html  #: The file.

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file."""
        with open(path, "wb") as file:
            file.write(self.html)

    def _repr_html_(self) -> str:
        from html import escape

        text = escape(self.html.decode("utf-8", "replace"), quote=True)
        return f'<iframe srcdoc="{text}" width="100%" height="560" style="border: 0"></iframe>'

    def __repr__(self) -> str:
        return f"<Page of {len(self.html):,} bytes>"
