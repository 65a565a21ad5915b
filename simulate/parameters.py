"""Places in the flat arrays that hold a vessel and a programme for the compiled kernel.

Places are integers; choices that stand in arrays of floating-point numbers are floats.
"""

from __future__ import annotations

from types import ModuleType
from typing import NamedTuple


def _as_module(places: NamedTuple) -> ModuleType:
    """The fields as a module: numba takes an attribute of a module as a constant.

    A tuple would be built anew at each use, and an array indexed by the member of an enumeration through a call.
    """
    module = ModuleType(type(places).__name__.strip("_"))
    module.__dict__.update(places._asdict())
    return module


class _States(NamedTuple):
    """State vector; the first ten are those of a trajectory."""

    X: int = 0
    Y: int = 1
    PSI: int = 2
    U: int = 3
    V: int = 4
    R: int = 5
    PHI: int = 6
    P: int = 7
    DELTA: int = 8
    N: int = 9
    INTEGRAL: int = 10  # of an autopilot's error
    SPARE: int = 11  # makes the vector a multiple of four, which the processor adds four at a time


State = _as_module(_States())


class _Nodes(NamedTuple):
    """Variables of the hull terms; products of them follow from NODES on."""

    V: int = 0
    BETA: int = 1
    R: int = 2
    P: int = 3
    PHI: int = 4
    DU: int = 5
    SURGE: int = 6
    DELTA: int = 7
    C: int = 8
    THRUST: int = 9
    ETA: int = 10
    ONE: int = 11


Node = _as_module(_Nodes())


class _Shapes(NamedTuple):
    """Integers that are the same for all draws: sizes and choices of model."""

    APPROACH_SCALED: int = 0  # hull forces are scaled by U0 instead of U
    NEEDS_BETA: int = 1
    PRODUCTS: int = 2
    X_END: int = 3  # terms of X end here, those of Y begin
    Y_END: int = 4
    N_END: int = 5
    K_END: int = 6
    ROLL: int = 7
    THRUST: int = 8
    WAKE: int = 9
    TABLE: int = 10  # rows (J, KT, slope) of the open-water diagram begin here in the tables
    TABLE_ROWS: int = 11
    RUDDER: int = 12
    SWITCH_AT_PROPELLER: int = 13
    CROSS_FLOW: int = 14
    STATIONS: int = 15
    TORQUE: int = 16
    ASTERN: int = 17
    NEEDS_DRIFT: int = 18
    BETA_IS_TANGENT: int = 19


Shape = _as_module(_Shapes())


class _Thrusts(NamedTuple):
    """Thrust models."""

    NONE: int = 0
    PARABOLA: int = 1
    POLYNOMIAL: int = 2
    TABLE: int = 3
    SURFACE: int = 4


Thrust = _as_module(_Thrusts())


class _Wakes(NamedTuple):
    """Wake models, in the order of :data:`towtank.simulate.propeller.WAKES`."""

    CONSTANT: int = 0
    C1C2: int = 1
    EXPONENTIAL: int = 2
    SWAY_AND_YAW: int = 3


Wake = _as_module(_Wakes())


class _Inflows(NamedTuple):
    """Rudder models."""

    NONE: int = 0
    MMG: int = 1
    SON_NOMOTO: int = 2


Inflow = _as_module(_Inflows())


class _Parameters(NamedTuple):
    """Numbers of one draw, SI; the coefficients of the hull terms follow."""

    LENGTH: int = 0
    SPEED: int = 1  # approach speed
    ORIGIN: int = 2  # reference point of the hull terms forward of midship, m
    MASS_U: int = 3  # inverse of the mass matrix
    MASS_V_V: int = 4
    MASS_V_R: int = 5
    MASS_V_P: int = 6
    MASS_R_V: int = 7
    MASS_R_R: int = 8
    MASS_R_P: int = 9
    MASS_P_V: int = 10
    MASS_P_R: int = 11
    MASS_P_P: int = 12
    X_VR: int = 13  # forces of inertia over products of velocities
    X_RR: int = 14
    X_PR: int = 15
    Y_UR: int = 16
    Y_RR: int = 17
    N_UV: int = 18
    N_UR: int = 19
    K_UR: int = 20
    K_PHI: int = 21  # righting moment over the heel
    X_CONSTANT: int = 22
    PROPELLER_MASS: int = 23  # mass of the ship, which a thrust surface is divided by
    THRUST_UNIT: int = 24  # rho D^2 times the number of propellers
    DIAMETER: int = 25
    ONE_MINUS_T: int = 26
    WP0: int = 27
    XP: int = 28  # m
    C1: int = 29
    C2_POSITIVE: int = 30
    C2_NEGATIVE: int = 31
    TAU: int = 32
    CPV: int = 33
    CPR: int = 34
    KT0: int = 35
    KT1: int = 36
    KT2: int = 37
    KT3: int = 38
    KT4: int = 39
    KT_ASTERN: int = 40
    TUU: int = 41
    TUN: int = 42
    TNN: int = 43
    CUN: int = 44
    CNN: int = 45
    TORQUE_UNIT: int = 46  # rho D^3
    KQ0: int = 47
    KQ1: int = 48
    KQ2: int = 49
    TORQUE: int = 50  # of the approach, kept by an engine of constant torque
    SHAFT: int = 51  # 2 pi times the inertia of the shaft
    RATE_LAG: int = 52
    RUDDER_FORCE: int = 53  # 0.5 rho area f_alpha
    JET: int = 54  # 8 / (rho pi D^2) over the number of propellers
    EPS: int = 55
    KAPPA: int = 56
    ETA: int = 57
    GAMMA_POSITIVE: int = 58
    GAMMA_NEGATIVE: int = 59
    RUDDER_LEVER: int = 60  # lR in m
    ONE_MINUS_TR: int = 61
    ONE_PLUS_AH: int = 62
    YAW_LEVER: int = 63  # xR + aH xH in m
    ROLL_LEVER: int = 64  # zR (1 + aH) in m
    CR_R: int = 65
    CR_RRR: int = 66
    CR_RRV: int = 67
    GEAR_RATE: int = 68
    GEAR_LIMIT: int = 69
    GEAR_LAG: int = 70
    GEAR_BAND: int = 71


