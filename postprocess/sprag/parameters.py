# SPDX-License-Identifier: GPL-3.0-only
"""Reads the full list of parameters that a result holds and that `sprag FILE.prm --print-parameters` prints."""

import re
from typing import NamedTuple, Optional


class Parameter(NamedTuple):
    """The text of a value as used, its unit, "1" where it has none, and its default's text where it was set apart from it."""

    text: str
    unit: str
    default: Optional[str] = None

    @property
    def number(self):
        """None where the text is no number."""
        try:
            return float(self.text)
        except ValueError:
            return None


def value_of_text(text):
    """The value that a line gives: without comment and blanks around it, with \\xHH as the byte it stands for."""
    return re.sub(r"\\x([0-9a-fA-F]{2})", lambda escape: chr(int(escape[1], 16)), text.split("#")[0].strip())


def parse(listing):
    """{"Section/Name": Parameter}. The unit stands in brackets at the end of the comment above."""
    found, section, comment = {}, [], ""
    for line in (line.strip() for line in listing.replace("\\\n", " ").splitlines()):
        if line.startswith("subsection "):
            section.append(line[len("subsection ") :].strip())
        elif line == "end":
            section = section[:-1]
        elif line.startswith("set "):
            name, _, value = line[len("set ") :].partition("=")
            unit = re.findall(r"\[([^\[\]]+)\](?=[:;])", comment)
            text, default = value_of_text(value), re.search(r"#\s*default:(.*)$", value)
            apart = default and different(text, default[1].strip())
            unit = unit[-1] if unit and unit[-1] != "-" else "1"
            found["/".join((*section, name.strip()))] = Parameter(text, unit, default[1].strip() if apart else None)
        comment = f"{comment} {line[1:].strip()}".strip() if line.startswith("#") else ""
    return found


def different(one, other):
    """Whether two texts differ; 1e3 and 1000 do not."""
    try:
        return float(one) != float(other)
    except ValueError:
        return one != other


def set_apart(parameters):
    """{name: Parameter} of those that are not at their defaults, where output goes left out."""
    return {name: parameter for name, parameter in parameters.items() if parameter.default is not None and not name.startswith("Output/")}


def scene_of(parameters):
    """A scene that holds those parameters alone, as the program reads it."""
    sections = {}
    for name, parameter in parameters.items():
        *section, own = name.split("/")
        sections.setdefault("/".join(section), []).append(f"  set {own} = {parameter.text}")
    return "\n".join(f"subsection {section}\n" + "\n".join(lines) + "\nend\n" for section, lines in sections.items())


def differing(listings):
    """Names of what is not the same in all of the parsed lists, in their order. Where output goes makes no difference."""
    names = dict.fromkeys(name for parameters in listings for name in parameters if not name.startswith("Output/"))
    return [name for name in names if len({value_of(parameters.get(name)) for parameters in listings}) > 1]


def value_of(parameter):
    """1e3 and 1000 are the same."""
    return parameter and (parameter.number if parameter.number is not None else parameter.text)
