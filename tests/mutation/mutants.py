"""Mutants of a Python source: one small change each, of the kind that a reader overlooks.

Comparisons, arithmetic, numbers, minima and maxima, conditions, signs and the order of arguments are changed;
statements, keyword arguments and elements of lists are removed. Annotations, decorators, messages and imports
stay. The text is changed, so that functions that numba compiles are mutated like any other.
"""

import ast
import random
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, takewhile

COMPARISONS = {
    ast.Lt: ("<", ("<=", ">")),
    ast.LtE: ("<=", ("<",)),
    ast.Gt: (">", (">=", "<")),
    ast.GtE: (">=", (">",)),
    ast.Eq: ("==", ("!=",)),
    ast.NotEq: ("!=", ("==",)),
    ast.Is: ("is", ("is not",)),
    ast.IsNot: ("is not", ("is",)),
    ast.In: ("in", ("not in",)),
    ast.NotIn: ("not in", ("in",)),
}
ARITHMETIC = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
    ast.Pow: ("**", "*"),
    ast.FloorDiv: ("//", "/"),
    ast.Mod: ("%", "//"),
    ast.BitAnd: ("&", "|"),
    ast.BitOr: ("|", "&"),
}
COUNTERPARTS = (("min", "max"), ("minimum", "maximum"), ("argmin", "argmax"), ("any", "all"))
RENAMED = {a: b for pair in COUNTERPARTS for a, b in (pair, pair[::-1])}


@dataclass(frozen=True)
class Mutant:
    """A change of one source: the bytes from `start` to `end` become `text`."""

    file: str
    kind: str
    start: int
    end: int
    text: str

    def apply(self, source: str) -> str:
        """Make the change in the text of the file."""
        raw = source.encode()
        return (raw[: self.start] + self.text.encode() + raw[self.end :]).decode()

    def lines(self, source: str) -> tuple[int, str, str]:
        """Return the number of the first changed line, and the changed lines before and after."""
        before, after = source.split("\n"), self.apply(source).split("\n")
        first = _n_common(before, after)
        last = _n_common(before[first:][::-1], after[first:][::-1])
        return first + 1, *(
            " ".join(line.strip() for line in lines[first : len(lines) - last]) for lines in (before, after)
        )


def find_mutants(file: str, source: str) -> list[Mutant]:
    """List all mutants of a source that can be compiled and differ from it."""
    finder = _Finder(source)
    finder.visit(ast.parse(source))
    mutants = [Mutant(file, *change) for change in finder.changes]
    return [
        mutant for mutant in mutants if mutant.apply(source) != source and _compiles(mutant.apply(source))
    ]


def sample(mutants: Sequence[Mutant], number: int, draw: random.Random) -> list[Mutant]:
    """Draw `number` mutants: from each file its share, and within a file from all kinds in turn."""
    by_file = defaultdict(list)
    for mutant in mutants:
        by_file[mutant.file].append(mutant)
    drawn = []
    for file_mutants in by_file.values():
        share = max(1, round(number * len(file_mutants) / len(mutants)))
        drawn += _in_turn(file_mutants, draw)[:share]
    return draw.sample(drawn, min(number, len(drawn)))


def _in_turn(mutants: Sequence[Mutant], draw: random.Random) -> list[Mutant]:
    """Order mutants so that those of rare kinds come as early as those of frequent ones."""
    seen: dict[str, int] = defaultdict(int)
    ranked = []
    for mutant in draw.sample(mutants, len(mutants)):
        ranked.append((seen[mutant.kind], draw.random(), mutant))
        seen[mutant.kind] += 1
    return [mutant for *_, mutant in sorted(ranked, key=lambda entry: entry[:2])]


def _n_common(one: Sequence[str], other: Sequence[str]) -> int:
    """Count the leading lines that are the same."""
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False)))


def _compiles(source: str) -> bool:
    try:
        compile(source, "mutant", "exec")
    except (SyntaxError, ValueError):
        return False
    return True