Parameter = _as_module(_Parameters())


class _Controls(NamedTuple):
    """What steers the ship at this moment."""

    KIND: int = 0
    TARGET: int = 1
    PROPORTIONAL: int = 2
    DERIVATIVE: int = 3
    INTEGRAL: int = 4
    SLEW: int = 5  # rudder rate while it runs at a known rate, rad/s
    ENGINE: int = 6
    RATE: int = 7  # ordered propeller rate, or its ramp


Control = _as_module(_Controls())


class _Orders(NamedTuple):
    """Orders to the rudder."""

    ANGLE: float = 0.0
    COURSE: float = 1.0
    YAW_RATE: float = 2.0
    SCHEDULE: float = 3.0


Order = _as_module(_Orders())


class _Drives(NamedTuple):
    """What the propeller rate does."""

    CONSTANT: float = 0.0
    LAGGED: float = 1.0
    TORQUE: float = 2.0
    RAMP: float = 3.0


Drive = _as_module(_Drives())


class _PhaseColumns(NamedTuple):
    """Columns of the table of phases."""

    KIND: int = 0
    TARGET: int = 1
    PROPORTIONAL: int = 2
    DERIVATIVE: int = 3
    INTEGRAL: int = 4
    RATE: int = 5  # ordered propeller rate; NaN keeps the order that stands
    RATE_IS_FACTOR: int = 6  # the rate is a multiple of that of the approach
    EXECUTE: int = 7  # 1: headings count from here
    START_EVENT: int = 8  # row of the events, or -1
    END: int = 9  # condition
    END_VALUE: int = 10
    END_SIGN: int = 11
    END_EVENT: int = 12
    DURATION: int = 13  # longest, s
    DURATION_ENDS: int = 14  # 1: the phase ends then; 0: the manoeuvre is not completed


Phase = _as_module(_PhaseColumns())


class _WatchColumns(NamedTuple):
    """Columns of the table of watched events."""

    CONDITION: int = 0
    VALUE: int = 1
    SIGN: int = 2
    PHASE: int = 3  # phase in which it is watched, -1: all
    EVENT: int = 4


Watch = _as_module(_WatchColumns())


class _Conditions(NamedTuple):
    """Events: each is the first zero of a function that rises through it."""

    NONE: float = 0.0
    TURNED: float = 1.0  # sign (psi - psi at execute) - value
    YAW_RATE: float = 2.0  # -sign (r - value)
    SURGE: float = 3.0  # sign (u - value times u at execute)
    ADVANCE_RATE: float = 4.0  # -sign dx/dt, along the course at execute
    TRANSFER_RATE: float = 5.0  # -sign dy/dt
    STEADY: float = 6.0  # value less the largest scaled acceleration, at the end of a step
    LATERAL: float = 7.0  # sign (y - y at execute) - value
    ROLL_RATE: float = 8.0  # sign (p - value)


Condition = _as_module(_Conditions())


class _Settings(NamedTuple):
    """Numbers that steer the integration."""

    TOLERANCE: int = 0
    MAX_STEPS: int = 1
    INTERVAL: int = 2  # of the samples, s; 0 takes none
    MAX_STEP: int = 3  # s


Setting = _as_module(_Settings())


class _Statuses(NamedTuple):
    """How a draw ended."""

    COMPLETED: int = 0
    DIVERGED: int = 1
    REVERSED: int = 2
    COLLAPSED: int = 3
    TOO_MANY_STEPS: int = 4
    NOT_COMPLETED: int = 5
    TRACK_FULL: int = 6


Status = _as_module(_Statuses())


# numba takes the length of an array from a plain integer only
STATES = len(_States._fields)
NODES = len(_Nodes._fields)
SHAPES = len(_Shapes._fields)
COEFFICIENTS = len(_Parameters._fields)
"""Place of the first coefficient of the hull terms, after the numbers of :class:`Parameter`."""
CONTROLS = len(_Controls._fields)
PHASE_COLUMNS = len(_PhaseColumns._fields)
WATCH_COLUMNS = len(_WatchColumns._fields)
SETTINGS = len(_Settings._fields)
