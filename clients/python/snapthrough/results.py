"""Attributes of the documents that are received: results, states of jobs and sweeps, events.

Made by clients/python/generate.py from the OpenAPI document; change that instead.
"""
from typing import Any, Dict, List, Literal, Optional, Tuple, Union, cast

from ._part import Part, PartList, PartMap

__all__ = ["AtCritical", "Branch", "Buckling", "COLUMNS", "Check", "CheckSize", "ContactEvent", "CriticalPoint",
           "CriticalPointEvent", "Diagnostics", "DisplacementExtreme", "Extremes", "Failure", "Finding", "ForceExtreme",
           "FoundationState", "Job", "JobError", "JobList", "JobProgressEvent", "Koiter", "Limits", "Link",
           "MemberExtremes", "MemberExtremesAxialForce", "MemberExtremesBendingMoment", "MemberExtremesDisplacement",
           "MemberExtremesShearForce", "MemberState", "MeshLoad", "MeshReport", "MeshReportAccuracy", "Mode",
           "ModeMember", "MomentExtreme", "NeutralMotion", "NodeMotion", "PathPointsEvent",
           "PathPointsEventMonitorsItem", "Problem", "ResultFields", "ResultFieldsModel", "Resultant", "Sensitivity",
           "Softest", "SpringState", "State", "Static", "Summary", "SupportReaction", "Sweep", "SweepCounts",
           "SweepList", "SweepProgressEvent", "Warning"]

#: Of the tables of a result: fields with a column, and fields with a column for each id.
COLUMNS: Dict[str, Tuple[Tuple[str, ...], Tuple[str, ...]]] = {
    "CriticalPoint": (('branch', 'type', 'cause', 'load_factor', 'error_estimate', 'confirmed', 'arc_length',
        'negative_before', 'negative_after', 'multiplicity', 'state', 'member'), ('monitors',)),
    "Branch": (('load_factor', 'arc_length', 'negative_eigenvalues', 'stiffness_ratio'), ('monitors',
        'contact_fraction')),
    "Static": (('load_factor', 'negative_eigenvalues', 'state'), ('monitors', 'contact_fraction')),
    "MemberState": (('s', 'x0', 'y0', 'x', 'y', 'u', 'v', 'rotation', 'axial_force', 'shear_force', 'bending_moment'),
        ()),
}


class ResultFieldsModel(Part):
    """What the model is called."""

    __slots__ = ()

    @property
    def title(self) -> "str":
        """Title of the model."""
        return cast("str", self._document["title"])

    @property
    def units(self) -> "Dict[str, str]":
        """Labels of the units."""
        return cast("Dict[str, str]", self._document["units"])


class ModeMember(Part):
    """A mode along a member; lists of equal length."""

    __slots__ = ()

    @property
    def s(self) -> "List[float]":
        """Undeformed arc length from the start of the member [length]."""
        return cast("List[float]", self._document["s"])

    @property
    def u(self) -> "List[float]":
        """Displacement along global x, scaled [of the mode: largest hypot(u, v) is 1]."""
        return cast("List[float]", self._document["u"])

    @property
    def v(self) -> "List[float]":
        """Displacement along global y, scaled [of the mode: largest hypot(u, v) is 1]."""
        return cast("List[float]", self._document["v"])

    @property
    def rotation(self) -> "List[float]":
        """Rotation, counter-clockwise, scaled [radians per length, of the mode]."""
        return cast("List[float]", self._document["rotation"])


class Mode(Part):
    """A shape of displacements: the largest displacement is 1, its larger component positive."""

    __slots__ = ()

    @property
    def members(self) -> "PartMap[ModeMember]":
        """The shape by id of the member."""
        return PartMap(ModeMember, self._document["members"])


class Softest(Part):
    """Where the structure is softest before it loses stability."""

    __slots__ = ()

    @property
    def load_factor(self) -> "float":
        """Load factor there, on the path's mesh [dimensionless (times the proportional actions)]."""
        return cast("float", self._document["load_factor"])

    @property
    def stiffness_ratio(self) -> "float":
        """Least stiffness there over that of the unloaded structure; 0 at a critical point [dimensionless]."""
        return cast("float", self._document["stiffness_ratio"])

    @property
    def mode(self) -> "Optional[Mode]":
        """The motion with that stiffness; null when no modes or states are asked for."""
        value = self._document["mode"]
        return None if value is None else Mode(value)


class AtCritical(Part):
    """Largest movements of the state at the critical load factor."""

    __slots__ = ()

    @property
    def displacement(self) -> "float":
        """Largest hypot(u, v) [length]."""
        return cast("float", self._document["displacement"])

    @property
    def relative_displacement(self) -> "float":
        """The same over the diagonal of the structure's bounding box [dimensionless]."""
        return cast("float", self._document["relative_displacement"])

    @property
    def rotation(self) -> "float":
        """Largest rotation, of either sense [rad]."""
        return cast("float", self._document["rotation"])

    @property
    def strain(self) -> "float":
        """Largest of |N| / EA, |Q| / GA and |M| / EI times sqrt(EI / EA) [dimensionless]."""
        return cast("float", self._document["strain"])


class Summary(Part):
    """What most readers want."""

    __slots__ = ()

    @property
    def critical_load_factor(self) -> "Optional[float]":
        """Load factor at which the path from the unloaded state first loses stability, confirmed; positive
        unless analysis.step.direction is -1; null when there is none. buckling: the lowest positive one
        [dimensionless (times the proportional actions)].
        """
        return cast("Optional[float]", self._document["critical_load_factor"])

    @property
    def critical_type(self) -> "Optional[str]":
        """Kind of that critical point; null when there is none."""
        return cast("Optional[str]", self._document["critical_type"])

    @property
    def error_estimate(self) -> "Optional[float]":
        """Estimated relative error of that load factor; null when none was made [dimensionless]."""
        return cast("Optional[float]", self._document["error_estimate"])

    @property
    def softest(self) -> "Optional[Softest]":
        """Where the stiffness ratio has its first local minimum below a tenth before the critical load factor,
        else its lowest; the critical point itself where it has no minimum; null when neither was met.
        """
        value = self._document["softest"]
        return None if value is None else Softest(value)

    @property
    def at_critical(self) -> "Optional[AtCritical]":
        """How far the structure has moved at the critical load factor; null when there is none, and in
        linearised analyses.
        """
        value = self._document["at_critical"]
        return None if value is None else AtCritical(value)

    @property
    def termination(self) -> "str":
        """Code of what ended the analysis; see docs/requests.md, How an analysis ends."""
        return cast("str", self._document["termination"])

    @property
    def message(self) -> "str":
        """The same as a sentence with the deciding numbers."""
        return cast("str", self._document["message"])


