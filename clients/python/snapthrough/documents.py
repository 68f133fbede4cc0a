"""Types of the documents that are sent: requests and sweeps, as dictionaries.

Made by clients/python/generate.py from the OpenAPI document; change that instead.
"""
from typing import Any, Literal, Mapping, Optional, Sequence, TypedDict, Union

__all__ = ["Analysis", "AnalysisBranches", "AnalysisControlWithDisplacement", "AnalysisTemplate", "AnnotatedRequest",
           "AnnotatedSweep", "ArcCurve", "Callback", "Curve", "Direction", "Discretization",
           "DiscretizationWithAccuracy", "DiscretizationWithElements", "DistributedLoad", "Foundation",
           "FoundationWithDirection", "FoundationWithSide", "Id", "Imperfection", "InitialStrainLoad", "Label",
           "LineCurve", "Load", "Location", "LocationWithMember", "LocationWithNode", "Member", "MemberRelease",
           "Metadata", "ModeImperfection", "Model", "ModelTemplate", "Monitor", "Node", "Output",
           "OutputStatesWithAtLoadFactors", "OutputStatesWithEvery", "ParabolaCurve", "Pattern", "PointLoad",
           "PointsCurve", "PointsImperfection", "PressureLoad", "Range", "Reaction", "Request", "Section",
           "SectionWithE", "SectionWithEA", "Side", "SineCurve", "SineImperfection", "Spring", "StartShape",
           "StartState", "Step", "Stop", "StopMonitor", "Support", "SupportPlain", "SupportPlainDisplacement",
           "SupportWithDisplacement", "SupportWithDisplacementDisplacement", "SweepDesign",
           "SweepDesignWithLatinHypercube", "SweepDesignWithLatinHypercubeLatinHypercube", "SweepDocument",
           "SweepParameter", "SweepParameterWithRange", "SweepParameterWithRangeRange", "SweepParameterWithValues",
           "SweepTarget", "Units"]


#: Labels of units by quantity, such as {"length": "m"}; echoed, never interpreted
Units = Mapping[str, str]


#: A name, unique within its list: 1 to 200 characters, none of them a control character
Id = str


class Node(TypedDict):
    """A point that members join.

    id: Name of the node.
    x: Global x, to the right [length].
    y: Global y, up [length].
    """
    id: Id
    x: float
    y: float


class _SectionWithEARequired(TypedDict):
    id: Id
    EA: float
    EI: float


class SectionWithEA(_SectionWithEARequired, total=False):
    """By stiffness.

    id: Name of the section.
    EA: Axial stiffness [force].
    EI: Bending stiffness [force times length squared].
    GA (optional): Shear stiffness with the shear area; without it the section does not shear [force].
    """
    GA: float


class _SectionWithERequired(TypedDict):
    id: Id
    E: float
    A: float
    I: float


class SectionWithE(_SectionWithERequired, total=False):
    """By material and shape: EA = E A, EI = E I, GA = shear_area E / (2 (1 + nu)).

    id: Name of the section.
    E: Young's modulus [force per length squared].
    A: Area [length squared].
    I: Second moment of area [length to the fourth power].
    nu (optional): Poisson's ratio; needed with shear_area [dimensionless].
    shear_area (optional): Area that shears; without it the section does not shear [length squared].
    """
    nu: float
    shear_area: float


#: Stiffness of a member: by stiffness, or by material and shape
Section = Union[SectionWithEA, SectionWithE]


class LineCurve(TypedDict):
    """A straight line.

    type: A straight line.
    """
    type: Literal["line"]


class ArcCurve(TypedDict):
    """A circular arc.

    type: A circular arc.
    sweep_degrees: Angle that the axis turns by from start to end, positive to the left, not 0 [degrees].
    """
    type: Literal["arc"]
    sweep_degrees: float


class ParabolaCurve(TypedDict):
    """A parabola over the chord.

    type: A parabola over the chord.
    rise: Rise along the left normal of the chord [length].
    """
    type: Literal["parabola"]
    rise: float


class _SineCurveRequired(TypedDict):
    type: Literal["sine"]
    rise: float


class SineCurve(_SineCurveRequired, total=False):
    """Half waves of a sine over the chord.

    type: Half waves of a sine over the chord.
    rise: Rise along the left normal of the chord [length].
    half_waves (optional): Number of half waves [dimensionless]; default 1.
    """
    half_waves: int


