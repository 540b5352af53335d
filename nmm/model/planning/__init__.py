"""The effects of a scene as the step loop asks them: built, handed on to another model, summed."""
