"""What to write instead of a character that has no meaning in a formula: look-alikes, mathematics, other languages."""

from __future__ import annotations

import unicodedata

ONE_COMPARISON = "there is one comparison at a time: where(a < b, where(b < c, x, y), y)"

OTHER_LANGUAGES = {
    "{": "vectors are written with square brackets: [a, b]",
    "|": "write norm(v) for |v|",
    ".": "start a number with a digit, 0.5; the entries of p are p[0], p[1], ...",
    "&": ONE_COMPARISON,
    "%": "what is left of x after multiples of L is wrap(x, L)",
    "@": "a product of matrices is A * B, one of vectors dot(a, b)",
    "!": "comparisons are <, <=, =, >, >=",
    ";": "a formula is one value; name its parts with `let`",
    "'": "names are written without quotes",
    '"': "names are written without quotes",
    "\\": "write a / b, sqrt(x), cos(x); LaTeX is not read",
}  # fmt: skip

MATHEMATICS = {
    "\u00d7": "*", "\u00b7": "*", "\u22c5": "*", "\u2217": "*", "\u2212": "-", "\u2013": "-", "\u2014": "-", "\u00f7": "/",
    "\u2215": "/", "\u2044": "/", "\u2264": "<=", "\u2265": ">=", "\u221a": "sqrt(x)", "\u221e": "infinity",
    "\u2016": "norm(v)", "\u2225": "norm(v)", "\u27e8": "dot(u, v)", "\u2220": "atan2(y, x)", "\u2297": "outer(a, b)",
}  # fmt: skip

LOOK_ALIKES = dict(zip(
    "\u0430\u0435\u043e\u0440\u0441\u0443\u0445\u0456\u0458\u0455\u0501\u0410\u0412\u0415\u041a\u041c\u041d\u041e\u0420\u0421\u0422\u0425",
    "aeopcyxijsdABEKMHOPCTX",
    strict=True,
))  # fmt: skip


def advice(character: str) -> str | None:
    """A hint, or None for an ASCII character of which nothing is known."""
    if character.isascii():
        return OTHER_LANGUAGES.get(character)
    if not character.isprintable():
        return "formulas are written in plain ASCII: remove it, or write a space; it may be invisible"
    instead = _instead(character)
    return "formulas are written in plain ASCII" + (f": write `{instead}`" if instead else "")


def _instead(character: str) -> str | None:
    """The ASCII that the author meant."""
    if character in MATHEMATICS or character in LOOK_ALIKES:
        return MATHEMATICS.get(character) or LOOK_ALIKES[character]
    name = unicodedata.name(character, "")
    plain = unicodedata.normalize("NFKC", character).replace("\u2044", "/")
    if name.startswith("SUPERSCRIPT") and plain.isascii():
        return f"^{plain}"
    if plain.isascii() and plain.strip():
        return plain
    if name.startswith("GREEK SMALL LETTER") and len(name.split()) == 4:
        return name.split()[-1].lower()
    digit = unicodedata.digit(character, None)
    return None if digit is None else str(digit)