class MeshLoad(Part):
    """What one mesh said of a critical point."""

    __slots__ = ()

    @property
    def elements(self) -> "int":
        """Elements of the mesh [dimensionless]."""
        return cast("int", self._document["elements"])

    @property
    def order(self) -> "int":
        """Polynomial order of its elements [dimensionless]."""
        return cast("int", self._document["order"])

    @property
    def load_factor(self) -> "Optional[float]":
        """Load factor there; null: nothing was found there [dimensionless (times the proportional actions)]."""
        return cast("Optional[float]", self._document["load_factor"])


class Sensitivity(Part):
    """Derivative of a critical load factor."""

    __slots__ = ()

    @property
    def pointer(self) -> "str":
        """The number of the model, as asked."""
        return cast("str", self._document["pointer"])

    @property
    def derivative(self) -> "Optional[float]":
        """d load_factor / d value, on the mesh of the load factor; null where there is none [of the load factor
        over the value's].
        """
        return cast("Optional[float]", self._document["derivative"])

    @property
    def reason(self) -> "Optional[str]":
        """Why there is none. breaks_bifurcation: the path no longer meets the point, and its load falls by a
        power less than one; contact: a support that begins or ceases to act makes the point; multiple: several
        eigenvalues vanish there and go apart; unsymmetric: follower pressure acts on a free end;
        not_differentiable: the equations have a kink or a jump there; not_found: the point could not be found
        again to rounding; one of breaks_bifurcation, contact, multiple, unsymmetric, not_differentiable,
        not_found.
        """
        return cast("Optional[str]", self._document["reason"])


class Koiter(Part):
    """How the path that crosses leaves a simple bifurcation."""

    __slots__ = ()

    @property
    def a(self) -> "float":
        """0 at a symmetric bifurcation [one over length]."""
        return cast("float", self._document["a"])

    @property
    def b(self) -> "Optional[float]":
        """Null at an asymmetric bifurcation [one over length squared]."""
        return cast("Optional[float]", self._document["b"])

    @property
    def kind(self) -> "str":
        """asymmetric: an imperfection takes away by its power 1/2; stable_symmetric: the state at the load
        itself is stable; unstable_symmetric: an imperfection takes away by its power 2/3; one of asymmetric,
        stable_symmetric, unstable_symmetric.
        """
        return cast("str", self._document["kind"])


class CriticalPoint(Part):
    """A point of a path where stability changes."""

    __slots__ = ()

    @property
    def branch(self) -> "int":
        """Index of the branch in branches [dimensionless]."""
        return cast("int", self._document["branch"])

    @property
    def type(self) -> "str":
        """Kind of the point; one of bifurcation, limit_max, limit_min, broken_bifurcation."""
        return cast("str", self._document["type"])

    @property
    def cause(self) -> "str":
        """smooth: an eigenvalue passes zero; contact: a support that begins or ceases to act changes the
        stiffness; one of smooth, contact.
        """
        return cast("str", self._document["cause"])

    @property
    def load_factor(self) -> "float":
        """Load factor [dimensionless (times the proportional actions)]."""
        return cast("float", self._document["load_factor"])

    @property
    def error_estimate(self) -> "Optional[float]":
        """Estimated relative error of the load factor; null when none was made [dimensionless]."""
        return cast("Optional[float]", self._document["error_estimate"])

    @property
    def confirmed(self) -> "bool":
        """Whether a finer mesh found the point within the asked accuracy."""
        return cast("bool", self._document["confirmed"])

    @property
    def meshes(self) -> "PartList[MeshLoad]":
        """What each mesh said, coarsest first."""
        return PartList(MeshLoad, self._document["meshes"])

    @property
    def arc_length(self) -> "float":
        """Arc length of the path up to the point [dimensionless]."""
        return cast("float", self._document["arc_length"])

    @property
    def monitors(self) -> "Dict[str, float]":
        """Values of monitors there, by id."""
        return cast("Dict[str, float]", self._document["monitors"])

    @property
    def negative_before(self) -> "Optional[int]":
        """Negative eigenvalues of the tangent stiffness before the point; null when not counted
        [dimensionless].
        """
        return cast("Optional[int]", self._document["negative_before"])

    @property
    def negative_after(self) -> "Optional[int]":
        """The same after the point [dimensionless]."""
        return cast("Optional[int]", self._document["negative_after"])

    @property
    def multiplicity(self) -> "int":
        """How many eigenvalues vanish there [dimensionless]."""
        return cast("int", self._document["multiplicity"])

    @property
    def imperfection(self) -> "Optional[float]":
        """Of a bifurcation: the size of what breaks it, about the root mean square slope of the imperfection
        along its mode; null where it was not measured [dimensionless].
        """
        return cast("Optional[float]", self._document["imperfection"])

    @property
    def state(self) -> "Optional[int]":
        """Index of the point's state in states; null when there is none [dimensionless]."""
        return cast("Optional[int]", self._document["state"])

    @property
    def member(self) -> "Optional[str]":
        """The member whose own buckling the point is: nine tenths of the strain energy of the motion lost there
        are its; null where that is no single member's.
        """
        return cast("Optional[str]", self._document["member"])

    @property
    def mode(self) -> "Optional[Mode]":
        """The null vector at a bifurcation, the path's direction at a limit point; null without a state."""
        value = self._document["mode"]
        return None if value is None else Mode(value)

    @property
    def sensitivities(self) -> "Optional[PartList[Sensitivity]]":
        """In the order of analysis.sensitivities; absent where none were asked for; None when absent."""
        value = self._document.get("sensitivities")
        return None if value is None else PartList(Sensitivity, value)

    @property
    def koiter(self) -> "Optional[Koiter]":
        """load_factor (1 + a s + b s^2) along the path that crosses, s the amplitude of the mode; null where it
        has none; absent where it was not asked for; None when absent.
        """
        value = self._document.get("koiter")
        return None if value is None else Koiter(value)


class NodeMotion(Part):
    """Motion of a node."""

    __slots__ = ()

    @property
    def u(self) -> "float":
        """Along global x, scaled [of the motion: largest hypot(u, v) is 1]."""
        return cast("float", self._document["u"])

    @property
    def v(self) -> "float":
        """Along global y, scaled [of the motion: largest hypot(u, v) is 1]."""
        return cast("float", self._document["v"])

    @property
    def rotation(self) -> "float":
        """Rotation, counter-clockwise, scaled [radians per length, of the motion]."""
        return cast("float", self._document["rotation"])


class NeutralMotion(Part):
    """A motion that meets no stiffness along a part of a path: it is held by the least norm, and stability is
    counted on the rest.
    """

    __slots__ = ()

    @property
    def branch(self) -> "int":
        """Index of the branch in branches [dimensionless]."""
        return cast("int", self._document["branch"])

    @property
    def from_(self) -> "float":
        """Load factor where it begins [dimensionless (times the proportional actions)]."""
        return cast("float", self._document["from"])

    @property
    def to(self) -> "Optional[float]":
        """Load factor where it ends; null: with the path [dimensionless (times the proportional actions)]."""
        return cast("Optional[float]", self._document["to"])

    @property
    def nodes(self) -> "PartMap[NodeMotion]":
        """Motion by id of the node."""
        return PartMap(NodeMotion, self._document["nodes"])