class PointsCurve(TypedDict):
    """A smooth (C2) cubic spline.

    type: A smooth spline from start to end.
    points: Interior points [x, y] in order.
    """
    type: Literal["points"]
    points: Sequence[Sequence[float]]


#: Axis of a member from its start to its end
Curve = Union[LineCurve, ArcCurve, ParabolaCurve, SineCurve, PointsCurve]


class MemberRelease(TypedDict, total=False):
    """Internal hinges.

    start (optional): Released at the start: rotation makes a hinge; default [].
    end (optional): Released at the end: rotation makes a hinge; default [].
    """
    start: Sequence[Literal["rotation"]]
    end: Sequence[Literal["rotation"]]


class _MemberRequired(TypedDict):
    id: Id
    start: Id
    end: Id
    section: Id


class Member(_MemberRequired, total=False):
    """A beam between two nodes.

    id: Name of the member.
    start: Id of the node that s is counted from.
    end: Id of the other node.
    section: Id of the section.
    curve (optional): Axis of the member; a straight line when left out.
    release (optional): Internal hinges.
    """
    curve: Curve
    release: MemberRelease


#: proportional: multiplied by the load factor; constant: acts in full before the load factor grows
Pattern = Literal["proportional", "constant"]


class SupportPlainDisplacement(TypedDict, total=False):
    """Prescribed values of fixed components.

    x (optional): Prescribed displacement along the support's x [length]; default 0.
    y (optional): Prescribed displacement along the support's y [length]; default 0.
    rotation (optional): Prescribed rotation, counter-clockwise [radians]; default 0.
    pattern (optional): What multiplies the displacement; default "proportional".
    """
    x: float
    y: float
    rotation: float
    pattern: Pattern


class _SupportPlainRequired(TypedDict):
    node: Id
    fixed: Sequence[Literal["x", "y", "rotation"]]


class SupportPlain(_SupportPlainRequired, total=False):
    """A support; a pattern of its displacement stands in the displacement.

    node: Id of the node that is held; one support a node.
    fixed: Components that are held, in the support's own axes.
    angle_degrees (optional): Angle of the support's x axis to the global one, counter-clockwise [degrees]; default
        0.
    displacement (optional): Prescribed values of fixed components.
    """
    angle_degrees: float
    displacement: SupportPlainDisplacement


class SupportWithDisplacementDisplacement(TypedDict, total=False):
    """Prescribed values of fixed components.

    x (optional): Prescribed displacement along the support's x [length]; default 0.
    y (optional): Prescribed displacement along the support's y [length]; default 0.
    rotation (optional): Prescribed rotation, counter-clockwise [radians]; default 0.
    """
    x: float
    y: float
    rotation: float


class _SupportWithDisplacementRequired(TypedDict):
    node: Id
    fixed: Sequence[Literal["x", "y", "rotation"]]
    displacement: SupportWithDisplacementDisplacement
    pattern: Pattern


class SupportWithDisplacement(_SupportWithDisplacementRequired, total=False):
    """A support with the pattern beside its displacement.

    node: Id of the node that is held; one support a node.
    fixed: Components that are held, in the support's own axes.
    angle_degrees (optional): Angle of the support's x axis to the global one, counter-clockwise [degrees]; default
        0.
    displacement: Prescribed values of fixed components.
    pattern: What multiplies the displacement; default "proportional".
    """
    angle_degrees: float


#: A node that is held
Support = Union[SupportPlain, SupportWithDisplacement]


class LocationWithNode(TypedDict):
    """A node.

    node: Id of the node.
    """
    node: Id


class LocationWithMember(TypedDict):
    """A point of a member, exact for any mesh.

    member: Id of the member.
    fraction: How far along the member, from its start [fraction of the member's undeformed length].
    """
    member: Id
    fraction: float


#: A place on the structure: a node, or any point of a member
Location = Union[LocationWithNode, LocationWithMember]


#: A direction [dx, dy] in global axes; only its direction counts [dimensionless]
Direction = Sequence[float]


#: bilateral: pushes and pulls; compression_only: pushes only; tension_only: pulls only
Reaction = Literal["bilateral", "compression_only", "tension_only"]