class _Finder(ast.NodeVisitor):
    """Collects ``changes``: kind, first and last byte, new text."""

    def __init__(self, source: str) -> None:
        self.raw = source.encode()
        self.line_starts = [0]
        for line in self.raw.split(b"\n"):
            self.line_starts.append(self.line_starts[-1] + len(line) + 1)
        self.changes: list[tuple[str, int, int, str]] = []

    def start(self, node: ast.AST) -> int:
        return self.line_starts[node.lineno - 1] + node.col_offset

    def end(self, node: ast.AST) -> int:
        return self.line_starts[node.end_lineno - 1] + node.end_col_offset

    def text(self, node: ast.AST) -> str:
        return self.raw[self.start(node) : self.end(node)].decode()

    def replace(self, kind: str, node: ast.AST, text: str) -> None:
        self.changes.append((kind, self.start(node), self.end(node), text))

    def replace_between(self, kind: str, left: ast.AST, right: ast.AST, old: str, new: str) -> None:
        """Replace the operator `old` that is written between two operands."""
        at = self.raw.find(old.encode(), self.end(left), self.start(right))
        if at >= 0:
            self.changes.append((kind, at, at + len(old), new))

    def drop(self, kind: str, nodes: Sequence[tuple[ast.AST, ast.AST]], index: int) -> None:
        """Drop one element, given by its first and last node, from a list of them, with its comma."""
        first, last = nodes[index]
        start, end = self.start(first), self.end(last)
        if index + 1 < len(nodes):
            end = self.start(nodes[index + 1][0])
        elif index:
            start = self.end(nodes[index - 1][1])
        self.changes.append((kind, start, end, ""))

    # what stays

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        for part in (*node.args.defaults, *filter(None, node.args.kw_defaults), *node.body):
            self.visit(part)

    def visit_ClassDef(self, node: ast.ClassDef) -> None:
        for part in node.body:
            self.visit(part)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value:
            self.visit(node.value)

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        pass

    # what changes

    def visit_Compare(self, node: ast.Compare) -> None:
        operands = [node.left, *node.comparators]
        for (left, right), operator in zip(pairwise(operands), node.ops, strict=True):
            old, others = COMPARISONS[type(operator)]
            for new in others:
                self.replace_between("comparison", left, right, old, new)
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        is_message = any(map(_is_text, (node.left, node.right)))
        if type(node.op) in ARITHMETIC and not is_message:
            self.replace_between("arithmetic", node.left, node.right, *ARITHMETIC[type(node.op)])
        self.generic_visit(node)

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        old, new = ("and", "or") if isinstance(node.op, ast.And) else ("or", "and")
        for left, right in pairwise(node.values):
            self.replace_between("condition", left, right, old, new)
        self.generic_visit(node)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        if isinstance(node.op, ast.Not | ast.USub):
            kind = "condition" if isinstance(node.op, ast.Not) else "sign"
            self.replace(kind, node, self.text(node.operand))
        self.generic_visit(node)

    def visit_If(self, node: ast.If | ast.IfExp) -> None:
        if isinstance(node.test, ast.Name | ast.Attribute | ast.Call):
            self.replace("condition", node.test, f"not {self.text(node.test)}")
        self.generic_visit(node)

    visit_IfExp = visit_If

    def visit_Constant(self, node: ast.Constant) -> None:
        value = node.value
        if isinstance(value, bool):
            self.replace("constant", node, str(not value))
        elif isinstance(value, int):
            self.replace("constant", node, str(value + 1))
        elif isinstance(value, float):
            self.replace("constant", node, repr(1.04 * value or 0.04))

    def visit_Name(self, node: ast.Name) -> None:
        if node.id in RENAMED:
            self.replace("extremum", node, RENAMED[node.id])

    def visit_Attribute(self, node: ast.Attribute) -> None:
        if node.attr in RENAMED:
            end = self.end(node)
            self.changes.append(("extremum", end - len(node.attr), end, RENAMED[node.attr]))
        self.generic_visit(node)

    def visit_Call(self, node: ast.Call) -> None:
        for left, right in pairwise(node.args):
            if isinstance(left, ast.Name | ast.Attribute) and type(left) is type(right):
                swapped = f"{self.text(right)}, {self.text(left)}"
                self.changes.append(("swapped arguments", self.start(left), self.end(right), swapped))
        arguments = sorted([*node.args, *node.keywords], key=self.start)
        for index, argument in enumerate(arguments):
            if isinstance(argument, ast.keyword):
                self.drop("dropped argument", [(one, one) for one in arguments], index)
        self.generic_visit(node)

    def visit_List(self, node: ast.List | ast.Tuple | ast.Set) -> None:
        if not isinstance(getattr(node, "ctx", None), ast.Store) and len(node.elts) > 1:
            for index in range(len(node.elts)):
                self.drop("dropped element", [(one, one) for one in node.elts], index)
        self.generic_visit(node)

    visit_Tuple = visit_Set = visit_List

    def visit_Dict(self, node: ast.Dict) -> None:
        if all(node.keys):
            for index in range(len(node.keys)):
                self.drop("dropped element", list(zip(node.keys, node.values, strict=True)), index)
        self.generic_visit(node)

    def visit_Assign(self, node: ast.Assign) -> None:
        if isinstance(node.targets[0], ast.Attribute | ast.Subscript):
            self.replace("removed statement", node, "pass")
        if isinstance(node.targets[0], ast.Tuple) and isinstance(node.value, ast.Tuple):
            for element in node.value.elts:
                self.visit(element)
        else:
            self.visit(node.value)

    def visit_Expr(self, node: ast.Expr) -> None:
        if isinstance(node.value, ast.Call):
            self.replace("removed statement", node, "pass")
        self.generic_visit(node)

    def visit_Raise(self, node: ast.Raise) -> None:
        self.replace("removed statement", node, "pass")

    def visit_AugAssign(self, node: ast.AugAssign) -> None:
        self.replace("removed statement", node, "pass")
        self.visit(node.value)

    def visit_Continue(self, node: ast.Continue | ast.Break) -> None:
        self.replace("removed statement", node, "pass")

    visit_Break = visit_Continue


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.JoinedStr) or (isinstance(node, ast.Constant) and isinstance(node.value, str))
