"""Scalar fields that spread along their slope: matrices, edges, joints and steps in time.

Temperature and water head are such fields; nothing here knows which.
"""
