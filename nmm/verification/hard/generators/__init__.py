"""Classes of hard cases, one subject a file: each yields scenes with their oracles.

Oracles are in `oracles`.
"""
