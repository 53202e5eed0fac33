"""Plain text as Markdown: docstrings of classes and comments of netlists."""

from __future__ import annotations

import re

from generate.tables import fence

STARS = re.compile(r"([*<\[\]|]|(?<![\w`])_|_(?!\w))")


def flowing(text: str, up: str = "../../") -> list[str]:
    """Paragraphs that flow; what is indented or aligned (equations, tables, netlists) keeps its lines."""
    lines: list[str] = []
    for one in re.split(r"\n\s*\n", text.strip("\n")):
        lines += fence("text", one) if _aligned(one) else [_prose(one, up), ""]
    return lines


def _aligned(text: str) -> bool:
    return any(line.startswith(" ") or "   " in line for line in text.splitlines())


def _prose(text: str, up: str) -> str:
    """Signs outside `code` are themselves; the pages of docs/ that a text names are links."""
    parts = re.split(r"(`[^`]+`)", text)
    said = "".join(part if part.startswith("`") else STARS.sub(r"\\\1", part) for part in parts)
    said = re.sub(r"^(\s*)([-+#>]|\d+\.)(?=\s)", r"\1\\\2", said, flags=re.MULTILINE)
    return re.sub(r"`?docs/([\w/]+)\.md`?", rf"[docs/\1.md]({up}\1.md)", said)
