"""The table of docs/architecture.md, held against the code: who imports whom, what nothing does."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parent.parent
PACKAGE = "rsrm_gen"
STAGES = ("spec", "derive", "lower", "emit", "audit")

# Every room and the rooms that it may import besides itself.
INPUT = {"errors", "document", "files"}
MAY_IMPORT = {
    "errors": set(),
    "document": {"errors"},
    "files": {"errors"},
    "version": set(),
    "manifold": set(),
    "budget": {"errors"},
    "native": {*INPUT, "budget"},
    "driver": {*INPUT, "version", "budget", "native", *STAGES},
    "cli": {*INPUT, "version", "budget", "driver", "native", *STAGES},
    "kernels": {*INPUT, "manifold", "native"},
    "rows": {*INPUT, "manifold", "native"},
    "load": {*INPUT, "version", "manifold", "spec", "driver", "native", "kernels", "rows"},
    "trainer": {*INPUT, "version", "manifold", "load", "native", "rows", "package", "bench"},
    "bench": {*INPUT, "version", "manifold", "rows", "load", "native", "driver", *STAGES, "trainer"},
    "testing": {*INPUT, "driver", "cli", "spec", "audit"},
    "package": {"errors", "version", "manifold", "load"},
    **{stage: {*INPUT, "version", "budget", *STAGES[:i]} for i, stage in enumerate(STAGES)},
}
MAY_IMPORT["audit"] |= {"native"}  # the audit runs the C code
MANIFOLDS = sorted(yaml.safe_load(path.read_text())["manifold"] for path in (ROOT / "manifolds").glob("*.yaml"))


def module_name(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_name(path): path for path in sorted((ROOT / PACKAGE).rglob("*.py"))}


def room(module: str) -> str:
    match module.split("."):
        case [_]:
            return "package"
        case [_, "compiler", stage, *_] if stage in STAGES:
            return stage
        case [_, "compiler", "budget" | "native" as name]:
            return name
        case [_, "compiler", "cli", *_]:
            return "cli"
        case [_, "compiler", *_]:
            return "driver"
        case [_, name, *_]:
            return name
    raise AssertionError(module)


@cache
def tree(module: str) -> ast.Module:
    return ast.parse(MODULES[module].read_text(encoding="utf-8"))


@cache
def imports(module: str) -> frozenset[str]:
    """The modules of the project that a module names in an import, wherever in it the import stands."""
    package = module if MODULES[module].name == "__init__.py" else module.rpartition(".")[0]
    found = set()
    for node in ast.walk(tree(module)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            base = ".".join([*above, *([node.module] if node.module else [])])
            found |= {f"{base}.{a.name}" if f"{base}.{a.name}" in MODULES else base for a in node.names}
    return frozenset(name for name in found if name.split(".")[0] == PACKAGE)


def loaded_by(module: str) -> set[str]:
    """All modules of the project that importing a module runs, packages on the way included."""
    found: set[str] = set()
    waiting = [module]
    while waiting:
        name = waiting.pop()
        if name in MODULES and name not in found:
            found.add(name)
            waiting += [*imports(name), name.rpartition(".")[0]]
    return found


def test_every_room_is_in_the_table() -> None:
    assert {room(module) for module in MODULES} <= MAY_IMPORT.keys()


@pytest.mark.parametrize("module", MODULES)
def test_imports_go_one_way(module: str) -> None:
    allowed = MAY_IMPORT[room(module)] | {room(module)}
    wrong = {name for name in imports(module) if room(name) not in allowed}
    assert not wrong, f"{module} is in `{room(module)}`, which may import only {sorted(allowed)}"


def test_imports_name_modules_that_exist() -> None:
    wanted = {(module, name) for module in MODULES for name in imports(module)}
    assert len(wanted) > 50
    assert {pair for pair in wanted if pair[1] not in MODULES} == set()


@pytest.mark.parametrize(
    "module",
    [
        "train",
        "objectives",
        "model",
        "density",
        "optimise",
        "link",
        "scene",
        "settings",
        "curves",
        "roadmap",
        "labels",
        "sampling",
    ],
)
def test_training_cannot_reach_the_reference(module: str) -> None:
    reached = loaded_by(f"{PACKAGE}.trainer.{module}")
    assert f"{PACKAGE}.trainer.{module}" in reached
    assert reached & {f"{PACKAGE}.trainer.{name}" for name in ("reference", "evaluate")} == set()


@pytest.mark.parametrize("name", MANIFOLDS)
def test_the_trainer_names_no_manifold(name: str) -> None:
    word = re.compile(rf"(?<![a-z]){name}(?![a-z])", re.IGNORECASE)
    found = [
        f"{path.relative_to(ROOT)}:{number}: {line.strip()}"
        for path in sorted((ROOT / PACKAGE / "trainer").rglob("*.py"))
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if word.search(line)
    ]
    assert found == []


# By the last name of what is called; `compile` only as the builtin, because of re.compile and torch.compile.
RUNS_TEXT = {"eval", "exec", "sympify", "parse_expr", "lambdify", "__import__", "unsafe_load", "full_load", "Unpickler"}


@pytest.mark.parametrize("module", MODULES)
def test_no_text_is_run_as_code(module: str) -> None:
    for node in ast.walk(tree(module)):
        if isinstance(node, ast.Import | ast.ImportFrom):
            names = {alias.name for alias in node.names} | {getattr(node, "module", None)}
            assert not names & {"pickle", "marshal", "shelve", "dill", *RUNS_TEXT}, f"line {node.lineno}"
        if not isinstance(node, ast.Call):
            continue
        called = ast.unparse(node.func)
        assert called.split(".")[-1] not in RUNS_TEXT, f"line {node.lineno}: {called}"
        assert called not in ("compile", "yaml.load", "yaml.load_all", "os.system"), f"line {node.lineno}: {called}"
        keywords = {k.arg: ast.unparse(k.value) for k in node.keywords}
        assert keywords.get("shell", "False") == "False", f"line {node.lineno}: a shell"
        if called == "torch.load":
            assert keywords.get("weights_only") == "True", f"line {node.lineno}: torch.load unpickles"


@pytest.mark.parametrize("module", MODULES)
def test_modules_are_short_enough_to_read(module: str) -> None:
    assert len(MODULES[module].read_text(encoding="utf-8").splitlines()) <= 500