class ContactEvent(Part):
    """Contact that begins or ends somewhere."""

    __slots__ = ()

    @property
    def branch(self) -> "int":
        """Index of the branch in branches [dimensionless]."""
        return cast("int", self._document["branch"])

    @property
    def id(self) -> "str":
        """Id of the foundation or of the one-sided spring."""
        return cast("str", self._document["id"])

    @property
    def type(self) -> "str":
        """opened: contact was lost; closed: contact was made; one of opened, closed."""
        return cast("str", self._document["type"])

    @property
    def load_factor(self) -> "float":
        """Load factor [dimensionless (times the proportional actions)]."""
        return cast("float", self._document["load_factor"])

    @property
    def arc_length(self) -> "float":
        """Arc length of the path up to the event [dimensionless]."""
        return cast("float", self._document["arc_length"])

    @property
    def zones_before(self) -> "int":
        """Contact zones before [dimensionless]."""
        return cast("int", self._document["zones_before"])

    @property
    def zones_after(self) -> "int":
        """Contact zones after [dimensionless]."""
        return cast("int", self._document["zones_after"])


class Branch(Part):
    """An equilibrium path; its lists have one entry a point."""

    __slots__ = ()

    @property
    def id(self) -> "int":
        """Number of the branch; 0 is the primary path [dimensionless]."""
        return cast("int", self._document["id"])

    @property
    def parent(self) -> "Optional[int]":
        """Branch that it bifurcates from; null for the primary path [dimensionless]."""
        return cast("Optional[int]", self._document["parent"])

    @property
    def load_factor(self) -> "List[float]":
        """Load factors [dimensionless (times the proportional actions)]."""
        return cast("List[float]", self._document["load_factor"])

    @property
    def arc_length(self) -> "List[float]":
        """Arc length from the branch's first point, increasing [dimensionless]."""
        return cast("List[float]", self._document["arc_length"])

    @property
    def monitors(self) -> "Dict[str, List[float]]":
        """Displacements of monitors, by id."""
        return cast("Dict[str, List[float]]", self._document["monitors"])

    @property
    def negative_eigenvalues(self) -> "List[int]":
        """Negative eigenvalues of the constrained tangent stiffness; 0 is stable [dimensionless]."""
        return cast("List[int]", self._document["negative_eigenvalues"])

    @property
    def stiffness_ratio(self) -> "List[Optional[float]]":
        """Least stiffness over that of the unloaded structure: 1 unloaded, 0 at a critical point; null where it
        is not known [dimensionless].
        """
        return cast("List[Optional[float]]", self._document["stiffness_ratio"])

    @property
    def contact_fraction(self) -> "Dict[str, List[float]]":
        """How much of each foundation is in contact, by id."""
        return cast("Dict[str, List[float]]", self._document["contact_fraction"])

    @property
    def termination(self) -> "str":
        """Code of what ended the branch."""
        return cast("str", self._document["termination"])


class MemberState(Part):
    """A member in a state; lists of equal length, points_per_member entries."""

    __slots__ = ()

    @property
    def s(self) -> "List[float]":
        """Undeformed arc length from the start of the member [length]."""
        return cast("List[float]", self._document["s"])

    @property
    def x0(self) -> "List[float]":
        """Global x of the undeformed axis [length]."""
        return cast("List[float]", self._document["x0"])

    @property
    def y0(self) -> "List[float]":
        """Global y of the undeformed axis [length]."""
        return cast("List[float]", self._document["y0"])

    @property
    def x(self) -> "List[float]":
        """Global x of the deformed axis [length]."""
        return cast("List[float]", self._document["x"])

    @property
    def y(self) -> "List[float]":
        """Global y of the deformed axis [length]."""
        return cast("List[float]", self._document["y"])

    @property
    def u(self) -> "List[float]":
        """Displacement along global x [length]."""
        return cast("List[float]", self._document["u"])

    @property
    def v(self) -> "List[float]":
        """Displacement along global y [length]."""
        return cast("List[float]", self._document["v"])

    @property
    def rotation(self) -> "List[float]":
        """Rotation of the cross-section, counter-clockwise [radians]."""
        return cast("List[float]", self._document["rotation"])

    @property
    def axial_force(self) -> "List[float]":
        """N, along the deformed tangent of the section, tension positive [force]."""
        return cast("List[float]", self._document["axial_force"])

    @property
    def shear_force(self) -> "List[float]":
        """Q, along the deformed left normal, of the part beyond on the part before [force]."""
        return cast("List[float]", self._document["shear_force"])

    @property
    def bending_moment(self) -> "List[float]":
        """M, positive when it turns the member to its left as s grows [force times length]."""
        return cast("List[float]", self._document["bending_moment"])


class SupportReaction(Part):
    """What a support does to the structure, in global axes."""

    __slots__ = ()

    @property
    def fx(self) -> "float":
        """Force along global x of the support on the structure [force]."""
        return cast("float", self._document["fx"])

    @property
    def fy(self) -> "float":
        """Force along global y of the support on the structure [force]."""
        return cast("float", self._document["fy"])

    @property
    def moment(self) -> "float":
        """Moment of the support on the structure, counter-clockwise [force times length]."""
        return cast("float", self._document["moment"])


class Resultant(Part):
    """Sum of forces, with its moment about the origin of the model's axes at the deformed positions (undeformed
    when geometry is linear).
    """

    __slots__ = ()

    @property
    def fx(self) -> "float":
        """Force along global x on the structure [force]."""
        return cast("float", self._document["fx"])

    @property
    def fy(self) -> "float":
        """Force along global y on the structure [force]."""
        return cast("float", self._document["fy"])

    @property
    def moment(self) -> "float":
        """Moment about the origin, counter-clockwise [force times length]."""
        return cast("float", self._document["moment"])


class SpringState(Part):
    """A spring in a state."""

    __slots__ = ()

    @property
    def force(self) -> "float":
        """What the spring presses on the structure against its direction: positive when the medium pushes back,
        negative when it pulls [force; force times length for a rotational one].
        """
        return cast("float", self._document["force"])

    @property
    def displacement(self) -> "float":
        """Displacement along its direction; rotation for a rotational one [length; radians for a rotation]."""
        return cast("float", self._document["displacement"])

    @property
    def closed(self) -> "bool":
        """Whether it acts."""
        return cast("bool", self._document["closed"])

    @property
    def resultant(self) -> "Resultant":
        """Force of the spring on the structure."""
        return Resultant(self._document["resultant"])


class FoundationState(Part):
    """A foundation in a state."""

    __slots__ = ()

    @property
    def s(self) -> "List[float]":
        """Undeformed arc length of the member [length]."""
        return cast("List[float]", self._document["s"])

    @property
    def reaction(self) -> "List[float]":
        """Reaction per undeformed length, positive when the medium pushes on the structure [force per length]."""
        return cast("List[float]", self._document["reaction"])

    @property
    def displacement(self) -> "List[float]":
        """Displacement into the medium [length]."""
        return cast("List[float]", self._document["displacement"])

    @property
    def contact(self) -> "List[List[float]]":
        """Intervals in contact."""
        return cast("List[List[float]]", self._document["contact"])

    @property
    def resultant(self) -> "Resultant":
        """Force of the medium on the structure, shear layer included."""
        return Resultant(self._document["resultant"])


