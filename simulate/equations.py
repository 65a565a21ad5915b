"""Right-hand side of the equations of motion: hull terms, inertia, propeller, rudder, steering gear, environment.

Home axes, origin midship, SI. The arrays are laid out in ``parameters``. The same source runs as plain Python with
``NUMBA_DISABLE_JIT=1``.
"""

from __future__ import annotations

import math

import numpy as np

from .circular import sine_and_cosine
from .compilation import compiled, compiled_for_python
from .drift import drift_angle
from .environment_forces import wave_drift_forces, wind_forces
from .environment_layout import CURRENT_X, CURRENT_Y, WAVES_AT, WIND_AT
from .parameters import COEFFICIENTS, NODES, Control, Drive, Inflow, Node, Order, Parameter, Shape, State, Thrust
from .propulsion import propeller_flow, propeller_thrust, propeller_torque
from .rudder_force import rudder_normal_force

_SLOWEST = 1e-6
"""Share of the approach speed below which non-dimensional velocities are no longer divided by the speed."""


@compiled_for_python
def derivative(
    state: np.ndarray,
    control: np.ndarray,
    shape: np.ndarray,
    products: np.ndarray,
    nodes: np.ndarray,
    p: np.ndarray,
    tables: np.ndarray,
    environment: np.ndarray,
    value: np.ndarray,
    rate: np.ndarray,
) -> None:
    """Time derivative of the state, written to `rate`; `value` is room for the variables and products."""
    psi, u, v, r = state[State.PSI], state[State.U], state[State.V], state[State.R]
    phi, roll, delta, n = state[State.PHI], state[State.P], state[State.DELTA], state[State.N]
    s, c = sine_and_cosine(psi)
    # sway and yaw of a heeled ship are in its own plane
    upright = math.cos(phi) if shape[Shape.ROLL] == 1 else 1.0
    rate[State.X] = u * c - upright * v * s + environment[CURRENT_X]
    rate[State.Y] = u * s + upright * v * c + environment[CURRENT_Y]
    rate[State.PSI] = upright * r
    rate[State.PHI] = roll

    speed = math.sqrt(u * u + v * v)
    drift = drift_angle(u, v) if shape[Shape.NEEDS_DRIFT] == 1 else 0.0
    flow = propeller_flow(shape, p, u, v, r, speed, drift)
    thrust = propeller_thrust(shape, p, tables, u, n, flow)

    hull_v = v + p[Parameter.ORIGIN] * r
    if shape[Shape.APPROACH_SCALED] == 1:
        scale = p[Parameter.SPEED]
    else:
        slowest = _SLOWEST * p[Parameter.SPEED]
        scale = max(math.sqrt(u * u + hull_v * hull_v) if p[Parameter.ORIGIN] != 0.0 else speed, slowest)
    inverse = 1.0 / scale
    value[Node.V] = hull_v * inverse
    value[Node.R] = r * inverse
    value[Node.P] = roll * inverse
    value[Node.PHI] = phi
    value[Node.DU] = (u - p[Parameter.SPEED]) * inverse
    value[Node.SURGE] = u * inverse
    value[Node.DELTA] = delta
    value[Node.ETA] = state[State.Y]
    if shape[Shape.NEEDS_BETA] == 1:
        value[Node.BETA] = -hull_v / u if shape[Shape.BETA_IS_TANGENT] == 1 else drift_angle(u, hull_v)
    if shape[Shape.THRUST] == Thrust.SURFACE:
        squared = p[Parameter.CUN] * u * n + p[Parameter.CNN] * n * n
        value[Node.C] = math.sqrt(max(squared, 0.0)) * inverse
        value[Node.THRUST] = thrust / p[Parameter.PROPELLER_MASS] * inverse * inverse
    force_x, force_y, moment_n, moment_k = hull_forces(shape, products, nodes, p, value)
    square = scale * scale
    force_x *= square
    force_y *= square
    moment_n = moment_n * square + p[Parameter.ORIGIN] * force_y
    moment_k *= square

    force_x += r * (p[Parameter.X_VR] * v + p[Parameter.X_RR] * r + p[Parameter.X_PR] * roll)
    force_y += r * (p[Parameter.Y_UR] * u + p[Parameter.Y_RR] * r)
    moment_n += u * (p[Parameter.N_UV] * v + p[Parameter.N_UR] * r)
    moment_k += p[Parameter.K_UR] * u * r - p[Parameter.K_PHI] * phi
    force_x += p[Parameter.X_CONSTANT] + p[Parameter.ONE_MINUS_T] * thrust

    if shape[Shape.RUDDER] != Inflow.NONE:
        sine, cosine = sine_and_cosine(delta)
        normal = rudder_normal_force(shape, p, v, r, speed, drift, flow, thrust, sine, cosine)
        force_x -= p[Parameter.ONE_MINUS_TR] * normal * sine
        lateral = normal * cosine
        force_y -= p[Parameter.ONE_PLUS_AH] * lateral
        moment_n -= p[Parameter.YAW_LEVER] * lateral
        moment_k += p[Parameter.ROLL_LEVER] * lateral
    if shape[Shape.STATIONS] > 0:
        drag, moment = cross_flow_drag(shape, tables, v, r)
        force_y += drag
        moment_n += moment
    if environment[WIND_AT] != 0.0:
        x, y, k, turning = wind_forces(environment, psi, u, v)
        force_x += x
        force_y += y
        moment_n += turning
        moment_k += k
    if environment[WAVES_AT] != 0.0:
        x, y, turning = wave_drift_forces(environment, psi)
        force_x += x
        force_y += y
        moment_n += turning

    rate[State.U] = p[Parameter.MASS_U] * force_x
    rate[State.V] = p[Parameter.MASS_V_V] * force_y + p[Parameter.MASS_V_R] * moment_n
    rate[State.R] = p[Parameter.MASS_R_V] * force_y + p[Parameter.MASS_R_R] * moment_n
    if shape[Shape.ROLL] == 1:
        rate[State.V] += p[Parameter.MASS_V_P] * moment_k
        rate[State.R] += p[Parameter.MASS_R_P] * moment_k
        rate[State.P] = (
            p[Parameter.MASS_P_V] * force_y + p[Parameter.MASS_P_R] * moment_n + p[Parameter.MASS_P_P] * moment_k
        )
    else:
        rate[State.P] = 0.0

    rate[State.INTEGRAL] = 0.0
    if (control[Control.KIND] == Order.ANGLE and p[Parameter.GEAR_LAG] == 0.0) or control[
        Control.KIND
    ] == Order.SCHEDULE:
        rate[State.DELTA] = control[Control.SLEW]
    else:
        steering_rate(state, control, p, rate)
    engine_rate(shape, p, control, n, flow, rate)


