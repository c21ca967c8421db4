# SPDX-License-Identifier: GPL-3.0-only
"""Reports of results as one HTML file each, with all pictures in it: nothing else is loaded, and no text of a result is run."""

import base64
import re
from pathlib import Path

from headlines import HEADLINES, headlines
from several import told_apart
from sketch import device_svg
from sprag.parameters import differing, parse, scene_of, set_apart, value_of
from sprag.results import NotAResult

# The sketch of the device leaves these out, where a parameter is not as usual.
NOT_SKETCHED = {
    ("Lever/Outline", "bar"): "the outline of the lever",
    ("Friction plate/Type", "none"): "the friction plate",
    ("Rotational spring/Type", "torsional"): "the leaf spring",
    ("Mirrored pair/Type", "half"): "the second lever",
}
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
    names = told_apart(results).names if len(results) > 1 else [result.name for result in results]
    devices = [device_svg(result, each) for result, each in zip(results, parameters)]
    text = template.render(
        title=results[0].name if len(results) == 1 else f"Comparison of {len(results)} results",
        results=[about(*each) for each in zip(results, names, parameters, (Markup(device or "") for device in devices))],
        numbers=numbers(results),
        differences=[(name, [said(each.get(name)) for each in parameters]) for name in differing(parameters)] if len(results) > 1 else [],
        pictures={name: base64.b64encode(file.read_bytes()).decode() for name, file in pictures.items()},
    )
    path.write_text(text, encoding="utf-8")
    print(path)


def about(result, name, parameters, device):
    apart = set_apart(parameters)
    return {
        "name": name,
        "folder": result.name,
        "type": result.type,
        "verdict": verdict(result),
        "device": device,
        "left_out": [words for (name, usual), words in NOT_SKETCHED.items() if name in parameters and parameters[name].text != usual],
        "warnings": [(text, text.more.get("effect", ""), text.more.get("remedy", "")) for text in warnings(result)],
        "apart": [(key, said(parameter), parameter.default) for key, parameter in apart.items()],
        "scene": scene_of(apart),
        "meta": {key: rounded(value) for key, value in result.meta.items() if not key.startswith(("cpu_time_", "wall_time_"))},
        "cost": f"{result.meta['cpu_time']:.3g} s of CPU time" if "cpu_time" in result.meta else "",
    }


def warnings(result):
    return [text for text in result.groups.get("warnings", {}).values() if isinstance(text, str)]


def numbers(results):
    """[(entry, meaning, unit, [(value, in J, error) of each result])], ten of the first result's type."""
    known = [headlines(result) for result in results]
    names = [name for name in HEADLINES.get(results[0].type, ()) if all(name in found for found in known)][:10]
    return [(name, known[0][name].description, known[0][name].unit, [told(*each, name) for each in zip(results, known)]) for name in names]


def told(result, found, name):
    number, error = found[name], error_of(result, name)
    joules = f"{number / 1000:.4g} J" if number.unit == "N mm" else ""
    return f"{number:.4g}", joules, "" if error is None else f"\N{PLUS-MINUS SIGN} {100 * error:.2g} %"


def error_of(result, name):
    """The estimated relative error of an entry; None where there is none. Peaks of a force share that of the force."""
    accuracy = result.groups.get("accuracy", {})
    force = re.fullmatch(r"peak_([PQ])_\w+", name)
    share = re.fullmatch(r"reversal_1_(frequency|overshoot)\w*", name)
    error = accuracy.get(name, accuracy.get(force[1] if force else share[1] if share else ""))
    return float(error) if isinstance(error, float) and error == error else None


def said(parameter):
    if parameter is None:
        return "default"
    text = value_of(parameter) if parameter.number is None else f"{parameter.number:g}"
    return f"{text} {parameter.unit}" if parameter.unit != "1" else text


def rounded(value):
    return f"{value:.4g} {value.unit if value.unit != '1' else ''}".strip() if isinstance(value, float) else value


# Verdicts


def verdict(result):
    """Sentences that answer what the analysis asked."""
    if not result.finished:
        return "The run goes on, or was killed: what follows is as far as it came."
    found, words = result.summary, []
    n = lambda name, digits=4: f"{found[name]:.{digits}g} {found[name].unit if found[name].unit != '1' else ''}".strip()  # noqa: E731
    known = lambda *names: all(name in headlines_of(result) for name in names)  # noqa: E731
    if known("peak_P_forward", "peak_P_backward", "loop_area"):
        words.append(f"The normal force P reaches {n('peak_P_forward')} forward and {n('peak_P_backward')} backward.")
        words.append(f"The drive does {n('loop_area')} ({found['loop_area'] / 1000:.3g} J) of work.")
    if known("largest_pressure"):
        words.append(f"The largest pressure on the friction face is {n('largest_pressure')}.")
    if known("reversal_1_frequency") and "reversal_1_verdict" in found:
        words.append(f"The first reversal rings at {n('reversal_1_frequency')}; the ringing {found['reversal_1_verdict']}.")
    if "verdict" in found:
        grows = f", and grows by {n('growth_rate', 3)} at {n('frequency', 3)}" if known("growth_rate", "frequency") and found["growth_rate"] > 0 else ""
        where = f" at x = {n('x')}" if known("x") else ""
        words.append(f"The slide{where}, {result.parameter('Stability', 'Direction')}: {found['verdict']}{grows}.")
    for name in (name for name in headlines(result) if name.startswith("critical_")):
        words.append(f"{found[name].description} at {n(name)}.")
    if known("cycle_frequency", "cycle_amplitude_P"):
        words.append(f"It ends in a cycle of {n('cycle_frequency')}, in which P swings by {n('cycle_amplitude_P', 3)}.")
    if known("transmissibility_rms"):
        words.append(f"The table moves with {n('transmissibility_rms', 3)} times the acceleration of its base (root mean square).")
    if known("largest_displacement"):
        words.append(f"It moves by up to {n('largest_displacement', 3)} against the base.")
    if "meets_demands" in found:
        words.append("The lever meets all demands." if found["meets_demands"] == 1 else "No lever was found that meets all demands.")
    if known("unstable_forward", "unstable_backward"):
        words.append(f"Unstable are {100 * found['unstable_forward']:.3g} % of the map forward, {100 * found['unstable_backward']:.3g} % backward.")
    if "runs" in found and "completed" in found:
        words.append(f"{found['completed']:.0f} of {found['runs']:.0f} runs were completed.")
    status, number = found.get("status", "no status"), len(warnings(result))
    words.append(f"{status[:1].upper()}{status[1:]}, {'no warnings' if number == 0 else '1 warning' if number == 1 else f'{number} warnings'}.")
    return " ".join(words)


def headlines_of(result):
    """Any number that is known."""
    return {name for name, value in result.summary.items() if isinstance(value, float) and value == value}