class State(Part):
    """An equilibrium state. Supports (with their moment arms), springs, foundations and loads add up to zero."""

    __slots__ = ()

    @property
    def branch(self) -> "int":
        """Index of the branch in branches [dimensionless]."""
        return cast("int", self._document["branch"])

    @property
    def load_factor(self) -> "float":
        """Load factor [dimensionless (times the proportional actions)]."""
        return cast("float", self._document["load_factor"])

    @property
    def refinements(self) -> "int":
        """How often the path's mesh was refined for this state [dimensionless]."""
        return cast("int", self._document["refinements"])

    @property
    def members(self) -> "PartMap[MemberState]":
        """Shape and forces by id of the member."""
        return PartMap(MemberState, self._document["members"])

    @property
    def supports(self) -> "PartMap[SupportReaction]":
        """Reactions by id of the node that is held."""
        return PartMap(SupportReaction, self._document["supports"])

    @property
    def springs(self) -> "PartMap[SpringState]":
        """Springs by id."""
        return PartMap(SpringState, self._document["springs"])

    @property
    def foundations(self) -> "PartMap[FoundationState]":
        """Foundations by id."""
        return PartMap(FoundationState, self._document["foundations"])

    @property
    def loads(self) -> "Resultant":
        """Resultant of all loads that act in the state."""
        return Resultant(self._document["loads"])


class Static(Part):
    """Equilibrium at the load factors that were asked for and reached, in the order asked; lists have one entry a
    load factor.
    """

    __slots__ = ()

    @property
    def load_factor(self) -> "List[float]":
        """Load factors [dimensionless (times the proportional actions)]."""
        return cast("List[float]", self._document["load_factor"])

    @property
    def monitors(self) -> "Dict[str, List[float]]":
        """Displacements of monitors, by id."""
        return cast("Dict[str, List[float]]", self._document["monitors"])

    @property
    def negative_eigenvalues(self) -> "List[Optional[int]]":
        """Negative eigenvalues of the constrained tangent stiffness; 0 is stable, null not counted
        [dimensionless].
        """
        return cast("List[Optional[int]]", self._document["negative_eigenvalues"])

    @property
    def contact_fraction(self) -> "Dict[str, List[float]]":
        """How much of each foundation is in contact, by id."""
        return cast("Dict[str, List[float]]", self._document["contact_fraction"])

    @property
    def state(self) -> "List[Optional[int]]":
        """Index in states; null when there is none [dimensionless]."""
        return cast("List[Optional[int]]", self._document["state"])


class Buckling(Part):
    """Linearised buckling about the reference load."""

    __slots__ = ()

    @property
    def load_factors(self) -> "List[float]":
        """Buckling loads, increasing in size; negative ones, of the opposite actions, where analysis.reversed
        asks for them; empty where the constant actions alone exceed buckling loads [dimensionless (times the
        proportional actions)].
        """
        return cast("List[float]", self._document["load_factors"])

    @property
    def error_estimates(self) -> "List[Optional[float]]":
        """Estimated relative error of each; null when none was made [dimensionless]."""
        return cast("List[Optional[float]]", self._document["error_estimates"])

    @property
    def modes(self) -> "PartList[Mode]":
        """Mode of each."""
        return PartList(Mode, self._document["modes"])


class ForceExtreme(Part):
    """An extreme value of a force and where it is."""

    __slots__ = ()

    @property
    def value(self) -> "float":
        """The value [force]."""
        return cast("float", self._document["value"])

    @property
    def s(self) -> "float":
        """Undeformed arc length where it is [length]."""
        return cast("float", self._document["s"])

    @property
    def branch(self) -> "int":
        """Index of the branch in branches [dimensionless]."""
        return cast("int", self._document["branch"])

    @property
    def load_factor(self) -> "float":
        """Load factor at which it is [dimensionless (times the proportional actions)]."""
        return cast("float", self._document["load_factor"])


class MemberExtremesAxialForce(Part):
    """Axial force N."""

    __slots__ = ()

    @property
    def min(self) -> "ForceExtreme":
        """Smallest value."""
        return ForceExtreme(self._document["min"])

    @property
    def max(self) -> "ForceExtreme":
        """Largest value."""
        return ForceExtreme(self._document["max"])


class MemberExtremesShearForce(Part):
    """Shear force Q."""

    __slots__ = ()

    @property
    def min(self) -> "ForceExtreme":
        """Smallest value."""
        return ForceExtreme(self._document["min"])

    @property
    def max(self) -> "ForceExtreme":
        """Largest value."""
        return ForceExtreme(self._document["max"])


class MomentExtreme(Part):
    """An extreme value of a moment and where it is."""

    __slots__ = ()

    @property
    def value(self) -> "float":
        """The value [force times length]."""
        return cast("float", self._document["value"])

    @property
    def s(self) -> "float":
        """Undeformed arc length where it is [length]."""
        return cast("float", self._document["s"])

    @property
    def branch(self) -> "int":
        """Index of the branch in branches [dimensionless]."""
        return cast("int", self._document["branch"])

    @property
    def load_factor(self) -> "float":
        """Load factor at which it is [dimensionless (times the proportional actions)]."""
        return cast("float", self._document["load_factor"])


class MemberExtremesBendingMoment(Part):
    """Bending moment M."""

    __slots__ = ()

    @property
    def min(self) -> "MomentExtreme":
        """Smallest value."""
        return MomentExtreme(self._document["min"])

    @property
    def max(self) -> "MomentExtreme":
        """Largest value."""
        return MomentExtreme(self._document["max"])


class DisplacementExtreme(Part):
    """An extreme value of a displacement and where it is."""

    __slots__ = ()

    @property
    def value(self) -> "float":
        """The value [length]."""
        return cast("float", self._document["value"])

    @property
    def s(self) -> "float":
        """Undeformed arc length where it is [length]."""
        return cast("float", self._document["s"])

    @property
    def branch(self) -> "int":
        """Index of the branch in branches [dimensionless]."""
        return cast("int", self._document["branch"])

    @property
    def load_factor(self) -> "float":
        """Load factor at which it is [dimensionless (times the proportional actions)]."""
        return cast("float", self._document["load_factor"])


class MemberExtremesDisplacement(Part):
    """Displacement hypot(u, v)."""

    __slots__ = ()

    @property
    def max(self) -> "DisplacementExtreme":
        """Largest value."""
        return DisplacementExtreme(self._document["max"])


