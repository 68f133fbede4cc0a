"""Builders of models, analyses and sweeps, with the fields of the contract.

Made by clients/python/generate.py from the OpenAPI document; change that instead.
"""
from dataclasses import dataclass, field
from typing import Any, ClassVar, List, Literal, Mapping, Optional, Sequence, Tuple, TypeVar, Union

from . import documents
from ._buildable import AnalysisBase, Buildable, Place, Targets, as_place, as_targets, given

_Self = TypeVar("_Self", bound="Buildable")


@dataclass
class ModelFields(Buildable):
    """The structure, what holds it and what acts on it, in one consistent set of units.

    Fields:
        nodes: Points that members join; each is the end of a member.
        sections: Stiffnesses of members.
        members: Beams.
        title: A title, echoed in the result.
        units: Labels of the units.
        supports: Nodes that are held; supports, springs or foundations must hold the structure.
        springs: Discrete springs to the ground.
        foundations: Continuous elastic bases.
        loads: Actions; one must be proportional and not zero unless the analysis is static.
        imperfections: Stress-free offsets of the axes.
        monitors: Displacements that are recorded.
    """

    title: Optional[str] = None
    units: Optional[documents.Units] = None
    nodes: List[documents.Node] = field(default_factory=list)
    sections: List[documents.Section] = field(default_factory=list)
    members: List[documents.Member] = field(default_factory=list)
    supports: List[documents.Support] = field(default_factory=list)
    springs: List[documents.Spring] = field(default_factory=list)
    foundations: List[documents.Foundation] = field(default_factory=list)
    loads: List[documents.Load] = field(default_factory=list)
    imperfections: List[documents.Imperfection] = field(default_factory=list)
    monitors: List[documents.Monitor] = field(default_factory=list)

    _required: ClassVar[Tuple[str, ...]] = ("nodes", "sections", "members",)

    def node(self: _Self, id: documents.Id, x: float, y: float) -> _Self:
        """A point that members join.

        Arguments:
            id: Name of the node.
            x: Global x, to the right [length].
            y: Global y, up [length].
        """
        return self._add("nodes", {"id": id, "x": x, "y": y})

    def section(self: _Self, id: documents.Id, *, EA: Optional[float] = None, EI: Optional[float] = None,
                GA: Optional[float] = None, E: Optional[float] = None, A: Optional[float] = None,
                I: Optional[float] = None, nu: Optional[float] = None, shear_area: Optional[float] = None) -> _Self:
        """Stiffness of a member: by stiffness, or by material and shape.

        Arguments:
            id: Name of the section.
            EA: Axial stiffness [force].
            EI: Bending stiffness [force times length squared].
            GA: Shear stiffness with the shear area; without it the section does not shear [force].
            E: Young's modulus [force per length squared].
            A: Area [length squared].
            I: Second moment of area [length to the fourth power].
            nu: Poisson's ratio; needed with shear_area [dimensionless].
            shear_area: Area that shears; without it the section does not shear [length squared].
        """
        return self._add("sections", {"id": id, "EA": EA, "EI": EI, "GA": GA, "E": E, "A": A, "I": I, "nu": nu,
                                      "shear_area": shear_area})

    def member(self: _Self, id: documents.Id, start: documents.Id, end: documents.Id, section: documents.Id, *,
               curve: Optional[documents.Curve] = None, release: Optional[documents.MemberRelease] = None) -> _Self:
        """A beam between two nodes.

        Arguments:
            id: Name of the member.
            start: Id of the node that s is counted from.
            end: Id of the other node.
            section: Id of the section.
            curve: Axis of the member; a straight line when left out.
            release: Internal hinges.
        """
        return self._add("members", {"id": id, "start": start, "end": end, "section": section, "curve": curve,
                                     "release": release})

    def line_member(self: _Self, id: documents.Id, start: documents.Id, end: documents.Id, section: documents.Id, *,
                    release: Optional[documents.MemberRelease] = None) -> _Self:
        """A beam between two nodes: a straight line.

        Arguments:
            id: Name of the member.
            start: Id of the node that s is counted from.
            end: Id of the other node.
            section: Id of the section.
            release: Internal hinges.
        """
        return self._add("members", {"id": id, "start": start, "end": end, "section": section, "release": release,
                                     "curve": given({"type": "line"})})

    def arc_member(self: _Self, id: documents.Id, start: documents.Id, end: documents.Id, section: documents.Id,
                   sweep_degrees: float, *, release: Optional[documents.MemberRelease] = None) -> _Self:
        """A beam between two nodes: a circular arc.

        Arguments:
            id: Name of the member.
            start: Id of the node that s is counted from.
            end: Id of the other node.
            section: Id of the section.
            sweep_degrees: Angle that the axis turns by from start to end, positive to the left, not 0 [degrees].
            release: Internal hinges.
        """
        return self._add("members", {"id": id, "start": start, "end": end, "section": section, "release": release,
                                     "curve": given({"type": "arc", "sweep_degrees": sweep_degrees})})

    def parabola_member(self: _Self, id: documents.Id, start: documents.Id, end: documents.Id, section: documents.Id,
                        rise: float, *, release: Optional[documents.MemberRelease] = None) -> _Self:
        """A beam between two nodes: a parabola over the chord.

        Arguments:
            id: Name of the member.
            start: Id of the node that s is counted from.
            end: Id of the other node.
            section: Id of the section.
            rise: Rise along the left normal of the chord [length].
            release: Internal hinges.
        """
        return self._add("members", {"id": id, "start": start, "end": end, "section": section, "release": release,
                                     "curve": given({"type": "parabola", "rise": rise})})

    def sine_member(self: _Self, id: documents.Id, start: documents.Id, end: documents.Id, section: documents.Id,
                    rise: float, *, release: Optional[documents.MemberRelease] = None,
                    half_waves: Optional[int] = None) -> _Self:
        """A beam between two nodes: half waves of a sine over the chord.

        Arguments:
            id: Name of the member.
            start: Id of the node that s is counted from.
            end: Id of the other node.
            section: Id of the section.
            rise: Rise along the left normal of the chord [length].
            release: Internal hinges.
            half_waves: Number of half waves [dimensionless].
        """
        return self._add("members", {"id": id, "start": start, "end": end, "section": section, "release": release,
                                     "curve": given({"type": "sine", "rise": rise, "half_waves": half_waves})})

    def points_member(self: _Self, id: documents.Id, start: documents.Id, end: documents.Id, section: documents.Id,
                      points: Sequence[Sequence[float]], *, release: Optional[documents.MemberRelease] = None) -> _Self:
        """A beam between two nodes: a smooth (C2) cubic spline.

        Arguments:
            id: Name of the member.
            start: Id of the node that s is counted from.
            end: Id of the other node.
            section: Id of the section.
            points: Interior points [x, y] in order.
            release: Internal hinges.
        """
        return self._add("members", {"id": id, "start": start, "end": end, "section": section, "release": release,
                                     "curve": given({"type": "points", "points": points})})

    def support(self: _Self, node: documents.Id, fixed: Sequence[Literal["x", "y", "rotation"]], *,
                angle_degrees: Optional[float] = None,
                displacement: Optional[Union[documents.SupportPlainDisplacement, documents.SupportWithDisplacementDisplacement]] = None,
                pattern: Optional[documents.Pattern] = None) -> _Self:
        """A node that is held.

        Arguments:
            node: Id of the node that is held; one support a node.
            fixed: Components that are held, in the support's own axes.
            angle_degrees: Angle of the support's x axis to the global one, counter-clockwise [degrees].
            displacement: Prescribed values of fixed components.
            pattern: What multiplies the displacement.
        """
        return self._add("supports", {"node": node, "fixed": fixed, "angle_degrees": angle_degrees,
                                      "displacement": displacement, "pattern": pattern})

    def spring(self: _Self, id: documents.Id, at: Place, direction: Union[documents.Direction, Literal["rotation"]],
               stiffness: float, *, reaction: Optional[documents.Reaction] = None,
               gap: Optional[float] = None) -> _Self:
        """A discrete elastic spring to the ground.

        Arguments:
            id: Name of the spring.
            at: Where it is attached.
            direction: Along a direction that points into the medium, or rotation for a rotational spring.
            stiffness: Stiffness [force per length; force times length per radian for a rotational one].
            reaction: What it can do.
            gap: Free travel before a one-sided spring reacts; needs a one-sided reaction [length; radians for a
                rotational one].
        """
        return self._add("springs", {"id": id, "at": as_place(at), "direction": direction, "stiffness": stiffness,
                                     "reaction": reaction, "gap": gap})

    def foundation(self: _Self, id: documents.Id, member: documents.Id, stiffness: float, *,
                   shear_stiffness: Optional[float] = None, reaction: Optional[documents.Reaction] = None,
                   range: Optional[documents.Range] = None, gap: Optional[float] = None,
                   direction: Optional[Union[Literal["normal"], documents.Direction]] = None,
                   side: Optional[documents.Side] = None) -> _Self:
        """A continuous elastic base along a member.

        Arguments:
            id: Name of the foundation.
            member: Id of the member that it lies along.
            stiffness: Winkler modulus K of the reaction r = K w - G w'' per undeformed length [force per length
                squared (force per length of member and length of displacement)].
            shear_stiffness: Stiffness G of the shear layer (Pasternak, Filonenko-Borodich); needs a bilateral
                reaction [force].
            reaction: What it can do.
            range: Part of the member that it lies along [fraction of the member's undeformed length].
            gap: Free travel before a one-sided foundation reacts; needs a one-sided reaction [length].
            direction: Along the initial normal of the member / Points into the medium [dimensionless].
            side: Where the medium lies.
        """
        return self._add("foundations", {"id": id, "member": member, "stiffness": stiffness,
                                         "shear_stiffness": shear_stiffness, "reaction": reaction, "range": range,
                                         "gap": gap, "direction": direction, "side": side})

    def point_load(self: _Self, at: Place, force: Sequence[float], *, moment: Optional[float] = None,
                   pattern: Optional[documents.Pattern] = None) -> _Self:
        """A dead force, a moment, or both, at a point.

        Arguments:
            at: Where it acts.
            force: Force [fx, fy] in global axes [force].
            moment: Moment, counter-clockwise [force times length].
            pattern: What multiplies the load.
        """
        return self._add("loads", {"type": "point", "at": as_place(at), "force": force, "moment": moment,
                                   "pattern": pattern})

    def distributed_load(self: _Self, member: documents.Id, force: Sequence[float], *,
                         range: Optional[documents.Range] = None,
                         per: Optional[Literal["length", "horizontal", "vertical"]] = None,
                         pattern: Optional[documents.Pattern] = None) -> _Self:
        """A dead load along a member.

        Arguments:
            member: Id of the member that it acts on.
            force: Load [qx, qy] in global axes [force per length].
            range: Part of the member [fraction of the member's undeformed length].
            per: Length that the load is counted by: of the undeformed axis, or of its projection.
            pattern: What multiplies the load.
        """
        return self._add("loads", {"type": "distributed", "member": member, "force": force, "range": range, "per": per,
                                   "pattern": pattern})

    def pressure_load(self: _Self, member: documents.Id, value: float, *, side: Optional[documents.Side] = None,
                      pattern: Optional[documents.Pattern] = None) -> _Self:
        """A pressure on the deformed line.

        Arguments:
            member: Id of the member that it acts on.
            value: Pressure, per deformed length, across the deformed axis [force per length].
            side: The side that it pushes from.
            pattern: What multiplies the load.
        """
        return self._add("loads", {"type": "pressure", "member": member, "value": value, "side": side,
                                   "pattern": pattern})

    def initial_strain_load(self: _Self, member: documents.Id, *, axial: Optional[float] = None,
                            curvature: Optional[float] = None, pattern: Optional[documents.Pattern] = None) -> _Self:
        """A strain without stress: temperature, shrinkage, prestress.

        Arguments:
            member: Id of the member that it acts on.
            axial: Axial strain, extension positive [dimensionless].
            curvature: Curvature, to the left positive [radians per length].
            pattern: What multiplies the load.
        """
        return self._add("loads", {"type": "initial_strain", "member": member, "axial": axial, "curvature": curvature,
                                   "pattern": pattern})

    def sine_imperfection(self: _Self, member: documents.Id, half_waves: int, amplitude: float) -> _Self:
        """Half waves of a sine.

        Arguments:
            member: Id of the member that it acts on.
            half_waves: Number of half waves [dimensionless].
            amplitude: Largest offset along the left normal [length].
        """
        return self._add("imperfections", {"type": "sine", "member": member, "half_waves": half_waves,
                                           "amplitude": amplitude})

    def mode_imperfection(self: _Self, number: int, amplitude: float) -> _Self:
        """A linearised buckling mode.

        Arguments:
            number: Which mode; 1 is that of the lowest load [dimensionless].
            amplitude: Largest offset along the left normal [length].
        """
        return self._add("imperfections", {"type": "mode", "number": number, "amplitude": amplitude})

    def points_imperfection(self: _Self, member: documents.Id, offsets: Sequence[Sequence[float]]) -> _Self:
        """Offsets at points, joined by a smooth spline.

        Arguments:
            member: Id of the member that it acts on.
            offsets: Pairs [fraction, offset], fractions increasing.
        """
        return self._add("imperfections", {"type": "points", "member": member, "offsets": offsets})

    def monitor(self: _Self, id: documents.Id, at: Place, component: Literal["x", "y", "rotation", "normal"]) -> _Self:
        """A displacement that is recorded at every step.

        Arguments:
            id: Name of the monitor.
            at: Where.
            component: Which displacement; normal is along the initial left normal and needs a place on a member.
        """
        return self._add("monitors", {"id": id, "at": as_place(at), "component": component})


