"""What is there before anything moves: velocities and stress.

A start in equilibrium is sought in `stepping.drive`.
"""