class _SpringRequired(TypedDict):
    id: Id
    at: Location
    direction: Union[Direction, Literal["rotation"]]
    stiffness: float


class Spring(_SpringRequired, total=False):
    """A discrete elastic spring to the ground.

    id: Name of the spring.
    at: Where it is attached.
    direction: Along a direction that points into the medium, or rotation for a rotational spring.
    stiffness: Stiffness [force per length; force times length per radian for a rotational one].
    reaction (optional): What it can do; default "bilateral".
    gap (optional): Free travel before a one-sided spring reacts; needs a one-sided reaction [length; radians for a
        rotational one]; default 0.
    """
    reaction: Reaction
    gap: float


#: A part [f0, f1] of a member, f0 < f1 [fraction of the member's undeformed length]
Range = Sequence[float]


#: A side of a member, looking from its start to its end; left is the side of its left normal
Side = Literal["left", "right"]


class _FoundationWithSideRequired(TypedDict):
    id: Id
    member: Id
    stiffness: float


class FoundationWithSide(_FoundationWithSideRequired, total=False):
    """Along the initial normal of the member.

    id: Name of the foundation.
    member: Id of the member that it lies along.
    stiffness: Winkler modulus K of the reaction r = K w - G w'' per undeformed length [force per length squared
        (force per length of member and length of displacement)].
    shear_stiffness (optional): Stiffness G of the shear layer (Pasternak, Filonenko-Borodich); needs a bilateral
        reaction [force]; default 0.
    reaction (optional): What it can do; default "bilateral".
    range (optional): Part of the member that it lies along [fraction of the member's undeformed length]; default
        [0, 1].
    gap (optional): Free travel before a one-sided foundation reacts; needs a one-sided reaction [length]; default
        0.
    direction (optional): Along the initial normal of the member; default "normal".
    side (optional): Where the medium lies; default "left".
    """
    shear_stiffness: float
    reaction: Reaction
    range: Range
    gap: float
    direction: Literal["normal"]
    side: Side


class _FoundationWithDirectionRequired(TypedDict):
    id: Id
    member: Id
    stiffness: float
    direction: Direction


class FoundationWithDirection(_FoundationWithDirectionRequired, total=False):
    """Along a fixed direction.

    id: Name of the foundation.
    member: Id of the member that it lies along.
    stiffness: Winkler modulus K of the reaction r = K w - G w'' per undeformed length [force per length squared
        (force per length of member and length of displacement)].
    shear_stiffness (optional): Stiffness G of the shear layer (Pasternak, Filonenko-Borodich); needs a bilateral
        reaction [force]; default 0.
    reaction (optional): What it can do; default "bilateral".
    range (optional): Part of the member that it lies along [fraction of the member's undeformed length]; default
        [0, 1].
    gap (optional): Free travel before a one-sided foundation reacts; needs a one-sided reaction [length]; default
        0.
    direction: Points into the medium [dimensionless].
    """
    shear_stiffness: float
    reaction: Reaction
    range: Range
    gap: float


#: A continuous elastic base along a member
Foundation = Union[FoundationWithSide, FoundationWithDirection]


class _PointLoadRequired(TypedDict):
    type: Literal["point"]
    at: Location
    force: Sequence[float]


class PointLoad(_PointLoadRequired, total=False):
    """A dead force, a moment, or both, at a point.

    type: At a point.
    at: Where it acts.
    force: Force [fx, fy] in global axes [force].
    moment (optional): Moment, counter-clockwise [force times length]; default 0.
    pattern (optional): What multiplies the load; default "proportional".
    """
    moment: float
    pattern: Pattern


class _DistributedLoadRequired(TypedDict):
    type: Literal["distributed"]
    member: Id
    force: Sequence[float]


class DistributedLoad(_DistributedLoadRequired, total=False):
    """A dead load along a member.

    type: Along a member.
    member: Id of the member that it acts on.
    force: Load [qx, qy] in global axes [force per length].
    range (optional): Part of the member [fraction of the member's undeformed length]; default [0, 1].
    per (optional): Length that the load is counted by: of the undeformed axis, or of its projection; default
        "length".
    pattern (optional): What multiplies the load; default "proportional".
    """
    range: Range
    per: Literal["length", "horizontal", "vertical"]
    pattern: Pattern


