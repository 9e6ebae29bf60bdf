"""What stands below the keys of a model; read when a page or a schema is made, since it takes a while."""

import ast
import sys
from functools import cache
from itertools import pairwise
from pathlib import Path

from pydantic import BaseModel


@cache
def docstrings(model: type) -> dict[str, str]:
    """Return the docstrings of the keys of a model and of its bases, by key."""
    texts: dict[str, str] = {}
    for part in reversed(model.__mro__):
        body = _classes(part.__module__).get(part.__name__, [])
        for key, text in pairwise(body):
            if isinstance(key, ast.AnnAssign) and isinstance(text, ast.Expr) and part is not BaseModel:
                texts[key.target.id] = " ".join(text.value.value.split())
    return texts


@cache
def _classes(module: str) -> dict[str, list]:
    """Parse the classes of a module: the body of each by its name."""
    if not (file := getattr(sys.modules[module], "__file__", None)):
        return {}
    tree = ast.parse(Path(file).read_text(encoding="utf-8"))
    return {node.name: node.body for node in tree.body if isinstance(node, ast.ClassDef)}
