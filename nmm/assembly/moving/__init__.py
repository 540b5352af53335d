"""Bodies that move: kinematics, motion by the unknowns of a step, their spin and momenta.

The state that moves is in `assembly.state`; velocities after a step are those of integrators.
"""
