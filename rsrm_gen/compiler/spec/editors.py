"""The schema of manifold files as JSON schema, for editors that complete keys, show what they mean and underline mistakes.

The models of `schema.py` say what a file may hold; here is added what only people need: titles and examples, and in terms
of JSON schema what the models check by code.
"""

from __future__ import annotations

from typing import Any

from pydantic.json_schema import models_json_schema

from rsrm_gen.compiler.spec.schema import FORMULA, ManifoldFile, ProductFile

DIALECT = "https://json-schema.org/draft/2020-12/schema"
NUMBER_OR_TEXT = {"anyOf": [{"type": "string", "minLength": 1}, {"type": "number"}]}
FORMULA_SCHEMA = {
    "title": "Formula",
    "description": "a formula as text; a number, or a list of formulas, may stand without quotes",
    "anyOf": [
        *NUMBER_OR_TEXT["anyOf"],
        {"type": "array", "items": {"anyOf": [*NUMBER_OR_TEXT["anyOf"], {"type": "array", "items": NUMBER_OR_TEXT}]}},
    ],
}

EXAMPLES: dict[str, dict[str, list[Any]]] = {
    "Heading": {
        "manifold": ["sphere", "my_arm"],
        "doc": ["The unit sphere S^n in R^(n+1) with the round metric; distances are angles in radians."],
        "symbols": [{"p": "joint angles in radians"}],
        "parameters": [{"n": 2}, {"radius": "1/2"}],
        "scale": ["radius"],
    },
    "ManifoldFile": {
        "let": [{"a": "m1 * c1^2 + i1"}],
        "frame": [["qmul(p, [0, 1/2, 0, 0])", "qmul(p, [0, 0, 1/2, 0])", "qmul(p, [0, 0, 0, 1/2])"]],
        "metric": ["dot(u, v)", [["r^2", 0], [0, 1]]],
        "maps": ["retraction"],
        "exp": ["wrap(p + v)", "cos(norm(v)) * p + sinc(norm(v)) * v"],
        "log": ["wrap(q - p)", {"let": {"d": "q - p"}, "value": "d"}],
        "norm": ["sqrt(dot(v, v))"],
        "distance": ["t"],
        "log_det": ["(n - 1) * log(t / sin(t))"],
        "transport": ["v"],
        "sample": ["normal / norm(normal)"],
        "injectivity_radius": ["pi", "infinity"],
        "diameter": ["pi"],
    },
    "LetSection": {"let": [{"d": "q - p", "t": "norm(d)"}], "value": ["t * d"]},
    "EmbeddedSection": {
        "space": ["R^(n+1)"],
        "constraint": ["dot(p, p) - 1"],
        "project": ["p / norm(p)"],
        "domain": ["p[0] > 0"],
        "equivalent": ["-p"],
    },
    "ChartSection": {"space": ["R^n"], "domain": ["p[1] > 0"], "period": ["2 * pi", ["2 * pi", None]]},
    "CutLocusSection": {
        "where": ["norm(q + p) <= 4 * eps"],
        "log": ["pi * orthogonal(p)"],
        "log_det": ["(n - 1) * log(pi / (4 * eps))"],
        "policy": ["tie"],
    },
    "FactorSection": {"manifold": ["torus"], "parameters": [{"n": 6}], "weight": ["reach"], "power": [2]},
    "ProductFile": {"product": [{"base": "se2", "arm": {"manifold": "torus", "parameters": {"n": 6}}}]},
}
SECTIONS = {
    "embedded": "points are vectors in R^D under constraints",
    "chart": "points are coordinates, maybe periodic",
    "cut_locus": "where shortest geodesics stop being unique, and what the code returns there",
}


def json_schema() -> dict[str, Any]:
    """The JSON schema of manifold files: of a product where there is a key `product`, else of a single manifold."""
    _, made = models_json_schema([(ManifoldFile, "validation"), (ProductFile, "validation")])
    definitions = {name: _named(name, definition) for name, definition in made["$defs"].items()}
    definitions["Formula"] = FORMULA_SCHEMA
    _exactly_one(definitions["ManifoldFile"], ["embedded"], ["chart"])
    _exactly_one(definitions["CutLocusSection"], ["policy"], ["log", "log_det"])
    definitions["ManifoldFile"]["required"] += ["exp", "log"]
    return {
        "$schema": DIALECT,
        "title": "A manifold for rsrm-gen",
        "type": "object",
        "if": {"required": ["product"]},
        "then": {"$ref": "#/$defs/ProductFile"},
        "else": {"$ref": "#/$defs/ManifoldFile"},
        "$defs": definitions,
    }


def _named(name: str, definition: dict[str, Any]) -> dict[str, Any]:
    """A definition whose keys have a title, a description and examples."""
    examples = {**EXAMPLES["Heading"], **EXAMPLES.get(name, {})}
    for key, schema in definition.get("properties", {}).items():
        schema["title"] = key
        if key in examples:
            schema["examples"] = examples[key]
        if key in SECTIONS:
            schema.setdefault("description", SECTIONS[key])
    with_formulas: dict[str, Any] = _with_formulas(definition)
    return with_formulas


def _with_formulas(schema: Any) -> Any:
    """The schema with a reference to that of formulas wherever one stands, and no names but those of a pattern."""
    if isinstance(schema, list):
        return [_with_formulas(item) for item in schema]
    if not isinstance(schema, dict):
        return schema
    if FORMULA.items() <= schema.items():
        rest = {key: value for key, value in schema.items() if key not in FORMULA}
        return {"$ref": "#/$defs/Formula", **rest}
    found = {key: value if key == "examples" else _with_formulas(value) for key, value in schema.items()}
    return {**found, "additionalProperties": False} if "patternProperties" in found else found


def _exactly_one(definition: dict[str, Any], *keys: list[str]) -> None:
    definition["oneOf"] = [{"required": some} for some in keys]
