"""towtank: captive tests to hydrodynamic derivatives, with uncertainty and conventions."""

__version__ = "0.1.0"
