"""Rules that no table can check by itself: names exist, and effects have what they need.

They work on unvalidated tables, so that their faults are reported together with those of values.
"""
