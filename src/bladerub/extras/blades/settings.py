"""What a config says of a blade of another program."""

from typing import Annotated, Literal

from pydantic import Field

from bladerub.settings.fields import Degree, Form, Number, Omitted, Section, Unit

_Axis = Literal["x", "y", "z", "-x", "-y", "-z"]
_NodeSet = Annotated[
    str, Field(pattern=r"^.+$", max_length=200), Form("the name of a node set or of a physical group")
]


class Source(Section):
    """A mesh of another program, a table of sections, or matrices, instead of the parametric blade.

    Must have file, matrices, or the key of a source that plugs in. With file or matrices hub_radius, tip_cone
    and sections have no effect, mesh has one with a table only, and the material none with matrices.
    `bladerub import` with the file or folder checks it, and prints this group for it.
    """

    file: Annotated[
        Omitted[str],
        Form(
            "the path of a file that ends in .inp (Abaqus, CalculiX), .msh (Gmsh) or .vtu (VTK), or of a "
            "table of sections that ends in .csv, .txt or .dat"
        ),
    ] = Field(
        None,
        pattern=r"^.+\.([iI][nN][pP]|[mM][sS][hH]|[vV][tT][uU]|[cC][sS][vV]|[tT][xX][tT]|[dD][aA][tT])$",
    )
    """What it must hold: docs/how-to/bring_a_blade.md."""
    matrices: Annotated[Omitted[str], Form("the path of a folder")] = Field(None, pattern=r"^.+$")
    """What it must hold: docs/how-to/bring_a_blade.md."""
    matrix_units: Annotated[
        Omitted[Literal["SI", "mm-tonne", "inch-lbf"]],
        Form("SI (kg, N/m), mm-tonne (t, N/mm) or inch-lbf (lbf s²/in, lbf/in)"),
    ] = None
    """SI if not given. Frequencies are the same in all of them, so only the mass shows a mistake."""
    omega_max: Omitted[Annotated[float, Unit("rad/s")]] = Field(None, gt=0, le=100000)
    """Speed of stiffness_max. If given, it must be reduction.f_omega_max times the first frequency of the
    matrices to within 0.1 %."""
    unit: Annotated[
        Omitted[Literal["m", "mm", "cm", "inch", "in", "feet", "ft"]],
        Form("m, mm, cm, inch (in) or feet (ft)"),
    ] = None
    """Of lengths in the file; m if not given."""
    angle_unit: Omitted[Literal["rad", "deg"]] = None
    """Of theta1 and theta2 of a table of sections; rad if not given."""
    rotation: Omitted[_Axis] = None
    """The axis of the file about which the blade turns by the right-hand rule; -x if not given."""
    downstream: Omitted[_Axis] = None
    """Direction of the flow, along the axis of rotation; x if not given."""
    radial: Omitted[_Axis] = None
    """The axis of the file from root to tip, z if not given."""
    root_set: Omitted[_NodeSet] = None
    """The clamped nodes; if not given, those of the surface nearest to the axis of rotation that looks
    towards it."""
    tip_set: Omitted[_NodeSet] = None
    """The tip face; if not given, the surface farthest from the axis that looks away from it."""
    tip_cone: Omitted[Degree] = Field(None, ge=-45, le=45)
    """As blade.tip_cone; if not given, of the cone that fits the tip best."""


class Scale(Section):
    """Factors of values that are for the blade of config/config.yaml.

    E and K then mean the same on another blade. `bladerub import` prints them.
    """

    length: Number = Field(ge=0.001, le=1000)
    """Of amplitude and interference of the casings, contact.layer_thickness and
    contact.tip_profile.edge_drop."""
    modulus: Number = Field(ge=1e-6, le=1e6)
    """Of contact.modulus_unit; keeps the stiffness of an element in proportion to that of the tip."""
    time: Number = Field(ge=0.001, le=1000)
    """Of solver.max_time_step; periods of the first mode."""
