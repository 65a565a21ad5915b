"""The vocabulary of the house: ships, conventions, records, terms, derivative sets, provenance, errors."""

from .conventions import HOME, Conventions
from .derivative_set import DerivativeSet
from .errors import TowtankError
from .findings import Finding
from .hull_models import HULL_MODELS, hull_model
from .provenance import Provenance
from .record import Record
from .ship import Ship
from .terms import Term

__all__ = [
    "HOME",
    "HULL_MODELS",
    "Conventions",
    "DerivativeSet",
    "Finding",
    "Provenance",
    "Record",
    "Ship",
    "Term",
    "TowtankError",
    "hull_model",
]
