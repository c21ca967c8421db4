# SPDX-License-Identifier: GPL-3.0-only
"""Reports of results as one HTML file each, with all pictures in it: nothing else is loaded, and no text of a result is run."""

import base64
import re
from pathlib import Path

import numpy as np

from arguments import DPI
from design import free_parameters
from several import distinguish, headlines_in_common, said
from sketch import device_svg
from sprag.parameters import differing, parse, scene_text, set_apart, slug
from sprag.results import NotAResult
from style import TWO_COLUMNS
from study import find_quantities, varied_parameters

# The sketch of the device leaves these out, where a parameter is not as usual.
NOT_SKETCHED = {
    ("Lever/Outline", "bar"): "the outline of the lever",
    ("Friction plate/Type", "none"): "the friction plate",
    ("Rotational spring/Type", "torsional"): "the leaf spring",
    ("Mirrored pair/Type", "half"): "the second lever",
}
MOST_RUNS = 20  # rows of a study's table
BESIDE_HEADLINES = ("slope_forward", "slope_backward", "largest_lever_stress", "largest_layer_stress")  # of a drive
TEMPLATE = Path(__file__).with_name("report.html")


def write_report(results, pictures, path):
    """pictures: {name: file}, PNG. Throws NotAResult without Jinja2."""
    try:
        from jinja2 import Environment, select_autoescape
        from markupsafe import Markup
    except ImportError as error:
        raise NotAResult("a report needs Debian's python3-jinja2") from error
    environment = Environment(autoescape=select_autoescape(default=True), trim_blocks=True, lstrip_blocks=True)
    template = environment.from_string(TEMPLATE.read_text(encoding="utf-8"))
    parameters = [parse(result.parameters) for result in results]
    names = [result.name for result in results]
    if len(results) > 1:
        several = distinguish(results)
        names = [plain(name if several.values is None else f"{several.parameter} {name}") for name in several.names]
    devices = [device_svg(result, each) for result, each in zip(results, parameters)]
    text = template.render(
        title=results[0].name if len(results) == 1 else f"Comparison of {len(results)} results",
        results=[about(*each) for each in zip(results, names, parameters, (Markup(device or "") for device in devices))],
        numbers=numbers(results),
        differences=[(name, [plain(said(each.get(name))) for each in parameters]) for name in differing(parameters)] if len(results) > 1 else [],
        pictures=[(name, *embedded(file.read_bytes())) for name, file in pictures.items()],
    )
    path.write_text(text, encoding="utf-8")
    print(path)


def plain(text):
    """A text with a unit whose powers are not raised as in pictures."""
    return re.sub(r"\$\^\{(.*?)\}\$", r"^\1", text)


def embedded(picture):
    """The text of a PNG, and its share of a page's width [%]."""
    return base64.b64encode(picture).decode(), min(100, round(100 * int.from_bytes(picture[16:20]) / (DPI * TWO_COLUMNS)))


def about(result, name, parameters, device):
    apart = set_apart(parameters)
    return {
        "name": name,
        "folder": result.name,
        "type": result.type,
        "status": status(result),
        "answer": answer(result),
        "runs": study_runs(result) if result.type == "study" else None,
        "device": device,
        "left_out": [words for (name, usual), words in NOT_SKETCHED.items() if name in parameters and parameters[name].text != usual],
        "warnings": [(text, text.more.get("effect", ""), text.more.get("remedy", "")) for text in warnings(result)],
        "apart": [(key, plain(said(parameter)), parameter.default) for key, parameter in apart.items()],
        "scene": scene_text(apart),
        "meta": {key: rounded(value) for key, value in result.meta.items() if not key.startswith(("cpu_time_", "wall_time_"))},
        "cost": f"{result.meta['cpu_time']:.3g} s of CPU time" if "cpu_time" in result.meta else "",
    }


