"""Ways to spoil the text of a scene or formulation: one small change each, drawn by a seed."""

import re
from collections.abc import Callable, Iterator
from random import Random
from typing import Any, get_args

from pydantic import BaseModel

Mutator = Callable[[str, Random], str]

TOKEN = re.compile(r'"[^"\n]*"|[A-Za-z_][\w.-]*|[-+]?\d[\d_.eE+-]*|[\[\]{}=,]')
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
WORD = re.compile(r'"[^"\n]*"')
ODD_VALUES = (
    *("true", "false", '""', '"x"', "[]", "{}", "[[]]", "[1, 2]", "[[0, 0], [1, 1]]", '["x"]'),
    *("0", "-1", "1", "2", "1.5", "nan", "inf", "-inf", "-0.0", "1e-320", "1e308", "1e30", "1e-30"),
    *('"all"', '"any"', '"1 m"', '"1 kg"', '"1e400 m"', '"- m"', '"1 parsec"', '"nan m"', '"9 % "'),
    *(
        "1979-05-27",
        "07:32:00",
        "0x7fffffffffffffffffff",
        "1_000",
        '"os:system"',
        '"a:B"',
        "'''\n'''",
    ),
    *(
        "9" * 400,
        '"\\u0000"',
        '"\\u202e"',
        '"[red]"',
        "{ x = 1 }",
        "[{}]",
        "[true, false]",
        "3",
        "4",
    ),
)
ODD_SIGNS = (
    *("\x00", "\x1b", "\r", "\n", "\t", "\ufeff", "\u202e", "\u00bd", "\U0001f600", "e\u0301"),
    *(
        '"',
        "'",
        '"""',
        "[",
        "]",
        "[[",
        "]]",
        "{",
        "}",
        "=",
        ",",
        ".",
        "#",
        "\\",
        ":",
        "-",
        "\u2212",
    ),
)
FACTORS = (0.0, -1.0, 1e-3, 1e3, 1e-9, 1e9, 1e-15, 1e15, 1e-29, 1e29, 1e300, 0.5, 1 + 1e-15)
DEPTHS = (1, 2, 17, 300, 3000)


def mutated(text: str, random: Random, keys: tuple[str, ...]) -> str:
    """Return a text with one to three changes.

    Parameters
    ----------
    text
        A sound file.
    random
        What is drawn from.
    keys
        Keys that files of its kind may have.
    """
    for _ in range(random.choice((1, 1, 1, 2, 3))):
        way = random.choice((*MUTATORS, None))
        text = _with_key(text, random, keys) if way is None else way(text, random)
    return text


def keys_of(model: type[BaseModel]) -> tuple[str, ...]:
    """Return all keys of a model and of the tables in it, each once."""
    return tuple(dict.fromkeys(_keys(model)))


def _keys(model: type[BaseModel]) -> Iterator[str]:
    for name, info in model.model_fields.items():
        yield info.alias or name
        for inner in _models(info.annotation):
            yield from _keys(inner)


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for item in get_args(annotation):
        yield from _models(item)


def _place(text: str, random: Random) -> int:
    return random.randrange(len(text) + 1)


def _other(text: str, pattern: re.Pattern[str], random: Random, made: Callable[[str], str]) -> str:
    """Change one match of a pattern."""
    found = list(pattern.finditer(text))
    if not found:
        return text
    match = random.choice(found)
    return text[: match.start()] + made(match.group()) + text[match.end() :]


def _flipped(text: str, random: Random) -> str:
    at = _place(text, random)
    return text[:at] + chr(random.choice((random.randrange(32, 127), 0, 10, 255))) + text[at + 1 :]


def _with_sign(text: str, random: Random) -> str:
    at = _place(text, random)
    return text[:at] + random.choice(ODD_SIGNS) + text[at:]


def _without_part(text: str, random: Random) -> str:
    at = _place(text, random)
    return text[:at] + text[at + random.choice((1, 2, 10, 100)) :]


def _cut_off(text: str, random: Random) -> str:
    return text[: _place(text, random)]


def _swapped(text: str, random: Random) -> str:
    found = list(TOKEN.finditer(text))
    if len(found) < 2:
        return text
    one, two = sorted(random.sample(found, 2), key=lambda match: match.start())
    parts = (text[: one.start()], two.group(), text[one.end() : two.start()], one.group())
    return "".join((*parts, text[two.end() :]))


def _lines(text: str, random: Random, change: Callable[[list[str], int], None]) -> str:
    lines = text.splitlines()
    if lines:
        change(lines, random.randrange(len(lines)))
    return "\n".join(lines) + "\n"


def _without_line(text: str, random: Random) -> str:
    return _lines(text, random, lambda lines, at: lines.__delitem__(at))


def _line_twice(text: str, random: Random) -> str:
    return _lines(text, random, lambda lines, at: lines.insert(at, lines[at]))


def _line_moved(text: str, random: Random) -> str:
    return _lines(
        text, random, lambda lines, at: lines.insert(random.randrange(len(lines)), lines.pop(at))
    )


def _table_twice(text: str, random: Random) -> str:
    """Append one table, from its header to the next, again."""
    heads = [match.start() for match in re.finditer(r"^\[", text, re.MULTILINE)]
    if not heads:
        return text
    number = random.randrange(len(heads))
    return text + "\n" + text[heads[number] : [*heads, len(text)][number + 1]]


def _number_changed(text: str, random: Random) -> str:
    factor = random.choice(FACTORS)
    return _other(text, NUMBER, random, lambda told: repr(float(told) * factor))


def _number_replaced(text: str, random: Random) -> str:
    return _other(text, NUMBER, random, lambda told: random.choice(ODD_VALUES))


def _text_replaced(text: str, random: Random) -> str:
    words = WORD.findall(text)
    made = (*ODD_VALUES, *words)
    return _other(text, WORD, random, lambda told: random.choice(made))


def _value_replaced(text: str, random: Random) -> str:
    value = re.compile(r"(?<==)[^\n=]*$", re.MULTILINE)
    return _other(text, value, random, lambda told: " " + random.choice(ODD_VALUES))


def _key_misspelt(text: str, random: Random) -> str:
    key = re.compile(r"^\w+(?= *=)", re.MULTILINE)
    return _other(text, key, random, lambda told: told[:-1] if len(told) > 1 else told + "x")


def _deeper(text: str, random: Random) -> str:
    depth = random.choice(DEPTHS)
    one, other = random.choice((("[", "]"), ("{ a = ", " }")))
    value = re.compile(r"(?<==)[^\n=]*$", re.MULTILINE)
    return _other(text, value, random, lambda told: f" {one * depth}{told}{other * depth}")


def _with_key(text: str, random: Random, keys: tuple[str, ...]) -> str:
    line = f"{random.choice(keys)} = {random.choice(ODD_VALUES)}"
    return _lines(text, random, lambda lines, at: lines.insert(at, line))


# Values are changed as often as text, as most broken text is refused before it is understood.
_OF_VALUES: tuple[Mutator, ...] = (
    *(_number_changed, _number_replaced, _text_replaced, _value_replaced, _table_twice),
)
MUTATORS: tuple[Mutator, ...] = (
    *_OF_VALUES,
    *_OF_VALUES,
    *_OF_VALUES,
    *(_flipped, _with_sign, _without_part, _cut_off, _swapped, _without_line, _line_twice),
    *(_line_moved, _key_misspelt, _deeper),
)
