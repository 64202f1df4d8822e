"""YAML files as plain data that still knows where each value stood, checked against a pydantic schema.

User files are data: they are composed, never constructed, so no YAML tag can run code; aliases are refused, because a
few of them can stand for more data than a machine holds.
"""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar, get_args

import yaml
from pydantic import BaseModel, Tag, ValidationError

from rsrm_gen.errors import Source, Span, UserError, did_you_mean

MAX_CHARACTERS = 200_000
MAX_DEPTH = 40
MAX_NUMBER = 400  # characters
YAML = "tag:yaml.org,2002:"
PLAIN = {"str", "int", "float", "bool", "null", "map", "seq"}

Path_ = tuple[str | int, ...]
Model = TypeVar("Model", bound=BaseModel)


@dataclass(frozen=True)
class Document:
    """A YAML document: `data` as dicts, lists and scalars; the positions of every value and key by path."""

    source: Source
    data: dict[str, Any]
    values: dict[Path_, Span] = field(repr=False)
    keys: dict[Path_, Span] = field(repr=False)

    def span(self, path: Path_) -> Span:
        """Where the value at that path stands; the closest enclosing value if there is none."""
        while path and path not in self.values:
            path = path[:-1]
        return self.values[path]

    def key_span(self, path: Path_) -> Span:
        """Where the key at that path stands."""
        return self.keys.get(path) or self.span(path)


def read_document(path: Path) -> Document:
    """Read a YAML file; every way in which it can be unreadable is a `UserError`."""
    try:
        with path.open(encoding="utf-8-sig") as file:
            text = file.read(MAX_CHARACTERS + 1)
    except FileNotFoundError:
        folder = path.parent
        stems = {p.stem: p.name for p in folder.glob(f"*{path.suffix}")} if folder.is_dir() else {}
        close = difflib.get_close_matches(path.stem, stems, n=1)
        hint = f"did you mean `{stems[close[0]]}`?" if close else None
        raise UserError(f"there is no file {path}", hint=hint) from None
    except UnicodeDecodeError as error:
        raise UserError(f"{path} is not UTF-8 text (byte {error.start})") from None
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror}") from None
    return parse_document(text, str(path))


def parse_document(text: str, name: str = "<text>") -> Document:
    """Parse YAML text whose top level is a mapping."""
    source = Source(name, text)
    if len(text) > MAX_CHARACTERS:
        raise UserError(f"{name} has more than {MAX_CHARACTERS} characters", hint="a manifold file is a page of text")
    try:
        root = yaml.compose(text, Loader=yaml.SafeLoader)
        loader = yaml.SafeLoader("")
    except yaml.MarkedYAMLError as error:
        raise _yaml_error(error, source) from None
    except yaml.reader.ReaderError as error:
        character = f"the character U+{ord(text[error.position]):04X} cannot stand in YAML"
        raise UserError(character, _span_at(source, error.position), "remove it; it may be invisible") from None
    except RecursionError:
        raise UserError(f"{name} is nested too deeply; at most {MAX_DEPTH} levels are read") from None
    if root is None:
        raise UserError(f"{name} is empty", hint="write lines like `key: value`")
    if not isinstance(root, yaml.MappingNode):
        raise UserError("this is no mapping: it must be made of `key: value` lines", Span(source, 1, 1))
    walker = _Walker(source, loader)
    data = walker.value(root, ())
    return Document(source, data, walker.values, walker.keys)


def _span_at(source: Source, position: int) -> Span:
    """Where the character with that number from 0 stands."""
    before = source.text[:position].splitlines() or [""]
    if source.text[:position].endswith("\n"):
        before.append("")
    return Span(source, len(before), len(before[-1]) + 1)


def _yaml_error(error: yaml.MarkedYAMLError, source: Source) -> UserError:
    """What PyYAML found, at the bracket or quote that stays open when the file goes on without closing it."""
    mark, opened = error.problem_mark, error.context_mark
    context = error.context or ""
    if "single document" in context and mark:
        return UserError("a second document begins here", _span_of(source, mark), "keep one document in a file")
    unclosed = "flow" in context or "quoted" in context
    if unclosed and opened and mark and opened.line != mark.line:
        mark = opened
    hint = "a value that holds `: `, ` #`, `{`, `[` or begins with a sign like % or @ must be put in double quotes"
    if mark and "\t" in source.line(mark.line + 1):
        hint = "YAML is indented with spaces, not tabs"
    elif "quoted" in context:
        hint = "close the quote that is opened here"
    elif "block end" in str(error.problem):
        hint = "the keys of a section begin in the same column"
    problem = str(error.problem)
    if unclosed and mark is opened:
        problem = "this is opened and not closed"
    return UserError(f"this is not valid YAML: {problem}", _span_of(source, mark) if mark else None, hint)