def answer(result):
    """[(line, text)] as the program prints them; of a design its lever and what becomes of the demands."""
    lines = list(zip(*result.groups.get("answer", {}).values()))
    if result.type != "design" or not result.summary.get("evaluations"):
        return lines
    demands = result.groups.get("demands", {"demand": [], "value": []})
    lever = [(name, rounded(result.summary[slug(name)])) for name, _, _ in free_parameters(result)]
    within = bool(result.parameter("Design", "Tolerances"))
    texts = [demand_text(result, demand, f"{value:.4g}") for demand, value in zip(demands["demand"], demands["value"])]
    if within:
        texts = [f"{text}, at worst {worst:.4g}" for text, worst in zip(texts, demands["worst"])]
    return [*lever, *zip(demands["demand"], texts), *lines]


def demand_text(result, demand, text):
    """A number as text with the unit of the quantity that is demanded."""
    unit = getattr(result.summary.get(slug(re.split("[<>=]", demand)[0].strip())), "unit", "1")
    return text if unit == "1" else f"{text} {unit}"


def study_runs(result):
    """The first rows of a study's table: what was varied, the columns that say most, outcome and warnings."""
    head = lambda name, unit: name if unit == "1" else f"{name} [{unit}]"
    columns = {head(one.name, one.unit): one.texts for one in varied_parameters(result)}
    columns.update({head(name, result.units[name]): [f"{value:.4g}" for value in result.table[name]] for name in find_quantities(result)})
    columns.update({name: result.groups["runs"][name].astype(str) for name in ("outcome", "warnings") if name in result.groups["runs"]})
    rows = list(zip(*columns.values()))
    return {"heads": list(columns), "rows": rows[:MOST_RUNS], "more": max(0, len(rows) - MOST_RUNS)}


def warnings(result):
    return [text for text in result.groups.get("warnings", {}).values() if isinstance(text, str)]


def numbers(results):
    """[(entry, meaning, unit, [(value, in J, error) of each result])]."""

    def entry(name):
        first = results[0].summary[name]
        return name, first.description, first.unit, [entry_text(result, name) for result in results]

    beside = [name for name in BESIDE_HEADLINES if all(np.isfinite(result.summary.get(name, np.nan)) for result in results)]
    return [entry(name) for name in [*headlines_in_common(results), *beside] if not is_limit_error(name)]


def entry_text(result, name):
    number, error = result.summary[name], entry_error(result, name)
    joules = f"{number / 1000:.4g} J" if number.unit == "N mm" else ""
    if all(f"{name}_{end}" in result.summary for end in ("low", "high")):
        return f"{number:.4g}", joules, " to ".join(f"{result.summary[f'{name}_{end}']:.4g}" for end in ("low", "high"))
    if not name.startswith("critical_"):
        return f"{number:.4g}", joules, "" if error is None else f"\N{PLUS-MINUS SIGN} {100 * error:.2g} %"
    # The answer rounds limits to the stable side: with more digits here, none contradicts it.
    error = result.summary.get(f"{name}_error")
    return f"{number:.6g}", joules, "" if error is None else f"\N{PLUS-MINUS SIGN} {error:.2g} {number.unit}"


def is_limit_error(name):
    return name.startswith("critical_") and name.endswith("_error")


def entry_error(result, name):
    """The estimated relative error of an entry; None where there is none. Peaks of a force share that of the force."""
    accuracy = result.groups.get("accuracy", {})
    force = re.fullmatch(r"peak_([PQ])_\w+", name)
    share = re.fullmatch(r"reversal_1_(frequency|overshoot)\w*", name)
    error = accuracy.get(name, accuracy.get(force[1] if force else share[1] if share else ""))
    return float(error) if isinstance(error, float) and error == error else None


def rounded(value):
    return f"{value:.4g} {value.unit if value.unit != '1' else ''}".strip() if isinstance(value, float) else value


def status(result):
    if not result.finished:
        return "The run goes on, or was killed: what follows is as far as it came."
    text, number = result.summary.get("status", "no status"), len(warnings(result))
    return f"{text[:1].upper()}{text[1:]}, {'no warnings' if number == 0 else '1 warning' if number == 1 else f'{number} warnings'}."
