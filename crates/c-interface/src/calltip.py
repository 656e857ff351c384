"""Descriptions of functions by their calltips: `int handle, table t = sim.name(string text, float x=1.0)`.

CoppeliaSim's Python package asks for the types of parameters and results.
"""

import re
from dataclasses import dataclass, field


@dataclass
class VarDef:
    """A parameter or result: its type, its name, the text of its default."""

    name: str
    type: str = "any"
    default: str | None = None


@dataclass
class FuncDef:
    """A function: its name, its parameters and its results."""

    func_name: str
    in_args: list = field(default_factory=list)
    out_args: list = field(default_factory=list)

    @classmethod
    def from_calltip(cls, calltip):
        """The function that a calltip describes. ValueError where it describes none."""
        match = re.fullmatch(r"\s*(?:(.*?)=)?\s*([\w.]+)\s*\((.*)\)\s*", calltip, re.DOTALL)
        if not match:
            raise ValueError(f"no calltip: {calltip!r}")
        results, name, parameters = match.groups()
        return cls(name, _variables(parameters), _variables(results or ""))


def _variables(text):
    return [_variable(part) for part in _parts(text) if part.strip()]


def _parts(text):
    """Splits at commas that are in no brackets and in no quotes."""
    depth, quote, part = 0, None, ""
    for char in text:
        if quote:
            quote = None if char == quote else quote
        elif char in "'\"":
            quote = char
        elif char in "([{":
            depth += 1
        elif char in ")]}":
            depth -= 1
        if char == "," and depth == 0 and not quote:
            yield part
            part = ""
        else:
            part += char
    yield part


def _variable(text):
    declared, equals, default = text.partition("=")
    words = declared.split()
    name = words[-1] if words else ""
    kind = " ".join(words[:-1]) or ("..." if name == "..." else "any")
    return VarDef(name, kind, default.strip() if equals else None)
