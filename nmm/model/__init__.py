"""What compiles scene and formulation into what is solved.

Parts, covers, the model and the plan of effects. No step is taken here.
"""