class _PressureLoadRequired(TypedDict):
    type: Literal["pressure"]
    member: Id
    value: float


class PressureLoad(_PressureLoadRequired, total=False):
    """A pressure on the deformed line.

    type: A follower pressure.
    member: Id of the member that it acts on.
    value: Pressure, per deformed length, across the deformed axis [force per length].
    side (optional): The side that it pushes from; default "left".
    pattern (optional): What multiplies the load; default "proportional".
    """
    side: Side
    pattern: Pattern


class _InitialStrainLoadRequired(TypedDict):
    type: Literal["initial_strain"]
    member: Id


class InitialStrainLoad(_InitialStrainLoadRequired, total=False):
    """A strain without stress: temperature, shrinkage, prestress.

    type: A strain.
    member: Id of the member that it acts on.
    axial (optional): Axial strain, extension positive [dimensionless]; default 0.
    curvature (optional): Curvature, to the left positive [radians per length]; default 0.
    pattern (optional): What multiplies the load; default "proportional".
    """
    axial: float
    curvature: float
    pattern: Pattern


#: An action on the structure
Load = Union[PointLoad, DistributedLoad, PressureLoad, InitialStrainLoad]


class SineImperfection(TypedDict):
    """Half waves of a sine.

    type: Half waves of a sine.
    member: Id of the member that it acts on.
    half_waves: Number of half waves [dimensionless].
    amplitude: Largest offset along the left normal [length].
    """
    type: Literal["sine"]
    member: Id
    half_waves: int
    amplitude: float


class ModeImperfection(TypedDict):
    """A linearised buckling mode.

    type: A linearised buckling mode.
    number: Which mode; 1 is that of the lowest load [dimensionless].
    amplitude: Largest offset along the left normal [length].
    """
    type: Literal["mode"]
    number: int
    amplitude: float


class PointsImperfection(TypedDict):
    """Offsets at points, joined by a smooth spline.

    type: Offsets at points.
    member: Id of the member that it acts on.
    offsets: Pairs [fraction, offset], fractions increasing.
    """
    type: Literal["points"]
    member: Id
    offsets: Sequence[Sequence[float]]


#: A stress-free offset of the axis along its left normal; several add up
Imperfection = Union[SineImperfection, ModeImperfection, PointsImperfection]


class Monitor(TypedDict):
    """A displacement that is recorded at every step.

    id: Name of the monitor.
    at: Where.
    component: Which displacement; normal is along the initial left normal and needs a place on a member.
    """
    id: Id
    at: Location
    component: Literal["x", "y", "rotation", "normal"]


class _ModelRequired(TypedDict):
    nodes: Sequence[Node]
    sections: Sequence[Section]
    members: Sequence[Member]


class Model(_ModelRequired, total=False):
    """The structure, what holds it and what acts on it, in one consistent set of units.

    title (optional): A title, echoed in the result; default "".
    units (optional): Labels of the units.
    nodes: Points that members join; each is the end of a member.
    sections: Stiffnesses of members.
    members: Beams.
    supports (optional): Nodes that are held; supports, springs or foundations must hold the structure; default [].
    springs (optional): Discrete springs to the ground; default [].
    foundations (optional): Continuous elastic bases; default [].
    loads (optional): Actions; one must be proportional and not zero unless the analysis is static; default [].
    imperfections (optional): Stress-free offsets of the axes; default [].
    monitors (optional): Displacements that are recorded; default [].
    """
    title: str
    units: Units
    supports: Sequence[Support]
    springs: Sequence[Spring]
    foundations: Sequence[Foundation]
    loads: Sequence[Load]
    imperfections: Sequence[Imperfection]
    monitors: Sequence[Monitor]


class StartShape(TypedDict):
    """Displacements and section forces of a member, a number for each place; splines join them.

    s: Arc lengths of the places along the perfect axis, growing, from 0 to the member's length [length].
    u: Displacements along x [length].
    v: Displacements along y [length].
    rotation: Rotations [rad].
    axial_force: Axial forces [force].
    shear_force: Shear forces [force].
    bending_moment: Bending moments [force times length].
    """
    s: Sequence[float]
    u: Sequence[float]
    v: Sequence[float]
    rotation: Sequence[float]
    axial_force: Sequence[float]
    shear_force: Sequence[float]
    bending_moment: Sequence[float]


