"""Integrators, load control, the step loop and its verdicts.

How contact is solved within a step is in `contact`; integrators are in `integrators`.
"""