@dataclass
class SweepFields(Buildable):
    """A request, what varies in it, and what is wanted of each point.

    Fields:
        model: The structure.
        analysis: The analysis.
        parameters: What varies.
        design: Which points are computed.
        outputs: Columns of the table.
        follow: Name of the last parameter: its critical point is followed along it.
    """

    model: Any
    analysis: Any
    design: documents.SweepDesign
    outputs: Sequence[str]
    follow: Optional[str] = None
    parameters: List[documents.SweepParameter] = field(default_factory=list)

    _required: ClassVar[Tuple[str, ...]] = ("model", "analysis", "parameters", "design", "outputs",)

    def parameter(self: _Self, name: str, targets: Targets, *, values: Optional[Sequence[Any]] = None,
                  label: Optional[Sequence[str]] = None,
                  range: Optional[documents.SweepParameterWithRangeRange] = None) -> _Self:
        """What varies.

        Arguments:
            name: Name of its column; not error, point or request, and not beginning with /.
            targets: Where it is written.
            values: Numbers, names, whole lists.
            label: How each value is named in tables: one text a value, no two alike; for values that are objects or
                lists.
            range: Numbers from one end to the other.
        """
        return self._add("parameters", {"name": name, "targets": as_targets(targets), "values": values, "label": label,
                                        "range": range})