def _span_of(source: Source, mark: yaml.Mark) -> Span:
    return Span(source, mark.line + 1, mark.column + 1)


class _Walker:
    """Turns YAML nodes into data and notes where each stood."""

    def __init__(self, source: Source, loader: yaml.SafeLoader) -> None:
        self.source = source
        self.loader = loader
        self.values: dict[Path_, Span] = {}
        self.keys: dict[Path_, Span] = {}
        self.seen: set[int] = set()

    def value(self, node: yaml.Node, path: Path_) -> Any:
        span = self.values[path] = self.span(node)
        if id(node) in self.seen:
            hint = "write the value out in both places"
            raise UserError("YAML anchors and aliases (`&name`, `*name`) are not read", span, hint)
        if len(path) > MAX_DEPTH:
            raise UserError(f"nested too deeply; at most {MAX_DEPTH} levels are read", span)
        self.seen.add(id(node))
        self.check_tag(node, span)
        if isinstance(node, yaml.MappingNode):
            return self.mapping(node, path)
        if isinstance(node, yaml.SequenceNode):
            return [self.value(item, (*path, i)) for i, item in enumerate(node.value)]
        return self.scalar(node, span)

    def mapping(self, node: yaml.MappingNode, path: Path_) -> dict[str, Any]:
        result: dict[str, Any] = {}
        for key_node, value_node in node.value:
            span = self.span(key_node)
            key = key_node.value
            if not isinstance(key, str):
                raise UserError("a key must be a plain word", span)
            if key in result:
                raise UserError(f"`{key}` is given twice", span, "keep one of them")
            self.keys[(*path, key)] = span
            result[key] = self.value(value_node, (*path, key))
        return result

    def scalar(self, node: yaml.Node, span: Span) -> Any:
        if len(node.value) > MAX_NUMBER and node.tag.endswith((":int", ":float")):
            raise UserError(f"a number of {len(node.value)} characters; at most {MAX_NUMBER} are read", span)
        try:
            # The loader's own constructor for the five plain types: numbers as YAML 1.1 writes them.
            return self.loader.construct_object(node)
        except ValueError as error:
            raise UserError(f"not a value: {error}", span) from None

    def check_tag(self, node: yaml.Node, span: Span) -> None:
        """Refuse all but plain data: no tag of a user's makes anything."""
        kind = node.tag.removeprefix(YAML)
        if kind == "timestamp":
            raise UserError("YAML reads this as a date", span, "put it in double quotes")
        if kind not in PLAIN:
            tag = f"!!{kind}" if node.tag.startswith(YAML) else node.tag
            raise UserError(f"the YAML tag `{tag}` is not read here", span, "write plain text, a number or a list")

    def span(self, node: yaml.Node) -> Span:
        mark, end = node.start_mark, node.end_mark
        line = self.source.line(mark.line + 1)
        stop = end.column if end.line == mark.line else len(line)
        quoted = isinstance(node, yaml.ScalarNode) and node.style in ("'", '"')
        start = mark.column + (1 if quoted else 0)  # the text inside the quotes
        return Span(self.source, mark.line + 1, start + 1, max(stop - start - (1 if quoted else 0), 1))


def validate(document: Document, model: type[Model], data: Any = None, at: Path_ = ()) -> Model:
    """Check data (by default the whole document) against a schema; the first problem is raised where it stands."""
    try:
        return model.model_validate(document.data if data is None else data)
    except ValidationError as error:
        # A misspelt key is also a missing one: what is there and unknown is said first.
        # Of the ways in which neither of two forms fits, the one that is not about plain text says more.
        errors = sorted(error.errors(), key=lambda e: (e["type"] != "extra_forbidden", e["type"] == "string_type"))
        kinds = {str(e["type"]) for e in errors if e["input"] is errors[0]["input"]}
        raise _schema_error(document, model, errors[0], kinds, at) from None