class MemberExtremes(Part):
    """Extremes of a member."""

    __slots__ = ()

    @property
    def axial_force(self) -> "MemberExtremesAxialForce":
        """Axial force N."""
        return MemberExtremesAxialForce(self._document["axial_force"])

    @property
    def shear_force(self) -> "MemberExtremesShearForce":
        """Shear force Q."""
        return MemberExtremesShearForce(self._document["shear_force"])

    @property
    def bending_moment(self) -> "MemberExtremesBendingMoment":
        """Bending moment M."""
        return MemberExtremesBendingMoment(self._document["bending_moment"])

    @property
    def displacement(self) -> "MemberExtremesDisplacement":
        """Displacement hypot(u, v)."""
        return MemberExtremesDisplacement(self._document["displacement"])


class Extremes(Part):
    """Extremes over all states and all points of paths up to the first critical load (of the whole path when there
    is none).
    """

    __slots__ = ()

    @property
    def members(self) -> "PartMap[MemberExtremes]":
        """By id of the member."""
        return PartMap(MemberExtremes, self._document["members"])


class Warning(Part):
    """Something that the reader of the result must know."""

    __slots__ = ()

    @property
    def code(self) -> "str":
        """large_strain: strains beyond 0.05, where the elastic law for small strains is not valid;
        touching_supports: supports touch without pressure, and it is not certain that no motion has a lower
        load; touching_eigenvalue: a stiffness falls to zero within rounding and rises again, and whether two
        critical points lie there cannot be told; path_points: a path has fewer points than asked for;
        monitor_still: the monitor of a stop rule does not move on any path that was followed, so that the rule
        could not act; contact_changes: a linearised analysis keeps the contact of its reference load, and under
        the critical load one-sided supports touch elsewhere; nearly_unstable: the stiffness ratio falls below a
        tenth before the critical load factor; unstable: rows of a static analysis are unstable equilibria; one
        of large_strain, touching_supports, touching_eigenvalue, path_points, monitor_still, contact_changes,
        nearly_unstable, unstable.
        """
        return cast("str", self._document["code"])

    @property
    def detail(self) -> "str":
        """Where and how much."""
        return cast("str", self._document["detail"])


class MeshReportAccuracy(Part):
    """Relative error of load factors."""

    __slots__ = ()

    @property
    def requested(self) -> "Optional[float]":
        """What was asked for; null with a fixed mesh [dimensionless]."""
        return cast("Optional[float]", self._document["requested"])

    @property
    def estimated(self) -> "Optional[float]":
        """What was reached by estimate; null when none was made [dimensionless]."""
        return cast("Optional[float]", self._document["estimated"])


class MeshReport(Part):
    """The mesh of the result."""

    __slots__ = ()

    @property
    def elements(self) -> "Optional[int]":
        """Elements; null when the analysis has none [dimensionless]."""
        return cast("Optional[int]", self._document["elements"])

    @property
    def order(self) -> "Optional[int]":
        """Polynomial order of the elements; null when the analysis has none [dimensionless]."""
        return cast("Optional[int]", self._document["order"])

    @property
    def unknowns(self) -> "Optional[int]":
        """Free displacement unknowns, inside elements included; null when the analysis has none
        [dimensionless].
        """
        return cast("Optional[int]", self._document["unknowns"])

    @property
    def refinements(self) -> "Optional[int]":
        """How often the mesh was refined; null when the analysis has none [dimensionless]."""
        return cast("Optional[int]", self._document["refinements"])

    @property
    def paths(self) -> "int":
        """Paths followed, of which the last is reported: each but the first on a mesh with every element cut in
        four or more, because finer meshes did not confirm what was found [dimensionless].
        """
        return cast("int", self._document["paths"])

    @property
    def accuracy(self) -> "MeshReportAccuracy":
        """Relative error of load factors."""
        return MeshReportAccuracy(self._document["accuracy"])


class Diagnostics(Part):
    """What the analysis took."""

    __slots__ = ()

    @property
    def steps(self) -> "Optional[int]":
        """Steps along paths; null when the analysis has none [dimensionless]."""
        return cast("Optional[int]", self._document["steps"])

    @property
    def rejected_steps(self) -> "Optional[int]":
        """Steps that were taken again, shorter; null when the analysis has none [dimensionless]."""
        return cast("Optional[int]", self._document["rejected_steps"])

    @property
    def iterations(self) -> "Optional[int]":
        """Newton corrections; null when the analysis has none [dimensionless]."""
        return cast("Optional[int]", self._document["iterations"])

    @property
    def factorizations(self) -> "Optional[int]":
        """Factorisations of the stiffness matrix; null when the analysis has none [dimensionless]."""
        return cast("Optional[int]", self._document["factorizations"])

    @property
    def max_relative_residual(self) -> "Optional[float]":
        """Largest out-of-balance force of an accepted point, of the size of the forces; null when the analysis
        has none [dimensionless].
        """
        return cast("Optional[float]", self._document["max_relative_residual"])

    @property
    def wall_time_s(self) -> "float":
        """Time of the analysis [seconds]."""
        return cast("float", self._document["wall_time_s"])

    @property
    def skipped(self) -> "List[str]":
        """What was left out because nobody asked for it or the model does not need it."""
        return cast("List[str]", self._document["skipped"])


class Failure(Part):
    """Why the analysis could not do what was asked."""

    __slots__ = ()

    @property
    def code(self) -> "str":
        """Code; see docs/requests.md, How an analysis ends."""
        return cast("str", self._document["code"])

    @property
    def detail(self) -> "str":
        """A sentence with the deciding numbers."""
        return cast("str", self._document["detail"])


class ResultFields(Part):
    """What an analysis found; see docs/results.md."""

    __slots__ = ()

    @property
    def model(self) -> "ResultFieldsModel":
        """What the model is called."""
        return ResultFieldsModel(self._document["model"])

    @property
    def summary(self) -> "Summary":
        """What most readers want."""
        return Summary(self._document["summary"])

    @property
    def critical_points(self) -> "PartList[CriticalPoint]":
        """Points where stability changes, in the order of paths."""
        return PartList(CriticalPoint, self._document["critical_points"])

    @property
    def neutral_motion(self) -> "PartList[NeutralMotion]":
        """Motions without stiffness."""
        return PartList(NeutralMotion, self._document["neutral_motion"])

    @property
    def contact_events(self) -> "PartList[ContactEvent]":
        """Where contact begins or ends, in the order of paths."""
        return PartList(ContactEvent, self._document["contact_events"])

    @property
    def branches(self) -> "PartList[Branch]":
        """Equilibrium paths; empty for buckling and static."""
        return PartList(Branch, self._document["branches"])

    @property
    def states(self) -> "PartList[State]":
        """Full states, as analysis.output.states asks for them."""
        return PartList(State, self._document["states"])

    @property
    def static(self) -> "Optional[Static]":
        """Equilibrium at load factors; of type static only; None when absent."""
        value = self._document.get("static")
        return None if value is None else Static(value)

    @property
    def not_reached(self) -> "List[float]":
        """Load factors that were asked for and not reached [dimensionless (times the proportional actions)]."""
        return cast("List[float]", self._document["not_reached"])

    @property
    def buckling(self) -> "Optional[Buckling]":
        """Buckling loads and modes; of type buckling only; None when absent."""
        value = self._document.get("buckling")
        return None if value is None else Buckling(value)

    @property
    def extremes(self) -> "Optional[Extremes]":
        """Extremes by member; only when analysis.output.extremes is true; None when absent."""
        value = self._document.get("extremes")
        return None if value is None else Extremes(value)

    @property
    def warnings(self) -> "PartList[Warning]":
        """What the reader must know."""
        return PartList(Warning, self._document["warnings"])

    @property
    def discretization(self) -> "MeshReport":
        """The mesh of the result."""
        return MeshReport(self._document["discretization"])

    @property
    def diagnostics(self) -> "Diagnostics":
        """What the analysis took."""
        return Diagnostics(self._document["diagnostics"])

    @property
    def failure(self) -> "Optional[Failure]":
        """Only when the analysis could not do what was asked; None when absent."""
        value = self._document.get("failure")
        return None if value is None else Failure(value)