@dataclass
class Buckling(AnalysisBase):
    """Analysis of type buckling. Linearised eigenvalues about the reference load.

    Every field is optional:
        modes: how many loads and modes; with reversed so many of each sign [dimensionless].
        reversed: whether loads of the opposite actions count, too, as negative load factors; needs bilateral
            springs and foundations.
        geometry: nonlinear: large displacements; linear: small ones, for static only.
        discretization: The mesh; an accuracy of 1e-3 when left out.
        output: What is given back.
    """

    modes: Optional[int] = None
    reversed: Optional[bool] = None
    geometry: Optional[Literal["nonlinear", "linear"]] = None
    discretization: Optional[documents.Discretization] = None
    output: Optional[documents.Output] = None

    _type: ClassVar[str] = "buckling"


@dataclass
class Critical(AnalysisBase):
    """Analysis of type critical. The first loss of stability on the path from the unloaded state.

    Every field is optional:
        geometry: nonlinear: large displacements; linear: small ones, for static only.
        discretization: The mesh; an accuracy of 1e-3 when left out.
        output: What is given back.
        sensitivities: numbers of the model by which the load factor of each critical point is differentiated.
        koiter: Koiter's coefficients of bifurcations.
    """

    geometry: Optional[Literal["nonlinear", "linear"]] = None
    discretization: Optional[documents.Discretization] = None
    output: Optional[documents.Output] = None
    sensitivities: Optional[Sequence[str]] = None
    koiter: Optional[bool] = None

    _type: ClassVar[str] = "critical"


