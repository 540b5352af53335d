"""The hard matrix: generated cases over every exchangeable part, with oracles that need no answer.

A class of hard cases is one module and one line in `nmm.verification.hard.running.registry`.
"""
