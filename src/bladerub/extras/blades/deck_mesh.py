"""The mesh in a deck of Abaqus or CalculiX: nodes, solid elements by kind, sets of nodes."""

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bladerub.blade.surface import FACES
from bladerub.extras.blades import deck
from bladerub.extras.blades.deck import Block, Line

_KINDS = {4: "tetra", 5: "pyramid", 6: "wedge", 8: "hexahedron"}  # in meshio, by number of nodes
_KINDS |= {10: "tetra10", 13: "pyramid13", 15: "wedge15", 20: "hexahedron20", 27: "hexahedron27"}
# elements of lines and surfaces, whose sets are sets of nodes here
_MARKING = re.compile(r"(T[23]D[23]|B[23][123]|STRI|S[34689]|M3D|SFM3D|CP[ES]\d|R3D|DS\d)\w*")
_GENERATING = ("*NGEN", "*NFILL", "*NCOPY", "*NMAP", "*ELGEN", "*ELCOPY")
_QUADRATIC = {8: 20, 20: 20, 4: 10, 10: 10}  # nodes of the element with the same faces


class Content(NamedTuple):
    """What is read of a mesh file; nodes count from 0 in the order of the file."""

    points: np.ndarray  # (n_points, 3), as in the file
    solids: dict[str, np.ndarray]  # nodes (n_elements, n_nodes) by kind of meshio
    node_sets: dict[str, np.ndarray]  # also those of elements of lines and surfaces
    volume_sets: list[str]  # names of sets of solid elements


def read(path: Path) -> Content:
    """Read the mesh of one part; a ValueError names line and cause of what is not read."""
    blocks = deck.blocks(path)
    _check(blocks)
    model = _Model(blocks)
    if not model.rows:
        raise ValueError("has no *NODE, as a deck of Abaqus or CalculiX has")
    cells: dict[str, list[list[int]]] = {}
    for number, kind in model.kinds.items():
        cells.setdefault(kind, []).append([model.rows[node] for node in model.nodes[number]])
    node_sets, volume_sets = {name: numbers for name, _, numbers in model.node_sets.values()}, []
    for name, _, numbers in model.element_sets.values():
        if model.kinds.keys() & numbers.keys():
            volume_sets.append(name)
        else:
            node_sets.setdefault(name, model.nodes_of(numbers))
    solids = {kind: np.array(rows) for kind, rows in cells.items()}
    sets = {name: np.array([model.rows[node] for node in nodes], int) for name, nodes in node_sets.items()}
    return Content(np.array(model.points), solids, sets, volume_sets)


def _check(blocks: list[Block]) -> None:
    """Refuse what makes or moves nodes or elements in a way that is not followed here."""
    for block in blocks:
        where = f"{block.place}: has {block.keyword}"
        system = block.parameters.get("SYSTEM", "R").upper()
        if block.keyword in _GENERATING:
            raise ValueError(f"{where}, which makes nodes or elements; must list them all")
        if block.keyword == "*SYSTEM" and block.lines:
            raise ValueError(f"{where}; nodes must be in the axes of the whole model")
        if block.keyword == "*NODE" and system != "R":
            raise ValueError(f"{where} with SYSTEM={system}; must be in Cartesian coordinates")
        if block.keyword == "*INSTANCE" and any(re.search("[1-9]", line.text) for line in block.lines):
            raise ValueError(f"{where}, which moves its part; must leave it where it is")
    for keyword in ("*PART", "*INSTANCE"):
        places = [block.place for block in blocks if block.keyword == keyword]
        if len(places) > 1:
            raise ValueError(f"{places[1]}: has another {keyword}; must be the mesh of one part")


class _Sets(dict[str, tuple[str, bool, dict[int, None]]]):
    """Sets by their names in capitals: name as first written, whether in the part, and numbers."""

    def add(self, name: str, numbers: Iterable[int], in_part: bool, place: str) -> None:
        """Add `numbers` to the set `name`, whose blocks add up."""
        _, first_in_part, members = self.setdefault(name.upper(), (name, in_part, {}))
        if first_in_part != in_part:
            raise ValueError(f"{place}: a set {name} is in the part as well; must have another name")
        members.update(dict.fromkeys(numbers))

    def members(self, name: str, place: str) -> dict[int, None]:
        """Numbers in the set `name`, which may have the name of its instance before a point."""
        for key in (name.upper(), name.upper().rpartition(".")[2]):
            if key in self:
                return self[key][2]
        raise ValueError(f"{place}: there is no set {name} above this line")