class Finding(Part):
    """A mistake in a document."""

    __slots__ = ()

    @property
    def pointer(self) -> "str":
        """JSON Pointer to it."""
        return cast("str", self._document["pointer"])

    @property
    def code(self) -> "str":
        """Kind of mistake; see docs/requests.md and docs/sweeps.md."""
        return cast("str", self._document["code"])

    @property
    def detail(self) -> "str":
        """What is wrong, and the rule."""
        return cast("str", self._document["detail"])


class Problem(Part):
    """An error (RFC 9457)."""

    __slots__ = ()

    @property
    def type(self) -> "str":
        """Kind of problem; see docs/service.md."""
        return cast("str", self._document["type"])

    @property
    def title(self) -> "str":
        """The kind in words."""
        return cast("str", self._document["title"])

    @property
    def status(self) -> "int":
        """HTTP status [dimensionless]."""
        return cast("int", self._document["status"])

    @property
    def detail(self) -> "str":
        """What is wrong here."""
        return cast("str", self._document["detail"])

    @property
    def instance(self) -> "Optional[str]":
        """Path of the request; absent when the connection was refused before a request was read; None when
        absent.
        """
        return cast("Optional[str]", self._document.get("instance"))

    @property
    def request_id(self) -> "Optional[str]":
        """Id of the request, as in X-Request-Id and the log; absent likewise; None when absent."""
        return cast("Optional[str]", self._document.get("request_id"))

    @property
    def errors(self) -> "Optional[PartList[Finding]]":
        """invalid-request, malformed-json: every mistake; None when absent."""
        value = self._document.get("errors")
        return None if value is None else PartList(Finding, value)

    @property
    def code(self) -> "Optional[str]":
        """analysis-failed: code of the failure; None when absent."""
        return cast("Optional[str]", self._document.get("code"))

    @property
    def reached(self) -> "Optional[ResultFields]":
        """analysis-failed: the result as far as it got; None when absent."""
        value = self._document.get("reached")
        return None if value is None else ResultFields(value)


class CheckSize(Part):
    """Size of a valid document."""

    __slots__ = ()

    @property
    def points(self) -> "int":
        """Points of the sweep; 1 for a request [dimensionless]."""
        return cast("int", self._document["points"])

    @property
    def unknowns(self) -> "int":
        """Displacement unknowns of the first mesh of a point [dimensionless]."""
        return cast("int", self._document["unknowns"])


class Check(Part):
    """What is wrong with a document, or how large it is."""

    __slots__ = ()

    @property
    def valid(self) -> "bool":
        """Whether it would be accepted."""
        return cast("bool", self._document["valid"])

    @property
    def errors(self) -> "PartList[Finding]":
        """Every mistake."""
        return PartList(Finding, self._document["errors"])

    @property
    def size(self) -> "Optional[CheckSize]":
        """null when it is not valid."""
        value = self._document["size"]
        return None if value is None else CheckSize(value)


class JobError(Part):
    """Why a job failed."""

    __slots__ = ()

    @property
    def code(self) -> "str":
        """Code."""
        return cast("str", self._document["code"])

    @property
    def detail(self) -> "str":
        """A sentence."""
        return cast("str", self._document["detail"])


class Link(Part):
    """A resource that belongs to this one."""

    __slots__ = ()

    @property
    def rel(self) -> "str":
        """What it is to this one: self, request, result, table, next."""
        return cast("str", self._document["rel"])

    @property
    def href(self) -> "str":
        """Its address."""
        return cast("str", self._document["href"])

    @property
    def type(self) -> "str":
        """Its media type."""
        return cast("str", self._document["type"])


class Job(Part):
    """Status of a job."""

    __slots__ = ()

    @property
    def id(self) -> "str":
        """Name of the job (UUID version 7)."""
        return cast("str", self._document["id"])

    @property
    def status(self) -> "str":
        """Where it stands; one of accepted, running, successful, failed, dismissed."""
        return cast("str", self._document["status"])

    @property
    def progress(self) -> "int":
        """100 at its end, else 0: the length of a path is not known before its end [percent]."""
        return cast("int", self._document["progress"])

    @property
    def message(self) -> "str":
        """Where it stands, as a sentence."""
        return cast("str", self._document["message"])

    @property
    def title(self) -> "str":
        """Title of its model."""
        return cast("str", self._document["title"])

    @property
    def analysis(self) -> "str":
        """Type of its analysis; empty when not known."""
        return cast("str", self._document["analysis"])

    @property
    def attempt(self) -> "int":
        """How often it was begun [dimensionless]."""
        return cast("int", self._document["attempt"])

    @property
    def created(self) -> "str":
        """When it was handed in."""
        return cast("str", self._document["created"])

    @property
    def started(self) -> "Optional[str]":
        """When it was begun."""
        return cast("Optional[str]", self._document["started"])

    @property
    def finished(self) -> "Optional[str]":
        """When it ended."""
        return cast("Optional[str]", self._document["finished"])

    @property
    def label(self) -> "Optional[str]":
        """Only where the client gave one; None when absent."""
        return cast("Optional[str]", self._document.get("label"))

    @property
    def metadata(self) -> "Optional[Dict[str, str]]":
        """Only where the client gave some; None when absent."""
        return cast("Optional[Dict[str, str]]", self._document.get("metadata"))

    @property
    def callback(self) -> "Optional[str]":
        """Only where the client gave one; None when absent."""
        return cast("Optional[str]", self._document.get("callback"))

    @property
    def error(self) -> "Optional[JobError]":
        """Only when it failed; None when absent."""
        value = self._document.get("error")
        return None if value is None else JobError(value)

    @property
    def links(self) -> "PartList[Link]":
        """Related resources."""
        return PartList(Link, self._document["links"])


class JobList(Part):
    """A page of jobs."""

    __slots__ = ()

    @property
    def jobs(self) -> "PartList[Job]":
        """Newest first."""
        return PartList(Job, self._document["jobs"])

    @property
    def links(self) -> "PartList[Link]":
        """next: the next page."""
        return PartList(Link, self._document["links"])