class StartState(TypedDict):
    """The fields of a state of a result (states[n]) that a path needs to begin with it.

    load_factor: Load factor of the state, at which its equilibrium is found again [dimensionless].
    members: By member id, each member of the model.
    """
    load_factor: float
    members: Mapping[str, StartShape]


class DiscretizationWithAccuracy(TypedDict, total=False):
    """The mesh is chosen, and refined until every load factor is as accurate as asked.

    accuracy (optional): Relative error wanted in every load factor [dimensionless]; default 0.001.
    """
    accuracy: float


class _DiscretizationWithElementsRequired(TypedDict):
    elements: Union[int, Mapping[str, int]]


class DiscretizationWithElements(_DiscretizationWithElementsRequired, total=False):
    """A fixed mesh.

    elements: Number of elements: on every member, or by member (all members named).
    order (optional): Polynomial order of the elements [dimensionless]; default 1.
    foundation (optional): consistent: integrated along the elements; lumped: springs at the nodes; default
        "consistent".
    """
    order: int
    foundation: Literal["consistent", "lumped"]


#: How fine the mesh is: an accuracy, or a fixed mesh
Discretization = Union[DiscretizationWithAccuracy, DiscretizationWithElements]


class AnalysisControlWithDisplacement(TypedDict):
    """The displacement of a monitor.

    displacement: Id of the monitor.
    """
    displacement: Id


class Step(TypedDict, total=False):
    """Lengths of the steps along a path; by default they are chosen and adapted.

    initial (optional): First step [fraction of the path's length scale: of the way to the first critical load].
    min (optional): Smallest step before the path counts as stuck [fraction of the path's length scale: of the way
        to the first critical load].
    max (optional): Largest step [fraction of the path's length scale: of the way to the first critical load].
    direction (optional): path: how the load factor begins to change: 1 grows, -1 falls [dimensionless]; default 1.
    """
    initial: float
    min: float
    max: float
    direction: Literal[1, -1]


class StopMonitor(TypedDict):
    """When a monitor leaves its range.

    id: Id of the monitor.
    range: [lo, hi] [that of the monitor: length or radians].
    """
    id: Id
    range: Sequence[float]


class Stop(TypedDict, total=False):
    """Where a path ends: the first rule to be met.

    limit_points (optional): After this many limit points [dimensionless].
    load_factor (optional): When the load factor leaves [lo, hi] [dimensionless].
    monitor (optional): When a monitor leaves its range.
    steps (optional): After this many steps [dimensionless].
    negative_eigenvalues (optional): At the first point of a path with more negative eigenvalues than this. Where
        neither this nor load_factor nor steps is given, a path ends with 10 more than at its start, and one more
        for each of limit_points, unless the monitor moves [dimensionless].
    """
    limit_points: int
    load_factor: Sequence[float]
    monitor: StopMonitor
    steps: int
    negative_eigenvalues: int


class AnalysisBranches(TypedDict, total=False):
    """path: which bifurcated branches are followed.

    follow (optional): primary: none; first: those of the first bifurcation; all; default "primary".
    limit (optional): At most this many branches [dimensionless].
    """
    follow: Literal["primary", "first", "all"]
    limit: int


class OutputStatesWithEvery(TypedDict):
    """At every n-th point.

    every: States are given at every so many points [dimensionless].
    """
    every: int


class OutputStatesWithAtLoadFactors(TypedDict):
    """At load factors.

    at_load_factors: Load factors at which the path is cut; those that are not reached are listed in not_reached
        [dimensionless].
    """
    at_load_factors: Sequence[float]


class Output(TypedDict, total=False):
    """What of the analysis is given back.

    states (optional): Where full states (shape, forces, reactions) are given.
    points_per_member (optional): Points along a member in states and modes; times members at most 2000000
        [dimensionless]; default 101.
    path_points (optional): At least this many points of each path, evenly along the arc, for smooth plots; without
        it the points are those of the steps [dimensionless].
    extremes (optional): Whether the largest and smallest forces and displacements of each member are given; default
        false.
    """
    states: Union[Literal["none", "critical", "all"], OutputStatesWithEvery, OutputStatesWithAtLoadFactors]
    points_per_member: int
    path_points: int
    extremes: bool


class _AnalysisRequired(TypedDict):
    type: Literal["buckling", "critical", "path", "static"]


