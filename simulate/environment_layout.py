"""Places in the flat array that holds an environment for the compiled right-hand side.

The array begins with a header of :data:`HEADER` numbers; a block of wind and a block of waves follow where they
act, each at the place that the header names (0 when it does not act)::

    header    0  current along x0, m/s         1  current along y0, m/s
              2  place of the wind block       3  place of the wave block
    wind      0  velocity of the air along x0  1  along y0, m/s
              2  angle table of X, Y, K, N over the squared relative wind speed, N s2/m2 and N s2/m
    waves     0  direction of travel from x0, rad
              1  HARMONIC_DRIFT or TABULATED_DRIFT
              2  harmonic: X over cos, Y over sin, N over sin, N over sin of twice the encounter angle, N and N m
                 tabulated: angle table of X, Y, N, in N and N m
    table     0  number of angles n
              1  n angles from 0 to pi, rad; then for each column n values and n slopes a radian
"""

from __future__ import annotations

CURRENT_X = 0
CURRENT_Y = 1
WIND_AT = 2
WAVES_AT = 3
HEADER = 4

WIND_TABLE = 2

WAVE_DIRECTION = 0
WAVE_KIND = 1
WAVE_DATA = 2

HARMONIC_DRIFT = 1.0
TABULATED_DRIFT = 2.0
