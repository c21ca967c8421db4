# SPDX-License-Identifier: GPL-3.0-only
"""No sentence of a page has more than 30 words. Code, tables, headings and pictures do not count, a name in code is one word."""

import os
import pathlib
import re
import sys

ROOT = pathlib.Path(os.environ.get("SPRAG_SOURCE", pathlib.Path(__file__).parents[2]))
MANY_WORDS = 30


def read_paragraphs(page):
    """Prose; each item of a list is a paragraph."""
    text = re.sub(r"```.*?```", "\n\n", page.read_text(encoding="utf-8"), flags=re.S)
    text = re.sub(r"^(?: {4,}(?![-*] ).*|\t.*|#.*| *\|.*|!\[.*|> .*)$", "", text, flags=re.M)
    text = re.sub(r"^ *(?:[-*]|\d+\.) +", "\n\n", text, flags=re.M)
    return [" ".join(part.split()) for part in re.split(r"\n\s*\n", text) if part.strip()]


def read_sentences(page):
    for paragraph in read_paragraphs(page):
        plain = re.sub(r"\]\([^)]*\)", "]", paragraph)
        plain = re.sub(r"`[^`]*`|\$[^$]*\$", "NAME", plain)
        plain = re.sub(r"\b(e\.g|Figs?|eqs?|Proc|Inst|Mech|Eng|Res|Commun|J|Vib)\.", r"\1", plain)
        yield from (part for part in re.split(r"(?<=[.?!])[*)]*\s+|(?<=:)[*]*\s+(?=[A-Z*\[(`])", plain) if len(part.split()) > 1)


pages = [path for path in sorted(ROOT.glob("**/*.md")) if "build" not in str(path.relative_to(ROOT))]
sentences = [(page.relative_to(ROOT), sentence) for page in pages for sentence in read_sentences(page)]
long = [(page, sentence) for page, sentence in sentences if len(sentence.split()) > MANY_WORDS]
for page, sentence in long:
    print(f"{page}: {len(sentence.split())} words: {sentence}")
print(f"{len(sentences)} sentences on {len(pages)} pages, {len(long)} over {MANY_WORDS} words")
sys.exit(bool(long) or not sentences)