class SweepCounts(Part):
    """Rows by what became of them."""

    __slots__ = ()

    @property
    def successful(self) -> "int":
        """Rows without an error [dimensionless]."""
        return cast("int", self._document["successful"])

    @property
    def failed(self) -> "int":
        """Rows with an error [dimensionless]."""
        return cast("int", self._document["failed"])

    @property
    def reused(self) -> "int":
        """Rows that were computed before [dimensionless]."""
        return cast("int", self._document["reused"])

    @property
    def remaining(self) -> "int":
        """Points without a row [dimensionless]."""
        return cast("int", self._document["remaining"])


class Sweep(Part):
    """Status of a sweep."""

    __slots__ = ()

    @property
    def id(self) -> "str":
        """Name of the sweep (UUID version 7)."""
        return cast("str", self._document["id"])

    @property
    def status(self) -> "str":
        """Where it stands; one of accepted, running, successful, failed, dismissed."""
        return cast("str", self._document["status"])

    @property
    def progress(self) -> "int":
        """How much is done [percent]."""
        return cast("int", self._document["progress"])

    @property
    def message(self) -> "str":
        """Where it stands, as a sentence."""
        return cast("str", self._document["message"])

    @property
    def title(self) -> "str":
        """Title of its model."""
        return cast("str", self._document["title"])

    @property
    def analysis(self) -> "str":
        """Type of its analysis, whatever its parameters make of it; empty when not known."""
        return cast("str", self._document["analysis"])

    @property
    def points(self) -> "int":
        """Points of the design [dimensionless]."""
        return cast("int", self._document["points"])

    @property
    def counts(self) -> "SweepCounts":
        """Rows by what became of them."""
        return SweepCounts(self._document["counts"])

    @property
    def created(self) -> "str":
        """When it was handed in."""
        return cast("str", self._document["created"])

    @property
    def started(self) -> "Optional[str]":
        """When it was begun."""
        return cast("Optional[str]", self._document["started"])

    @property
    def finished(self) -> "Optional[str]":
        """When it ended."""
        return cast("Optional[str]", self._document["finished"])

    @property
    def label(self) -> "Optional[str]":
        """Only where the client gave one; None when absent."""
        return cast("Optional[str]", self._document.get("label"))

    @property
    def metadata(self) -> "Optional[Dict[str, str]]":
        """Only where the client gave some; None when absent."""
        return cast("Optional[Dict[str, str]]", self._document.get("metadata"))

    @property
    def callback(self) -> "Optional[str]":
        """Only where the client gave one; None when absent."""
        return cast("Optional[str]", self._document.get("callback"))

    @property
    def links(self) -> "PartList[Link]":
        """Related resources."""
        return PartList(Link, self._document["links"])


class SweepList(Part):
    """A page of sweeps."""

    __slots__ = ()

    @property
    def sweeps(self) -> "PartList[Sweep]":
        """Newest first."""
        return PartList(Sweep, self._document["sweeps"])

    @property
    def links(self) -> "PartList[Link]":
        """next: the next page."""
        return PartList(Link, self._document["links"])


class Limits(Part):
    """Every number that bounds the service."""

    __slots__ = ()

    @property
    def body_bytes(self) -> "float":
        """Largest body of a request [bytes]."""
        return cast("float", self._document["body_bytes"])

    @property
    def head_bytes(self) -> "float":
        """Largest head of a request [bytes]."""
        return cast("float", self._document["head_bytes"])

    @property
    def header_count(self) -> "float":
        """Headers of a request [dimensionless]."""
        return cast("float", self._document["header_count"])

    @property
    def target_bytes(self) -> "float":
        """Longest path with its query [bytes]."""
        return cast("float", self._document["target_bytes"])

    @property
    def buffered_bytes(self) -> "float":
        """Of all requests that are being received [bytes]."""
        return cast("float", self._document["buffered_bytes"])

    @property
    def json_depth(self) -> "float":
        """Nesting of a document [dimensionless]."""
        return cast("float", self._document["json_depth"])

    @property
    def json_values(self) -> "float":
        """Values in a document [dimensionless]."""
        return cast("float", self._document["json_values"])

    @property
    def nodes(self) -> "float":
        """Nodes of a model [dimensionless]."""
        return cast("float", self._document["nodes"])

    @property
    def members(self) -> "float":
        """Members of a model [dimensionless]."""
        return cast("float", self._document["members"])

    @property
    def elements(self) -> "float":
        """Elements of a mesh [dimensionless]."""
        return cast("float", self._document["elements"])

    @property
    def order(self) -> "float":
        """Polynomial order of elements [dimensionless]."""
        return cast("float", self._document["order"])

    @property
    def steps(self) -> "float":
        """Largest count of a stop rule [dimensionless]."""
        return cast("float", self._document["steps"])

    @property
    def sweep_points(self) -> "float":
        """Points of a sweep [dimensionless]."""
        return cast("float", self._document["sweep_points"])

    @property
    def sweep_parameters(self) -> "float":
        """Parameters of a sweep [dimensionless]."""
        return cast("float", self._document["sweep_parameters"])

    @property
    def sweep_targets(self) -> "float":
        """Targets of a parameter [dimensionless]."""
        return cast("float", self._document["sweep_targets"])

    @property
    def sweep_outputs(self) -> "float":
        """Outputs of a sweep [dimensionless]."""
        return cast("float", self._document["sweep_outputs"])

    @property
    def sweeps(self) -> "float":
        """Sweeps that are not done [dimensionless]."""
        return cast("float", self._document["sweeps"])

    @property
    def table_rows(self) -> "float":
        """Rows of a table in one response [dimensionless]."""
        return cast("float", self._document["table_rows"])

    @property
    def label_characters(self) -> "float":
        """Characters of a label [dimensionless]."""
        return cast("float", self._document["label_characters"])

    @property
    def metadata_members(self) -> "float":
        """Members of metadata [dimensionless]."""
        return cast("float", self._document["metadata_members"])

    @property
    def metadata_name_characters(self) -> "float":
        """Characters of a name in metadata [dimensionless]."""
        return cast("float", self._document["metadata_name_characters"])

    @property
    def metadata_value_characters(self) -> "float":
        """Characters of a text in metadata [dimensionless]."""
        return cast("float", self._document["metadata_value_characters"])

    @property
    def callback_characters(self) -> "float":
        """Characters of a callback [dimensionless]."""
        return cast("float", self._document["callback_characters"])

    @property
    def buckling_modes(self) -> "float":
        """Modes of a buckling analysis [dimensionless]."""
        return cast("float", self._document["buckling_modes"])

    @property
    def monitors(self) -> "float":
        """Monitors of a model [dimensionless]."""
        return cast("float", self._document["monitors"])

    @property
    def state_points(self) -> "float":
        """Members times points_per_member [dimensionless]."""
        return cast("float", self._document["state_points"])

    @property
    def connections(self) -> "float":
        """Connections at a time [dimensionless]."""
        return cast("float", self._document["connections"])

    @property
    def streams(self) -> "float":
        """Streams of events at a time [dimensionless]."""
        return cast("float", self._document["streams"])

    @property
    def queue(self) -> "float":
        """Jobs that wait [dimensionless]."""
        return cast("float", self._document["queue"])

    @property
    def quota_jobs_waiting(self) -> "float":
        """Jobs of one owner that wait; 0: any number [dimensionless]."""
        return cast("float", self._document["quota_jobs_waiting"])

    @property
    def quota_points_waiting(self) -> "float":
        """Points of one owner's sweeps without a row; 0: any number [dimensionless]."""
        return cast("float", self._document["quota_points_waiting"])

    @property
    def quota_points_per_hour(self) -> "float":
        """Points of sweeps that one owner may hand in or try again within an hour; 0: any number
        [dimensionless].
        """
        return cast("float", self._document["quota_points_per_hour"])

    @property
    def quota_bytes_kept(self) -> "float":
        """Requests, results and rows of one owner that are kept; 0: any size [bytes]."""
        return cast("float", self._document["quota_bytes_kept"])

    @property
    def workers(self) -> "float":
        """Analyses at a time [dimensionless]."""
        return cast("float", self._document["workers"])

    @property
    def max_run_s(self) -> "float":
        """Of one analysis; beyond it the code is time_limit [seconds]."""
        return cast("float", self._document["max_run_s"])

    @property
    def max_job_memory_bytes(self) -> "float":
        """Of one analysis; beyond it the code is memory_limit [bytes]."""
        return cast("float", self._document["max_job_memory_bytes"])

    @property
    def max_crashes(self) -> "float":
        """Deaths of the process during a job before it has failed [dimensionless]."""
        return cast("float", self._document["max_crashes"])

    @property
    def lease_s(self) -> "float":
        """How long a worker holds a job without news [seconds]."""
        return cast("float", self._document["lease_s"])

    @property
    def default_wait_s(self) -> "float":
        """How long POST /v1/jobs waits for a result [seconds]."""
        return cast("float", self._document["default_wait_s"])

    @property
    def longest_wait_s(self) -> "float":
        """Longest wait that Prefer may ask for [seconds]."""
        return cast("float", self._document["longest_wait_s"])

    @property
    def keep_jobs_s(self) -> "float":
        """How long jobs are kept after their end; 0: for ever [seconds]."""
        return cast("float", self._document["keep_jobs_s"])

    @property
    def keep_keys_s(self) -> "float":
        """How long an idempotency key is known [seconds]."""
        return cast("float", self._document["keep_keys_s"])