class Analysis(_AnalysisRequired, total=False):
    """What is computed.

    type: critical: the first loss of stability on the path from the unloaded state; path: the equilibrium path;
        buckling: linearised eigenvalues about the reference load; static: equilibrium at load_factors.
    modes (optional): buckling: how many loads and modes; with reversed so many of each sign [dimensionless];
        default 1.
    reversed (optional): buckling: whether loads of the opposite actions count, too, as negative load factors; needs
        bilateral springs and foundations; default false.
    load_factors (optional): static: where equilibrium is wanted [dimensionless]; default [1].
    start (optional): path: the state that the path begins with, such as one of a branch that no path from the
        unloaded state reaches; by default the unloaded state or that of the constant actions.
    unstable (optional): static, nonlinear: what is done where the path loses stability before an asked load factor.
        refuse: the analysis ends there with the failure beyond_critical_point; follow: rows beyond a bifurcation
        are given, with their counts and a warning; default "refuse".
    geometry (optional): nonlinear: large displacements; linear: small ones, for static only; default "nonlinear".
    discretization (optional): The mesh; an accuracy of 1e-3 when left out.
    control (optional): path: what is increased from step to step.
    step (optional): path: lengths of the steps.
    stop (optional): path: where it ends.
    branches (optional): path: which bifurcated branches are followed.
    output (optional): What is given back.
    sensitivities (optional): critical, path: numbers of the model by which the load factor of each critical point
        is differentiated; default [].
    koiter (optional): critical, path: Koiter's coefficients of bifurcations; default false.
    """
    modes: int
    reversed: bool
    load_factors: Sequence[float]
    start: StartState
    unstable: Literal["refuse", "follow"]
    geometry: Literal["nonlinear", "linear"]
    discretization: Discretization
    control: Union[Literal["arc_length", "load"], AnalysisControlWithDisplacement]
    step: Step
    stop: Stop
    branches: AnalysisBranches
    output: Output
    sensitivities: Sequence[str]
    koiter: bool


class Request(TypedDict):
    """A structure and what to analyse about it. Rules of more than one field (references, mechanics) are checked
    beyond this schema; see docs/requests.md.

    model: The structure.
    analysis: What to compute.
    """
    model: Model
    analysis: Analysis


class ModelTemplate(TypedDict, total=False):
    """The structure before values are written into it: as Model, but what a parameter writes may be left out, or be
    anything.

    title (optional): A title, echoed in the result.
    units (optional): Labels of the units.
    nodes (optional): Points that members join; each is the end of a member.
    sections (optional): Stiffnesses of members.
    members (optional): Beams.
    supports (optional): Nodes that are held; supports, springs or foundations must hold the structure.
    springs (optional): Discrete springs to the ground.
    foundations (optional): Continuous elastic bases.
    loads (optional): Actions; one must be proportional and not zero unless the analysis is static.
    imperfections (optional): Stress-free offsets of the axes.
    monitors (optional): Displacements that are recorded.
    """
    title: Any
    units: Any
    nodes: Any
    sections: Any
    members: Any
    supports: Any
    springs: Any
    foundations: Any
    loads: Any
    imperfections: Any
    monitors: Any


class AnalysisTemplate(TypedDict, total=False):
    """The analysis before values are written into it: as Analysis, but what a parameter writes may be left out, or
    be anything.

    type (optional): critical: the first loss of stability on the path from the unloaded state; path: the
        equilibrium path; buckling: linearised eigenvalues about the reference load; static: equilibrium at
        load_factors.
    modes (optional): buckling: how many loads and modes.
    load_factors (optional): static: where equilibrium is wanted.
    geometry (optional): nonlinear: large displacements; linear: small ones, for static only.
    discretization (optional): The mesh; an accuracy of 1e-3 when left out.
    control (optional): path: what is increased from step to step.
    step (optional): path: lengths of the steps.
    stop (optional): path: where it ends.
    branches (optional): path: which bifurcated branches are followed.
    output (optional): What is given back.
    """
    type: Any
    modes: Any
    load_factors: Any
    geometry: Any
    discretization: Any
    control: Any
    step: Any
    stop: Any
    branches: Any
    output: Any


class _SweepTargetRequired(TypedDict):
    pointer: str


