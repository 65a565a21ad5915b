"""How the functions of the kernel are compiled."""

from __future__ import annotations

from numba import njit

compiled = njit(cache=True, error_model="numpy", nogil=True, fastmath={"contract"}, _nrt=False)
"""Decorator of all functions that are called within the integration.

They allocate nothing, so their arrays need no reference counts (``_nrt``): counting would take half of the time. A
product and a sum may be rounded once (``contract``).
"""