class JobProgressEvent(Part):
    """Data of a progress event of a job."""

    __slots__ = ()

    @property
    def branch(self) -> "int":
        """Branch that is followed [dimensionless]."""
        return cast("int", self._document["branch"])

    @property
    def step(self) -> "int":
        """Step along it [dimensionless]."""
        return cast("int", self._document["step"])

    @property
    def load_factor(self) -> "float":
        """Load factor there [dimensionless (times the proportional actions)]."""
        return cast("float", self._document["load_factor"])

    @property
    def negative_eigenvalues(self) -> "int":
        """Negative eigenvalues there; -1: not counted [dimensionless]."""
        return cast("int", self._document["negative_eigenvalues"])


class PathPointsEventMonitorsItem(Part):
    """."""

    __slots__ = ()

    @property
    def id(self) -> "str":
        """The monitor."""
        return cast("str", self._document["id"])

    @property
    def values(self) -> "List[float]":
        """Its values [length (u, v, x, y) or rad (rotation)]."""
        return cast("List[float]", self._document["values"])


class PathPointsEvent(Part):
    """Data of a points event: points of the path that were traced, column by column."""

    __slots__ = ()

    @property
    def branch(self) -> "List[int]":
        """Index of the branch in branches [dimensionless]."""
        return cast("List[int]", self._document["branch"])

    @property
    def step(self) -> "List[int]":
        """Step along the branch; where one is left out so are points [dimensionless]."""
        return cast("List[int]", self._document["step"])

    @property
    def load_factor(self) -> "List[float]":
        """Load factors [dimensionless (times the proportional actions)]."""
        return cast("List[float]", self._document["load_factor"])

    @property
    def arc_length(self) -> "List[float]":
        """Arc length of the path up to the point [dimensionless]."""
        return cast("List[float]", self._document["arc_length"])

    @property
    def negative_eigenvalues(self) -> "List[int]":
        """Negative eigenvalues: 0 is stable; -1: not counted [dimensionless]."""
        return cast("List[int]", self._document["negative_eigenvalues"])

    @property
    def monitors(self) -> "PartList[PathPointsEventMonitorsItem]":
        """One for each monitor of the model, the first 100."""
        return PartList(PathPointsEventMonitorsItem, self._document["monitors"])


class CriticalPointEvent(Part):
    """Data of a critical_point event."""

    __slots__ = ()

    @property
    def branch(self) -> "int":
        """Index of the branch in branches [dimensionless]."""
        return cast("int", self._document["branch"])

    @property
    def type(self) -> "str":
        """Kind of the point; one of bifurcation, limit_max, limit_min, broken_bifurcation."""
        return cast("str", self._document["type"])

    @property
    def load_factor(self) -> "float":
        """Load factor there [dimensionless (times the proportional actions)]."""
        return cast("float", self._document["load_factor"])

    @property
    def arc_length(self) -> "float":
        """Arc length of the path up to the point [dimensionless]."""
        return cast("float", self._document["arc_length"])

    @property
    def negative_before(self) -> "int":
        """Negative eigenvalues before it; -1: not counted [dimensionless]."""
        return cast("int", self._document["negative_before"])

    @property
    def negative_after(self) -> "int":
        """Negative eigenvalues after it; -1: not counted [dimensionless]."""
        return cast("int", self._document["negative_after"])

    @property
    def error_estimate(self) -> "Optional[float]":
        """Estimated relative error of the load factor; null when none was made [dimensionless]."""
        return cast("Optional[float]", self._document["error_estimate"])

    @property
    def final(self) -> "bool":
        """false: from the path's own mesh while it runs; true: as the result has it."""
        return cast("bool", self._document["final"])


class SweepProgressEvent(Part):
    """Data of a progress event of a sweep."""

    __slots__ = ()

    @property
    def points(self) -> "int":
        """Points of the design [dimensionless]."""
        return cast("int", self._document["points"])

    @property
    def successful(self) -> "int":
        """Rows without an error [dimensionless]."""
        return cast("int", self._document["successful"])

    @property
    def failed(self) -> "int":
        """Rows with an error [dimensionless]."""
        return cast("int", self._document["failed"])

    @property
    def reused(self) -> "int":
        """Rows that were computed before [dimensionless]."""
        return cast("int", self._document["reused"])

    @property
    def remaining(self) -> "int":
        """Points without a row [dimensionless]."""
        return cast("int", self._document["remaining"])