@dataclass
class Path(AnalysisBase):
    """Analysis of type path. The equilibrium path.

    Every field is optional:
        start: the state that the path begins with, such as one of a branch that no path from the unloaded state
            reaches; by default the unloaded state or that of the constant actions.
        geometry: nonlinear: large displacements; linear: small ones, for static only.
        discretization: The mesh; an accuracy of 1e-3 when left out.
        control: what is increased from step to step.
        step: lengths of the steps.
        stop: where it ends.
        branches: which bifurcated branches are followed.
        output: What is given back.
        sensitivities: numbers of the model by which the load factor of each critical point is differentiated.
        koiter: Koiter's coefficients of bifurcations.
    """

    start: Optional[documents.StartState] = None
    geometry: Optional[Literal["nonlinear", "linear"]] = None
    discretization: Optional[documents.Discretization] = None
    control: Optional[Union[Literal["arc_length", "load"], documents.AnalysisControlWithDisplacement]] = None
    step: Optional[documents.Step] = None
    stop: Optional[documents.Stop] = None
    branches: Optional[documents.AnalysisBranches] = None
    output: Optional[documents.Output] = None
    sensitivities: Optional[Sequence[str]] = None
    koiter: Optional[bool] = None

    _type: ClassVar[str] = "path"


@dataclass
class Static(AnalysisBase):
    """Analysis of type static. Equilibrium at load_factors.

    Every field is optional:
        load_factors: where equilibrium is wanted [dimensionless].
        unstable: what is done where the path loses stability before an asked load factor. refuse: the analysis ends
            there with the failure beyond_critical_point; follow: rows beyond a bifurcation are given, with their
            counts and a warning.
        geometry: nonlinear: large displacements; linear: small ones, for static only.
        discretization: The mesh; an accuracy of 1e-3 when left out.
        output: What is given back.
    """

    load_factors: Optional[Sequence[float]] = None
    unstable: Optional[Literal["refuse", "follow"]] = None
    geometry: Optional[Literal["nonlinear", "linear"]] = None
    discretization: Optional[documents.Discretization] = None
    output: Optional[documents.Output] = None

    _type: ClassVar[str] = "static"
