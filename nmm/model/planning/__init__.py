"""The effects of a scene as the step loop uses them: built, carried to other models, summed.

No step.
"""