class SweepTarget(_SweepTargetRequired, total=False):
    """A place that a parameter's value is written to.

    pointer: JSON Pointer to something in /model or /analysis.
    scale (optional): The value to the power, times this, is written; needs numbers [dimensionless]; default 1.
    power (optional): Power of the value, such as 3 where EI goes with the third power of a thickness; needs numbers
        [dimensionless]; default 1.
    """
    scale: float
    power: float


class _SweepParameterWithValuesRequired(TypedDict):
    name: str
    targets: Sequence[SweepTarget]
    values: Sequence[Any]


class SweepParameterWithValues(_SweepParameterWithValuesRequired, total=False):
    """A list of values.

    name: Name of its column; not error, point or request, and not beginning with /.
    targets: Where it is written.
    values: Numbers, names, whole lists.
    label (optional): How each value is named in tables: one text a value, no two alike; for values that are objects
        or lists.
    """
    label: Sequence[str]


_SweepParameterWithRangeRangeRequired = TypedDict("_SweepParameterWithRangeRangeRequired", {"from": float, "to": float})


class SweepParameterWithRangeRange(_SweepParameterWithRangeRangeRequired, total=False):
    """Numbers from one end to the other.

    from: First value [that of the targets].
    to: Last value [that of the targets].
    count (optional): Number of values, both ends included; not in a Latin hypercube, needed elsewhere
        [dimensionless].
    spacing (optional): linear: equal differences; log: equal ratios, positive ends; default "linear".
    """
    count: int
    spacing: Literal["linear", "log"]


class SweepParameterWithRange(TypedDict):
    """A range of numbers.

    name: Name of its column; not error, point or request, and not beginning with /.
    targets: Where it is written.
    range: Numbers from one end to the other.
    """
    name: str
    targets: Sequence[SweepTarget]
    range: SweepParameterWithRangeRange


#: What varies
SweepParameter = Union[SweepParameterWithValues, SweepParameterWithRange]


class SweepDesignWithLatinHypercubeLatinHypercube(TypedDict):
    """One sample in each of equal parts of every range.

    samples: Number of samples [dimensionless].
    seed: Seed of the random numbers [dimensionless].
    """
    samples: int
    seed: int


class SweepDesignWithLatinHypercube(TypedDict):
    """A sample.

    latin_hypercube: One sample in each of equal parts of every range.
    """
    latin_hypercube: SweepDesignWithLatinHypercubeLatinHypercube


#: Which combinations of values are computed
SweepDesign = Union[Literal["grid", "zip"], SweepDesignWithLatinHypercube]


class _SweepDocumentRequired(TypedDict):
    model: Union[Model, ModelTemplate]
    analysis: Union[Analysis, AnalysisTemplate]
    parameters: Sequence[SweepParameter]
    design: SweepDesign
    outputs: Sequence[str]


class SweepDocument(_SweepDocumentRequired, total=False):
    """A request, what varies in it, and what is wanted of each point.

    model: The structure.
    analysis: The analysis.
    parameters: What varies.
    design: Which points are computed.
    follow (optional): Name of the last parameter: its critical point is followed along it.
    outputs: Columns of the table.
    """
    follow: str


#: A name that the client gives to what belongs together; has no part in what is computed
Label = str


#: Texts that the client keeps with a job or sweep; they have no part in what is computed
Metadata = Mapping[str, str]


#: Address on a host that the service allows (callback_hosts); see webhooks
Callback = str


class _AnnotatedRequestRequired(TypedDict):
    request: Request


class AnnotatedRequest(_AnnotatedRequestRequired, total=False):
    """A request with what the client notes on it; the request is stored and compared without.

    request: What to analyse.
    label (optional): Shown in the status; lists filter by it.
    metadata (optional): Shown in the status.
    callback (optional): Told when it has ended.
    """
    label: Label
    metadata: Metadata
    callback: Callback


class _AnnotatedSweepRequired(TypedDict):
    sweep: SweepDocument


class AnnotatedSweep(_AnnotatedSweepRequired, total=False):
    """A sweep with what the client notes on it; the sweep is stored and compared without.

    sweep: What to analyse.
    label (optional): Shown in the status; lists filter by it.
    metadata (optional): Shown in the status.
    callback (optional): Told when it has ended.
    """
    label: Label
    metadata: Metadata
    callback: Callback
