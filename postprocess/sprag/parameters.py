# SPDX-License-Identifier: GPL-3.0-only
"""Reads the full list of parameters that a result holds and that `sprag FILE.prm --print-parameters` prints."""

import math
import re
from typing import NamedTuple, Optional


# A comment: what the parameter means, its unit in brackets, and the values that it takes; some tell these in their own words.
COMMENT = re.compile(r"(.*?)(?: \[[^\[\]]*\])?[:;] ((?:auto or )?an? (?:number|integer)\b.*|numbers .*|one of .*)\.")


class Parameter(NamedTuple):
    """The text of a value as used, its unit, "1" where it has none, its default's text where it differs from it, what it means,
    the range of values: "a number > 0", "one of a | b"; empty where the meaning tells it, whether a scene sets it, and the name
    of a file as it is written there."""

    text: str
    unit: str
    default: Optional[str] = None
    meaning: str = ""
    range: str = ""
    is_set: bool = True
    file: str = ""

    @property
    def number(self):
        """Returns the number, or None for another text."""
        try:
            return float(self.text)
        except ValueError:
            return None


def slug(name):
    """The attribute or entry of a name: "Lever/Young modulus" is lever_young_modulus."""
    return "".join(c.lower() if c.isalnum() else "_" for c in name)


def parse_value(text):
    """The value that a line gives: without comment and blanks around it, with \\xHH as the byte it stands for."""
    return re.sub(r"\\x([0-9a-fA-F]{2})", lambda escape: chr(int(escape[1], 16)), text.split("#")[0].strip())


def parse(listing):
    """{"Section/Name": Parameter}. The unit stands in brackets at the end of the comment above."""
    found: dict[str, Parameter] = {}
    section, comment = [], ""
    for line in (line.strip() for line in listing.replace("\\\n", " ").splitlines()):
        if line.startswith("subsection "):
            section.append(line[len("subsection ") :].strip())
        elif line == "end":
            section = section[:-1]
        elif line.startswith(("set ", "#set ")):  # a comment where the parameter was left at its default
            name, _, value = line.partition("set ")[2].partition("=")
            units = re.findall(r"\[([^\[\]]+)\](?=[:;])", comment)
            text, default = parse_value(value), re.search(r"#(?:\s*given as (.*);)?\s*default:(.*)$", value)
            apart = default and different(text, default[2].strip())
            unit = units[-1] if units and units[-1] != "-" else "1"
            parts = COMMENT.fullmatch(comment)
            file = parse_value(default[1]) if default and default[1] and text.startswith("/") else ""
            meaning, rule = (parts[1], parts[2]) if parts else (comment, "")
            found["/".join((*section, name.strip()))] = Parameter(
                text, unit, default[2].strip() if default and apart else None, meaning, rule, line.startswith("set "), file
            )
        comment = f"{comment} {line[1:].strip()}".strip() if line.startswith("#") and not line.startswith("#set ") else ""
    return found


def different(one, other):
    """Tells if two texts differ; 1e3 and 1000 do not."""
    try:
        return float(one) != float(other)
    except ValueError:
        return one != other


def set_apart(parameters):
    """{name: Parameter} of those that a scene sets to other values than their defaults, where output goes left out."""
    apart = lambda parameter: parameter.is_set and parameter.default is not None
    return {name: parameter for name, parameter in parameters.items() if apart(parameter) and not name.startswith("Output/")}


def scene_text(parameters):
    """A scene that holds those parameters alone, as the program reads it."""
    sections: dict[str, list] = {}
    for name, parameter in parameters.items():
        *section, own = name.split("/")
        sections.setdefault("/".join(section), []).append(f"  set {own} = {parameter.file or parameter.text}")
    return "\n".join(f"subsection {section}\n" + "\n".join(lines) + "\nend\n" for section, lines in sections.items())


def document(parameters):
    """{section: {name: number or text}} as schema() describes it."""
    sections: dict[str, dict] = {}
    for full, parameter in parameters.items():
        section, _, name = full.partition("/")
        sections.setdefault(section, {})[name] = plain_value(parameter.text)
    return sections


def parse_document(sections):
    """{"Section/Name": Parameter} of such a document, for scene_text()."""
    return {f"{section}/{name}": Parameter(str(value), "1") for section, entries in sections.items() for name, value in entries.items()}


def plain_value(text):
    """Returns the finite number that a text is, or the text."""
    number = Parameter(text, "1").number
    if number is None or not math.isfinite(number):
        return text
    return int(number) if number.is_integer() else number


def differing(listings):
    """Names of what is not the same in all of the parsed lists, in their order. Where output goes makes no difference."""
    names = dict.fromkeys(name for parameters in listings for name in parameters if not name.startswith("Output/"))
    return [name for name in names if len({compared_value(parameters.get(name)) for parameters in listings}) > 1]


def compared_value(parameter):
    """Returns a value for comparisons, in which 1e3 and 1000 are the same."""
    return parameter and (parameter.number if parameter.number is not None else parameter.text)


def schema(parameters):
    """The JSON schema of {section: {name: value}}, a dictionary. Its units are annotations."""
    sections: dict[str, dict] = {}
    for full, parameter in parameters.items():
        section, _, name = full.partition("/")
        default = plain_value(parameter.text if parameter.default is None else parameter.default)
        unit = {} if parameter.unit == "1" else {"unit": parameter.unit}
        sections.setdefault(section, {})[name] = {"description": parameter.meaning, **unit, "default": default, **range_rule(parameter.range)}
    closed = {name: {"type": "object", "properties": each, "additionalProperties": False} for name, each in sections.items()}
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "type": "object", "properties": closed, "additionalProperties": False}


def range_rule(text):
    """Returns the rule of a range of values."""
    if text.startswith("one of "):
        return {"enum": [int(word) if word.isdigit() else word for word in text[len("one of ") :].split(" | ")]}
    kind = re.match(r"(auto or )?an? (number|integer)", text)
    if not kind:
        return {"type": ["string", "number"]}
    words = {">": "exclusiveMinimum", ">=": "minimum", "<": "exclusiveMaximum", "<=": "maximum"}
    limits = {words[sign]: float(number) for sign, number in re.findall(r"([<>]=?) ([-+\d.e]+)", text)}
    number = {"type": kind[2], **limits}
    return {"anyOf": [{"const": "auto"}, number]} if kind[1] else number
