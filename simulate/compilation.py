"""How the functions of the kernel are compiled."""

from __future__ import annotations

from typing import Any

from numba import njit

_CHOICES: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}, "_nrt": False}
"""Nothing is allocated, so arrays need no reference counts (``_nrt``): counting would take half of the time. A product
and a sum may be rounded once (``contract``)."""

# Options that numba takes and does not declare.
_INNER: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}

compiled = njit(**_CHOICES, **_INNER)
"""Decorator of functions that other compiled functions call, and nothing else.

They have no entry for Python, which would take as long to compile as many of them: a call from Python ends the process.
Each is compiled into its callers, whose code alone is kept on disk.
"""

compiled_for_python = njit(**_CHOICES, cache=True, nogil=True)
"""Decorator of functions that Python calls too."""
