"""Formulas of the contact in C++, translated from the Python functions that the time loop is compiled from.

So a law of the elements, the profile of the tip and the direction of the contact force are written once.
"""

import ast
import inspect
from collections.abc import Callable, Sequence
from types import ModuleType

from bladerub.contact import friction, gap, tip

# What the time loop calls: functions of a law, of the tip, the gap and the direction of the force
LAW = ("return_mapping", "tangent", "elastic_force", "stored_energy", "dissipated_energy")
_OF_TIP = (tip.relief, tip.coverage, tip.mean_coverage, tip.highest)
OF_CONTACT = (*_OF_TIP, gap.penetration, friction.contact_force)

_RECORDS = {"element": "Element", "tip": "Profile"}  # by the name of an argument; others are numbers
_VECTOR_FUNCTIONS = {"absolute", "maximum", "minimum", "where", "sqrt"}
_NAMES = {"sqrt": "sqrt_of"}
_OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.BitAnd: "&", ast.BitOr: "|"}
_COMPARISONS = {ast.Gt: ">", ast.LtE: "<=", ast.Lt: "<", ast.GtE: ">="}


def of_contact() -> str:
    """Translate the formulas of profile, gap and contact force."""
    return "struct Profile { real half_width, curvature; };\n" + _with_callees(OF_CONTACT)


def of_law(law: ModuleType, source: str = "") -> str:
    """Describe the elements of a law and translate its functions; `source` is its text, if in no file.

    Raises `ValueError`, which names function and expression, if one has what is not known here.
    """
    fields = law.Element._fields
    loaded = ", ".join(f"load(from, j + 8 * {row})" for row in range(len(fields)))
    load = "HERE Element load_element(const double* from, const integer& j)"
    return (
        f"struct Element {{ real {', '.join(fields)}; }};\nconstexpr int LAW_FIELDS = {len(fields)};\n"
        f"{load} {{ return Element{{{loaded}}}; }}\n"
    ) + _with_callees([getattr(law, name) for name in LAW], source)


def _with_callees(functions: Sequence[Callable], source: str = "") -> str:
    """Translate functions, each after those that it calls."""
    translations: dict[str, tuple[Callable, str]] = {}
    statements = ast.parse(source).body
    no_file = {node.name: node for node in statements if isinstance(node, ast.FunctionDef)}

    def add(function: Callable) -> None:
        name = function.__name__
        if name in translations:
            if translations[name][0] is not function:
                raise ValueError(f"{name}: two functions of this name, which a GPU can't be given")
            return
        is_text = function.__code__.co_filename.startswith("<")
        definition = no_file[name] if is_text else ast.parse(inspect.getsource(function)).body[0]
        translation = _Translation(function, definition)
        for callee in translation.callees():
            add(callee)
        translations[name] = function, translation.text()

    for function in functions:
        add(function)
    return "\n".join(text for _, text in translations.values())


class _Translation:
    """A function of assignments and one return at its end."""

    def __init__(self, function: Callable, definition: ast.stmt):
        self.function, self.body = function, definition
        self.arguments = [argument.arg for argument in definition.args.args]
        self.assigned: set[str] = set()

    def callees(self) -> list[Callable]:
        """Functions that this one calls, but for those of vectors."""
        calls = [node.func for node in ast.walk(self.body) if isinstance(node, ast.Call)]
        names = dict.fromkeys(call.id for call in calls if isinstance(call, ast.Name))
        scope = self.function.__globals__
        called = [name for name in names if name not in _VECTOR_FUNCTIONS and name != "elementwise"]
        if missing := [name for name in called if not inspect.isfunction(scope.get(name))]:
            raise ValueError(f"{self.function.__name__}: {missing[0]}: no function that a GPU is given")
        return [scope[name] for name in called]

    def text(self) -> str:
        """Translate the function."""
        arguments = ", ".join(f"const {_RECORDS.get(name, 'real')}& {name}" for name in self.arguments)
        statements = self.body.body[ast.get_docstring(self.body) is not None :]
        lines = "".join(f"  {self._statement(statement)}\n" for statement in statements)
        kind = "Pair" if isinstance(statements[-1].value, ast.Tuple) else "real"
        return f"HERE {kind} {self.body.name}({arguments}) {{\n{lines}}}"

    def _statement(self, statement: ast.stmt) -> str:
        match statement:
            case ast.Return(ast.Tuple(values)):
                return f"return Pair{{{', '.join(map(self._expression, values))}}};"
            case ast.Return(value):
                return f"return {self._expression(value)};"
            case ast.Assign([ast.Name(name)], value):
                text = self._expression(value)
                return f"{self._declared(name)} = {text};"
            case ast.Assign([ast.Tuple([ast.Name(first), ast.Name(second)])], value):
                pair = f"{first}_and_{second}"
                parts = f"const Pair {pair} = {self._expression(value)};"
                parts += f" {self._declared(first)} = {pair}.first;"
                return f"{parts} {self._declared(second)} = {pair}.second;"
        raise self._unknown(statement)

    def _declared(self, name: str) -> str:
        is_declared = name in self.assigned
        self.assigned.add(name)
        return name if is_declared else f"auto {name}"

    def _expression(self, node: ast.expr) -> str:
        match node:
            case ast.Name(name) if name in self.assigned or name in self.arguments:
                return name
            case ast.Name(name) if isinstance(self.function.__globals__.get(name), int | float):
                return repr(float(self.function.__globals__[name]))
            case ast.Constant(value) if isinstance(value, int | float) and not isinstance(value, bool):
                return repr(float(value))
            case ast.Attribute(ast.Name(record), field) if record in _RECORDS:
                return f"{record}.{field}"
            case ast.BinOp(lhs, operator, rhs) if type(operator) in _OPERATORS:
                lhs, rhs = self._expression(lhs), self._expression(rhs)
                return f"({lhs} {_OPERATORS[type(operator)]} {rhs})"
            case ast.UnaryOp(ast.USub(), operand):
                return f"(0.0 - {self._expression(operand)})"
            case ast.Compare(lhs, [comparison], [rhs]) if type(comparison) in _COMPARISONS:
                lhs, rhs = self._expression(lhs), self._expression(rhs)
                return f"({lhs} {_COMPARISONS[type(comparison)]} {rhs})"
            case ast.Call(ast.Name(name), arguments, []):
                return f"{_NAMES.get(name, name)}({', '.join(map(self._expression, arguments))})"
        raise self._unknown(node)

    def _unknown(self, node: ast.AST) -> ValueError:
        text = ast.unparse(node)
        return ValueError(f"{self.function.__name__}: {text}: no part of a formula that a GPU is given")