@compiled_for_python
def hull_forces(
    shape: np.ndarray, products: np.ndarray, nodes: np.ndarray, p: np.ndarray, value: np.ndarray
) -> tuple[float, float, float, float]:
    """Sums X, Y, N and K of the hull terms over the squared speed, from the variables in `value`."""
    value[Node.ONE] = 1.0
    for k in range(shape[Shape.PRODUCTS]):
        first = value[products[k, 0]]
        second = products[k, 1]
        value[NODES + k] = abs(first) if second < 0 else first * value[second]
    x = y = n = k_moment = 0.0
    for i in range(shape[Shape.X_END]):
        x += p[COEFFICIENTS + i] * value[nodes[i]]
    for i in range(shape[Shape.X_END], shape[Shape.Y_END]):
        y += p[COEFFICIENTS + i] * value[nodes[i]]
    for i in range(shape[Shape.Y_END], shape[Shape.N_END]):
        n += p[COEFFICIENTS + i] * value[nodes[i]]
    for i in range(shape[Shape.N_END], shape[Shape.K_END]):
        k_moment += p[COEFFICIENTS + i] * value[nodes[i]]
    return x, y, n, k_moment


@compiled
def cross_flow_drag(shape: np.ndarray, tables: np.ndarray, v: float, r: float) -> tuple[float, float]:
    """Y and N of the sectional drag."""
    force = moment = 0.0
    at = shape[Shape.CROSS_FLOW]
    for _ in range(shape[Shape.STATIONS]):
        x = tables[at]
        cross = v + x * r
        part = -tables[at + 1] * abs(cross) * cross
        force += part
        moment += x * part
        at += 2
    return force, moment


@compiled
def ordered_angle(state: np.ndarray, control: np.ndarray) -> tuple[float, float]:
    """Rudder angle that an autopilot wants, before the limit, and its error."""
    if control[Control.KIND] == Order.COURSE:
        error = control[Control.TARGET] - state[State.PSI]
        wanted = control[Control.PROPORTIONAL] * error - control[Control.DERIVATIVE] * state[State.R]
    elif control[Control.KIND] == Order.YAW_RATE:
        error = control[Control.TARGET] - state[State.R]
        wanted = control[Control.PROPORTIONAL] * error
    else:
        return control[Control.TARGET], 0.0
    return wanted + control[Control.INTEGRAL] * state[State.INTEGRAL], error


@compiled
def steering_rate(state: np.ndarray, control: np.ndarray, p: np.ndarray, rate: np.ndarray) -> None:
    """Rate of the rudder towards an order, limited; the integral of the error stands still at the limit."""
    wanted, error = ordered_angle(state, control)
    limit, fastest = p[Parameter.GEAR_LIMIT], p[Parameter.GEAR_RATE]
    order = min(max(wanted, -limit), limit)
    if order == wanted or wanted * error * control[Control.INTEGRAL] < 0.0:
        rate[State.INTEGRAL] = error
    lag = p[Parameter.GEAR_LAG]
    if lag == 0.0:
        lag = p[Parameter.GEAR_BAND] / fastest
    rate[State.DELTA] = min(max((order - state[State.DELTA]) / lag, -fastest), fastest)


@compiled
def engine_rate(
    shape: np.ndarray, p: np.ndarray, control: np.ndarray, n: float, flow: float, rate: np.ndarray
) -> None:
    """Rate of change of the propeller's rate."""
    drive = control[Control.ENGINE]
    if drive == Drive.CONSTANT:
        rate[State.N] = 0.0
    elif drive == Drive.LAGGED:
        rate[State.N] = (control[Control.RATE] - n) / p[Parameter.RATE_LAG]
    elif drive == Drive.TORQUE:
        rate[State.N] = (p[Parameter.TORQUE] - propeller_torque(p, n, flow)) / p[Parameter.SHAFT]
    else:
        rate[State.N] = control[Control.RATE]