def _schema_error(document: Document, model: type[BaseModel], error: Any, kinds: set[str], at: Path_) -> UserError:
    # pydantic puts the tags of union members into the path; only what the document has is a place in it.
    path: Path_ = at
    for part in error["loc"]:
        if (*path, part) in document.values or (error["type"] == "missing" and part == error["loc"][-1]):
            path = (*path, part)
    name = ".".join(str(part) for part in path)
    if error["type"] == "extra_forbidden":
        return UserError(f"unknown key `{path[-1]}`", document.key_span(path), _unknown_hint(model, error["loc"]))
    if error["type"] == "missing":
        return UserError(f"`{name}` is missing", document.key_span(path[:-1]), f"add a line `{path[-1]}: ...`")
    if error["type"] == "string_pattern_mismatch":
        given = " ".join(str(error["input"]).split())
        if error["loc"][-1] == "[key]":
            return UserError(f"`{given}` is no name", document.key_span(path), _pattern_hint(error))
        return UserError(f"`{name}` cannot be `{given}`", document.span(path), _pattern_hint(error))
    if error["type"] == "literal_error":
        hint = "write " + str(error["ctx"]["expected"]).replace("'", "`")
        return UserError(f"`{name}` cannot be `{error['input']}`", document.span(path), hint)
    if error["type"] in ("string_too_short", "too_short"):
        return UserError(f"`{name}` is empty", document.span(path))
    if error["type"] in KINDS:
        kind = "text, or a section of `key: value` lines" if kinds >= {"string_type", "model_type"} else None
        span = document.span(path)
        return UserError(f"`{name}` must be {kind or KINDS[error['type']]}", span, _kind_hint(error["input"]))
    message = str(error["msg"]).removeprefix("Value error, ")
    message = message[:1].lower() + message[1:]
    return UserError(f"`{name}`: {message}" if name else message, document.span(path))


KINDS = {
    "string_type": "text",
    "dict_type": "a section of `key: value` lines",
    "model_type": "a section of `key: value` lines",
    "list_type": "a list",
    "int_type": "a number",
    "float_type": "a number",
    "bool_type": "true or false",
}


def _kind_hint(given: object) -> str | None:
    if isinstance(given, bool):
        return "YAML reads yes, no, on, off, true and false as truth values: put it in double quotes"
    if isinstance(given, int | float):
        return "put it in double quotes"
    return "it has no value: write one after the colon" if given is None else None


def _pattern_hint(error: Any) -> str:
    pattern = str(error["ctx"]["pattern"])
    words = pattern.strip("^$")
    return f"write `{words}`" if words.isalpha() else "use letters, digits and underscores, a letter first"


def _unknown_hint(model: type[BaseModel], loc: tuple[int | str, ...]) -> str | None:
    """What else an unknown key may mean; pydantic puts the tags of union members into its `loc`."""
    models: dict[str | None, type[BaseModel]] = {None: model}
    for part in loc[:-1]:
        if len(models) > 1 and part in models:
            models = {str(part): models[str(part)], **{tag: m for tag, m in models.items() if tag != part}}
            continue
        field_info = next(iter(models.values())).model_fields.get(str(part))
        if field_info is None:
            continue  # an index, a key of the user's own, or what pydantic calls a member without a tag
        models = _members(field_info.annotation, field_info.metadata)
        if not models:
            return None
    known, key = [_keys(m) for m in models.values()], str(loc[-1])
    others = [tag for tag, keys in zip(models, known, strict=True) if key in keys]
    return f"it belongs to `{others[0]}`" if others else did_you_mean(key, known[0])


def _members(annotation: Any, metadata: Sequence[Any] = ()) -> dict[str | None, type[BaseModel]]:
    """The nested models of a field, by their tags where they have some."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return {next((m.tag for m in metadata if isinstance(m, Tag)), None): annotation}
    found: dict[str | None, type[BaseModel]] = {}
    inner = getattr(annotation, "__metadata__", ())
    for argument in get_args(annotation)[: 1 if inner else None]:
        found |= _members(argument, inner)
    return found


def _keys(model: type[BaseModel]) -> list[str]:
    return [info.alias or name for name, info in model.model_fields.items()]
