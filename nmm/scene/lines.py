"""Line numbers of the keys of a TOML text.

`tomllib` keeps no positions. The text has been parsed by it before, so that this scanner relies on
the grammar and follows only tables, keys, strings, brackets and line ends.
"""

from __future__ import annotations

import re

Path = tuple[str | int, ...]

_STRING = r'"""[\s\S]*?"{3,5}|\'\'\'[\s\S]*?\'{3,5}|"(?:\\.|[^"\\\n])*"|\'[^\'\n]*\''
_TOKEN = re.compile(
    rf"(?P<string>{_STRING})|(?P<comment>#[^\n]*)|(?P<end>\n)|(?P<space>[ \t\r]+)"
    r"|(?P<mark>[\[\]{}=,.])|(?P<word>[^\s\[\]{}=,.#\"']+)"
)


def line_numbers(text: str) -> dict[Path, int]:
    """Return the line (from 1) on which each key path of a valid TOML text begins.

    Paths are tuples of keys and, in arrays, indices: `("blocks", 2, "vertices", 0)`.
    """
    return _Scanner(text).scan()


class _Scanner:
    def __init__(self, text: str) -> None:
        self.tokens: list[tuple[str, str, int]] = []
        line = 1
        for match in _TOKEN.finditer(text):
            kind, value = str(match.lastgroup), match.group()
            if kind not in ("comment", "space"):
                self.tokens.append((kind, value, line))
            line += value.count("\n")
        self.at = 0
        self.found: dict[Path, int] = {}
        self.lengths: dict[Path, int] = {}

    def scan(self) -> dict[Path, int]:
        table: Path = ()
        while self.at < len(self.tokens):
            kind, value, line = self.tokens[self.at]
            if kind == "end":
                self.at += 1
            elif value == "[" and kind == "mark":
                table = self._header(line)
            else:
                self._pair(table)
        return self.found

    def _header(self, line: int) -> Path:
        double = self._peek(1) == "["
        self.at += 2 if double else 1
        path = self._resolve(self._key(), line)
        if double:
            index = self.lengths.get(path, 0)
            self.lengths[path] = index + 1
            path = (*path, index)
        self.found.setdefault(path, line)
        while self.at < len(self.tokens) and self.tokens[self.at][0] != "end":
            self.at += 1
        return path

    def _resolve(self, keys: list[str], line: int) -> Path:
        """Return the path of a header; [a.b] after [[a]] refers to the last element of a."""
        path: Path = ()
        for number, key in enumerate(keys):
            path = (*path, key)
            self.found.setdefault(path, line)
            if path in self.lengths and number < len(keys) - 1:
                path = (*path, self.lengths[path] - 1)
        return path

    def _key(self) -> list[str]:
        parts: list[str] = []
        while self._peek() not in ("=", "]"):
            kind, value, _ = self.tokens[self.at]
            if kind == "string":
                parts.append(value[1:-1])
            elif kind == "word":
                parts.append(value)
            self.at += 1
        return parts

    def _pair(self, table: Path) -> None:
        line = self.tokens[self.at][2]
        path = table
        for key in self._key():
            path = (*path, key)
            self.found.setdefault(path, line)
        self.at += 1  # "="
        self._value(path)

    def _value(self, path: Path) -> None:
        opening = self._peek()
        if self.tokens[self.at][0] != "mark" or opening not in ("[", "{"):
            while self._peek() not in (",", "]", "}", "\n", ""):
                self.at += 1
            return
        self.at += 1
        index = 0
        while self._peek() not in ("]", "}"):
            kind, value, line = self.tokens[self.at]
            if kind == "end" or value == ",":
                self.at += 1
            elif opening == "{":
                self._pair(path)
            else:
                self.found.setdefault((*path, index), line)
                self._value((*path, index))
                index += 1
        self.at += 1

    def _peek(self, ahead: int = 0) -> str:
        """Return the text of a token; a string counts as a word: its content is never a mark."""
        if self.at + ahead >= len(self.tokens):
            return ""
        kind, value, _ = self.tokens[self.at + ahead]
        return "word" if kind == "string" else value
