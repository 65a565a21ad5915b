"""Squat: from sinkage and trim records to squat curves, scores of predictions, and empirical formulas."""
