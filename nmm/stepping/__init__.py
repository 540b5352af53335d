"""Integrators, load control, the step loop and its verdicts."""
