"""How equilibrium under one load is sought: on the updated geometry, by relaxation; and evidence.

How loads grow from one to the next is decided in `drive`.
"""
