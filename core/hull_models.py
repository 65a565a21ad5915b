"""Hull-force models as lists of terms, by the name the field gives them."""

from __future__ import annotations

from .errors import TermError
from .terms import Term, parse_terms

_MMG_DRIFT = "R0 Xvv Xvvvv Yv Yvvv Nv Nvvv"
_MMG = "R0 Xvv Xvr Xrr Xvvvv Yv Yr Yvvv Yvvr Yvrr Yrrr Nv Nr Nvvv Nvvr Nvrr Nrrr"
_SWAY_YAW_INERTIA = "Yvdot Yrdot Nvdot Nrdot"

_MODELS: dict[str, tuple[str, str]] = {
    "mmg": ("MMG cubic (Yasukawa and Yoshimura 2015)", f"{_MMG} {_SWAY_YAW_INERTIA}"),
    "mmg-steady": ("MMG cubic without acceleration terms, for steady runs", _MMG),
    "mmg-drift": ("MMG terms that static drift determines", _MMG_DRIFT),
    "abkowitz": (
        "Abkowitz third order in sway and yaw, with surge perturbation",
        "X0 Xu Xuu Xvv Xrr Xvr Yv Yr Yvvv Yrrr Yvvr Yvrr Yvu Yru Nv Nr Nvvv Nrrr Nvvr Nvrr Nvu Nru "
        f"Xudot {_SWAY_YAW_INERTIA}",
    ),
    "modulus": (
        "second-order modulus (Fedyaevskiy and Sobolev 1964; Norrbin 1971)",
        f"R0 Xvv Xvr Xrr Yv Yr Yv|v| Yv|r| Yr|r| Nv Nr Nv|v| Nv|r| Nr|r| {_SWAY_YAW_INERTIA}",
    ),
    "inland": (
        "inland-ship limited-range form in the drift angle (MASHCON 2019, hull coefficients of inland ships)",
        "X0 Xbb Xbr Xrr Yb Yb|b| Yr Yrrr Ybbr Ybrr Nb Nb|b| Nr Nr|r| Nbbr Nbrr",
    ),
    "heel": (
        "MMG with heel terms (pure car carrier, MASHCON 2019)",
        "R0 Xvv Xvr Xvvvv Xvphi Xrphi Xphiphi Yv Yr Yvvv Yvvr Yphi Yvvphi Yvphiphi Yrphiphi Yrrphi "
        "Nv Nr Nvvv Nvvr Nphi Nvvphi Nvphiphi Nrphiphi Nrrphi",
    ),
    "bank": (
        "drift terms with bank-distance terms (pure car carrier near a bank, MASHCON 2019)",
        "R0 Xvv Xvvvv Xetaeta Xveta Yv Yvvv Yeta Yetaetaeta Yvveta Yvetaeta "
        "Nv Nvvv Neta Netaetaeta Nvveta Nvetaeta",
    ),
}

HULL_MODELS: dict[str, str] = {name: meaning for name, (meaning, _) in _MODELS.items()}
"""Name and meaning of each ready-made model."""


def hull_model(name: str) -> tuple[Term, ...]:
    """Terms of a ready-made model.

    Raises
    ------
    TermError
        For an unknown name, with the known ones.
    """
    try:
        return parse_terms(_MODELS[name][1].split())
    except KeyError:
        raise TermError(f"unknown hull model '{name}'", cure=f"use one of {', '.join(_MODELS)}") from None