class _Model:
    """What a deck holds, by the numbers of its nodes and elements."""

    def __init__(self, blocks: list[Block]):
        self.rows: dict[int, int] = {}  # of nodes
        self.points: list[list[float]] = []
        self.nodes: dict[int, list[int]] = {}  # of elements
        self.kinds: dict[int, str] = {}  # of solid elements
        self.node_sets, self.element_sets = _Sets(), _Sets()
        for keywords, add in (
            (("*NODE",), self._add_nodes),
            (("*ELEMENT",), self._add_elements),
            (("*NSET", "*ELSET"), self._add_set),
            (("*SURFACE",), self._add_surface),
        ):
            for block in blocks:
                if block.keyword in keywords:
                    add(block)

    def nodes_of(self, elements: Iterable[int]) -> dict[int, None]:
        """Nodes of `elements`, in their order."""
        return dict.fromkeys(node for number in elements for node in self.nodes[number])

    def _add_nodes(self, block: Block) -> None:
        for line in block.lines:
            cells = line.cells()
            number, point = _whole(cells[0], line), _coordinates(cells[1:], line)
            row = self.rows.setdefault(number, len(self.points))
            if row == len(self.points):
                self.points.append(point)
            elif self.points[row] != point:
                raise ValueError(f"{line.place}: node {number} is there twice, in two places")
            if "NSET" in block.parameters:
                self.node_sets.add(block.parameters["NSET"], [number], block.in_part, line.place)

    def _add_elements(self, block: Block) -> None:
        size = _size(block)
        for line, (number, *nodes) in _elements(block, size):
            if absent := [node for node in nodes if node not in self.rows]:
                raise ValueError(f"{line.place}: node {absent[0]} of element {number} is not there")
            if self.nodes.setdefault(number, nodes) is not nodes:
                raise ValueError(f"{line.place}: element {number} is there twice")
            if size:
                self.kinds[number] = _KINDS[size]
            if "ELSET" in block.parameters:
                self.element_sets.add(block.parameters["ELSET"], [number], block.in_part, line.place)

    def _add_set(self, block: Block) -> None:
        parameters = block.parameters
        if block.keyword == "*NSET" and "ELSET" in parameters:
            elements = self.element_sets.members(parameters["ELSET"], block.place)
            self.node_sets.add(_name(block, "NSET"), self.nodes_of(elements), block.in_part, block.place)
            return
        sets, members = self.element_sets, self.nodes
        if block.keyword == "*NSET":
            sets, members = self.node_sets, self.rows
        name = _name(block, block.keyword[1:])
        sets.add(name, [], block.in_part, block.place)
        for line in block.lines:
            numbers = _range(line) if "GENERATE" in parameters else _members(line, sets)
            present = [number for number in numbers if number in members]
            if len(present) < len(numbers) and "GENERATE" not in parameters:
                absent = next(number for number in numbers if number not in members)
                raise ValueError(f"{line.place}: {absent} of the set {name} is not there")
            sets.add(name, present, block.in_part, line.place)

    def _add_surface(self, block: Block) -> None:
        """Add the nodes of a surface as a set of nodes, unless one has its name."""
        nodes: dict[int, None] = {}
        for line in block.lines:
            member, *label = line.cells()
            if block.parameters.get("TYPE", "ELEMENT").upper() == "NODE":
                nodes.update(dict.fromkeys(_members(Line(member, line.place), self.node_sets)))
                continue
            face = re.fullmatch("S([1-6])", label[0].upper()) if label else None
            elements = _members(Line(member, line.place), self.element_sets)
            if face is None or any(len(self.nodes[number]) not in _QUADRATIC for number in elements):
                return  # of shells or wedges, or all outer faces of a set
            for number in elements:
                corners = self.nodes[number]
                places = FACES[_QUADRATIC[len(corners)]][int(face[1]) - 1]
                nodes.update(dict.fromkeys(corners[place] for place in places if place < len(corners)))
        name = _name(block, "NAME")
        if name.upper() not in self.node_sets:
            self.node_sets.add(name, nodes, block.in_part, block.place)


def _name(block: Block, parameter: str) -> str:
    if not block.parameters.get(parameter):
        raise ValueError(f"{block.place}: {block.keyword} has no {parameter}=")
    return block.parameters[parameter]


def _size(block: Block) -> int | None:
    """Count the nodes of each solid element of a block; None of lines and surfaces."""
    name = _name(block, "TYPE").upper()
    solid = re.fullmatch(r"C3D(\d+)[A-Z]*", name)
    if solid and int(solid[1]) in _KINDS:
        return int(solid[1])
    if not _MARKING.fullmatch(name):
        raise ValueError(f"{block.place}: has elements of type {name}, which are not read; leave them out")
    return None


def _elements(block: Block, size: int | None) -> Iterator[tuple[Line, list[int]]]:
    """Yield number and nodes of each element, and its last line."""
    numbers: list[int] = []
    for line in block.lines:
        numbers += [_whole(cell, line) for cell in line.cells()]
        if size is None and line.text.endswith(","):
            continue
        count = len(numbers) - 1
        if size is not None and count > size:
            raise ValueError(f"{line.place}: element {numbers[0]} has {count} nodes, must have {size}")
        if size in (None, count):
            yield line, numbers
            numbers = []
    if numbers:
        raise ValueError(f"{block.lines[-1].place}: element {numbers[0]} has too few nodes")


def _whole(cell: str, line: Line) -> int:
    if not re.fullmatch(r"[+-]?\d+", cell):
        raise ValueError(f"{line.place}: has {cell or 'nothing'}, must be a whole number")
    return int(cell)


def _coordinates(cells: list[str], line: Line) -> list[float]:
    """Three coordinates; those that are left out are 0."""
    try:
        return ([deck.number(cell) for cell in cells] + [0.0, 0.0, 0.0])[:3]
    except ValueError:
        raise ValueError(f"{line.place}: has {line.text[:60]}, must be a node and its coordinates") from None


def _range(line: Line) -> range:
    numbers = [_whole(cell, line) for cell in line.cells()]
    if len(numbers) not in (2, 3) or min(numbers[2:], default=1) < 1:
        rule = "must be the first, the last and, if any, a step of 1 or more"
        raise ValueError(f"{line.place}: has {line.text[:60]}, {rule}")
    first, last, *step = numbers
    return range(first, last + 1, *step)


def _members(line: Line, sets: _Sets) -> list[int]:
    """Numbers of a line, and the members of sets that it names."""
    members: list[int] = []
    for cell in filter(None, line.cells()):
        number = cell.rpartition(".")[2]
        members += [int(number)] if re.fullmatch(r"\d+", number) else sets.members(cell, line.place)
    return members
